//! What the posterior foretells of each measure, beside what was observed.

use super::outcome::Outcome;
use super::posterior::{LEVELS, quantile};
use super::problem::{Problem, Role};

/// What simulations from the posterior say of a measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// The measure.
    pub key: String,
    /// Whether the fit saw it.
    pub role: Role,
    /// What was observed.
    pub observed: f64,
    /// Median of the simulations; `None` if none of them has the measure.
    pub median: Option<f64>,
    /// Central intervals with 50, 90 and 95 % of them.
    pub intervals: Option<[[f64; 2]; 3]>,
    /// Share of the simulations below the observation, equal ones by half.
    pub below: Option<f64>,
    /// Simulations that have the measure.
    pub count: usize,
}

impl Prediction {
    /// Whether the observation lies within the 95 % interval; `None` if nothing was foretold.
    pub fn is_within(&self) -> Option<bool> {
        let [_, _, [low, high]] = self.intervals?;
        Some((low..=high).contains(&self.observed))
    }
}

/// What is foretold of each observation.
pub(super) fn predictions(problem: &Problem, outcomes: &[Outcome]) -> Vec<Prediction> {
    let one = |(index, observation): (usize, &super::Observation)| {
        let measured = outcomes.iter().filter_map(|outcome| {
            let value = outcome.as_ref().ok()?.get(index).copied().flatten()?;
            value.is_finite().then_some(value)
        });
        let mut values: Vec<f64> = measured.collect();
        values.sort_by(f64::total_cmp);
        let weight = 1.0 / values.len() as f64;
        let sorted: Vec<(f64, f64)> = values.iter().map(|value| (*value, weight)).collect();
        let is_any = !sorted.is_empty();
        let ends = |level: f64| [0.5 - 0.5 * level, 0.5 + 0.5 * level];
        let observed = observation.value;
        let share = |value: f64| {
            if value < observed {
                weight
            } else if value == observed {
                0.5 * weight
            } else {
                0.0
            }
        };
        Prediction {
            key: observation.key.clone(),
            role: observation.role,
            observed,
            median: is_any.then(|| quantile(&sorted, 0.5)),
            intervals: is_any
                .then(|| LEVELS.map(|level| ends(level).map(|share| quantile(&sorted, share)))),
            below: is_any.then(|| values.iter().map(|value| share(*value)).sum()),
            count: values.len(),
        }
    };
    problem.observed.iter().enumerate().map(one).collect()
}
