//! Lines of pixels as smooth lines with few points.
//!
//! Steps from pixel to pixel are up to 8 % longer than the line that they stand for. A Gaussian of
//! two pixels takes the steps out; what is left of a straight line is its own length. Then a line
//! is cut into even pieces, and further wherever the smooth line is more than a bound off them
//! (\[douglas1973\]).

use crate::plane::{polyline, segment};
use glam::DVec2;

/// Standard deviation of the Gaussian along lines, points.
const DEVIATION: f64 = 2.0;

/// Points on either side that the Gaussian takes in.
const REACH: usize = 6;

/// The line without its steps. Both ends stay; towards them the Gaussian takes in fewer points, as
/// many on both sides.
pub(super) fn smooth(points: &[DVec2]) -> Vec<DVec2> {
    smoothed(points, |i| REACH.min(i).min(points.len() - 1 - i))
}

/// The same for a closed line.
pub(super) fn smooth_ring(points: &[DVec2]) -> Vec<DVec2> {
    let half = REACH.min((points.len().max(1) - 1) / 2);
    smoothed(points, |_| half)
}

/// The points of a ring after a Gaussian that takes in `half(i)` points on either side of point `i`.
fn smoothed(points: &[DVec2], half: impl Fn(usize) -> usize) -> Vec<DVec2> {
    let weights: [f64; REACH + 1] = std::array::from_fn(|i| {
        let off = i as f64 / DEVIATION;
        libm::exp(-0.5 * off * off)
    });
    let count = points.len();
    (0..count)
        .map(|i| {
            let (mut sum, mut total) = (points[i] * weights[0], weights[0]);
            for (k, weight) in weights.iter().enumerate().take(half(i) + 1).skip(1) {
                sum += (points[(i + count - k) % count] + points[(i + k) % count]) * *weight;
                total += 2.0 * weight;
            }
            sum / total
        })
        .collect()
}

/// Points of a line, by number, that cut it into even pieces of about `piece`, and so that no point
/// of it is farther than `bound` from the pieces.
pub(super) fn cut(points: &[DVec2], piece: f64, bound: f64) -> Vec<usize> {
    let passed = polyline::lengths(points);
    let length = passed[points.len() - 1];
    let pieces = (length / piece).round().max(1.0);
    let mut kept = vec![0];
    let mut i = 0;
    for number in 1..=pieces as usize {
        let at = length * number as f64 / pieces;
        while i + 1 < points.len() - 1 && passed[i + 1] <= at {
            i += 1;
        }
        // The nearer of the two points about the place.
        let next = if number as f64 == pieces {
            points.len() - 1
        } else if at - passed[i] > passed[i + 1] - at {
            i + 1
        } else {
            i
        };
        let before = kept[kept.len() - 1];
        if next > before {
            within_bound(points, before, next, bound, &mut kept);
            kept.push(next);
        }
    }
    kept
}

/// Adds points between two until none is farther than `bound` from the line between neighbours.
pub(super) fn within_bound(
    points: &[DVec2],
    first: usize,
    last: usize,
    bound: f64,
    kept: &mut Vec<usize>,
) {
    let mut open = vec![(first, last)];
    while let Some((from, to)) = open.pop() {
        if from > first && kept.last().is_some_and(|last| *last < from) {
            kept.push(from);
        }
        let off = |i: usize| segment::distance(points[from], points[to], points[i]);
        // The first of the farthest.
        let mut farthest = (bound, None);
        for i in from + 1..to {
            let here = off(i);
            if here > farthest.0 {
                farthest = (here, Some(i));
            }
        }
        if let (_, Some(middle)) = farthest {
            open.push((middle, to));
            open.push((from, middle));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_is_farther_off_than_the_bound() {
        let wave: Vec<DVec2> = (0..500)
            .map(|i| DVec2::new(f64::from(i), 30.0 * libm::sin(f64::from(i) * 0.05)))
            .collect();
        for (piece, bound) in [(1e9, 0.5), (20.0, 0.2), (3.0, 0.01)] {
            let kept = cut(&wave, piece, bound);
            assert!(kept.is_sorted_by(|a, b| a < b));
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, 499));
            for pair in kept.windows(2) {
                let (a, b) = (wave[pair[0]], wave[pair[1]]);
                for p in &wave[pair[0]..pair[1]] {
                    let off = ((b - a).perp_dot(*p - a) / a.distance(b)).abs();
                    assert!(off <= bound + 1e-12, "{off}");
                }
            }
        }
    }
}
