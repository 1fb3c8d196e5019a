//! Cumulative curves, and the test of Kolmogorov and Smirnov.

use serde::Serialize;

/// Products of two counts up to which all orders are counted.
const COUNTED: u64 = 20_000_000;
/// Terms of Kolmogorov's series beyond which nothing is added.
const TERMS: u32 = 100;

/// The greatest distance of two cumulative curves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Steps {
    /// It, 0 to 1.
    pub distance: f64,
    /// Two-sided p, in [0, 1].
    #[serde(skip)]
    pub p: f64,
    /// Whether all orders were counted; otherwise p is that of Kolmogorov's limit.
    pub exact: bool,
}

/// The test of Kolmogorov and Smirnov: do two samples of independent values come from one
/// distribution? Values must ascend.
///
/// Up to 2 · 10⁷ pairs, p is the share of all divisions of the values found into two groups of these
/// sizes whose curves are as far apart, ties and all. For more, Kolmogorov's limit for many values.
/// `None` if a sample is empty.
///
/// # Source
///
/// \[hodges1958\] for counting ways along a lattice; here the chance of having crossed the bound is
/// followed, so that small p keep their digits.
pub fn kolmogorov_smirnov(first: &[f64], second: &[f64]) -> Option<Steps> {
    let [m, n] = [first.len() as u64, second.len() as u64];
    if m == 0 || n == 0 {
        return None;
    }
    let (greatest, is_end) = compared(first, second);
    let distance = greatest as f64 / (m * n) as f64;
    if greatest == 0 {
        let (p, exact) = (1.0, true);
        return Some(Steps { distance, p, exact });
    }
    let exact = m * n <= COUNTED;
    let p = if exact {
        counted(m, n, greatest, &is_end)
    } else {
        let size = m as f64 * n as f64 / (m + n) as f64;
        limit(distance * size.sqrt())
    };
    Some(Steps { distance, p, exact })
}

/// The greatest distance of both curves times `m n`; and for each number of values, whether the
/// value after so many is another one.
fn compared(first: &[f64], second: &[f64]) -> (u64, Vec<bool>) {
    debug_assert!(first.is_sorted() && second.is_sorted());
    let [m, n] = [first.len(), second.len()];
    let (mut i, mut j, mut greatest) = (0, 0, 0);
    let mut is_end = vec![false; m + n + 1];
    while i < m || j < n {
        let next = match (first.get(i), second.get(j)) {
            (Some(a), Some(b)) => a.min(*b),
            (Some(value), None) | (None, Some(value)) => *value,
            (None, None) => break,
        };
        i += first[i..]
            .iter()
            .take_while(|value| **value <= next)
            .count();
        j += second[j..]
            .iter()
            .take_while(|value| **value <= next)
            .count();
        is_end[i + j] = true;
        greatest = greatest.max((i as u64 * n as u64).abs_diff(j as u64 * m as u64));
    }
    (greatest, is_end)
}

/// Share of all ways from (0, 0) to (m, n) that somewhere have `|i n − j m| ≥ greatest`.
fn counted(m: u64, n: u64, greatest: u64, is_end: &[bool]) -> f64 {
    let is_out = |i: u64, j: u64| is_end[(i + j) as usize] && (i * n).abs_diff(j * m) >= greatest;
    // crossed[j]: of the ways to (i, j), the share that has been out.
    let mut crossed = vec![0.0_f64; n as usize + 1];
    for i in 0..=m {
        for j in 0..=n {
            let at = j as usize;
            crossed[at] = if is_out(i, j) {
                1.0
            } else if i + j == 0 {
                0.0
            } else {
                let left = if j > 0 { crossed[at - 1] } else { 0.0 };
                (i as f64 * crossed[at] + j as f64 * left) / (i + j) as f64
            };
        }
    }
    crossed[n as usize].clamp(0.0, 1.0)
}

