//! The parabola along which a row of cells lies.

/// A row's rise along its axis over the distance `x` from it, both in units of the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RowCurve {
    /// Slope at the axis.
    pub(super) slope: f64,
    /// Change of slope with the distance.
    pub(super) bend: f64,
}

impl RowCurve {
    pub(super) fn rise(self, x: f64) -> f64 {
        (self.slope + 0.5 * self.bend * x) * x
    }

    /// Length of the row as far as `x`.
    pub(super) fn length(self, x: f64) -> f64 {
        let (from, to) = (self.slope, self.slope + self.bend * x);
        if (to - from).abs() < 0.1 {
            // Five-point Gauss quadrature: accurate to rounding where the row bends little and the
            // closed form cancels.
            const HALF: [(f64, f64); 2] = [
                (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
                (0.906_179_845_938_664, 0.236_926_885_056_189_08),
            ];
            let at = |share: f64| libm::hypot(1.0, 0.5 * ((to + from) + share * (to - from)));
            let sum: f64 = HALF
                .iter()
                .map(|&(share, weight)| weight * (at(share) + at(-share)))
                .sum();
            return 0.5 * x * (sum + 128.0 / 225.0 * at(0.0));
        }
        let antiderivative = |m: f64| 0.5 * (m * libm::hypot(1.0, m) + libm::asinh(m));
        (antiderivative(to) - antiderivative(from)) / self.bend
    }

    /// How far from the midrib a row of this length ends.
    pub(super) fn reach(self, length: f64) -> f64 {
        if self.bend == 0.0 {
            return length / libm::hypot(1.0, self.slope);
        }
        // A row is at least as long as it reaches. Newton's method, kept between bounds by
        // bisection.
        let (mut low, mut high) = (0.0, length);
        let mut x = length / libm::hypot(1.0, self.slope);
        for _ in 0..100 {
            let off = self.length(x) - length;
            if off > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let next = x - off / libm::hypot(1.0, self.slope + self.bend * x);
            let next = if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            if (next - x).abs() <= 1e-15 * length {
                return next;
            }
            x = next;
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    #[test]
    fn a_rows_length_is_that_of_its_curve() {
        for (slope, bend) in [
            (0.0, 0.0),
            (0.5, 0.05),
            (-1.2, 3.0),
            (2.0, -40.0),
            (0.0, 0.099),
        ] {
            let curve = RowCurve { slope, bend };
            let point = |i: u32| {
                let x = 0.7 * f64::from(i) / 1e5;
                DVec2::new(x, curve.rise(x))
            };
            let sum: f64 = (0..100_000)
                .map(|i| (point(i + 1) - point(i)).length())
                .sum();
            let length = curve.length(0.7);
            // Chords are shorter by h² y''²/24 at most.
            assert!((sum - length).abs() < 1e-8, "{sum} {length}");
            assert!((curve.reach(length) - 0.7).abs() < 1e-12);
        }
    }
}
