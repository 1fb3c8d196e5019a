//! Arches between secondary veins: sources that are laid out before random ones are thrown.
//!
//! In brochidodromous leaves each secondary vein bends towards the apex near the margin and joins
//! the next. Here rounds of sources produce that under the ordinary rules; each round starts when
//! the one before is used up. Under the rule of open patterns the first round draws the midrib. The
//! next rounds draw every secondary along a curve, outwards and upwards to its end on a line inside
//! the margin, like peaks of auxin that the growing lamina carries outwards. The last round, under
//! the rule of closed patterns, lies between neighbouring ends, where each source draws the two
//! veins beside it so that they join.
//!
//! # Source
//!
//! Section 7 of \[runions2005\] asks for such patterns; that peaks of auxin along the margin
//! precede secondary veins is from \[runions2017\]. The layout is our own.

use glam::DVec2;

use super::plan::MarginClearance;
use crate::plane::{polygon, polyline, segment};
use crate::random::{Use, uniform};

/// Greatest random displacement of a place, as a share of the distance between neighbouring places.
const JITTER: f64 = 0.25;

/// Number of rounds in which a secondary vein grows to its end.
const LEGS: u32 = 8;

/// Rise of a secondary along the midrib over its reach away from it.
const RISE: f64 = 0.8;

/// The margin from base to apex on one side, and its length up to each corner.
struct Side {
    points: Vec<DVec2>,
    lengths: Vec<f64>,
    /// 1 if the blade lies to the left when going from base to apex, −1 if to the right.
    inward: f64,
}

impl Side {
    fn new(points: Vec<DVec2>, inward: f64) -> Self {
        Self {
            lengths: polyline::lengths(&points),
            points,
            inward,
        }
    }

    /// The point at a share of the side's length.
    fn at(&self, share: f64) -> DVec2 {
        let wanted = share.clamp(0.0, 1.0) * self.lengths[self.lengths.len() - 1];
        let (i, along) = polyline::piece(&self.lengths, wanted);
        self.points[i - 1] + (self.points[i] - self.points[i - 1]) * along
    }

    /// A place at a share of the side, `distance` inward. The direction is taken over a twentieth
    /// of the side, so that teeth do not turn it.
    fn inside(&self, share: f64, distance: f64) -> DVec2 {
        let way = (self.at(share + 0.025) - self.at(share - 0.025)).normalize_or_zero();
        self.at(share) + way.perp() * (self.inward * distance)
    }
}

/// The rounds of sources for a blade with this margin (counter-clockwise), all in one frame.
pub(crate) fn rounds(
    rule: &MarginClearance,
    margin: &[DVec2],
    base: DVec2,
    apex: DVec2,
    seed: u64,
) -> Vec<Vec<DVec2>> {
    let [from, to] = [base, apex].map(|end| polyline::nearest(margin, end));
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
        polygon::sides(margin).all(|(a, b)| segment::distance(a, b, *p) >= 0.6 * distance)
    };
    let ends = f64::from(rule.arches);
    let up = (apex - base).normalize_or_zero();
    let mut rounds = vec![vec![apex - up * distance]];
    rounds.resize(LEGS as usize + 2, Vec::new());
    for (number, side) in [right, left].into_iter().enumerate() {
        if side.points.len() < 2 {
            continue;
        }
        let place = |k: f64| {
            let counter = u64::from(rule.arches) * number as u64 + k as u64;
            let jitter = JITTER * (uniform(seed, Use::Arch, counter) - 0.5);
            (k + 0.5 + jitter) / ends
        };
        let reach = |end: DVec2| (end - base).perp_dot(up);
        // Where the leaf is narrow there is no room for an arch.
        let has_room = |end: DVec2| clear(&end) && reach(end).abs() >= distance;
        let shares: Vec<f64> = (0..rule.arches)
            .map(|k| place(f64::from(k)))
            .filter(|&share| has_room(side.inside(share, distance)))
            .collect();
        let curves: Vec<[DVec2; 3]> = shares
            .iter()
            .map(|&share| {
                let end = side.inside(share, distance);
                let (height, reach) = ((end - base).dot(up), reach(end));
                let rise = (RISE * reach.abs()).min(0.9 * height).max(0.0);
                let start = base + up * (height - rise);
                // The path first leads mostly outwards, at its end mostly upwards.
                [
                    start,
                    start + up * (0.4 * rise) - up.perp() * (0.8 * reach),
                    end,
                ]
            })
            .collect();
        let at =
            |[start, bend, end]: [DVec2; 3], t: f64| start.lerp(bend, t).lerp(bend.lerp(end, t), t);
        for leg in 1..=LEGS {
            let t = f64::from(leg) / f64::from(LEGS);
            rounds[leg as usize].extend(curves.iter().map(|&curve| at(curve, t)));
        }
        for pair in curves.windows(2) {
            // The source lies between the end and the outer part of the next vein, close to the
            // latter. There both veins are its relative neighbours, and the arriving vein grows on
            // until it meets the other.
            let end = pair[0][2];
            let outer = (5..=10).map(|i| at(pair[1], 0.1 * f64::from(i)));
            let near = outer.min_by(|p, q| (*p - end).length().total_cmp(&(*q - end).length()));
            rounds[LEGS as usize + 1].extend(near.map(|near| end.lerp(near, 0.85)));
        }
    }
    rounds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_lie_along_the_margin_at_their_distance_on_both_sides() {
        let margin: Vec<DVec2> = (0..400)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 400.0 - std::f64::consts::FRAC_PI_2)
            .map(|a| DVec2::new(30.0 * libm::cos(a), 50.0 + 50.0 * libm::sin(a)))
            .collect();
        let rule = MarginClearance {
            distance: 0.05,
            until: 0.5,
            arches: 6,
        };
        let apex = DVec2::new(0.0, 100.0);
        let rounds = rounds(&rule, &margin, DVec2::ZERO, apex, 3);
        assert_eq!(rounds.len(), 10);
        assert_eq!(rounds[0], [DVec2::new(0.0, 95.0)]);
        // This ellipse has room for all ends.
        assert_eq!((rounds[8].len(), rounds[9].len()), (12, 10));
        for p in &rounds[8] {
            let away = margin.iter().map(|q| (*q - *p).length());
            let near = away.fold(f64::MAX, f64::min);
            assert!((near - 5.0).abs() < 0.5, "{p} is {near} from the margin");
        }
        assert_eq!(rounds[8].iter().filter(|p| p.x > 0.0).count(), 6);
    }
}
