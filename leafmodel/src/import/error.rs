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
    /// It holds no veins.
    #[error("holds no veins: {wanted}")]
    NoVeins {
        /// What was looked for.
        wanted: &'static str,
    },
    /// A value cannot be read.
    #[error("{place}: {key} is {value}; {allowed}")]
    BadValue {
        /// Where it stands: a line, a node, a feature.
        place: String,
        /// Its name.
        key: String,
        /// What stands there.
        value: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// Something that is needed is not there.
    #[error("{place}: {wanted}")]
    Missing {
        /// Where it should stand.
        place: String,
        /// What is missing.
        wanted: String,
    },
    /// Two nodes have one name.
    #[error("{place}: two nodes are called {name}")]
    NameTwice {
        /// Where the second stands.
        place: String,
        /// The name.
        name: String,
    },
    /// Lengths without a unit, and no scale.
    #[error(
        "gives {what} without a unit: say how many millimetres a unit or a pixel is (--mm-per-unit), \
         or name the unit in the key, as in x_mm or radius_um"
    )]
    NoScale {
        /// Places, radii or the margin.
        what: &'static str,
    },
    /// Lengths of one kind with a unit beside others without one.
    #[error(
        "gives some {what} with a unit and some without one: name the unit in all their keys, as in \
         x_mm or radius_um, or in none"
    )]
    MixedUnits {
        /// Places or radii.
        what: &'static str,
    },
    /// What is wrong makes measuring senseless.
    #[error("cannot be measured:\n{}", listed(.faults))]
    Faulty {
        /// All faults, errors first.
        faults: Vec<Fault>,
    },
    /// The margin is none.
    #[error("has a margin that cannot be used: {problem}")]
    BadMargin {
        /// What is wrong with it.
        problem: String,
    },
}
