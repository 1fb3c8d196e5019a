//! What a plan may ask for.

use thiserror::Error;

use super::plan::{DevelopmentPlan, Wave};
use crate::document::declared::Declared;
use crate::document::ranges::RangeError;
use crate::shape::outline::OutlineError;

/// Why a plan gives no leaf.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DevelopmentError {
    /// A number outside the range in which the model holds.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// A wave ends before it begins.
    #[error("wave {wave} lasts from a length of {from} until {until}; until must be the larger")]
    NoTime {
        /// Which wave, from 0.
        wave: usize,
        /// When it begins.
        from: f64,
        /// When it ends.
        until: f64,
    },
    /// A wave begins when the leaf is full-grown.
    #[error("wave {wave} starts at a length of {from}, but the full-grown leaf is {growth} long")]
    TooLate {
        /// Which wave, from 0.
        wave: usize,
        /// When it begins.
        from: f64,
        /// Length of the full-grown leaf.
        growth: f64,
    },
    /// A zone without extent.
    #[error("zone of wave {wave} goes from {from} to {to}; the second must be the larger")]
    NoZone {
        /// Which wave, from 0.
        wave: usize,
        /// Where it begins.
        from: f64,
        /// Where it ends.
        to: f64,
    },
    /// Convergence points without number.
    #[error("with a spacing of {spacing} wave {wave} brings more than {limit} convergence points")]
    TooManyVeins {
        /// Which wave, from 0.
        wave: usize,
        /// Its spacing.
        spacing: f64,
        /// How many there may be.
        limit: usize,
    },
    /// A margin too long and winding to be followed.
    #[error("the margin takes {points} points, more than {limit}")]
    TooLongMargin {
        /// How many it takes.
        points: usize,
        /// How many there may be.
        limit: usize,
    },
    /// A vein that the blade does not follow.
    #[error("a vein of the leaf leaves its blade")]
    BareVein,
    /// The margin is none in the end.
    #[error("the leaf develops a margin that is none: {0}")]
    Margin(#[from] OutlineError),
}

impl DevelopmentPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`DevelopmentError`], naming the parameter and its range.
    pub fn validate(&self) -> Result<(), DevelopmentError> {
        self.in_range()?;
        for (number, wave) in self.waves.iter().enumerate() {
            wave.validate(number, self.growth)?;
        }
        Ok(())
    }
}

impl Wave {
    fn validate(&self, wave: usize, growth: f64) -> Result<(), DevelopmentError> {
        let Self { from, until, .. } = *self;
        if from >= until {
            return Err(DevelopmentError::NoTime { wave, from, until });
        }
        if from >= growth {
            return Err(DevelopmentError::TooLate { wave, from, growth });
        }
        let [from, to] = self.zone;
        if from >= to {
            return Err(DevelopmentError::NoZone { wave, from, to });
        }
        Ok(())
    }
}
