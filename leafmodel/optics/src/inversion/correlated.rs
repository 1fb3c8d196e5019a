//! Residuals that are correlated along the spectrum, and what that does to errors.
//!
//! Noise of an instrument is smooth over some nanometres, and so is what a model lacks. Values that
//! err alike count as fewer: errors that take them as independent are too small.
//!
//! The covariance of two residuals of one spectrum is `s(λ) s(λ′) ρ(λ − λ′)`. Their size `s` is a
//! constant and a fraction of the signal, `s² = a + b y²`. Their correlation is `ρ(0) = 1` and
//! `ρ(Δ) = c exp(−Δ / L)` elsewhere. Both are fitted to the residuals, and the covariance of the
//! parameters follows from their influence on each parameter. Residuals are smaller and less
//! correlated than the noise, because the fit has followed a part of it; the number of independent
//! values says by how much.
//!
//! - **In**: the residuals of each spectrum, its fitted values, and the influence of each residual.
//! - **Out**: the covariance, or nothing if no spectrum is correlated.
//! - **Always true**: no variance is below that of independent residuals.
//! - **Left out**: correlation between spectra.
//!
//! `docs/src/theory/leaf-optics.md` has the formula.

use super::least_squares::{EXACT, Fit, Parameter, dot, minimise};

/// Fewest values of a spectrum in which correlation is looked for.
const LEAST: usize = 16;
/// Standard deviations beyond which the correlation of neighbours is not chance.
const SIGNIFICANT: f64 = 2.0;
/// Greatest part by which residuals may be less correlated than the noise.
const MOST_LOST: f64 = 0.3;
/// Least size of residuals, over their mean square.
const LEAST_SQUARE: f64 = 1e-3;

/// A spectrum that was fitted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted<'a> {
    /// Wavelengths, nm, rising.
    pub(super) nm: &'a [f64],
    /// Values of the model.
    pub(super) values: &'a [f64],
    /// Model less measurement.
    pub(super) left: &'a [f64],
}

/// How residuals are correlated: `fraction · exp(−Δ / length)` at a distance Δ above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// The part of the noise that is correlated, 0 to 1.
    pub fraction: f64,
    /// Its length, nm.
    pub length_nm: f64,
    /// How many values count as one independent value, ≥ 1.
    pub values_as_one: f64,
}

