//! What ends a tooth, a lobe or a blade: a gland, a mucro or an awn.
//!
//! - **In**: a closed polygon and some of its corners.
//! - **Out**: the polygon with those corners replaced by small ends of their own, and where the
//!   glands among them are.

use glam::DVec2;

use crate::document::Declared;
use crate::optics::contents_keys::changed_contents;
use crate::optics::{Constituent, Contents};

/// The end of a tooth, a lobe or a blade. Lengths are shares of the midrib's length.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub enum Tip {
    /// A knob.
    ///
    /// As that on the teeth of cherries and willows.
    Gland(Gland),
    /// A short point, set off.
    Mucro(Point),
    /// A bristle.
    ///
    /// As that on the lobes of red oaks: as wide as a hair but at its foot.
    Awn(Point),
}

/// A knob that stands on a corner, of tissue of its own.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Gland {
    /// Its diameter, as a share of the leaf's length.
    #[key("diameter", 1e-4..=0.05)]
    pub diameter: f64,
    /// What it holds.
    #[key("contents", block, with = changed_contents)]
    pub contents: Contents,
}

impl Default for Tip {
    fn default() -> Self {
        Self::Mucro(Point::default())
    }
}

impl Default for Gland {
    /// A small dark one: dense tissue with little chlorophyll, anthocyanins in its epidermis and
    /// some that has browned. By eye.
    fn default() -> Self {
        Self {
            diameter: 0.004,
            contents: Contents::of(&[
                (Constituent::Structure, 2.0),
                (Constituent::Chlorophyll, 6.0),
                (Constituent::Carotenoids, 4.0),
                (Constituent::Anthocyanins, 20.0),
                (Constituent::Brown, 0.5),
                (Constituent::Water, 0.02),
                (Constituent::DryMatter, 0.012),
            ]),
        }
    }
}

/// A gland on a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knob {
    /// Its middle, mm.
    pub centre: DVec2,
    /// mm.
    pub radius: f64,
    /// The two corners of the margin between which it stands.
    pub feet: [DVec2; 2],
    /// What it holds.
    pub contents: Contents,
}

impl Knob {
    /// The gland after its margin has been moved and scaled.
    pub(super) fn moved(&self, image: impl Fn(DVec2) -> DVec2, factor: f64) -> Self {
        Self {
            centre: image(self.centre),
            radius: self.radius * factor,
            feet: self.feet.map(image),
            contents: self.contents,
        }
    }
}

/// A point that stands on a corner.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Point {
    /// How far it stands out, as a share of the leaf's length.
    #[key("length", 1e-4..=0.2)]
    pub length: f64,
    /// Width of its foot, likewise.
    #[key("width", 1e-4..=0.1)]
    pub width: f64,
}

impl Default for Point {
    /// One that is just seen.
    fn default() -> Self {
        Self {
            length: 0.01,
            width: 0.004,
        }
    }
}

/// Edges of a knob.
const KNOB_EDGES: u32 = 10;

impl Tip {
    /// Width of the foot, as a share.
    fn foot(&self) -> f64 {
        match *self {
            Self::Gland(gland) => 0.7 * gland.diameter,
            Self::Mucro(point) | Self::Awn(point) => point.width,
        }
    }

    /// The corners from one side of the foot to the other, both left out; the tip points `ahead`.
    fn corners(&self, feet: [DVec2; 2], corner: DVec2, ahead: DVec2, length: f64) -> Vec<DVec2> {
        let middle = (feet[0] + feet[1]) * 0.5;
        let across = (feet[1] - feet[0]) * 0.5;
        match *self {
            Self::Gland(gland) => {
                let Knob { centre, radius, .. } = gland.knob(feet, ahead, length);
                let half = across.length().min(0.95 * radius);
                let side = across.normalize_or_zero();
                // From the foot all round to the foot.
                let start = libm::asin(half / radius);
                let sweep = std::f64::consts::TAU - 2.0 * start;
                // The ends are the feet themselves.
                (1..KNOB_EDGES)
                    .map(|i| {
                        let angle = start + sweep * f64::from(i) / f64::from(KNOB_EDGES);
                        let (sin, cos) = libm::sincos(angle);
                        centre - ahead * (radius * cos) - side * (radius * sin)
                    })
                    .collect()
            }
            Self::Mucro(point) => vec![corner + ahead * (point.length * length)],
            Self::Awn(point) => {
                let end = corner + ahead * (point.length * length);
                let near = middle.lerp(end, 0.3);
                vec![near - across * 0.4, end, near + across * 0.4]
            }
        }
    }
}

