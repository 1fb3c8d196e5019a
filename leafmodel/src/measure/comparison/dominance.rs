//! How often values of one group exceed those of the other.

use super::effect::{Effect, OUTSIDE};
use super::student::quantile;

/// Beyond this on either side lies a twentieth of the normal distribution.
const NORMAL: f64 = 1.959_963_984_540_054;

/// Cliff's delta: the share of pairs in which the value of the second group is the larger one, less
/// the share in which it is the smaller one; −1 to 1.
///
/// The interval is the asymmetric one of \[feng2004\] with the unbiased variance of \[cliff1993\],
/// which is at least `(1 − δ²)/(n₁ n₂ − 1)`, and Student's t with `n₁ + n₂ − 2` degrees of freedom.
/// Where all pairs go one way the variance tells nothing; the inner end is then that of a share of
/// `n` in `n` by Wilson's score, `(n − z²)/(n + z²)` with the size `n` of the smaller group and the
/// normal `z`. `None` if a group has fewer than two
/// values.
pub fn cliffs_delta(first: &[f64], second: &[f64]) -> Option<Effect> {
    let [m, n] = [first.len() as f64, second.len() as f64];
    if m < 2.0 || n < 2.0 {
        return None;
    }
    let sorted = |values: &[f64]| {
        let mut values: Vec<f64> = values.iter().map(|value| value + 0.0).collect();
        values.sort_unstable_by(f64::total_cmp);
        values
    };
    let [below, above] = [sorted(first), sorted(second)];
    // For each value: the others that are smaller less those that are larger, and those not equal.
    let stands = |values: &[f64], others: &[f64]| -> Vec<[f64; 2]> {
        let stand = |value: &f64| {
            let smaller = others.partition_point(|other| other < value);
            let larger = others.len() - others.partition_point(|other| other <= value);
            [smaller as f64 - larger as f64, (smaller + larger) as f64]
        };
        values.iter().map(stand).collect()
    };
    let (rows, columns) = (stands(&above, &below), stands(&below, &above));
    let sum: f64 = rows.iter().map(|row| row[0]).sum();
    let unequal: f64 = rows.iter().map(|row| row[1]).sum();
    let delta = sum / (m * n);
    let t = quantile(OUTSIDE, m + n - 2.0);
    if sum.abs() == m * n {
        let few = m.min(n);
        let inner = delta * (few - NORMAL * NORMAL) / (few + NORMAL * NORMAL);
        let interval = [delta.min(inner), delta.max(inner)];
        return Some(Effect {
            value: delta,
            interval,
        });
    }
    let squares = |stands: &[[f64; 2]], size: f64, sign: f64| -> f64 {
        let off = |stand: &[f64; 2]| stand[0] / size - sign * delta;
        stands.iter().map(|stand| off(stand) * off(stand)).sum()
    };
    let variance = (m * m * squares(&rows, m, 1.0) + n * n * squares(&columns, n, -1.0)
        - (unequal - m * n * delta * delta))
        / (m * n * (m - 1.0) * (n - 1.0));
    let left = 1.0 - delta * delta;
    let spread = t * t * variance.max(left / (m * n - 1.0));
    let reach = (spread * (left * left + spread)).sqrt();
    let end = |reach: f64| ((delta * left + reach) / (left + spread)).clamp(-1.0, 1.0);
    Some(Effect {
        value: delta,
        interval: [end(-reach), end(reach)],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use properties::uniform;

    #[test]
    fn a_published_example_comes_out_as_published() {
        // Hogarty and Kromrey (1999), Using SAS to calculate tests of Cliff's delta: δ = −0.25.
        let treated = [10.0, 10.0, 20.0, 20.0, 20.0, 30.0, 30.0, 30.0, 40.0, 50.0];
        let control = [10.0, 20.0, 30.0, 40.0, 40.0, 50.0];
        let found = cliffs_delta(&control, &treated).expect("values");
        assert!((found.value + 0.25).abs() < 1e-15, "{found:?}");
        // The interval that R's package effsize 0.8 gives for them.
        assert!((found.interval[0] + 0.7265846).abs() < 5e-8, "{found:?}");
        assert!((found.interval[1] - 0.3890062).abs() < 5e-8, "{found:?}");
        let back = cliffs_delta(&treated, &control).expect("values");
        assert!((back.value - 0.25).abs() < 1e-15);
        assert!((back.interval[0] + found.interval[1]).abs() < 1e-12);
    }

    #[test]
    fn pairs_that_all_go_one_way_have_an_interval_that_ends_at_one() {
        let found = cliffs_delta(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0, 7.0]).expect("values");
        assert_eq!((found.value, found.interval[1]), (1.0, 1.0));
        // Wilson's interval of 3 in 3: from 0.4385 on.
        assert!(
            (found.interval[0] - (2.0 * 0.438_503 - 1.0)).abs() < 1e-5,
            "{found:?}"
        );
        let equal = cliffs_delta(&[1.0, 1.0], &[1.0, 1.0, 1.0]).expect("values");
        assert_eq!(equal.value, 0.0);
        assert!(
            equal.interval[0] >= -1.0 && equal.interval[1] <= 1.0,
            "{equal:?}"
        );
        assert_eq!(cliffs_delta(&[1.0], &[1.0, 2.0]), None);
    }

    #[test]
    fn nineteen_of_twenty_intervals_hold_the_truth() {
        // y uniform in [0, 1), x uniform in [−0.3, 0.7): δ = 1 − 0.7² = 0.51.
        let held = (0..1000_u64)
            .filter(|&number| {
                let at = |purpose, i| uniform(number, purpose, i);
                let first: Vec<f64> = (0..12).map(|i| at(71, i) - 0.3).collect();
                let second: Vec<f64> = (0..15).map(|i| at(72, i)).collect();
                let found = cliffs_delta(&first, &second).expect("values");
                (found.interval[0]..=found.interval[1]).contains(&0.51)
            })
            .count();
        // Binomial with p = 0.95: 950 ± 6.9.
        assert!((922..=985).contains(&held), "{held} of 1000");
    }
}
