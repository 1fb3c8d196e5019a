//! Why a file gives no network.

use thiserror::Error;

use super::faults::{Fault, listed};

/// Why a file gives no network. Messages are written to follow the name of the file.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ImportError {
    /// There is nothing in it.
    #[error("is empty")]
    Empty,
    /// It does not follow its format.
    #[error("is no {format}: {problem}")]
    Malformed {
        /// Name of the format.
        format: &'static str,
        /// What the parser says, with the line.
        problem: String,
    },
    /// It holds no veins (what was looked for).
    #[error("holds no veins: {0}")]
    NoVeins(&'static str),
    /// Something of it cannot be read, or is missing.
    #[error("{place}: {problem}")]
    At {
        /// Where it is or should be: a line, a node, a feature.
        place: String,
        /// What is wrong there.
        problem: String,
    },
    /// Lengths without a unit, and no scale (places, radii or the margin).
    #[error(
        "gives {0} without a unit: say how many millimetres a unit or a pixel is (--mm-per-unit), \
         or name the unit in the key, as in x_mm or radius_um"
    )]
    NoScale(&'static str),
    /// Lengths of one kind with a unit beside others without one (places or radii).
    #[error(
        "gives some {0} with a unit and some without one: name the unit in all their keys, as in \
         x_mm or radius_um, or in none"
    )]
    MixedUnits(&'static str),
    /// What is wrong makes measuring senseless (all faults, errors first).
    #[error("cannot be measured:\n{}", listed(.0))]
    Faulty(Vec<Fault>),
    /// The margin is none (what is wrong with it).
    #[error("has a margin that cannot be used: {0}")]
    BadMargin(String),
}

impl ImportError {
    pub(super) fn at(place: impl Into<String>, problem: impl Into<String>) -> Self {
        let (place, problem) = (place.into(), problem.into());
        Self::At { place, problem }
    }

    /// A value that cannot be read, and what may stand there.
    pub(super) fn bad_value(
        place: impl Into<String>,
        key: &str,
        value: &str,
        allowed: &str,
    ) -> Self {
        Self::at(place, format!("{key} is {value}; {allowed}"))
    }

    pub(super) fn malformed(format: &'static str, problem: impl Into<String>) -> Self {
        let problem = problem.into();
        Self::Malformed { format, problem }
    }

    pub(super) fn bad_margin(problem: impl Into<String>) -> Self {
        let problem = problem.into();
        Self::BadMargin(problem)
    }
}
