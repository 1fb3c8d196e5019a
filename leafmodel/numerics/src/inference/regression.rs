//! Parameters estimated from measures: weighted linear regression with a penalty.
//!
//! \[fearnhead2012\] estimate posterior means by least squares and compare simulations by them. Where
//! measures are many and alike, least squares follows chance; so large coefficients are penalised
//! (Hoerl and Kennard 1970), as much as foretells best those simulations that are left out one at a
//! time. What is left over there is what the estimate is wrong by, not what it was fitted to.

use super::linear::Factor;

/// Penalties that are tried, relative to the variance of a measure.
const PENALTIES: [f64; 7] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0];

/// Linear estimates of all parameters.
#[derive(Clone, Debug)]
pub(super) struct Regression {
    /// Mean and standard deviation of each measure.
    scale: Vec<(f64, f64)>,
    /// Of each parameter: its mean, and a coefficient for each measure in units of its deviation.
    estimates: Vec<(f64, Vec<f64>)>,
}

/// The rows that a regression learns from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lesson<'l> {
    /// Measures of each row.
    pub(super) measures: &'l [&'l [f64]],
    /// Parameters of each row.
    pub(super) places: &'l [&'l [f64]],
    /// Weight of each row, greater than 0.
    pub(super) weights: &'l [f64],
}

impl Regression {
    /// Learns from rows; gives also what each row's parameters differ by from the estimate that
    /// all other rows make.
    pub(super) fn learn(lesson: Lesson<'_>) -> (Self, Vec<Vec<f64>>) {
        let (rows, total) = (lesson.measures.len(), lesson.weights.iter().sum::<f64>());
        let shares: Vec<f64> = lesson.weights.iter().map(|weight| weight / total).collect();
        let scale = scales(lesson.measures, &shares);
        let standard: Vec<Vec<f64>> = lesson
            .measures
            .iter()
            .map(|row| standardised(row, &scale))
            .collect();
        let products = products(&standard, &shares);
        let tried: Vec<(Factor, Vec<f64>)> = PENALTIES
            .iter()
            .filter_map(|penalty| {
                let mut matrix = products.clone();
                for (i, row) in matrix.iter_mut().enumerate() {
                    row[i] += penalty;
                }
                let factor = Factor::of(&matrix)?;
                // The share of a row in its own estimate.
                let own = standard.iter().zip(&shares).map(|(row, share)| {
                    let squares: f64 = factor.whitened(row).iter().map(|x| x * x).sum();
                    (share * (1.0 + squares)).min(1.0 - 1e-9)
                });
                let own = own.collect();
                Some((factor, own))
            })
            .collect();
        let parameters = lesson.places.first().map_or(0, |place| place.len());
        let mut residuals = vec![vec![0.0; parameters]; rows];
        let mut estimates = Vec::with_capacity(parameters);
        for parameter in 0..parameters {
            let values: Vec<f64> = lesson.places.iter().map(|place| place[parameter]).collect();
            let mean: f64 = values.iter().zip(&shares).map(|(v, share)| v * share).sum();
            let right = right_side(&standard, &shares, &values, mean);
            let mut best: Option<(f64, Vec<f64>, Vec<f64>)> = None;
            for (factor, own) in &tried {
                let slopes = factor.solved(&right);
                let left: Vec<f64> = (0..rows)
                    .map(|i| (values[i] - mean - dot(&slopes, &standard[i])) / (1.0 - own[i]))
                    .collect();
                let error: f64 = left
                    .iter()
                    .zip(&shares)
                    .map(|(e, share)| share * e * e)
                    .sum();
                if best.as_ref().is_none_or(|(least, ..)| error < *least) {
                    best = Some((error, slopes, left));
                }
            }
            let (_, slopes, left) =
                best.expect("a matrix with 1 added to its diagonal has a factor");
            for (row, value) in residuals.iter_mut().zip(left) {
                row[parameter] = value;
            }
            estimates.push((mean, slopes));
        }
        (Self { scale, estimates }, residuals)
    }

