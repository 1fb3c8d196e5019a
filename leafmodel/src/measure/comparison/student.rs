//! Means, their intervals, and Welch's test of two of them.

use serde::Serialize;

use special::Beta;

use super::effect::OUTSIDE;
use crate::measure::statistics::{mean, median, variance};

/// What a group of values is like.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// How many values there are, > 0.
    pub count: usize,
    /// Their arithmetic mean.
    pub mean: f64,
    /// Their median.
    pub median: f64,
    /// Standard deviation of a sample (`n − 1`); `None` for one value.
    #[serde(rename = "standard_deviation")]
    pub deviation: Option<f64>,
    /// Ends of the 95 % interval of the mean by Student's t; `None` for one value.
    #[serde(rename = "mean_interval_95")]
    pub interval: Option<[f64; 2]>,
}

/// Summary of some values; `None` without any.
pub fn summary(values: &[f64]) -> Option<Summary> {
    let (count, middle) = (values.len(), mean(values)?);
    let spread = variance(values);
    let interval = spread.map(|variance| {
        let error = (variance / count as f64).sqrt();
        let reach = quantile(OUTSIDE, count as f64 - 1.0) * error;
        [middle - reach, middle + reach]
    });
    Some(Summary {
        count,
        mean: middle,
        median: median(&mut values.to_vec())?,
        deviation: spread.map(f64::sqrt),
        interval,
    })
}

/// Welch's test of two means.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Welch {
    /// Mean of the second group less that of the first.
    #[serde(skip)]
    pub difference: f64,
    /// Ends of its 95 % interval.
    #[serde(skip)]
    pub interval: [f64; 2],
    /// The difference over its standard error.
    pub t: f64,
    /// Degrees of freedom by Satterthwaite's formula, ≥ 1.
    #[serde(rename = "degrees_of_freedom")]
    pub freedom: f64,
    /// Two-sided p, in [0, 1]; 0 only where it is below all numbers.
    #[serde(skip)]
    pub p: f64,
}

/// Welch's t-test: are the means of two groups equal, whose variances may differ?
///
/// `None` if a group has fewer than two values, or if neither group has any spread.
///
/// # Source
///
/// \[welch1947\].
pub fn welch(first: &[f64], second: &[f64]) -> Option<Welch> {
    let share = |values: &[f64]| Some(variance(values)? / values.len() as f64);
    let [a, b] = [share(first)?, share(second)?];
    let error = (a + b).sqrt();
    if error == 0.0 {
        return None;
    }
    let count = |values: &[f64]| values.len() as f64 - 1.0;
    // Shares of the variance of the difference: their squares cannot underflow.
    let [a, b] = [a, b].map(|part| part / (error * error));
    let freedom = 1.0 / (a * a / count(first) + b * b / count(second));
    let difference = mean(second)? - mean(first)?;
    let t = difference / error;
    let reach = quantile(OUTSIDE, freedom) * error;
    Some(Welch {
        difference,
        interval: [difference - reach, difference + reach],
        t,
        freedom,
        p: two_sided(t, freedom),
    })
}

/// The test of one value among others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Among {
    /// The value less the mean of the others, over the standard error of that.
    pub t: f64,
    /// Degrees of freedom, ≥ 1.
    #[serde(rename = "degrees_of_freedom")]
    pub freedom: f64,
    /// Two-sided p, in [0, 1].
    #[serde(skip)]
    pub p: f64,
}

/// Does one value belong to those of a group? Takes the group as normal, and the value as drawn with
/// the same spread.
///
/// `None` if the group has fewer than two values or no spread.
///
/// # Source
///
/// \[crawford1998\].
pub fn one_among(value: f64, others: &[f64]) -> Option<Among> {
    let count = others.len() as f64;
    let error = (variance(others)? * (1.0 + 1.0 / count)).sqrt();
    if error == 0.0 {
        return None;
    }
    let (t, freedom) = ((value - mean(others)?) / error, count - 1.0);
    let p = two_sided(t, freedom);
    Some(Among { t, freedom, p })
}

/// Probability that Student's t with these degrees of freedom is farther from 0 than `t`.
pub(super) fn two_sided(t: f64, freedom: f64) -> f64 {
    let half = 0.5 * freedom;
    let x = freedom / (freedom + t * t);
    x.inc_beta(half, 0.5, half.ln_beta(0.5)).clamp(0.0, 1.0)
}

