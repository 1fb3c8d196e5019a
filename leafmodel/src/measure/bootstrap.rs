//! How sure measures of areoles are: intervals by drawing the areoles anew.

use rayon::prelude::*;

use super::statistics::{mean, median, quantile, variation};
use super::subject::Subject;
use crate::random::{Use, below, bits};
use crate::venation::areole::Areole;

/// Share of the draws on either side of an interval.
const TAIL: f64 = 0.025;

/// The interval of a measure in which 95 % of the draws lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The measure's key.
    pub key: &'static str,
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
    /// Standard deviation of the draws.
    pub error: f64,
}

/// A measure of a list, which it may reorder.
type Measure = fn(&mut [f64]) -> Option<f64>;

impl Subject<'_> {
    /// 95 % intervals of the measures of areoles, by the percentile bootstrap (\[efron1993\]): as
    /// many areoles as there are are drawn with replacement, `draws` times, and measured.
    ///
    /// Areoles are drawn one by one as if they were independent. Neighbours in a leaf are not quite,
    /// so that intervals are rather too narrow; they say nothing of other leaves. Empty for fewer
    /// than two areoles or draws. One seed gives one result.
    pub fn confidence(&self, draws: u32, seed: u64) -> Vec<Interval> {
        let list = |value: fn(&Areole) -> f64| self.found.iter().map(value).collect::<Vec<f64>>();
        let areas = list(|areole| areole.area_mm2);
        let round = list(Areole::circularity);
        let long = list(|areole| areole.elongation);
        let measures: [(&'static str, &[f64], Measure); 6] = [
            ("areole_area_mm2_mean", &areas, |list| mean(list)),
            ("areole_area_cv", &areas, |list| variation(list)),
            ("areole_area_mm2_median", &areas, median),
            ("areole_circularity_mean", &round, |list| mean(list)),
            ("areole_circularity_median", &round, median),
            ("areole_elongation_median", &long, median),
        ];
        let found = measures.into_iter().filter_map(|(key, values, measure)| {
            interval(values, measure, draws, seed).map(|(low, high, error)| Interval {
                key,
                low,
                high,
                error,
            })
        });
        found.collect()
    }
}

/// Both ends of the interval, and the standard deviation of the draws.
fn interval(values: &[f64], measure: Measure, draws: u32, seed: u64) -> Option<(f64, f64, f64)> {
    let count = values.len() as u64;
    if count < 2 || draws < 2 {
        return None;
    }
    let mut found: Vec<f64> = (0..u64::from(draws))
        .into_par_iter()
        .filter_map(|draw| {
            let pick = |i: u64| {
                // The same areoles are drawn for every measure.
                let random = bits(
                    seed,
                    Use::Bootstrap,
                    draw.wrapping_mul(count).wrapping_add(i),
                );
                values[below(random, values.len())]
            };
            measure(&mut (0..count).map(pick).collect::<Vec<f64>>())
        })
        .collect();
    let middle = mean(&found)?;
    let squares: f64 = found
        .iter()
        .map(|value| (value - middle) * (value - middle))
        .sum();
    let error = (squares / (found.len() as f64 - 1.0)).sqrt();
    Some((
        quantile(&mut found, TAIL)?,
        quantile(&mut found, 1.0 - TAIL)?,
        error,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use properties::uniform;

    fn sample(number: u64, count: u64) -> Vec<f64> {
        (0..count).map(|i| uniform(number, 77, i)).collect()
    }

    #[test]
    fn the_error_of_a_mean_is_that_of_the_square_root_law() {
        let values = sample(1, 400);
        let (low, high, error) = interval(&values, |list| mean(list), 4000, 1).expect("many");
        let middle = mean(&values).expect("many");
        let squares: f64 = values.iter().map(|v| (v - middle) * (v - middle)).sum();
        // The bootstrap's variance is that of the sample with n instead of n − 1.
        let expected = (squares / 400.0 / 400.0).sqrt();
        // A standard deviation of 4000 draws is known to 1 in √8000, or 1.1 %.
        assert!(
            (error / expected - 1.0).abs() < 0.045,
            "{error} is not {expected}"
        );
        assert!(
            ((high - low) / (2.0 * 1.96 * expected) - 1.0).abs() < 0.08,
            "{low} to {high}"
        );
        assert!(low < middle && middle < high);
        let again = interval(&values, |list| mean(list), 4000, 1).expect("many");
        assert_eq!(again, (low, high, error));
        assert_ne!(interval(&values, |list| mean(list), 4000, 2), Some(again));
    }

    #[test]
    fn nineteen_of_twenty_intervals_hold_the_true_mean() {
        let held = (0..400)
            .filter(|&number| {
                let (low, high, _) =
                    interval(&sample(number, 100), |list| mean(list), 400, number).expect("many");
                (low..=high).contains(&0.5)
            })
            .count();
        // Binomial with p = 0.945 (percentile intervals of 100 values): 378 ± 4.6.
        assert!((362..=393).contains(&held), "{held} of 400");
    }

    #[test]
    fn few_values_have_no_interval() {
        assert_eq!(interval(&[1.0], |list| mean(list), 100, 1), None);
        assert_eq!(interval(&[1.0, 2.0], |list| mean(list), 1, 1), None);
    }
}
