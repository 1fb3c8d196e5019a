//! Why something does not grow.

use std::fmt::Display;

use thiserror::Error;

use crate::document::ranges::RangeError;

/// Why a plan is not carried out.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{problem}")]
pub struct NotGrown {
    problem: String,
}

impl NotGrown {
    /// An error with this message.
    pub fn because(problem: impl Display) -> Self {
        let problem = problem.to_string();
        Self { problem }
    }

    /// The same as an error of a part of the plan.
    pub fn of(part: &str, problem: impl Display) -> Self {
        Self::because(format!("{part}: {problem}"))
    }
}

impl From<RangeError> for NotGrown {
    fn from(error: RangeError) -> Self {
        Self::because(error)
    }
}

/// A [`NotGrown`] with a message written as for `format!`.
macro_rules! not_grown {
    ($($message:tt)*) => {
        $crate::not_grown::NotGrown::because(format!($($message)*))
    };
}

pub(crate) use not_grown;
