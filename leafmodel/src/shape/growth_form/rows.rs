//! Rows of cells: how fast they grow, along which curve, and where they end.

use glam::DVec2;

use super::{CurvedVein, GrowthForm, GrowthFormError, HalfForm, LateralGrowth};

/// Rows longer than this many midribs belong to no leaf.
const LONGEST: f64 = 1000.0;

/// Points of a vein's line.
const LINE: usize = 24;

/// The parabola of a row: its rise along the midrib over the distance `x` from it, both in units of the midrib.
#[derive(Clone, Copy, Debug, PartialEq)]
struct RowCurve {
    slope: f64,
    bend: f64,
}

impl RowCurve {
    fn rise(self, x: f64) -> f64 {
        (self.slope + 0.5 * self.bend * x) * x
    }

    /// Length of the row as far as `x`.
    fn length(self, x: f64) -> f64 {
        let (from, to) = (self.slope, self.slope + self.bend * x);
        if (to - from).abs() < 0.1 {
            // Five-point Gauss quadrature: exact to rounding over so little bend, where the closed form cancels.
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
    fn reach(self, length: f64) -> f64 {
        if self.bend == 0.0 {
            return length / libm::hypot(1.0, self.slope);
        }
        // A row is at least as long as it reaches. Newton's method, kept between bounds by bisection.
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

impl GrowthForm {
    /// Ends of the rows of a half after `steps`, from base to tip, in units of the midrib, which has grown by
    /// `enlargement`.
    pub(super) fn row_ends(
        &self,
        half: &HalfForm,
        steps: f64,
        enlargement: f64,
    ) -> Result<Vec<DVec2>, GrowthFormError> {
        let veins = self.vein_rows(half);
        let last = (self.rows - 1) as f64;
        (0..self.rows)
            .map(|j| {
                let (curve, x) = self.row(half, &veins, j, steps, enlargement)?;
                Ok(DVec2::new(x, j as f64 / last + curve.rise(x)))
            })
            .collect()
    }

    /// The lines of a half's veins.
    pub(super) fn half_lines(
        &self,
        half: &HalfForm,
        steps: f64,
        enlargement: f64,
    ) -> Result<Vec<Vec<DVec2>>, GrowthFormError> {
        let veins = self.vein_rows(half);
        let last = (self.rows - 1) as f64;
        let line = |&(j, _): &(usize, CurvedVein)| {
            let (curve, end) = self.row(half, &veins, j, steps, enlargement)?;
            let point = |i: usize| {
                let x = end * i as f64 / LINE as f64;
                DVec2::new(x, j as f64 / last + curve.rise(x))
            };
            Ok((0..=LINE).map(point).collect())
        };
        veins.iter().map(line).collect()
    }

    fn vein_rows(&self, half: &HalfForm) -> Vec<(usize, CurvedVein)> {
        let row = |vein: &CurvedVein| (self.row_at(vein.position), *vein);
        half.veins.iter().map(row).collect()
    }

    /// The curve of row `j` (from 0) and how far from the midrib it ends.
    fn row(
        &self,
        half: &HalfForm,
        veins: &[(usize, CurvedVein)],
        j: usize,
        steps: f64,
        enlargement: f64,
    ) -> Result<(RowCurve, f64), GrowthFormError> {
        let curve = curve(veins, j);
        let rate = self.row_rate(half, veins, j);
        // Rows start with their ends one midrib's length away from it (Eq. 2, in closed form).
        let length = curve.length(1.0) * libm::exp(steps * libm::log1p(rate)) / enlargement;
        if length > LONGEST * libm::hypot(1.0, curve.slope) {
            return Err(GrowthFormError::TooWide {
                row: j + 1,
                lengths: length,
            });
        }
        Ok((curve, curve.reach(length)))
    }

    /// `gL` of row `j`: Eq. 3 or the curve, times Eq. 4 where there are veins.
    fn row_rate(&self, half: &HalfForm, veins: &[(usize, CurvedVein)], j: usize) -> f64 {
        let last = self.rows - 1;
        let entire = match &half.lateral {
            LateralGrowth::Curve(curve) => curve.at(j as f64 / last as f64),
            LateralGrowth::Peak {
                rate_ratio,
                widest_at,
                falloff,
            } => {
                let peak = self.row_at(*widest_at).clamp(1, last - 1);
                let away = if j <= peak {
                    (peak - j) as f64 / peak as f64
                } else {
                    (j - peak) as f64 / (last - peak) as f64
                };
                self.axial_rate / rate_ratio * (1.0 - libm::pow(away, *falloff))
            }
        };
        let nearest = veins.iter().map(|(row, _)| row.abs_diff(j)).min();
        nearest.map_or(entire, |rows| {
            let fall = half.lobe_decay * libm::pow(rows as f64, half.lobe_exponent);
            entire * libm::exp(-fall)
        })
    }
}

/// Curve of row `j`: slope and bend linear between veins, constant outside the outermost ones.
fn curve(veins: &[(usize, CurvedVein)], j: usize) -> RowCurve {
    let of = |vein: &CurvedVein| RowCurve {
        slope: vein.slope,
        bend: vein.bend,
    };
    let after = veins.partition_point(|(row, _)| *row < j);
    let before = after.checked_sub(1).map(|i| &veins[i]);
    match (before, veins.get(after)) {
        (Some((r0, v0)), Some((r1, v1))) => {
            let share = (j - r0) as f64 / (r1 - r0) as f64;
            let (a, b) = (of(v0), of(v1));
            RowCurve {
                slope: a.slope + (b.slope - a.slope) * share,
                bend: a.bend + (b.bend - a.bend) * share,
            }
        }
        (Some((_, vein)), None) | (None, Some((_, vein))) => of(vein),
        (None, None) => RowCurve {
            slope: 0.0,
            bend: 0.0,
        },
    }
}

#[cfg(test)]
mod tests {
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
