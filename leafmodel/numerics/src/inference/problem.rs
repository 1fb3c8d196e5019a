//! What is to be fitted.

use thiserror::Error;

use super::prior::Parameter;

/// Fewest simulations of a fit.
pub const FEWEST: usize = 200;

/// What an observation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The parameters are to bring it forth.
    Fitted,
    /// The fit does not see it; the posterior foretells it.
    HeldOut,
}

/// A measured number.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Its name.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// What it is for.
    pub role: Role,
}

impl From<(&str, f64, Role)> for Observation {
    fn from((key, value, role): (&str, f64, Role)) -> Self {
        let key = key.to_owned();
        Self { key, value, role }
    }
}

/// Parameters, what was observed, and the effort.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub(super) parameters: Vec<Parameter>,
    pub(super) observed: Vec<Observation>,
    simulations: usize,
    pub(super) seed: u64,
}

/// Why a problem is none.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BadProblem {
    /// No parameter is free.
    #[error("no parameter is free")]
    NothingFree,
    /// No observation is fitted.
    #[error("no measure is fitted")]
    NothingFitted,
    /// A parameter or an observation is there twice (its name).
    #[error("{0} is there twice")]
    Twice(String),
    /// An observation is no number.
    #[error("{key} is {value}, not a finite number")]
    NotFinite {
        /// Its name.
        key: String,
        /// Its value.
        value: f64,
    },
    /// Too few simulations (their number).
    #[error("{0} simulations: {FEWEST} are the fewest, and 25 for each parameter")]
    TooFew(usize),
}

/// How many simulations of which kind.
pub(super) struct Plan {
    /// From the prior.
    pub(super) first: usize,
    /// In each generation around what fits.
    pub(super) each: usize,
    /// From the posterior.
    pub(super) predictive: usize,
}

impl Problem {
    /// A problem that takes `simulations` simulations altogether.
    ///
    /// # Errors
    ///
    /// [`BadProblem`].
    pub fn new(
        parameters: Vec<Parameter>,
        observed: Vec<Observation>,
        simulations: usize,
        seed: u64,
    ) -> Result<Self, BadProblem> {
        if parameters.is_empty() {
            return Err(BadProblem::NothingFree);
        }
        if !observed.iter().any(|one| one.role == Role::Fitted) {
            return Err(BadProblem::NothingFitted);
        }
        let mut names: Vec<&str> = parameters.iter().map(Parameter::name).collect();
        no_twins(&mut names)?;
        let mut keys: Vec<&str> = observed.iter().map(|one| one.key.as_str()).collect();
        no_twins(&mut keys)?;
        if let Some(bad) = observed.iter().find(|one| !one.value.is_finite()) {
            return Err(BadProblem::NotFinite {
                key: bad.key.clone(),
                value: bad.value,
            });
        }
        if simulations < FEWEST.max(25 * parameters.len()) {
            return Err(BadProblem::TooFew(simulations));
        }
        Ok(Self {
            parameters,
            observed,
            simulations,
            seed,
        })
    }

    /// The parameters.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// What was observed.
    pub fn observed(&self) -> &[Observation] {
        &self.observed
    }

    /// Simulations altogether.
    pub fn simulations(&self) -> usize {
        self.simulations
    }

    /// The seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// A tenth foretells, three tenths of the rest come from the prior.
    pub(super) fn plan(&self) -> Plan {
        let predictive = (self.simulations / 10).min(200);
        let rest = self.simulations - predictive;
        let generations = super::GENERATIONS as usize;
        let each = 7 * rest / (10 * generations);
        Plan {
            first: rest - generations * each,
            each,
            predictive,
        }
    }

    /// The values at a place of the scale on which the prior is uniform.
    pub(super) fn values(&self, place: &[f64]) -> Vec<f64> {
        let placed = self.parameters.iter().zip(place);
        let value = |(parameter, place): (&Parameter, &f64)| parameter.at(*place);
        placed.map(value).collect()
    }

    /// Indices of the observations that are fitted.
    pub(super) fn fitted(&self) -> Vec<usize> {
        let numbered = self.observed.iter().enumerate();
        let fitted = numbered.filter(|(_, one)| one.role == Role::Fitted);
        fitted.map(|(index, _)| index).collect()
    }
}

fn no_twins(names: &mut [&str]) -> Result<(), BadProblem> {
    names.sort_unstable();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(BadProblem::Twice(pair[0].to_owned())),
        None => Ok(()),
    }
}
