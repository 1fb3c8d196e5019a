//! Growth of the rows of cells, step by step (Eqs. 1–4 of \[young2010\]).

use glam::DVec2;

use super::growth_shape::{GrowthShape, GrowthShapeError};

/// Growth in length from primordium to maturity: 0.1 mm to 100 mm in the paper (section III).
pub(super) const ENLARGEMENT: f64 = 1000.0;

impl GrowthShape {
    /// Ends of the rows at maturity, from base to tip; the midrib is [`ENLARGEMENT`] long.
    pub(super) fn margin(&self, veins: &[(usize, f64)]) -> Vec<DVec2> {
        let last = self.rows - 1;
        let mut midrib: Vec<f64> = (0..=last).map(|j| j as f64 / last as f64).collect();
        let slopes: Vec<f64> = (0..=last).map(|j| slope(veins, j)).collect();
        let rates: Vec<f64> = (0..=last).map(|j| self.row_rate(veins, j)).collect();
        // A row starts with its end at x = 1; the slope is constant, so its length is x √(1 + s²)
        // throughout, and growing the length by a factor grows x by the same factor.
        let mut half_widths = vec![1.0; self.rows];
        let mut length = 1.0;
        while length * (1.0 + self.axial_rate) <= ENLARGEMENT {
            length *= 1.0 + self.axial_rate;
            for y in &mut midrib {
                *y *= 1.0 + self.axial_rate; // Eq. 1
            }
            for (x, rate) in half_widths.iter_mut().zip(&rates) {
                *x *= 1.0 + rate; // Eq. 2
            }
        }
        // The rest of the way is a part of a step, the same part for every cell.
        let rest = libm::log(ENLARGEMENT / length) / libm::log(1.0 + self.axial_rate);
        for (x, rate) in half_widths.iter_mut().zip(&rates) {
            *x *= libm::pow(1.0 + rate, rest);
        }
        (0..=last)
            .map(|j| {
                let y = midrib[j] * (ENLARGEMENT / length);
                DVec2::new(half_widths[j], y + slopes[j] * half_widths[j])
            })
            .collect()
    }

    /// Lateral growth rate along the midrib (Fig. 2, lower panel): `[y, gL]` of each row, `y` from 0 at the petiole to 1
    /// at the tip, `gL` per step.
    ///
    /// # Errors
    ///
    /// As [`GrowthShape::grow`].
    pub fn rate_curve(&self) -> Result<Vec<[f64; 2]>, GrowthShapeError> {
        let veins = self.checked_veins()?;
        let last = (self.rows - 1) as f64;
        let row = |j: usize| [j as f64 / last, self.row_rate(&veins, j)];
        Ok((0..self.rows).map(row).collect())
    }

    /// `gL` of row `j` (from 0): Eq. 3, times Eq. 4 where there are veins.
    fn row_rate(&self, veins: &[(usize, f64)], j: usize) -> f64 {
        let last = self.rows - 1;
        // Growth is 0 in the first and the last row, so the fastest is one between them.
        let peak = self.row_at(self.widest_at).clamp(1, last - 1);
        let away = if j <= peak {
            (peak - j) as f64 / peak as f64
        } else {
            (j - peak) as f64 / (last - peak) as f64
        };
        let entire = self.axial_rate / self.rate_ratio * (1.0 - libm::pow(away, self.falloff));
        let nearest = veins.iter().map(|&(row, _)| row.abs_diff(j)).min();
        nearest.map_or(entire, |rows| {
            let fall = self.lobe_decay * libm::pow(rows as f64, self.lobe_exponent);
            entire * libm::exp(-fall)
        })
    }
}

/// Slope of row `j`: linear between veins, constant outside the outermost ones.
fn slope(veins: &[(usize, f64)], j: usize) -> f64 {
    let after = veins.partition_point(|&(row, _)| row < j);
    match (after.checked_sub(1).map(|i| veins[i]), veins.get(after)) {
        (Some((r0, s0)), Some(&(r1, s1))) => s0 + (s1 - s0) * ((j - r0) as f64 / (r1 - r0) as f64),
        (Some((_, s)), None) | (None, Some(&(_, s))) => s,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_where_the_closed_form_does() {
        let shape = GrowthShape {
            veins: Vec::new(),
            lobe_decay: 0.0003,
            lobe_exponent: 2.0,
            falloff: 3.0,
            rows: 150,
            axial_rate: 0.1,
            rate_ratio: 1.2,
            widest_at: 0.3,
        };
        let steps = libm::log(1000.0) / libm::log(1.1);
        assert!((steps - 72.48).abs() < 0.01);
        let veins = [14, 44, 74, 104, 134].map(|row| (row, 0.7));
        for (j, p) in shape.margin(&veins).into_iter().enumerate() {
            let x = libm::pow(1.0 + shape.row_rate(&veins, j), steps);
            let y = 1000.0 * j as f64 / 149.0 + 0.7 * x;
            assert!((p.x - x).abs() <= 1e-9 * x, "row {j}: {} is not {x}", p.x);
            assert!(
                (p.y - y).abs() <= 1e-9 * y.abs(),
                "row {j}: {} is not {y}",
                p.y
            );
        }
    }

    #[test]
    fn slopes_are_linear_between_veins_and_constant_outside() {
        let veins = [(2, -1.0), (6, 3.0)];
        let slopes: Vec<f64> = (0..9).map(|j| slope(&veins, j)).collect();
        assert_eq!(slopes, [-1.0, -1.0, -1.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0]);
        assert_eq!(slope(&[], 4), 0.0);
    }
}