/// The covariance of parameters of which `influence` has a row each: how much it moves with each
/// residual of all spectra. `unknowns` were fitted.
pub(super) fn covariance(
    spectra: &[Fitted<'_>],
    influence: &[Vec<f64>],
    unknowns: usize,
) -> Option<(Vec<Vec<f64>>, Correlation)> {
    let scales: Vec<Vec<f64>> = spectra.iter().map(|spectrum| sizes(*spectrum)).collect();
    let found: Vec<Option<Vec<f64>>> = spectra
        .iter()
        .zip(&scales)
        .map(|(spectrum, scales)| autocorrelation(*spectrum, scales))
        .collect();
    let there: Vec<&Vec<f64>> = found.iter().flatten().collect();
    let lags = there.iter().map(|lags| lags.len()).min()?;
    let mean = |lag: usize| there.iter().map(|lags| lags[lag]).sum::<f64>() / there.len() as f64;
    let mean: Vec<f64> = (0..lags).map(mean).collect();
    let (nm, count) = (spectra[0].nm, spectra[0].nm.len());
    let values = spectra.len() * count;
    let step = step(nm);
    let threshold = SIGNIFICANT / (count as f64).sqrt();
    let first = mean
        .iter()
        .position(|rho| *rho < threshold)
        .map_or(lags, |at| 2 * (at + 1));
    let kept = first.max(4).min(lags);
    let raw = fitted(&mean[..kept], count);
    let lost = (unknowns as f64 * times(raw) / values as f64).min(MOST_LOST);
    let corrected: Vec<f64> = mean[..kept]
        .iter()
        .map(|rho| rho + lost * (1.0 - rho))
        .collect();
    let [fraction, length] = fitted(&corrected, count);
    let correlation = Correlation {
        fraction,
        length_nm: length * step,
        values_as_one: times([fraction, length]),
    };
    let white = Correlation {
        fraction: 0.0,
        ..correlation
    };
    let mut independent = 0.0;
    let mut sum = vec![vec![0.0; influence.len()]; influence.len()];
    for (number, (own, scales)) in found.iter().zip(&scales).enumerate() {
        let is_correlated = own.is_some();
        let own = if is_correlated { correlation } else { white };
        let factor = if is_correlated {
            times([fraction, length])
        } else {
            1.0
        };
        independent += count as f64 / factor;
        let moved: Vec<Vec<f64>> = influence
            .iter()
            .map(|row| {
                let row = &row[number * count..(number + 1) * count];
                row.iter()
                    .zip(scales)
                    .map(|(row, scale)| row * scale)
                    .collect()
            })
            .collect();
        let falls = own.falls(nm);
        let smooth: Vec<Vec<f64>> = moved.iter().map(|row| own.smoothed(&falls, row)).collect();
        for (line, moved) in sum.iter_mut().zip(&moved) {
            for (sum, smooth) in line.iter_mut().zip(&smooth) {
                *sum += dot(moved, smooth);
            }
        }
    }
    // As many unknowns have followed the noise.
    let spare = (independent - unknowns as f64).max(1.0);
    for value in sum.iter_mut().flatten() {
        *value *= independent / spare;
    }
    Some((sum, correlation))
}

impl Correlation {
    /// What is left of a correlation from one wavelength to the next.
    fn falls(self, nm: &[f64]) -> Vec<f64> {
        let steps = nm.windows(2).map(|pair| pair[1] - pair[0]);
        steps
            .map(|step| libm::exp(-step / self.length_nm))
            .collect()
    }

    /// The sum over all residuals of their correlation with each times a value: for the exponential
    /// by a sweep to either side.
    fn smoothed(self, falls: &[f64], row: &[f64]) -> Vec<f64> {
        let mut smooth: Vec<f64> = row.to_vec();
        let (mut before, mut behind) = (0.0, 0.0);
        for i in 1..row.len() {
            before = falls[i - 1] * (before + row[i - 1]);
            smooth[i] += self.fraction * before;
        }
        for i in (1..row.len()).rev() {
            behind = falls[i - 1] * (behind + row[i]);
            smooth[i - 1] += self.fraction * behind;
        }
        smooth
    }
}

/// How many values of a correlation count as one; its length in steps.
fn times([fraction, length]: [f64; 2]) -> f64 {
    let falls = libm::exp(-1.0 / length);
    1.0 + 2.0 * fraction * falls / (1.0 - falls)
}

/// Fraction and length, in steps, of the exponential through correlations at 1, 2, … steps.
fn fitted(rho: &[f64], count: usize) -> [f64; 2] {
    let known = [
        Parameter {
            bounds: [0.0, 1.0],
            scale: 1.0,
        },
        Parameter {
            bounds: [0.05, count as f64],
            scale: 1.0,
        },
    ];
    let start = [0.8, (rho.len() as f64 / 3.0).max(0.5)];
    let found = minimise(&known, &start, EXACT, |at| {
        let mut fit = Fit::of(2, rho.len());
        for (place, rho) in rho.iter().enumerate() {
            let over = (place + 1) as f64 / at[1];
            let fall = libm::exp(-over);
            fit.left[place] = at[0] * fall - rho;
            fit.slopes[0][place] = fall;
            fit.slopes[1][place] = at[0] * fall * over / at[1];
        }
        fit
    });
    [found.parameters[0], found.parameters[1]]
}

/// The median step of wavelengths.
fn step(nm: &[f64]) -> f64 {
    let mut steps: Vec<f64> = nm.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    steps[steps.len() / 2]
}

/// The size of each residual: the root of `a + b y²` that fits their squares best, those of small
/// residuals as well as those of large ones.
fn sizes(spectrum: Fitted<'_>) -> Vec<f64> {
    let count = spectrum.left.len().max(1) as f64;
    let squares: Vec<f64> = spectrum.left.iter().map(|left| left * left).collect();
    let mean = squares.iter().sum::<f64>() / count;
    let of_signal: Vec<f64> = spectrum.values.iter().map(|value| value * value).collect();
    let mut sizes = vec![mean; squares.len()];
    for _ in 0..5 {
        let weighted = |f: &dyn Fn(usize) -> f64| -> f64 {
            (0..squares.len())
                .map(|i| f(i) / (sizes[i] * sizes[i]))
                .sum()
        };
        let ones = weighted(&|_| 1.0);
        let cross = weighted(&|i| of_signal[i]);
        let signals = weighted(&|i| of_signal[i] * of_signal[i]);
        let (right, right_signal) = (
            weighted(&|i| squares[i]),
            weighted(&|i| of_signal[i] * squares[i]),
        );
        let determinant = ones * signals - cross * cross;
        let both = [
            (right * signals - right_signal * cross) / determinant,
            (right_signal * ones - right * cross) / determinant,
        ];
        let alone = [[right / ones, 0.0], [0.0, right_signal / signals]];
        let is_good = |[a, b]: &[f64; 2]| a.is_finite() && b.is_finite() && *a >= 0.0 && *b >= 0.0;
        let cost = |[a, b]: [f64; 2]| weighted(&|i| (squares[i] - a - b * of_signal[i]).powi(2));
        let best = [both, alone[0], alone[1]].into_iter().filter(is_good);
        let best = best.min_by(|one, other| cost(*one).total_cmp(&cost(*other)));
        let [a, b] = best.unwrap_or([mean, 0.0]);
        let least = LEAST_SQUARE * mean;
        sizes = of_signal
            .iter()
            .map(|signal| (a + b * signal).max(least))
            .collect();
    }
    // Together they are as large as the residuals.
    let over: f64 = squares
        .iter()
        .zip(&sizes)
        .map(|(square, size)| square / size)
        .sum();
    sizes
        .iter()
        .map(|size| (size * over / count).sqrt())
        .collect()
}

/// Correlations of residuals at 1, 2, … steps; `None` if those of neighbours are not correlated.
fn autocorrelation(spectrum: Fitted<'_>, scales: &[f64]) -> Option<Vec<f64>> {
    let (nm, count) = (spectrum.nm, spectrum.left.len());
    let is_constant = scales.iter().all(|scale| *scale > 0.0);
    if count < LEAST || !is_constant {
        return None;
    }
    let residuals: Vec<f64> = spectrum
        .left
        .iter()
        .zip(scales)
        .map(|(left, scale)| left / scale)
        .collect();
    let step = step(nm);
    let most = (count / 8).max(8);
    let mut sums = vec![(0.0, 0); most];
    let is_even = |pair: &[f64]| (pair[1] - pair[0] - step).abs() < 1e-6 * step;
    if nm.windows(2).all(is_even) {
        for (lag, (sum, pairs)) in (1..count).zip(&mut sums) {
            *pairs = count - lag;
            *sum = dot(&residuals[lag..], &residuals[..*pairs]);
        }
    } else {
        for i in 0..count {
            for j in i + 1..count {
                let lag = ((nm[j] - nm[i]) / step).round() as usize;
                if lag > most {
                    break;
                }
                if lag > 0 {
                    sums[lag - 1].0 += residuals[i] * residuals[j];
                    sums[lag - 1].1 += 1;
                }
            }
        }
    }
    let known = sums.iter().take_while(|(_, pairs)| *pairs >= LEAST / 2);
    let rho: Vec<f64> = known.map(|(sum, pairs)| sum / *pairs as f64).collect();
    let neighbours = rho.first()?;
    (neighbours * (count as f64).sqrt() > SIGNIFICANT).then_some(rho)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sweeps_give_the_sum_over_all_pairs() {
        let nm = [400.0_f64, 401.0, 403.0, 410.0];
        let row = [1.0, -2.0, 0.5, 3.0];
        let own = Correlation {
            fraction: 0.7,
            length_nm: 4.0,
            values_as_one: 1.0,
        };
        let smooth = own.smoothed(&own.falls(&nm), &row);
        for i in 0..4 {
            let others = (0..4).map(|j| {
                let rho = if i == j {
                    1.0
                } else {
                    0.7 * libm::exp(-(nm[i] - nm[j]).abs() / 4.0)
                };
                rho * row[j]
            });
            assert!((smooth[i] - others.sum::<f64>()).abs() < 1e-12);
        }
    }

    #[test]
    fn sizes_follow_a_constant_and_a_fraction_of_the_signal() {
        let nm: Vec<f64> = (0..400).map(f64::from).collect();
        let values: Vec<f64> = nm.iter().map(|nm| 0.05 + nm / 1000.0).collect();
        for (constant, fraction) in [(0.01, 0.0), (0.0, 0.02), (0.004, 0.01)] {
            let size = |value: f64| (constant * constant + (fraction * value).powi(2)).sqrt();
            // Signs only: the squares are exact.
            let signs = [1.0, 1.0, -1.0].into_iter().cycle();
            let left: Vec<f64> = values
                .iter()
                .zip(signs)
                .map(|(value, sign)| sign * size(*value))
                .collect();
            let found = sizes(Fitted {
                nm: &nm,
                values: &values,
                left: &left,
            });
            for (found, value) in found.iter().zip(&values) {
                assert!(
                    (found / size(*value) - 1.0).abs() < 1e-6,
                    "{constant} {fraction}"
                );
            }
        }
    }

    #[test]
    fn an_exponential_is_found_by_its_fraction_and_length() {
        let rho: Vec<f64> = (1..40)
            .map(|k| 0.6 * libm::exp(-f64::from(k) / 7.0))
            .collect();
        let [fraction, length] = fitted(&rho, 400);
        assert!((fraction - 0.6).abs() < 1e-6 && (length - 7.0).abs() < 1e-5);
        // 1 + 2 · 0.6 / (e^(1/7) − 1)
        let expected = 1.0 + 1.2 / (libm::exp(1.0 / 7.0) - 1.0);
        assert!((times([0.6, 7.0]) - expected).abs() < 1e-12);
    }
}
