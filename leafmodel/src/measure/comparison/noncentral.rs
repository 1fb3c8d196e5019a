//! Standardised differences of means, and their intervals from the noncentral t-distribution.

use libm::lgamma;

use super::effect::{Effect, OUTSIDE};
use crate::measure::statistics::{mean, variance};

/// Pieces into which each stretch of an integral is cut; Simpson's rule leaves less than 1e-8.
const PIECES: u32 = 400;
/// Standard deviations of a normal distribution beyond which next to nothing lies (1e-17).
const FAR: f64 = 8.5;

/// Hedges' g: the difference of the means in pooled standard deviations, corrected for the bias of
/// few values by the exact factor `Γ(ν/2) / (√(ν/2) Γ((ν − 1)/2))`, `ν = n₁ + n₂ − 2`.
///
/// The interval is that of the noncentrality of t (\[steiger1997\]), times the same factor; it
/// takes both groups as normal with one variance. `None` if a group has fewer than two values, or
/// if neither has spread.
///
/// # Source
///
/// \[hedges1981\].
pub fn hedges_g(first: &[f64], second: &[f64]) -> Option<Effect> {
    let [a, b] = [first.len() as f64, second.len() as f64];
    let squares = (a - 1.0) * variance(first)? + (b - 1.0) * variance(second)?;
    let freedom = a + b - 2.0;
    let deviation = (squares / freedom).sqrt();
    if deviation == 0.0 {
        return None;
    }
    let root = (1.0 / a + 1.0 / b).sqrt();
    let t = (mean(second)? - mean(first)?) / deviation / root;
    let unbiased =
        libm::exp(lgamma(0.5 * freedom) - lgamma(0.5 * (freedom - 1.0))) / (0.5 * freedom).sqrt();
    let limit = |below| noncentrality(t, freedom, below) * root * unbiased;
    Some(Effect {
        value: t * root * unbiased,
        interval: [limit(1.0 - 0.5 * OUTSIDE), limit(0.5 * OUTSIDE)],
    })
}

/// The noncentrality with which t falls below `t` with probability `below`.
fn noncentrality(t: f64, freedom: f64, below: f64) -> f64 {
    let reach = 20.0 + 10.0 * t.abs();
    let (mut low, mut high) = (-reach, reach);
    // The probability falls with the noncentrality.
    while high - low > 1e-10 * reach {
        let middle = 0.5 * (low + high);
        if cumulative(t, freedom, middle) > below {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Probability that noncentral t is at most `t`: `∫ Φ(t s − δ) f(s) ds`, where `s` is the standard
/// deviation that is found over the true one, `s² ν` of the chi-square distribution.
fn cumulative(t: f64, freedom: f64, noncentrality: f64) -> f64 {
    if t < 0.0 {
        return 1.0 - cumulative(-t, freedom, -noncentrality);
    }
    let half = 0.5 * freedom;
    let constant = libm::log(2.0) + half * libm::log(half) - lgamma(half);
    let density = |s: f64| {
        if s > 0.0 {
            libm::exp(constant + (freedom - 1.0) * libm::log(s) - half * s * s)
        } else {
            0.0
        }
    };
    // s is about 1 ± 1/√(2ν).
    let spread = 1.5 * FAR / (2.0 * freedom).sqrt();
    let (least, most) = ((1.0 - spread).max(0.0), 1.0 + spread);
    if t == 0.0 {
        return normal(-noncentrality);
    }
    // Φ rises from 0 to 1 between these.
    let rise = [-FAR, FAR].map(|far| ((noncentrality + far) / t).clamp(least, most));
    let rising = integral(rise, |s| normal(t * s - noncentrality) * density(s));
    let beyond = integral([rise[1], most], density);
    (rising + beyond).clamp(0.0, 1.0)
}

/// Probability that a standard normal number is at most `x`.
pub(super) fn normal(x: f64) -> f64 {
    0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2)
}

/// Simpson's rule.
fn integral([from, to]: [f64; 2], value: impl Fn(f64) -> f64) -> f64 {
    if to <= from {
        return 0.0;
    }
    let step = (to - from) / f64::from(PIECES);
    let inner = (1..PIECES).map(|i| {
        let weight = if i % 2 == 1 { 4.0 } else { 2.0 };
        weight * value(from + f64::from(i) * step)
    });
    let sum = value(from) + value(to) + inner.sum::<f64>();
    sum * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two groups, g, and the ends of its interval.
    type Case = (&'static [f64], &'static [f64], f64, [f64; 2]);

    // t, degrees of freedom, noncentrality, scipy.stats.nct.cdf of them; SciPy 1.17.1.
    const NONCENTRAL: [(f64, f64, f64, f64); 8] = [
        (1.0, 5.0, 0.3, 0.7329759811627552),
        (2.5, 8.0, 1.9, 0.6702316936242378),
        (-1.2, 3.0, 0.4, 0.0853372082355613),
        (10.0, 6.0, 7.0, 0.8020518658569933),
        (0.0, 4.0, 1.1, 0.13566606094638267),
        (3.0, 40.0, 3.5, 0.31122570892423895),
        (-2.0, 12.0, -2.4, 0.6593384304874568),
        (0.02, 9.0, -0.5, 0.6982756703215913),
    ];

    // Two groups, g by its formula, and ends found by scipy.optimize.brentq of scipy.stats.nct.cdf.
    const EFFECTS: [Case; 3] = [
        (
            &[7.9, 8.4, 8.1, 7.6, 8.8],
            &[6.2, 6.9, 6.4, 7.1],
            -3.018451043245458,
            [-4.921745231299799, -1.045009087198316],
        ),
        (
            &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
            &[1.5, 2.0, 4.0, 4.0, 7.0],
            0.09100907144952258,
            [-0.9968686918819012, 1.1739176708558199],
        ),
        (
            &[0.1, 0.4, 0.2],
            &[0.9, 0.8, 1.3, 1.1],
            3.3775844717381007,
            [0.9574201733746364, 5.728553463356059],
        ),
    ];

    #[test]
    fn the_noncentral_distribution_is_that_of_scipy() {
        for (t, freedom, noncentrality, p) in NONCENTRAL {
            let found = cumulative(t, freedom, noncentrality);
            assert!(
                (found - p).abs() < 2e-8,
                "{t} {freedom} {noncentrality}: {found} is not {p}"
            );
        }
    }

    #[test]
    fn intervals_of_g_are_those_that_scipy_inverts() {
        for (first, second, value, interval) in EFFECTS {
            let found = hedges_g(first, second).expect("values with spread");
            assert!(
                (found.value - value).abs() < 1e-9,
                "{found:?} is not {value}"
            );
            for (end, wanted) in found.interval.into_iter().zip(interval) {
                assert!(
                    (end - wanted).abs() < 1e-6 * (1.0 + wanted.abs()),
                    "{found:?} {interval:?}"
                );
            }
        }
    }

    #[test]
    fn no_spread_or_few_values_have_no_effect() {
        assert_eq!(hedges_g(&[1.0], &[2.0, 3.0]), None);
        assert_eq!(hedges_g(&[1.0, 1.0], &[2.0, 2.0]), None);
        // Groups that are millions of deviations apart have finite ends.
        let far = hedges_g(&[0.0, 1e-7], &[1.0, 1.0 + 1e-7]).expect("spread");
        assert!(
            far.interval[0].is_finite() && far.interval[0] > 1e5,
            "{far:?}"
        );
        assert!(far.interval[1] > far.value, "{far:?}");
    }
}
