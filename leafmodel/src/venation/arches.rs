//! Where secondary veins are to meet in arches: sources laid out before those that chance throws.
//!
//! In brochidodromous leaves each secondary vein bends towards the apex near the margin and joins the next. Two
//! rounds of sources bring that about under the ordinary rules of closed patterns. The first draws the midrib to the apex and secondaries
//! to places at regular distances along a line inside the margin, where auxin peaks form in young leaves. The second lies
//! between neighbouring ends, a little nearer to the margin: each source draws the two veins beside it, which join there.
//!
//! # Source
//!
//! Section 7 of \[runions2005\] asks for such patterns; that peaks of auxin along the margin precede secondary veins is from
//! \[runions2017\]. The layout is ours.

use glam::DVec2;

use super::chance::{Use, uniform};
use super::plan::MarginClearance;

/// Share of the distance between neighbouring places by which chance moves each.
const JITTER: f64 = 0.25;

/// The margin from base to apex on one side, and its length up to each corner.
struct Side {
    points: Vec<DVec2>,
    lengths: Vec<f64>,
    /// 1 if the blade lies on the left of the way from base to apex, −1 if on the right.
    inward: f64,
}

impl Side {
    fn new(points: Vec<DVec2>, inward: f64) -> Self {
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + (pair[1] - pair[0]).length());
        }
        Self {
            points,
            lengths,
            inward,
        }
    }

    /// The point at a share of the side's length.
    fn at(&self, share: f64) -> DVec2 {
        let wanted = share.clamp(0.0, 1.0) * self.lengths[self.lengths.len() - 1];
        let i = self
            .lengths
            .partition_point(|&length| length <= wanted)
            .clamp(1, self.points.len() - 1);
        let (before, after) = (self.lengths[i - 1], self.lengths[i]);
        let along = (wanted - before) / (after - before);
        self.points[i - 1] + (self.points[i] - self.points[i - 1]) * along
    }

    /// A place at a share of the side, `distance` inward. Teeth do not turn the direction: it is taken over a twentieth
    /// of the side.
    fn inside(&self, share: f64, distance: f64) -> DVec2 {
        let way = (self.at(share + 0.025) - self.at(share - 0.025)).normalize_or_zero();
        self.at(share) + way.perp() * (self.inward * distance)
    }
}

/// The two rounds of sources for a blade with this margin (counter-clockwise), all in one frame.
pub(crate) fn rounds(
    rule: &MarginClearance,
    margin: &[DVec2],
    base: DVec2,
    apex: DVec2,
    seed: u64,
) -> [Vec<DVec2>; 2] {
    let nearest = |p: DVec2| {
        let squared = |i: &usize| (margin[*i] - p).length_squared();
        (0..margin.len())
            .min_by(|i, j| squared(i).total_cmp(&squared(j)))
            .unwrap_or(0)
    };
    let (from, to) = (nearest(base), nearest(apex));
    let walk = |from: usize, to: usize| {
        let count = (to + margin.len() - from) % margin.len();
        let corner = |i| margin[(from + i) % margin.len()];
        (0..=count).map(corner).collect::<Vec<DVec2>>()
    };
    let right = Side::new(walk(from, to), 1.0);
    let mut left = walk(to, from);
    left.reverse();
    let left = Side::new(left, -1.0);
    let distance = rule.distance * (apex - base).length();
    let clear = |p: &DVec2| {
        (0..margin.len()).all(|i| {
            let (a, b) = (margin[i], margin[(i + 1) % margin.len()]);
            let way = b - a;
            let along = ((*p - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            (a + way * along - *p).length() >= 0.6 * distance
        })
    };
    let ends = f64::from(rule.arches);
    let mut first = vec![apex - (apex - base).normalize_or_zero() * distance];
    let mut second = Vec::new();
    for (number, side) in [right, left].into_iter().enumerate() {
        if side.points.len() < 2 {
            continue;
        }
        let place = |k: f64| {
            let counter = u64::from(rule.arches) * number as u64 + k as u64;
            let jitter = JITTER * (uniform(seed, Use::Arch, counter) - 0.5);
            (k + 0.5 + jitter) / ends
        };
        let shares: Vec<f64> = (0..rule.arches).map(|k| place(f64::from(k))).collect();
        first.extend(shares.iter().map(|&share| side.inside(share, distance)));
        let between = shares.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        second.extend(between.map(|share| side.inside(share, 0.8 * distance)));
    }
    [first, second].map(|places| places.into_iter().filter(clear).collect())
}
