//! Base and apex of a blade.
//!
//! Places are in lengths of the midrib: the base is the origin, the apex (0, 1).

use glam::DVec2;

use crate::document::Declared;
use crate::not_grown::{NotGrown, not_grown};
use crate::numeric::{bisect, smooth_step};
use crate::shape::tips::{Point, Tip};

/// The base of a blade. Lengths are shares of the leaf's.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub enum BaseShape {
    /// A sinus at the petiole.
    Cordate {
        /// How far lobes reach below the petiole, as a share of the length.
        #[key("depth", 0.005..=0.5, default = 0.08)]
        depth: f64,
        /// Width of the sinus at the ends of the lobes.
        #[key("width", 0.02..=2.0, default = 0.3)]
        width: f64,
    },
    /// A wedge.
    ///
    /// The margin rises from the petiole in nearly straight lines.
    Cuneate {
        /// By how much the margin is raised at the upper end of the wedge.
        #[key("height", 0.005..=0.4, default = 0.1)]
        height: f64,
        /// Width of the wedge at its upper end.
        #[key("width", 0.02..=2.0, default = 0.3)]
        width: f64,
    },
    /// The petiole is attached inside the blade.
    Peltate {
        /// How far the blade reaches below the petiole.
        #[key("inset", 0.005..=0.5, default = 0.2)]
        inset: f64,
    },
}

/// The apex of a blade. Lengths are shares of the leaf's.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub enum ApexShape {
    /// Drawn out into a drip tip.
    Acuminate {
        /// Length of the tip, as a share of the leaf's.
        #[key("length", 0.02..=0.6, default = 0.15)]
        length: f64,
        /// Share by which its end is narrower than the contour's.
        #[key("narrowing", 0.05..=0.95, default = 0.6)]
        narrowing: f64,
    },
    /// A notch.
    Emarginate {
        /// How far the apex lies below the ends beside it, as a share of the length.
        #[key("depth", 0.05..=0.4, default = 0.08)]
        depth: f64,
        /// Width of the notch between these ends.
        #[key("width", 0.02..=2.0, default = 0.3)]
        width: f64,
    },
    /// A shallow notch.
    Retuse {
        /// How far the apex lies below the ends beside it, as a share of the length.
        #[key("depth", 0.002..=0.05, default = 0.02)]
        depth: f64,
        /// Width of the notch between these ends.
        #[key("width", 0.02..=2.0, default = 0.2)]
        width: f64,
    },
    /// A short point, in which the midrib ends.
    Mucronate(Point),
}

/// Up to where along the midrib the lower part of a blade is stretched or compressed.
const BASE_REACH: f64 = 0.4;

impl BaseShape {
    pub(super) fn shape(self, points: &mut [DVec2]) -> Result<(), NotGrown> {
        match self {
            Self::Cordate { depth, width } => {
                let there = -points.iter().map(|p| p.y).fold(0.0, f64::min);
                if there >= depth {
                    let error = not_grown!(
                        "a cordate base of depth {depth} needs a contour that reaches less far \
                         below the petiole: this one goes {there:.3} below it"
                    );
                    let help = "ask for a deeper sinus, or leave the base to the contour";
                    return Err(error.mend("base.cordate.depth", help));
                }
                // Each place falls the farther the larger the amplitude; all stay in order.
                let fall = |p: DVec2| smooth_step(2.0 * p.x.abs() / width) * low(p.y, BASE_REACH);
                let amplitude = amplitude_for(depth, |amplitude| {
                    let lowest = points.iter().map(|&p| p.y - amplitude * fall(p));
                    -lowest.fold(0.0, f64::min)
                });
                let amplitude = amplitude.ok_or_else(|| {
                    let error = too_pointed("a cordate base", depth, "base");
                    let help =
                        "ask for a shallower or wider sinus, or a contour with a rounder base";
                    error.mend("base.cordate.depth", help)
                })?;
                for p in points {
                    p.y -= amplitude * fall(*p);
                }
            }
            Self::Cuneate { height, width } => {
                // What is above gives way by less than it is high, so all places stay in order.
                let reach = BASE_REACH.max(2.2 * height).min(0.95);
                for p in points {
                    let aside = (2.0 * p.x.abs() / width).min(1.0);
                    p.y += height * aside * low(p.y, reach);
                }
            }
            Self::Peltate { inset } => {
                for p in points {
                    p.y -= inset * low(p.y, 0.8);
                }
            }
        }
        Ok(())
    }
}