/// Kolmogorov's limit: the chance of a distance times `√(m n/(m + n))` above `x` > 0.
fn limit(x: f64) -> f64 {
    if x < 1.0 {
        // Jacobi's form of the same series: it needs few terms where the other needs many.
        let pi = std::f64::consts::PI;
        let term = |k: u32| {
            let odd = f64::from(2 * k - 1);
            libm::exp(-odd * odd * pi * pi / (8.0 * x * x))
        };
        let sum: f64 = (1..TERMS).map(term).sum();
        return (1.0 - (2.0 * pi).sqrt() / x * sum).clamp(0.0, 1.0);
    }
    let term = |k: u32| {
        let sign = if k % 2 == 1 { 2.0 } else { -2.0 };
        let k = f64::from(k);
        sign * libm::exp(-2.0 * k * k * x * x)
    };
    (1..TERMS).map(term).sum::<f64>().clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use properties::uniform;

    // Two samples, statistic and p of scipy.stats.ks_2samp(method='exact'); SciPy 1.17.1.
    const STEPS: [(&[f64], &[f64], f64, f64); 4] = [
        (
            &[0.1, 0.4, 0.7, 0.9],
            &[0.2, 0.5, 1.1, 1.3, 1.7],
            0.6,
            0.2857142857142857,
        ),
        (
            &[0.1, 0.2, 0.3, 0.4, 0.45, 0.6],
            &[0.5, 0.7, 0.8, 0.9],
            0.8333333333333334,
            0.04761904761904761,
        ),
        (
            &[1.0, 2.0, 3.0],
            &[10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0],
            1.0,
            0.01666666666666667,
        ),
        (
            &[
                0.034442000000000306,
                0.06888400000000061,
                0.09016999999999964,
                0.12461199999999906,
                0.18033999999999928,
                0.21478199999999958,
                0.23606799999999994,
                0.2705099999999998,
                0.3049520000000001,
                0.32623800000000003,
                0.36067999999999856,
                0.41640799999999967,
                0.4508499999999991,
                0.4721359999999999,
                0.5065779999999993,
                0.5410199999999996,
                0.5623059999999995,
                0.5967479999999998,
                0.618034,
                0.6524760000000001,
                0.6869179999999986,
                0.7082039999999998,
                0.7426459999999988,
                0.7983739999999999,
                0.8328159999999993,
                0.8541019999999999,
                0.8885439999999996,
                0.9229859999999981,
                0.9442719999999998,
                0.9787140000000001,
            ],
            &[
                0.008496396889627732,
                0.01894652089548376,
                0.03783834345738413,
                0.05358885362035675,
                0.09844901045292948,
                0.11952230653594872,
                0.1515721671638701,
                0.17571008839950025,
                0.23868334824587145,
                0.2665858907002251,
                0.3077767411248457,
                0.33806013381850625,
                0.3824894822505974,
                0.4149796711930001,
                0.49698318012069737,
                0.5323598045492073,
                0.5837730204967835,
                0.6210561226742547,
                0.7141951681622841,
                0.7540187643311398,
                0.8115743204226268,
                0.8531007093446206,
                0.9561784522875898,
            ],
            0.24202898550724639,
            0.3582349603428014,
        ),
    ];

    // x, scipy.stats.kstwobign.sf(x).
    const LIMITS: [(f64, f64); 7] = [
        (0.3, 0.9999906941986655),
        (0.6, 0.8642827790506042),
        (0.99, 0.2808738392255489),
        (1.0, 0.26999967167735456),
        (1.01, 0.25943416909359746),
        (1.5, 0.022217962616525127),
        (2.5, 7.453306344157342e-06),
    ];

    #[test]
    fn small_samples_are_those_of_scipy() {
        for (first, second, distance, p) in STEPS {
            let found = kolmogorov_smirnov(first, second).expect("values");
            assert!((found.distance - distance).abs() < 1e-12, "{found:?}");
            assert!((found.p - p).abs() < 1e-12, "{found:?} is not {p}");
        }
    }

    #[test]
    fn kolmogorovs_limit_is_that_of_scipy_on_both_sides_of_one() {
        for (x, p) in LIMITS {
            let found = limit(x);
            assert!((found - p).abs() < 1e-12, "{x}: {found} is not {p}");
        }
    }

    #[test]
    fn ties_are_counted_as_all_divisions_of_four_values() {
        // Of the C(4, 2) = 6 divisions of 1, 1, 2, 2 the curves are 1 apart in two, 0 in four.
        let far = kolmogorov_smirnov(&[1.0, 1.0], &[2.0, 2.0]).expect("values");
        assert!((far.p - 2.0 / 6.0).abs() < 1e-15, "{far:?}");
        let same = kolmogorov_smirnov(&[1.0, 2.0], &[1.0, 2.0]).expect("values");
        assert_eq!((same.distance, same.p), (0.0, 1.0));
        assert_eq!(kolmogorov_smirnov(&[], &[1.0]), None);
    }

    #[test]
    fn one_of_twenty_pairs_of_equal_samples_is_distinguished() {
        let told = (0..1000_u64)
            .filter(|&number| {
                let sample = |purpose, count| {
                    let one = |i| uniform(number, purpose, i);
                    let mut values: Vec<f64> = (0..count).map(one).collect();
                    values.sort_unstable_by(f64::total_cmp);
                    values
                };
                let found = kolmogorov_smirnov(&sample(81, 61), &sample(82, 53)).expect("values");
                found.p <= 0.05
            })
            .count();
        // At most 5 %, less a little since p has steps: binomial 50 ± 6.9.
        assert!((25..=78).contains(&told), "{told} of 1000");
    }
}
