//! Where damage is.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::stains::Stain;
use crate::numeric::bisect;
use crate::plane::segment;
use crate::random::{Use, bell, uniform};
use crate::shape::outline::Outline;
use crate::venation::network::{VeinSegment, VenationNetwork};

/// Spread of sizes: standard deviation of their logarithm.
const SPREAD: f64 = 0.35;

/// Corners of a hole.
const HOLE_CORNERS: u32 = 28;

/// Radius over that of the thickest secondary from which one stops a rip.
const STOPPING: f64 = 0.45;

/// Tries for each piece of damage.
pub(super) const TRIES: u64 = 80;

/// Bites keep this share of the leaf's length away from base and apex.
const ENDS: f64 = 0.12;

/// A lamina on which places are sought, one after the other.
pub(super) struct Places<'a> {
    outline: &'a Outline,
    /// Veins of the first and second order.
    major: Vec<VeinSegment>,
    seed: u64,
    drawn: u64,
    /// What has been eaten, as discs.
    eaten: Vec<(DVec2, f64)>,
}

impl<'a> Places<'a> {
    pub(super) fn new(outline: &'a Outline, network: &VenationNetwork, seed: u64) -> Self {
        Self {
            outline,
            major: network.segments().filter(|vein| vein.order <= 2).collect(),
            seed,
            drawn: 0,
            eaten: Vec::new(),
        }
    }

    pub(super) fn number(&mut self) -> f64 {
        self.drawn += 1;
        uniform(self.seed, Use::Damage, self.drawn)
    }

    /// A size about its median.
    pub(super) fn size(&mut self, median: f64) -> f64 {
        self.drawn += 1;
        median * libm::exp(SPREAD * bell(self.seed, Use::DamageSize, self.drawn))
    }

    /// A place on the blade.
    fn place(&mut self) -> Option<DVec2> {
        let (low, high) = self.outline.bounds();
        let share = DVec2::new(self.number(), self.number());
        let p = low + (high - low) * share;
        self.outline.contains(p).then_some(p)
    }

    /// Distance to the nearest larger vein's side, the margin or anything eaten.
    fn room(&self, p: DVec2) -> f64 {
        let veins = self
            .major
            .iter()
            .map(|vein| segment::distance(vein.from, vein.to, p) - vein.radius_from);
        let eaten = self.eaten.iter().map(|(q, radius)| q.distance(p) - radius);
        veins
            .chain(eaten)
            .fold(self.outline.distance_to_margin(p), f64::min)
    }

    /// Nothing more may be done to a disc.
    pub(super) fn eat(&mut self, middle: DVec2, radius: f64) {
        self.eaten.push((middle, radius));
    }

    /// Whether a place is farther than this from everything eaten.
    pub(super) fn is_uneaten(&self, p: DVec2, away: f64) -> bool {
        self.eaten
            .iter()
            .all(|(q, radius)| q.distance(p) > radius + away)
    }

    /// Radius from which a secondary stops a rip: rips cross the thin ends of secondaries, and the
    /// loops between them.
    pub(super) fn stopping_radius(&self) -> f64 {
        let secondaries = self.major.iter().filter(|vein| vein.order == 2);
        let thickest = secondaries.map(|vein| vein.radius_from).fold(0.0, f64::max);
        STOPPING * thickest
    }

    /// Whether the sides of all veins that stop a rip are farther than `gap` from a place, and those
    /// of primaries, where there are secondaries too, than `away`.
    pub(super) fn is_clear_of_veins(&self, p: DVec2, gap: f64, away: f64) -> bool {
        let stopping = self.stopping_radius();
        self.major.iter().all(|vein| {
            let gap = if vein.order == 1 && stopping > 0.0 {
                away
            } else {
                gap
            };
            let stops = vein.order == 1 || vein.radius_from >= stopping;
            !stops || segment::distance(vein.from, vein.to, p) - vein.radius_from > gap
        })
    }

    /// The direction of the larger veins about a place, either way along them: that of the
    /// secondaries where there are any.
    pub(super) fn grain(&self, p: DVec2) -> Option<DVec2> {
        let order = self.major.iter().map(|vein| vein.order).max()?;
        // Directions without a sense: twice their angle has one.
        let mut sum = DVec2::ZERO;
        for vein in self.major.iter().filter(|vein| vein.order == order) {
            let way = vein.to - vein.from;
            let unit = way.normalize_or_zero();
            let doubled = DVec2::new(unit.x * unit.x - unit.y * unit.y, 2.0 * unit.x * unit.y);
            let near =
                1.0 / (segment::distance(vein.from, vein.to, p) + 1e-3 * self.outline.length());
            sum += doubled * (way.length() * near * near * near * near);
        }
        let angle = 0.5 * libm::atan2(sum.y, sum.x);
        let (sin, cos) = libm::sincos(angle);
        sum.is_finite().then_some(DVec2::new(cos, sin))
    }

