//! Lines of straight pieces, in the plane or in space.

use glam::{DVec2, DVec3};

/// A point whose distance to another is known.
pub trait Point: Copy {
    /// Distance to another point.
    fn away(self, other: Self) -> f64;
}

impl Point for DVec2 {
    fn away(self, other: Self) -> f64 {
        self.distance(other)
    }
}

impl Point for DVec3 {
    fn away(self, other: Self) -> f64 {
        self.distance(other)
    }
}

/// Length of a line.
#[inline]
pub fn length<P: Point>(points: &[P]) -> f64 {
    points.windows(2).map(|pair| pair[0].away(pair[1])).sum()
}

/// Length of a line up to each of its points.
#[inline]
pub fn lengths<P: Point>(points: &[P]) -> Vec<f64> {
    let mut sum = 0.0;
    let pieces = points.windows(2).map(|pair| {
        sum += pair[0].away(pair[1]);
        sum
    });
    std::iter::once(0.0).chain(pieces).collect()
}

/// The number of the point that is nearest to `p`, the first of several; 0 without points.
#[inline]
pub fn nearest(points: &[DVec2], p: DVec2) -> usize {
    let squared = |i: &usize| (points[*i] - p).length_squared();
    let numbers = 0..points.len();
    let nearest = numbers.min_by(|i, j| squared(i).total_cmp(&squared(j)));
    nearest.unwrap_or(0)
}

/// The piece of a line that holds the place `at` of its lengths, by the number of the point where it
/// ends, and where on it as a share. A piece without length has share 0.
#[inline]
pub fn piece(lengths: &[f64], at: f64) -> (usize, f64) {
    let end = lengths.partition_point(|&length| length <= at);
    let end = end.clamp(1, lengths.len() - 1);
    let (from, to) = (lengths[end - 1], lengths[end]);
    let share = if to > from {
        (at - from) / (to - from)
    } else {
        0.0
    };
    (end, share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_length_and_its_pieces() {
        let line = [(0.0, 0.0), (3.0, 4.0), (3.0, 4.0), (3.0, 6.0)].map(DVec2::from);
        assert_eq!(length(&line), 7.0);
        let lengths = lengths(&line);
        assert_eq!(lengths, [0.0, 5.0, 5.0, 7.0]);
        assert_eq!(piece(&lengths, 2.5), (1, 0.5));
        assert_eq!(piece(&lengths, 5.5), (3, 0.25));
        assert_eq!(piece(&lengths, 7.0), (3, 1.0));
        assert_eq!(
            length(&[DVec3::ZERO, DVec3::X, DVec3::ONE]),
            1.0 + 2.0_f64.sqrt()
        );
    }
}
