//! Tears: rips that run from the margin inwards between the larger veins.
//!
//! A tear begins anywhere on the margin and follows the direction of the veins beside it, since a
//! blade rips most easily along them; it stops before a larger vein stands across its way. Its two
//! lips gape: the cut is a narrow wedge. They have come out of the plane, one towards the adaxial
//! side, the other away from it, as those of a sheet that was torn by shear.

use glam::DVec2;

use super::places::{Places, TRIES};
use crate::plane::segment;
use crate::shape::outline::Outline;

/// Steps of a rip.
const STEPS: usize = 48;
/// A rip that is stopped before this share of its length is none.
const LEAST: f64 = 0.4;
/// Rips keep this share of the leaf's length away from base, apex and primaries.
const AWAY: f64 = 0.03;
/// The lips are out of the plane up to this share of the tear's length beside it.
const REACH: f64 = 0.35;
/// Least cosine between a rip's first direction and the way straight inwards.
const INWARD: f64 = 0.35;

/// A rip in a blade.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tear {
    /// From the margin to its end, mm.
    path: Vec<DVec2>,
    /// Length up to each place, from the end, over all of it.
    shares: Vec<f64>,
    /// mm.
    length: f64,
    /// Height of the lip on the left of the path at the margin, mm; the other is as low.
    lift: f64,
}

impl Tear {
    fn new(path: Vec<DVec2>, lift: f64) -> Self {
        let mut shares = vec![0.0; path.len()];
        for i in (0..path.len() - 1).rev() {
            shares[i] = shares[i + 1] + path[i].distance(path[i + 1]);
        }
        let length = shares[0];
        for share in &mut shares {
            *share /= length;
        }
        Self {
            path,
            shares,
            length,
            lift: lift * length,
        }
    }

    /// Height of the blade at a flat point above the plane that it had, mm: the lips' at the tear,
    /// none at its end and beyond [`REACH`].
    pub(super) fn height(&self, p: DVec2) -> f64 {
        let reach = REACH * self.length;
        let mut nearest = (reach, 0.0, 0.0);
        for (i, pair) in self.path.windows(2).enumerate() {
            let way = pair[1] - pair[0];
            let along = segment::share(pair[0], pair[1], p);
            let foot = pair[0] + way * along;
            let away = foot.distance(p);
            if away < nearest.0 {
                let share = self.shares[i] + (self.shares[i + 1] - self.shares[i]) * along;
                // Beyond the mouth the side changes smoothly.
                let side = way.perp_dot(p - foot) / (way.length() * away.max(1e-12));
                let side = if along > 0.0 { side.signum() } else { side };
                nearest = (away, share, side);
            }
        }
        let (away, share, side) = nearest;
        let fall = 1.0 - away / reach;
        self.lift * side * share * share * fall * fall
    }
}

#[cfg(test)]
impl Tear {
    /// mm.
    pub(super) fn length(&self) -> f64 {
        self.length
    }

    /// Its place on the margin, and the direction inwards.
    pub(super) fn mouth(&self) -> (DVec2, DVec2) {
        let way = self.path[1] - self.path[0];
        (self.path[0], way.normalize_or_zero())
    }

    /// Whether it crosses a piece of vein.
    pub(super) fn crosses(&self, from: DVec2, to: DVec2) -> bool {
        let mut pieces = self.path.windows(2);
        pieces.any(|pair| segment::cross(pair[0], pair[1], from, to))
    }
}

