//! What a simulator brings forth, and why no fit comes of it.

use thiserror::Error;

/// What a simulation has brought forth: a number for each of the problem's observations, in their
/// order, `None` where it has nothing to measure; or why it failed.
pub type Outcome = Result<Vec<Option<f64>>, String>;

/// Why there is no fit.
#[derive(Debug, Error)]
pub enum FitError<E> {
    /// The function that simulates gave up.
    #[error("{0}")]
    Stopped(E),
    /// Too few simulations have all measures that are fitted.
    #[error(
        "{usable} of {all} simulations can be compared, fewer than {needed}: {failed} failed\
         {}{}{}",
        .first_failure.as_ref().map_or_else(String::new, |first| format!(" (the first: {first})")),
        .missing.as_ref().map_or_else(String::new, |(key, count)| format!(
            "; `{key}` is missing in {count}"
        )),
        "; choose ranges nearer to the leaf, or other measures"
    )]
    TooFew {
        /// Simulations that can be compared.
        usable: usize,
        /// How many are needed.
        needed: usize,
        /// All simulations.
        all: usize,
        /// Those that failed.
        failed: usize,
        /// Why the first of them failed.
        first_failure: Option<String>,
        /// The measure that is missing most often, and in how many.
        missing: Option<(String, usize)>,
    },
    /// No measure that is fitted differs among simulations.
    #[error("no measure that is fitted changes with the parameters or by chance")]
    NothingVaries,
}
