//! Simulations that were carried out.

use super::outcome::{FitError, Outcome};

/// A simulation that was carried out.
#[derive(Clone, Debug)]
pub(super) struct Particle {
    /// Its parameters where the prior is uniform from 0 to 1.
    pub(super) place: Vec<f64>,
    pub(super) outcome: Outcome,
}

/// What became of the simulations, for people.
#[derive(Clone, Debug, Default)]
pub(super) struct Counts {
    pub(super) all: usize,
    pub(super) failed: usize,
    pub(super) first_failure: Option<String>,
    pub(super) missing: Vec<(String, usize)>,
}

/// Too few simulations that can be compared.
#[derive(Debug)]
pub(super) enum Shortage {
    /// Simulations that lack no fitted measure, and how many are needed.
    TooFew {
        usable: usize,
        needed: usize,
        counts: Counts,
    },
    /// All fitted measures are constant.
    NothingVaries,
}

impl<E> FitError<E> {
    pub(super) fn from_shortage(shortage: Shortage) -> Self {
        match shortage {
            Shortage::NothingVaries => Self::NothingVaries,
            Shortage::TooFew {
                usable,
                needed,
                counts,
            } => Self::TooFew {
                usable,
                needed,
                all: counts.all,
                failed: counts.failed,
                first_failure: counts.first_failure,
                missing: counts.missing.into_iter().max_by_key(|(_, count)| *count),
            },
        }
    }
}