impl Places<'_> {
    /// Tears, and the margin with them in it; `gape` is the width of their mouths and `lift` the
    /// height of their lips over their length. Gives the edges too.
    pub(super) fn tears(
        &mut self,
        bitten: &mut Outline,
        count: u32,
        median_mm: f64,
        [gape, lift]: [f64; 2],
    ) -> (Vec<Tear>, Vec<Vec<DVec2>>) {
        let mut tears = Vec::new();
        let mut edges = Vec::new();
        for _ in 0..count {
            let length = self.size(median_mm);
            let turned = if self.number() < 0.5 { lift } else { -lift };
            let found = (0..TRIES).find_map(|_| {
                let along = self.number();
                let start = on_margin(bitten, along);
                let path = self.rip(bitten, start, length)?;
                let tear = Tear::new(path, turned);
                let (margin, edge) = cut(bitten, along, &tear, gape)?;
                Some((tear, margin, edge))
            });
            let Some((tear, margin, edge)) = found else {
                continue;
            };
            *bitten = margin;
            let half = 0.5 * gape * tear.length;
            for (p, share) in tear.path.iter().zip(&tear.shares) {
                self.eat(*p, (half * share).max(1.5 * tear.length / STEPS as f64));
            }
            edges.push(edge);
            tears.push(tear);
        }
        (tears, edges)
    }

    /// The way of a rip from a place of the margin, if there is one.
    fn rip(&mut self, blade: &Outline, start: (DVec2, DVec2), length: f64) -> Option<Vec<DVec2>> {
        let (at, inward) = start;
        let away = AWAY * blade.length();
        let ends = [blade.base(), blade.apex()];
        if ends.iter().any(|end| end.distance(at) < 2.0 * away) {
            return None;
        }
        let step = length / STEPS as f64;
        let mut heading = self.grain(at)?;
        if heading.dot(inward) < 0.0 {
            heading = -heading;
        }
        if heading.dot(inward) < INWARD {
            return None;
        }
        let mut path = vec![at];
        let mut wander = 0.0;
        for _ in 0..STEPS {
            let from = path[path.len() - 1];
            let grain = self.grain(from)?;
            let grain = if grain.dot(heading) < 0.0 {
                -grain
            } else {
                grain
            };
            heading = (heading + 0.35 * grain).normalize_or(heading);
            // A rip wanders, and its edge is rough.
            wander = 0.85 * wander + 0.1 * (2.0 * self.number() - 1.0);
            let rough = 0.5 * (2.0 * self.number() - 1.0);
            let (sin, cos) = libm::sincos(wander + rough);
            let p = from + DVec2::new(cos, sin).rotate(heading) * step;
            let is_free = blade.contains(p)
                && blade.distance_to_margin(p) > 0.5 * step
                && self.is_clear_of_veins(p, 0.7 * step, away)
                && self.is_uneaten(p, 2.0 * step);
            if !is_free {
                break;
            }
            path.push(p);
        }
        (path.len() as f64 > LEAST * STEPS as f64).then_some(path)
    }
}

/// The place at a share of a margin, and the direction inwards there, without its teeth.
fn on_margin(outline: &Outline, along: f64) -> (DVec2, DVec2) {
    let at = |share: f64| at_share(outline, share).1;
    let way = at(along + 0.01) - at(along - 0.01);
    (at(along), way.perp().normalize_or_zero())
}

/// The side of a margin that holds the place at a share of its length, and the place.
fn at_share(outline: &Outline, share: f64) -> (usize, DVec2) {
    let points = outline.points();
    let n = points.len();
    let mut left = share.rem_euclid(1.0) * outline.perimeter();
    for i in 0..n {
        let (a, b) = (points[i], points[(i + 1) % n]);
        let side = a.distance(b);
        if left <= side {
            return (i, a.lerp(b, left / side));
        }
        left -= side;
    }
    (n - 1, points[0])
}

/// The margin with a tear cut into it at a share of its length, and the tear's edge; none if that
/// leaves no margin.
fn cut(outline: &Outline, along: f64, tear: &Tear, gape: f64) -> Option<(Outline, Vec<DVec2>)> {
    let points = outline.points();
    let n = points.len();
    let half = 0.5 * gape * tear.length / outline.perimeter();
    // The mouth reaches as far along the margin as it is wide.
    let (before, first) = at_share(outline, along - half);
    let (after, last) = at_share(outline, along + half);
    let lip = |side: f64| {
        let inner = 1..tear.path.len() - 1;
        inner.map(move |i| {
            let way = (tear.path[i + 1] - tear.path[i - 1]).normalize_or_zero();
            let wide = 0.5 * gape * tear.length * tear.shares[i];
            tear.path[i] + way.perp() * (side * wide)
        })
    };
    // The margin goes counter-clockwise, so it comes first to the lip on the left of a way inwards.
    let mut edge = vec![first];
    edge.extend(lip(1.0));
    edge.push(tear.path[tear.path.len() - 1]);
    let back: Vec<DVec2> = lip(-1.0).collect();
    edge.extend(back.into_iter().rev());
    edge.push(last);
    let kept = (before + n - after - 1) % n + 1;
    let mut margin = edge.clone();
    margin.extend((1..=kept).map(|k| points[(after + k) % n]));
    let margin = Outline::new(margin, outline.base(), outline.apex()).ok()?;
    (margin.area() < outline.area()).then_some((margin, edge))
}
