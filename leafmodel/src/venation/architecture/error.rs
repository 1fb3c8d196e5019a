//! Why architectures cannot be grown.

use thiserror::Error;

use crate::document::RangeError;

/// Why an architecture cannot be grown, and how to mend it.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{problem}")]
pub struct ArchitectureError {
    /// What is wrong.
    pub problem: String,
    /// The key to change, from the architecture's block on.
    pub key: &'static [&'static str],
    /// What to write there instead.
    pub help: &'static str,
}

impl ArchitectureError {
    /// Refuses what a key says unless it is `valid`.
    pub(super) fn unless(
        valid: bool,
        key: &'static [&'static str],
        problem: impl FnOnce() -> String,
        help: &'static str,
    ) -> Result<(), Self> {
        valid.then_some(()).ok_or_else(|| Self {
            problem: problem(),
            key,
            help,
        })
    }
}

impl From<RangeError> for ArchitectureError {
    fn from(error: RangeError) -> Self {
        Self {
            problem: format!("architecture: {error}"),
            key: &[],
            help: "use a number in range",
        }
    }
}
