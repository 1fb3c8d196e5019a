//! The start, control and end points of veins.
//!
//! Leaf units: x along the midrib from 0 at the base to 1 at the apex, y across it, positive on the
//! left, which is the upper side in the article.

use glam::DVec2;

use super::cell_noise::cell_noise;
use super::plan::ArcuatePlan;
use super::spline::Quadratic;
use crate::plane::{polygon, polyline};
use crate::shape::cubic::Cubic;
use crate::shape::outline::Outline;

/// A vein as a spline in leaf units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vein {
    pub(super) curve: Quadratic,
    /// Number of the axis from which it starts, and the parameter there; both are 0 for the midrib.
    pub(super) axis: usize,
    pub(super) start: f64,
}

/// The map from leaf units to millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    base: DVec2,
    midrib: DVec2,
}

impl Frame {
    /// The frame with its base at the origin and the midrib along +y.
    pub(super) fn upright(length_mm: f64) -> Self {
        Self {
            base: DVec2::ZERO,
            midrib: DVec2::new(0.0, length_mm),
        }
    }

    pub(super) fn of(outline: &Outline) -> Self {
        Self {
            base: outline.base(),
            midrib: outline.apex() - outline.base(),
        }
    }

    pub(super) fn to_mm(self, p: DVec2) -> DVec2 {
        self.base + self.midrib * p.x + self.midrib.perp() * p.y
    }

    pub(super) fn to_leaf(self, p: DVec2) -> DVec2 {
        let off = p - self.base;
        DVec2::new(self.midrib.dot(off), self.midrib.perp_dot(off)) / self.midrib.length_squared()
    }

    /// Length of the midrib, mm.
    pub(super) fn length(self) -> f64 {
        self.midrib.length()
    }
}

/// A polyline with a parameter from 0 to 1 at each point.
#[derive(Clone, Debug)]
pub(super) struct Line {
    points: Vec<DVec2>,
    shares: Vec<f64>,
}

impl Line {
    fn at(&self, t: f64) -> DVec2 {
        let (i, share) = polyline::piece(&self.shares, t);
        self.points[i - 1].lerp(self.points[i], share.clamp(0.0, 1.0))
    }

    /// A line parametrised by arc length.
    fn by_length(points: Vec<DVec2>) -> Self {
        let walked = polyline::lengths(&points);
        let all = walked[walked.len() - 1];
        Self {
            points,
            shares: walked.into_iter().map(|w| w / all).collect(),
        }
    }
}

/// The two sides of a margin, from base to apex.
#[derive(Clone, Debug)]
pub(super) enum Sides {
    /// The article's spline on the left and its mirror image.
    Cubic(Cubic),
    /// Any two lines, left and right.
    Lines([Line; 2]),
}

impl Sides {
    /// A left side at even steps of its parameter, and its mirror image.
    pub(super) fn mirrored(points: Vec<DVec2>) -> Self {
        let last = (points.len() - 1) as f64;
        let shares: Vec<f64> = (0..points.len()).map(|i| i as f64 / last).collect();
        let right = points.iter().map(|p| DVec2::new(p.x, -p.y)).collect();
        let left = Line {
            points,
            shares: shares.clone(),
        };
        Self::Lines([
            left,
            Line {
                points: right,
                shares,
            },
        ])
    }

    /// The two parts of a margin between the places nearest to the ends of the midrib.
    pub(super) fn of(outline: &Outline, frame: Frame) -> Self {
        let points = outline.points();
        let n = points.len();
        let [base, apex] =
            [outline.base(), outline.apex()].map(|end| polygon::nearest(points, end));
        let (start, end) = (base.at, apex.at);
        let (base, apex) = (base.edge, apex.edge);
        // Counter-clockwise from the base is the right side.
        let walk = |from: usize, first: DVec2, to: usize, last: DVec2| {
            let mut way = vec![first];
            // If both lie on one edge, the walk is direct if the end lies ahead, else it goes all
            // the way round.
            let ahead =
                (last - points[from]).length_squared() >= (first - points[from]).length_squared();
            if from != to || !ahead {
                let mut corner = (from + 1) % n;
                loop {
                    way.push(points[corner]);
                    if corner == to {
                        break;
                    }
                    corner = (corner + 1) % n;
                }
            }
            way.push(last);
            way.into_iter()
                .map(|p| frame.to_leaf(p))
                .collect::<Vec<_>>()
        };
        let right = walk(base, start, apex, end);
        let mut left = walk(apex, end, base, start);
        left.reverse();
        Self::Lines([Line::by_length(left), Line::by_length(right)])
    }

    /// The point at `t` on the left (`up`) or right side.
    fn at(&self, up: bool, t: f64) -> DVec2 {
        match self {
            Self::Cubic(cubic) => {
                let p = cubic.at(t);
                if up { p } else { DVec2::new(p.x, -p.y) }
            }
            Self::Lines([left, right]) => if up { left } else { right }.at(t),
        }
    }
}

/// Number of places of a primary that are tested to lie on the blade.
const CHECKS: u32 = 24;

/// The lowest of a row of starting points along the midrib that fits; the base if none does.
fn first_start(fits: impl Fn(f64) -> bool) -> f64 {
    let mut starts = (0..40).map(|i| f64::from(i) / 80.0);
    starts.find(|&start| fits(start)).unwrap_or(0.0)
}