impl ApexShape {
    /// The tip that it is, if it is one.
    pub(super) fn tip(self) -> Option<Tip> {
        match self {
            Self::Mucronate(point) => Some(Tip::Mucro(point)),
            Self::Acuminate { .. } | Self::Emarginate { .. } | Self::Retuse { .. } => None,
        }
    }

    pub(super) fn shape(self, points: &mut [DVec2]) -> Result<(), NotGrown> {
        match self {
            Self::Acuminate { length, narrowing } => {
                for p in points {
                    let below = (1.0 - p.y) / length;
                    if below >= 1.0 {
                        continue;
                    }
                    // Lobes beside the apex stay where they are.
                    let aside = (p.x / (3.0 * length)).abs().min(1.0);
                    let near = (1.0 - aside * aside) * (1.0 - aside * aside);
                    p.x *= 1.0 - narrowing * (1.0 - smooth_step(below)) * near;
                }
                Ok(())
            }
            Self::Emarginate { depth, width } => {
                notched(points, depth, width, "an emarginate apex")
            }
            Self::Retuse { depth, width } => notched(points, depth, width, "a retuse apex"),
            Self::Mucronate(_) => Ok(()),
        }
    }
}

/// The error of a contour whose end is too pointed.
fn too_pointed(what: &str, depth: f64, end: &str) -> NotGrown {
    not_grown!("{what} of depth {depth} does not fit this contour, whose {end} is too pointed")
}

/// Raises what is beside the apex, so that it lies in a notch.
fn notched(
    points: &mut [DVec2],
    depth: f64,
    width: f64,
    what: &'static str,
) -> Result<(), NotGrown> {
    let too_pointed = || {
        let help = "ask for a shallower or wider notch, or a contour with a rounder apex";
        too_pointed(what, depth, "apex").mend("apex.*.depth", help)
    };
    let rise = |p: DVec2| smooth_step(2.0 * p.x.abs() / width) * low(1.0 - p.y, 0.4);
    let there = points.iter().map(|p| p.y - 1.0).fold(0.0, f64::max);
    if there >= depth {
        return Err(too_pointed());
    }
    let amplitude = amplitude_for(depth, |amplitude| {
        let highest = points.iter().map(|&p| p.y - 1.0 + amplitude * rise(p));
        highest.fold(0.0, f64::max)
    });
    let amplitude = amplitude.ok_or_else(too_pointed)?;
    for p in points {
        p.y += amplitude * rise(*p);
    }
    Ok(())
}

/// Lowers the right half of the blade and raises the left, by `offset` together.
pub(super) fn lower_right(points: &mut [DVec2], offset: f64) {
    for p in points {
        let aside = smooth_step(p.x.abs() / 0.15).copysign(p.x);
        p.y -= 0.5 * offset * aside * low(p.y, 0.6);
    }
}

/// 1 at and below the base, falling to 0 at `reach`.
fn low(y: f64, reach: f64) -> f64 {
    1.0 - smooth_step(y / reach)
}

/// The amplitude at which a depth that rises with it, and is 0 without, is the one wanted; none if
/// it had to be so great that the contour would no longer be itself.
fn amplitude_for(wanted: f64, depth: impl Fn(f64) -> f64) -> Option<f64> {
    let most = 2.0 * wanted + 0.15;
    (depth(most) >= wanted).then(|| bisect(0.0, most, 60, |amplitude| depth(amplitude) < wanted).1)
}
