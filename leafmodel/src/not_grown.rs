//! Why something does not grow.

use std::fmt::Display;

use thiserror::Error;

use crate::document::{Keys, RangeError};

/// Why a plan is not carried out.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{problem}")]
pub struct NotGrown {
    problem: String,
    /// Paths of keys: the first that a file has is to be changed, or else the last.
    paths: Vec<String>,
    help: &'static str,
    is_stop: bool,
}

impl NotGrown {
    /// An error with this message.
    pub fn because(problem: impl Display) -> Self {
        Self {
            problem: problem.to_string(),
            paths: Vec::new(),
            help: "",
            is_stop: false,
        }
    }

    /// The end of growth that the caller has stopped.
    pub(crate) fn stopped(message: impl Display) -> Self {
        Self {
            is_stop: true,
            ..Self::because(message)
        }
    }

    /// Whether the caller has stopped the growth.
    pub fn is_stop(&self) -> bool {
        self.is_stop
    }

    /// The same as an error of a part of the plan.
    pub fn of(part: &str, problem: impl Display) -> Self {
        Self::because(format!("{part}: {problem}"))
    }

    /// The same error, named as one of a part of the plan.
    pub(crate) fn in_part(self, part: &str) -> Self {
        let problem = format!("{part}: {}", self.problem);
        Self { problem, ..self }
    }

    /// The same with the key to change, by its path in the block of the plan, and what to write
    /// instead. Of several keys, the first that a file has is meant.
    #[must_use]
    pub(crate) fn mend(mut self, path: &str, help: &'static str) -> Self {
        self.paths.push(path.to_owned());
        Self { help, ..self }
    }

    /// The same with this key to change, unless it has one.
    #[must_use]
    pub(crate) fn or_at(self, path: &str, help: &'static str) -> Self {
        if self.paths.is_empty() {
            self.mend(path, help)
        } else {
            self
        }
    }

    /// The key to change, by its path in the block of the plan, and what to write instead.
    pub fn remedy(&self) -> Option<(&str, &'static str)> {
        Some((self.paths.last()?, self.help))
    }

    /// The same as an error of the block around.
    #[must_use]
    pub(crate) fn within(mut self, block: &str) -> Self {
        for path in &mut self.paths {
            *path = format!("{block}.{path}");
        }
        self
    }

    /// What to write instead.
    pub(crate) fn help(&self) -> &'static str {
        self.help
    }

    /// Reports the error at the key to change, if one is known.
    pub(crate) fn report(&self, keys: &Keys<'_>) {
        let mut paths = self.paths.iter().map(|path| path.split('.').collect());
        let there = paths.find(|path: &Vec<&str>| keys.has_path(path));
        let last = self.paths.last().map(|path| path.split('.').collect());
        if let Some(path) = there.or(last) {
            keys.refuse(&path, self.problem.clone(), self.help);
        }
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