/// A primary from the midrib to a point of the margin.
fn primary(start: f64, tip: DVec2, up: bool, bow: f64) -> Quadratic {
    let from = DVec2::new(start, 0.0);
    let chord = tip - from;
    let outwards = if up { chord.perp() } else { -chord.perp() };
    Quadratic([from, from + (chord + outwards * bow) * 0.5, tip])
}

/// The part of one side of the margin that the laterals of one axis reach.
struct Sector {
    axis: usize,
    up: bool,
    /// Parameters of the margin that correspond to the base and to the tip of the axis.
    margin: [f64; 2],
    /// Whether the sector is on the article's upper side, where its formula for variation has one
    /// more term.
    upper: bool,
}

/// The midrib, the primaries, and the laterals of all. Primaries start at the base, or as far up
/// the midrib as is needed for them to lie on the blade.
pub(super) fn lay_out(
    plan: &ArcuatePlan,
    sides: &Sides,
    on_blade: &dyn Fn(DVec2) -> bool,
) -> (Vec<Vein>, Vec<Vein>) {
    let mut axes = vec![Vein {
        curve: Quadratic::line(DVec2::ZERO, DVec2::X),
        axis: 0,
        start: 0.0,
    }];
    // The margin up to this parameter belongs to primaries already dealt with.
    let mut lower = 0.0;
    let mut sectors = Vec::new();
    if let Some(palmate) = &plan.palmate {
        let count = palmate.per_side;
        let end = |k: u32| 1.0 - palmate.spread * (1.0 - f64::from(k) / f64::from(count + 1));
        for k in 1..=count {
            // Neighbouring primaries share the margin between their ends equally.
            let upper = 0.5 * (end(k) + end(k + 1));
            let start = first_start(|start| {
                [true, false].into_iter().all(|up| {
                    let curve = primary(start, sides.at(up, end(k)), up, palmate.bow);
                    (1..CHECKS).all(|i| on_blade(curve.at(f64::from(i) / f64::from(CHECKS))))
                })
            });
            for up in [true, false] {
                let axis = axes.len();
                axes.push(Vein {
                    curve: primary(start, sides.at(up, end(k)), up, palmate.bow),
                    axis: 0,
                    start,
                });
                let sector = |from: f64, outer: bool| Sector {
                    axis,
                    up,
                    margin: [from, end(k)],
                    upper: outer,
                };
                sectors.extend([sector(lower, true), sector(upper, false)]);
            }
            lower = upper;
        }
    }
    let midrib = |up: bool| Sector {
        axis: 0,
        up,
        margin: [lower, 1.0],
        upper: up,
    };
    let mut laterals = Vec::new();
    for i in 0..plan.veins {
        for sector in [midrib(true), midrib(false)] {
            laterals.push(lateral(plan, sides, &axes, &sector, i));
        }
    }
    for sector in &sectors {
        laterals.extend((0..plan.veins).map(|i| lateral(plan, sides, &axes, sector, i)));
    }
    (axes, laterals)
}

/// Lateral `i` of a sector, by the article's formulas. For the midrib alone, the sector is the
/// whole side, as in the article.
fn lateral(plan: &ArcuatePlan, sides: &Sides, axes: &[Vein], sector: &Sector, i: u32) -> Vein {
    let delta = 1.0 / f64::from(plan.veins + 1);
    let half = delta / 2.0;
    // The article has only one axis. Other axes use seeds far from its own.
    let first = plan.seed.wrapping_add(1000 * sector.axis as u32);
    let noise = |offset: u32| cell_noise(first.wrapping_add(i + offset));
    let at = f64::from(i) * delta;
    let mut start = half + (at + half * plan.variation * noise(10)) * plan.squish3;
    if sector.upper {
        start += delta / 4.0 * plan.variation * noise(17) * plan.squish3;
    }
    let [from, to] = sector.margin;
    // Where primaries share the margin, the lower part of an axis bears no laterals. A midrib alone
    // has no such part.
    let bare = 0.5 * from.min(to) / from.max(to);
    let start = bare + (1.0 - bare) * start;
    let margin = |squish: f64| {
        let t = (at + half) * squish + 1.0 - squish;
        sides.at(sector.up, from + (to - from) * t)
    };
    let axis = axes[sector.axis].curve;
    let chord = axis.0[2] - axis.0[0];
    let above = margin(plan.squish2);
    let foot = axis.0[0] + chord * ((above - axis.0[0]).dot(chord) / chord.length_squared());
    Vein {
        curve: Quadratic([
            axis.at(start),
            foot + (above - foot) * plan.up,
            margin(plan.squish),
        ]),
        axis: sector.axis,
        start,
    }
}

/// Veins laid out on a blade.
#[derive(Clone, Debug, PartialEq)]
pub struct ArcuateVeins {
    pub(super) frame: Frame,
    pub(super) plan: ArcuatePlan,
    /// Midrib first, then the primaries beside it.
    pub(super) axes: Vec<Vein>,
    /// In the order of the article's code: from base to tip, upper side before lower side.
    pub(super) laterals: Vec<Vein>,
}

impl ArcuateVeins {
    /// Number of lateral veins of both sides.
    #[cfg(test)]
    pub(crate) fn laterals(&self) -> usize {
        self.laterals.len()
    }

    /// Start, control and end point of a lateral, mm. Laterals of the midrib come first, from base
    /// to tip, left before right.
    #[cfg(test)]
    pub(crate) fn lateral(&self, index: usize) -> Option<[DVec2; 3]> {
        let vein = self.laterals.get(index)?;
        Some(vein.curve.0.map(|p| self.frame.to_mm(p)))
    }
}