    /// Holes, each with a margin that is not quite round.
    pub(super) fn holes(&mut self, count: u32, median_mm: f64) -> Vec<Vec<DVec2>> {
        let mut holes = Vec::new();
        for _ in 0..count {
            let mut radius = 0.5 * self.size(median_mm);
            let found = (0..TRIES).find_map(|attempt| {
                if attempt % 20 == 19 {
                    // Where there is little room holes are small.
                    radius *= 0.75;
                }
                let p = self.place()?;
                (self.room(p) > 1.5 * radius).then_some(p)
            });
            let Some(middle) = found else { continue };
            self.eaten.push((middle, 1.3 * radius));
            let [stretch, turn, two, three] = std::array::from_fn(|_| self.number());
            let corner = |i: u32| {
                let angle = TAU * f64::from(i) / f64::from(HOLE_CORNERS);
                let wobble = 0.12 * libm::sin(2.0 * angle + TAU * two)
                    + 0.1 * libm::sin(3.0 * angle + TAU * three)
                    + 0.04 * libm::sin(7.0 * angle + TAU * turn);
                let (sin, cos) = libm::sincos(angle);
                let round = DVec2::new(cos, sin * (1.0 - 0.3 * stretch));
                let (sin, cos) = libm::sincos(TAU * turn);
                middle + DVec2::new(cos, sin).rotate(round) * (radius * (1.0 + wobble))
            };
            holes.push((0..HOLE_CORNERS).map(corner).collect());
        }
        holes
    }

    /// The margin with bites in it, and the edge of each.
    pub(super) fn bites(&mut self, count: u32, median_mm: f64) -> (Outline, Vec<Vec<DVec2>>) {
        let mut bitten = self.outline.clone();
        let mut edges = Vec::new();
        for _ in 0..count {
            let radius = 0.5 * self.size(median_mm);
            for _ in 0..TRIES {
                let points = self.outline.points();
                let at = points[(self.number() * points.len() as f64) as usize % points.len()];
                let ends = [bitten.base(), bitten.apex()];
                let far = radius * 1.3 + ENDS * bitten.length();
                let is_free = ends.iter().all(|end| end.distance(at) > far)
                    && self
                        .eaten
                        .iter()
                        .all(|(q, r)| q.distance(at) > r + 1.5 * radius)
                    && self
                        .major
                        .iter()
                        .filter(|vein| vein.order == 1)
                        .all(|vein| vein.from.distance(at) > 1.4 * radius);
                let turn = self.number();
                if !is_free {
                    continue;
                }
                if let Some((margin, edge)) = bite(&bitten, at, radius, turn) {
                    bitten = margin;
                    self.eaten.push((at, 1.3 * radius));
                    edges.push(edge);
                    break;
                }
            }
        }
        (bitten, edges)
    }

    /// Winding mines, which grow wider as the larva does and keep between the larger veins.
    pub(super) fn mines(&mut self, count: u32, width_mm: f64, length_mm: f64) -> Vec<Stain> {
        let mut mines = Vec::new();
        for _ in 0..count {
            let width = self.size(width_mm);
            let length = self.size(length_mm);
            let start = (0..TRIES).find_map(|_| {
                let p = self.place()?;
                (self.room(p) > width).then_some(p)
            });
            let Some(start) = start else { continue };
            let step = 0.5 * width;
            let steps = (length / step) as usize;
            let mut heading = TAU * self.number();
            let mut turning = 0.0;
            let mut path = vec![(start, 0.1 * width)];
            for i in 1..=steps.clamp(2, 4000) {
                let radius = 0.5 * width * (0.2 + 0.8 * i as f64 / steps as f64);
                turning = 0.7 * turning + 0.35 * (2.0 * self.number() - 1.0);
                heading += turning;
                let from = path[path.len() - 1].0;
                // Away from what is in the way, by the least turn.
                let ahead = (0..8).find_map(|k| {
                    let side = if k % 2 == 0 { 1.0 } else { -1.0 };
                    let angle = heading + side * f64::from((k + 1) / 2) * PI / 9.0;
                    let (sin, cos) = libm::sincos(angle);
                    let p = from + DVec2::new(cos, sin) * step;
                    let is_own = path.len() > 8
                        && path[..path.len() - 8]
                            .iter()
                            .any(|(q, r)| q.distance(p) < r + radius);
                    let is_free = self.outline.contains(p) && self.room(p) > 1.1 * radius;
                    (is_free && !is_own).then_some((p, angle))
                });
                let Some((p, angle)) = ahead else { break };
                heading = angle;
                path.push((p, radius));
            }
            mines.push(Stain::mine(path));
        }
        mines
    }

