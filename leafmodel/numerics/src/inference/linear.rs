//! Small symmetric matrices, factored by Cholesky's method.
//!
//! Written out rather than taken from a library of linear algebra: those choose instructions by
//! the processor (fused multiplications among them), and the same fit must have the same bits on
//! every machine.

/// `L` of `A = L Lᵀ`, its rows up to the diagonal.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    rows: Vec<Vec<f64>>,
}

impl Factor {
    /// Factors a symmetric matrix, of which the rows up to the diagonal are read; `None` unless it
    /// is positive definite.
    pub(super) fn of(matrix: &[Vec<f64>]) -> Option<Self> {
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(matrix.len());
        for (i, given) in matrix.iter().enumerate() {
            let mut row = Vec::with_capacity(i + 1);
            for j in 0..=i {
                let known: &[f64] = if j == i { &row } else { &rows[j] };
                let products = row.iter().zip(known).take(j);
                let sum = products.fold(given[j], |sum, (a, b)| sum - a * b);
                if j < i {
                    row.push(sum / rows[j][j]);
                } else if sum > 0.0 && sum.is_finite() {
                    row.push(sum.sqrt());
                } else {
                    return None;
                }
            }
            rows.push(row);
        }
        Some(Self { rows })
    }

    /// `L⁻¹ x`, whose squares add up to `xᵀ A⁻¹ x`.
    pub(super) fn whitened(&self, x: &[f64]) -> Vec<f64> {
        let mut found: Vec<f64> = Vec::with_capacity(x.len());
        for (row, value) in self.rows.iter().zip(x) {
            let products = row.iter().zip(&found);
            let rest = products.fold(*value, |sum, (a, b)| sum - a * b);
            found.push(rest / row[found.len()]);
        }
        found
    }

    /// `A⁻¹ x`.
    pub(super) fn solved(&self, x: &[f64]) -> Vec<f64> {
        let mut found = self.whitened(x);
        for i in (0..found.len()).rev() {
            let below = self.rows[i + 1..].iter().zip(&found[i + 1..]);
            let rest = below.fold(found[i], |sum, (row, value)| sum - row[i] * value);
            found[i] = rest / self.rows[i][i];
        }
        found
    }

    /// `L x`: has the covariance `A` if those of `x` are independent with variance 1.
    pub(super) fn coloured(&self, x: &[f64]) -> Vec<f64> {
        let row_times = |row: &Vec<f64>| row.iter().zip(x).map(|(a, b)| a * b).sum();
        self.rows.iter().map(row_times).collect()
    }

    /// The square root of the determinant of `A`.
    pub(super) fn volume(&self) -> f64 {
        let diagonal = self.rows.iter().enumerate().map(|(i, row)| row[i]);
        diagonal.product()
    }
}

/// Mean and covariance of weighted points; weights are ≥ 0 and not all 0.
pub(super) fn moments<'p>(
    points: impl Iterator<Item = (&'p [f64], f64)> + Clone,
    dimensions: usize,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut mean = vec![0.0; dimensions];
    let mut total = 0.0;
    for (point, weight) in points.clone() {
        total += weight;
        for (sum, x) in mean.iter_mut().zip(point) {
            *sum += weight * x;
        }
    }
    for sum in &mut mean {
        *sum /= total;
    }
    let mut covariance = vec![vec![0.0; dimensions]; dimensions];
    for (point, weight) in points {
        for (i, row) in covariance.iter_mut().enumerate() {
            for (j, sum) in row.iter_mut().enumerate() {
                *sum += weight / total * (point[i] - mean[i]) * (point[j] - mean[j]);
            }
        }
    }
    (mean, covariance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_solves_whitens_and_colours() {
        let matrix = vec![
            vec![4.0, 2.0, 0.6],
            vec![2.0, 5.0, 1.0],
            vec![0.6, 1.0, 3.0],
        ];
        let factor = Factor::of(&matrix).expect("positive definite");
        let x = [1.0, -2.0, 0.5];
        let solved = factor.solved(&x);
        for (row, wanted) in matrix.iter().zip(x) {
            let found: f64 = row.iter().zip(&solved).map(|(a, b)| a * b).sum();
            assert!((found - wanted).abs() < 1e-14, "{found} is not {wanted}");
        }
        let back = factor.coloured(&factor.whitened(&x));
        assert!(back.iter().zip(x).all(|(a, b)| (a - b).abs() < 1e-14));
        let determinant: f64 = 4.0 * (15.0 - 1.0) - 2.0 * (6.0 - 0.6) + 0.6 * (2.0 - 3.0);
        assert!((factor.volume() - determinant.sqrt()).abs() < 1e-13);
    }

    #[test]
    fn what_is_not_positive_definite_has_none() {
        for matrix in [
            vec![vec![1.0, 2.0], vec![2.0, 1.0]],
            vec![vec![0.0]],
            vec![vec![f64::NAN]],
        ] {
            assert!(Factor::of(&matrix).is_none());
        }
    }
}