/// The t > 0 from which Student's t is farther from 0 with probability `outside`.
pub(super) fn quantile(outside: f64, freedom: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while two_sided(high, freedom) > outside {
        (low, high) = (high, 2.0 * high);
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if two_sided(middle, freedom) > outside {
            low = middle;
        } else {
            high = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // t, degrees of freedom, 2 scipy.stats.t.sf(|t|, freedom); SciPy 1.17.1.
    const TAILS: [(f64, f64, f64); 7] = [
        (0.5, 3.0, 0.651447964848151),
        (2.1, 17.776, 0.05027647118287698),
        (12.0, 4.0, 0.000276428548502973),
        (-3.3, 1.0, 0.18731554186375868),
        (40.0, 2.5, 0.0001419563429049338),
        (0.001, 100.0, 0.9992041077601035),
        (9.0, 250.0, 5.84847305991762e-17),
    ];

    // Degrees of freedom, scipy.stats.t.isf(0.025, freedom).
    const QUANTILES: [(f64, f64); 5] = [
        (1.0, 12.706204736174705),
        (2.0, 4.302652729749464),
        (4.5, 2.658912347204404),
        (17.776, 2.1028213103802216),
        (100.0, 1.983971518523552),
    ];

    /// More hours of sleep with two drugs (\[student1908\]): the example of Welch's test in R's
    /// manual, which prints t = −1.8608, df = 17.776, p = 0.07939, −3.3654832 to 0.2054832.
    const FIRST: [f64; 10] = [0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0];
    const SECOND: [f64; 10] = [1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4];

    #[test]
    fn the_sleep_of_students_patients_comes_out_as_published() {
        let found = welch(&FIRST, &SECOND).expect("ten values each");
        assert!((found.t - 1.8608).abs() < 5e-5, "{found:?}");
        assert!((found.freedom - 17.776).abs() < 5e-4, "{found:?}");
        assert!((found.p - 0.07939).abs() < 5e-6, "{found:?}");
        assert!((found.difference - 1.58).abs() < 1e-12);
        assert!((found.interval[0] + 0.2054832).abs() < 5e-8, "{found:?}");
        assert!((found.interval[1] - 3.3654832).abs() < 5e-8, "{found:?}");
        let back = welch(&SECOND, &FIRST).expect("ten values each");
        assert_eq!((back.t, back.p), (-found.t, found.p));
    }

    #[test]
    fn probabilities_of_student_are_those_of_scipy() {
        for (t, freedom, p) in TAILS {
            let found = two_sided(t, freedom);
            assert!(
                (found / p - 1.0).abs() < 1e-10,
                "t {t}, {freedom}: {found} is not {p}"
            );
        }
        for (freedom, t) in QUANTILES {
            let found = quantile(0.05, freedom);
            assert!(
                (found / t - 1.0).abs() < 1e-10,
                "{freedom}: {found} is not {t}"
            );
        }
    }

    #[test]
    fn one_value_among_five_is_tested_as_by_hand() {
        // (8 − 3) / (√2.5 √1.2); 2 scipy.stats.t.sf(t, 4) of SciPy 1.17.1.
        let found = one_among(8.0, &[1.0, 2.0, 3.0, 4.0, 5.0]).expect("a group");
        assert!(
            (found.t - 2.886_751_345_948_128_7).abs() < 1e-14,
            "{found:?}"
        );
        assert!(
            (found.p - 0.044_708_587_279_680_585).abs() < 1e-10,
            "{found:?}"
        );
        assert_eq!(found.freedom, 4.0);
        assert_eq!(one_among(8.0, &[1.0]), None);
        assert_eq!(one_among(8.0, &[1.0, 1.0]), None);
    }

    #[test]
    fn few_values_and_values_without_spread_have_no_test() {
        assert_eq!(summary(&[]), None);
        let one = summary(&[3.0]).expect("a value");
        assert_eq!((one.mean, one.deviation, one.interval), (3.0, None, None));
        assert_eq!(welch(&[1.0], &[2.0, 3.0]), None);
        assert_eq!(welch(&[1.0, 1.0], &[2.0, 2.0]), None);
        let half = welch(&[1.0, 1.0], &[2.0, 3.0]).expect("one has spread");
        assert!((half.freedom - 1.0).abs() < 1e-12);
        // Squares of variances this small are below all numbers.
        let small = welch(&[1e-100, 2e-100], &[3e-100, 5e-100]).expect("spread");
        assert!((small.t - 2.236_067_977_499_79).abs() < 1e-12, "{small:?}");
    }
}