    /// Blotch mines: several lobes about a place.
    pub(super) fn blotches(&mut self, count: u32, median_mm: f64) -> Vec<Stain> {
        let mut blotches = Vec::new();
        for _ in 0..count {
            let radius = 0.5 * self.size(median_mm);
            let found = (0..TRIES).find_map(|_| {
                let p = self.place()?;
                (self.room(p) > 0.7 * radius).then_some(p)
            });
            let Some(middle) = found else { continue };
            let mut path = vec![(middle, 0.75 * radius)];
            for i in 0..7 {
                let (sin, cos) = libm::sincos(TAU * (f64::from(i) + self.number()) / 7.0);
                let away = radius * (0.35 + 0.3 * self.number());
                let p = middle + DVec2::new(cos, sin) * away;
                path.push((p, 0.5 * radius));
                path.push((middle, 0.75 * radius));
            }
            blotches.push(Stain::mine(path));
        }
        blotches
    }
}

/// The margin without a disc about a place on it, and the new edge; none if that leaves no margin.
fn bite(outline: &Outline, at: DVec2, radius: f64, turn: f64) -> Option<(Outline, Vec<DVec2>)> {
    let points = outline.points();
    let n = points.len();
    let nearest = (0..n).min_by(|&i, &j| {
        let away = |i: usize| points[i].distance_squared(at);
        away(i).total_cmp(&away(j))
    })?;
    let is_in = |i: usize| points[i % n].distance(at) < radius;
    // Everything between the last places beside it that the disc holds, teeth included.
    let reach = |forward: bool| {
        let mut way = 0.0;
        let mut last = 0;
        for k in 1..n / 2 {
            let i = if forward {
                nearest + k
            } else {
                nearest + n - k
            };
            let before = if forward { i - 1 } else { i + 1 };
            way += points[i % n].distance(points[before % n]);
            if way > 4.0 * radius {
                break;
            }
            if is_in(i) {
                last = k;
            }
        }
        last
    };
    let (fore, back) = (reach(true), reach(false));
    let enters = |inside: usize, outside: usize| {
        let (a, b) = (points[inside % n], points[outside % n]);
        let is_near = |share| a.lerp(b, share).distance(at) < radius;
        a.lerp(b, bisect(0.0, 1.0, 50, is_near).1)
    };
    if !is_in(nearest) || fore + back + 3 >= n {
        return None;
    }
    let first = enters(nearest + n - back, nearest + n - back - 1);
    let last = enters(nearest + fore, nearest + fore + 1);
    let angle = |p: DVec2| libm::atan2(p.y - at.y, p.x - at.x);
    let (from, to) = (angle(first), angle(last));
    // From where the margin comes to the disc, through the blade, to where it leaves it: clockwise
    // about the disc, since the margin goes counter-clockwise about the blade.
    let sweep = (from - to).rem_euclid(TAU);
    let pieces = ((sweep / 0.06).ceil() as u32).clamp(6, 120);
    let mut edge = vec![first];
    for i in 1..pieces {
        let share = f64::from(i) / f64::from(pieces);
        let (sin, cos) = libm::sincos(from - sweep * share);
        // Scalloped, as jaws leave it.
        let scallop = 1.0 + 0.05 * libm::sin(PI * share) * libm::sin(TAU * (turn + 4.0 * share));
        edge.push(at + DVec2::new(cos, sin) * (radius * scallop));
    }
    edge.push(last);
    let middle = edge[edge.len() / 2];
    if !outline.contains(middle) {
        return None;
    }
    let mut margin = edge.clone();
    let kept = n - (fore + back + 1);
    margin.extend((0..kept).map(|k| points[(nearest + fore + 1 + k) % n]));
    let margin = Outline::new(margin, outline.base(), outline.apex()).ok()?;
    (margin.area() < outline.area()).then_some((margin, edge))
}