    /// The parameters that measures let expect.
    pub(super) fn estimate(&self, measures: &[f64]) -> Vec<f64> {
        let standard = standardised(measures, &self.scale);
        let estimates = self.estimates.iter();
        estimates
            .map(|(mean, slopes)| mean + dot(slopes, &standard))
            .collect()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Weighted mean and deviation of each measure; a measure that does not vary has deviation 1.
fn scales(measures: &[&[f64]], shares: &[f64]) -> Vec<(f64, f64)> {
    let count = measures.first().map_or(0, |row| row.len());
    let of = |measure: usize| {
        let weighted = || measures.iter().zip(shares);
        let mean: f64 = weighted().map(|(row, share)| share * row[measure]).sum();
        let square = |x: f64| (x - mean) * (x - mean);
        let variance: f64 = weighted()
            .map(|(row, share)| share * square(row[measure]))
            .sum();
        // What rounding leaves of a constant is no deviation.
        let deviation = variance.sqrt();
        let is_constant = deviation <= 1e-12 * mean.abs();
        (mean, if is_constant { 1.0 } else { deviation })
    };
    (0..count).map(of).collect()
}

fn standardised(row: &[f64], scale: &[(f64, f64)]) -> Vec<f64> {
    let scaled = row.iter().zip(scale);
    scaled
        .map(|(x, (mean, deviation))| (x - mean) / deviation)
        .collect()
}

/// Weighted products of the measures with each other, rows up to the diagonal.
fn products(standard: &[Vec<f64>], shares: &[f64]) -> Vec<Vec<f64>> {
    let count = standard.first().map_or(0, Vec::len);
    let mut products: Vec<Vec<f64>> = (0..count).map(|i| vec![0.0; i + 1]).collect();
    for (row, share) in standard.iter().zip(shares) {
        for (i, sums) in products.iter_mut().enumerate() {
            for (sum, x) in sums.iter_mut().zip(row) {
                *sum += share * row[i] * x;
            }
        }
    }
    products
}

fn right_side(standard: &[Vec<f64>], shares: &[f64], values: &[f64], mean: f64) -> Vec<f64> {
    let mut right = vec![0.0; standard.first().map_or(0, Vec::len)];
    for ((row, share), value) in standard.iter().zip(shares).zip(values) {
        for (sum, x) in right.iter_mut().zip(row) {
            *sum += share * x * (value - mean);
        }
    }
    right
}

#[cfg(test)]
mod tests {
    use super::super::random::normal;
    use super::*;

    /// Rows of two measures and one parameter, `2 a − b` with some noise.
    fn rows(count: u32, noise: f64) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let all = (0..count).map(|i| {
            let x = normal(1, 0, i, 3);
            (vec![x[0], x[1]], vec![2.0 * x[0] - x[1] + noise * x[2]])
        });
        all.unzip()
    }

    fn as_slices(rows: &[Vec<f64>]) -> Vec<&[f64]> {
        rows.iter().map(Vec::as_slice).collect()
    }

    #[test]
    fn a_row_is_left_out_exactly() {
        let (measures, places) = rows(12, 0.5);
        let weights: Vec<f64> = (0..12).map(|i| 1.0 + f64::from(i % 4)).collect();
        let (x, y) = (as_slices(&measures), as_slices(&places));
        let all = Lesson {
            measures: &x,
            places: &y,
            weights: &weights,
        };
        let (_, left) = Regression::learn(all);
        // The same with the row taken away, at the smallest penalty: it changes less than 1e-4.
        let rest = Lesson {
            measures: &x[1..],
            places: &y[1..],
            weights: &weights[1..],
        };
        let (without, _) = Regression::learn(rest);
        let direct = places[0][0] - without.estimate(&measures[0])[0];
        assert!(
            (left[0][0] - direct).abs() < 0.05 * direct.abs(),
            "{} is not {direct}",
            left[0][0]
        );
    }

    #[test]
    fn a_linear_relation_is_found_and_a_constant_measure_does_no_harm() {
        let (mut measures, places) = rows(300, 0.0);
        for row in &mut measures {
            row.push(7.0);
        }
        let (x, y) = (as_slices(&measures), as_slices(&places));
        let lesson = Lesson {
            measures: &x,
            places: &y,
            weights: &[1.0; 300],
        };
        let (found, _) = Regression::learn(lesson);
        let estimate = found.estimate(&[1.0, 1.0, 7.0]);
        // The least penalty shrinks slopes by its own share.
        assert!((estimate[0] - 1.0).abs() < 1e-5, "{estimate:?}");
    }
}