impl Gland {
    /// The gland between two feet; it points `ahead`.
    fn knob(&self, feet: [DVec2; 2], ahead: DVec2, length: f64) -> Knob {
        let radius = 0.5 * self.diameter * length;
        let half = (0.5 * feet[0].distance(feet[1])).min(0.95 * radius);
        let middle = (feet[0] + feet[1]) * 0.5;
        Knob {
            centre: middle + ahead * (radius * radius - half * half).sqrt(),
            radius,
            feet,
            contents: self.contents,
        }
    }
}

/// A closed counter-clockwise polygon with tips on some of its corners; `length` is that of the
/// midrib. A foot takes no more than a third of the way to the next tip. Gives the glands too.
pub(super) fn with_tips(
    polygon: &[DVec2],
    tips: &[(usize, Tip)],
    length: f64,
) -> (Vec<DVec2>, Vec<Knob>) {
    let n = polygon.len();
    let at = |i: usize| polygon[i % n];
    // Lengths along the polygon, twice around.
    let mut along = vec![0.0];
    for i in 0..2 * n {
        along.push(along[i] + at(i).distance(at(i + 1)));
    }
    let round = along[n];
    let mut sorted = tips.to_vec();
    sorted.sort_by_key(|(i, _)| *i);
    sorted.dedup_by_key(|(i, _)| *i);
    // What is cut out, as lengths from and to, and what comes instead.
    let mut cuts: Vec<([f64; 2], Vec<DVec2>)> = Vec::new();
    let mut knobs = Vec::new();
    let place = |s: f64| {
        let s = s.rem_euclid(round);
        let i = along.partition_point(|&a| a <= s).clamp(1, n) - 1;
        let share = (s - along[i]) / (along[i + 1] - along[i]).max(f64::MIN_POSITIVE);
        at(i).lerp(at(i + 1), share.min(1.0))
    };
    for (k, &(i, tip)) in sorted.iter().enumerate() {
        let here = along[i];
        let gap = |other: usize| {
            let away = (along[other] - here).rem_euclid(round);
            away.min(round - away)
        };
        let count = sorted.len();
        let nearest = [(k + 1) % count, (k + count - 1) % count]
            .into_iter()
            .filter(|&other| other != k)
            .map(|other| gap(sorted[other].0))
            .fold(round, f64::min);
        let mut reach = 0.5 * tip.foot() * length;
        // On a sharp corner the foot lies farther back to be as wide.
        let [back, fore] = [place(here - reach) - at(i), place(here + reach) - at(i)];
        let half = 0.5 * (back - fore).length();
        if half > 0.0 {
            reach = (reach * reach / half).min(6.0 * reach);
        }
        reach = reach.min(nearest / 3.0).min(round / 8.0);
        let feet = [place(here - reach), place(here + reach)];
        // Outward of a counter-clockwise polygon is to the right of its direction.
        let outward = -(feet[1] - feet[0]).perp().normalize_or_zero();
        let bisector = (at(i) - (feet[0] + feet[1]) * 0.5).normalize_or(outward);
        let ahead = if bisector.dot(outward) > 0.0 {
            bisector
        } else {
            outward
        };
        if let Tip::Gland(gland) = tip {
            knobs.push(gland.knob(feet, ahead, length));
        }
        let mut instead = vec![feet[0]];
        instead.extend(tip.corners(feet, at(i), ahead, length));
        instead.push(feet[1]);
        cuts.push(([here - reach, here + reach], instead));
    }
    let mut points = Vec::with_capacity(n + 4 * cuts.len());
    for (i, &here) in along[..n].iter().enumerate() {
        for ([from, to], instead) in &cuts {
            let middle = 0.5 * (from + to);
            if (middle - here).abs() < 1e-12 * round {
                points.extend(instead.iter().copied());
            }
        }
        let is_cut = cuts.iter().any(|([from, to], _)| {
            [here - round, here, here + round]
                .iter()
                .any(|s| (*from..=*to).contains(s))
        });
        if !is_cut {
            points.push(at(i));
        }
    }
    (points, knobs)
}

/// Corners of a closed counter-clockwise polygon that stand out and turn by more than 50°: the ends
/// of pointed lobes.
pub(super) fn lobe_corners(polygon: &[DVec2]) -> Vec<usize> {
    let n = polygon.len();
    let least = 50.0_f64.to_radians();
    (0..n)
        .filter(|&i| {
            let [before, here, after] = [n - 1, 0, 1].map(|k| polygon[(i + k) % n]);
            let (into, out) = (here - before, after - here);
            libm::atan2(into.perp_dot(out), into.dot(out)) > least
        })
        .collect()
}
