//! P-values corrected for the number of tests.

/// Holm's correction: if all p up to 0.05 count, the chance that any of them counts by accident is
/// at most 0.05, however the tests depend on each other.
///
/// # Source
///
/// \[holm1979\].
pub fn holm(p: &[f64]) -> Vec<f64> {
    let order = ascending(p);
    let mut corrected = vec![0.0; p.len()];
    let mut least: f64 = 0.0;
    for (before, &place) in order.iter().enumerate() {
        let tests = (p.len() - before) as f64;
        least = least.max((tests * p[place]).min(1.0));
        corrected[place] = least;
    }
    corrected
}

/// Correction of Benjamini and Hochberg: if all p up to 0.05 count, at most 0.05 of those that do
/// so count by accident, on average; for tests that are independent or rise and fall together.
///
/// # Source
///
/// \[benjamini1995\].
pub fn benjamini_hochberg(p: &[f64]) -> Vec<f64> {
    let order = ascending(p);
    let mut corrected = vec![0.0; p.len()];
    let mut most: f64 = 1.0;
    for (before, &place) in order.iter().enumerate().rev() {
        most = most.min(p[place] * p.len() as f64 / (before + 1) as f64);
        corrected[place] = most;
    }
    corrected
}

fn ascending(p: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fifteen tests of a trial of drugs: the example of \[benjamini1995\].
    const TRIAL: [f64; 15] = [
        0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344, 0.0459, 0.3240, 0.4262,
        0.5719, 0.6528, 0.7590, 1.0,
    ];

    #[test]
    fn as_many_tests_count_as_in_the_published_trial() {
        let count = |p: Vec<f64>| p.into_iter().filter(|p| *p <= 0.05).count();
        // Bonferroni's correction leaves three, and so does Holm's; the false discovery rate four.
        assert_eq!(count(holm(&TRIAL)), 3);
        assert_eq!(count(benjamini_hochberg(&TRIAL)), 4);
        // In another order the same.
        let mut turned = TRIAL;
        turned.reverse();
        let mut back = holm(&turned);
        back.reverse();
        assert_eq!(back, holm(&TRIAL));
    }

    #[test]
    fn corrected_values_are_those_of_the_formulas_by_hand() {
        let p = [0.01, 0.04, 0.03, 0.005];
        let near = |found: Vec<f64>, wanted: [f64; 4]| {
            let mut pairs = found.iter().zip(wanted);
            assert!(
                pairs.all(|(a, b)| (a - b).abs() < 1e-15),
                "{found:?} is not {wanted:?}"
            );
        };
        near(holm(&p), [0.03, 0.06, 0.06, 0.02]);
        near(benjamini_hochberg(&p), [0.02, 0.04, 0.04, 0.02]);
        assert!(holm(&[]).is_empty() && benjamini_hochberg(&[]).is_empty());
        assert_eq!(holm(&[0.9, 0.8]), [1.0, 1.0]);
    }
}
