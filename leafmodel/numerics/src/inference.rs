//! Parameters of a random simulator from what was measured, without a likelihood.
//!
//! - **In**: a [`Problem`]: [`Parameter`]s with their ranges, [`Observation`]s, a number of
//!   simulations and a seed; and a function that carries out simulations.
//! - **Out**: a [`Fit`]: a weighted sample of the posterior, what it says of each parameter
//!   ([`ParameterEstimate`]), and how well it foretells what was measured ([`Prediction`]).
//! - **Always true**: no value of the sample lies outside of its range; no number is NaN. The same
//!   problem and the same simulations give the same bits on every machine; what is simulated
//!   depends on nothing but the problem and earlier simulations.
//! - **Left out**: what is simulated, on how many threads, and whether simulations are kept for
//!   later, which the caller decides.
//!
//! Approximate Bayesian computation by adaptive multiple importance sampling: simulations from the
//! prior come first, then four generations from around what fits (\[beaumont2009\]); all of them are
//! weighted together (\[cornuet2012\]), compared with the observation by estimates of the
//! parameters (\[fearnhead2012\]) and moved to it by the same local regression (\[beaumont2002\]).
//! `docs/src/theory/fit.md` says how, and how it was calibrated.
//!
//! ```
//! use numerics::inference::{Observation, Parameter, Problem, Role, fit};
//!
//! // The rate of a clock whose hand is read with an error of 0.1 (a fixed wave stands for noise).
//! let rate = Parameter::new("rate", 0.0, 5.0)?;
//! let observed = [("read", 3.0, Role::Fitted)].map(Observation::from).to_vec();
//! let problem = Problem::new(vec![rate], observed, 400, 1)?;
//! let found = fit(&problem, |draws| {
//!     let noise = |seed: u64| 0.1 * libm::sin(seed as f64);
//!     let read = draws.iter().map(|draw| Ok(vec![Some(draw.values[0] + noise(draw.seed))]));
//!     Ok::<_, std::convert::Infallible>(read.collect())
//! })?;
//! let told = &found.parameters[0];
//! assert!((told.median - 3.0).abs() < 0.05 && told.deviation < 0.12, "{told:?}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod distances;
mod linear;
mod outcome;
mod population;
mod posterior;
mod prediction;
mod prior;
mod problem;
mod random;
mod regression;
mod simulated;
#[cfg(test)]
mod tests;

pub use self::outcome::{FitError, Outcome};
pub use self::posterior::{Beyond, Correlation, Identified, ParameterEstimate};
pub use self::prediction::Prediction;
pub use self::prior::{BadRange, Parameter};
pub use self::problem::{BadProblem, FEWEST, Observation, Problem, Role};

use self::distances::Located;
use self::population::Population;
use self::random::seed_of;

/// A simulation that is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// 0 for simulations from the prior, 1 and more for those around what fits, the last one for
    /// those that foretell.
    pub generation: u32,
    /// Its number among those of the generation, from 0.
    pub number: u32,
    /// Seed of its chance: a function of the problem's seed, the generation and the number.
    pub seed: u64,
    /// The parameters, in the problem's order and within their ranges.
    pub values: Vec<f64>,
}

/// Parameters that bring forth what was observed.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// What is known of each parameter, in the problem's order.
    pub parameters: Vec<ParameterEstimate>,
    /// Of each pair of parameters.
    pub correlations: Vec<Correlation>,
    /// The posterior: values of the parameters, and a weight; weights add up to 1.
    pub sample: Vec<(Vec<f64>, f64)>,
    /// `1 / Σ w²`: as many equally weighted draws would be worth the same.
    pub effective_size: f64,
    /// Largest distance of a simulation in the sample from the observation, in standard deviations
    /// of the posterior.
    pub tolerance: f64,
    /// Simulations from prior and around what fits.
    pub simulations: usize,
    /// Those of them that failed.
    pub failed: usize,
    /// Why the first of them failed.
    pub first_failure: Option<String>,
    /// Measures that some of them lack, and how many do.
    pub missing: Vec<(String, usize)>,
    /// Measures that are the same in all simulations, and so were left out; and whether the
    /// observation has the same value.
    pub constant: Vec<(String, bool)>,
    /// How the sample foretells each measure, in the order of the observations.
    pub predictions: Vec<Prediction>,
}

/// Generations around what fits.
const GENERATIONS: u32 = 4;

/// Fits parameters to what was observed. `simulate` carries out simulations and gives an outcome
/// for each, in order; an error of its own ends the fit.
///
/// # Errors
///
/// [`FitError`].
pub fn fit<E>(
    problem: &Problem,
    mut simulate: impl FnMut(&[Draw]) -> Result<Vec<Outcome>, E>,
) -> Result<Fit, FitError<E>> {
    let plan = problem.plan();
    let mut population = Population::new(problem);
    for generation in 0..=GENERATIONS {
        let count = if generation == 0 {
            plan.first
        } else {
            plan.each
        };
        let places = population.propose(generation, count);
        let draws = draws(problem, generation, &places);
        let outcomes = simulate(&draws).map_err(FitError::Stopped)?;
        population.take(places, outcomes);
        let located = population.locate().map_err(FitError::from_shortage)?;
        population.centre(&located);
    }
    let located = population.locate().map_err(FitError::from_shortage)?;
    let places = located.resampled(problem.seed, GENERATIONS + 1, plan.predictive);
    let draws = draws(problem, GENERATIONS + 1, &places);
    let outcomes = simulate(&draws).map_err(FitError::Stopped)?;
    Ok(told(problem, &population, &located, &outcomes))
}

/// Simulations at places of the scale on which the prior is uniform.
fn draws(problem: &Problem, generation: u32, places: &[Vec<f64>]) -> Vec<Draw> {
    let numbered = places.iter().zip(0..);
    let draw = |(place, number): (&Vec<f64>, u32)| Draw {
        generation,
        number,
        seed: seed_of(problem.seed, generation, number),
        values: problem.values(place),
    };
    numbered.map(draw).collect()
}

fn told(
    problem: &Problem,
    population: &Population<'_>,
    located: &Located,
    foretold: &[Outcome],
) -> Fit {
    let total: f64 = located.sample.iter().map(|(_, weight)| weight).sum();
    let sample: Vec<(Vec<f64>, f64)> = located
        .sample
        .iter()
        .map(|(place, weight)| (place.clone(), weight / total))
        .collect();
    let squares: f64 = sample.iter().map(|(_, weight)| weight * weight).sum();
    let counts = population.counts();
    Fit {
        parameters: posterior::estimates(problem, &sample, &located.expected),
        correlations: posterior::correlations(problem, &sample),
        effective_size: 1.0 / squares,
        tolerance: located.tolerance,
        simulations: counts.all,
        failed: counts.failed,
        first_failure: counts.first_failure,
        missing: counts.missing,
        constant: located.constant.clone(),
        predictions: prediction::predictions(problem, foretold),
        sample: sample
            .into_iter()
            .map(|(place, weight)| (problem.values(&place), weight))
            .collect(),
    }
}
