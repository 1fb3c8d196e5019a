//! What a plan may ask for.

use thiserror::Error;

use super::plan::{DevelopmentPlan, Wave};
use crate::shape::outline::OutlineError;

/// A number: its name, its value, least and greatest, and both in words.
type Check = (&'static str, f64, f64, f64, &'static str);

/// Waves that a plan may have.
const MOST_WAVES: usize = 4;

/// Why a plan gives no leaf.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DevelopmentError {
    /// A number outside the range in which the model holds.
    #[error("{key} is {value}, outside {range}")]
    OutOfRange {
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The same of a wave of initiation.
    #[error("{key} of wave {wave} is {value}, outside {range}")]
    OfWave {
        /// Which wave, from 0.
        wave: usize,
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Too many waves.
    #[error("there are {waves} waves, more than {MOST_WAVES}")]
    TooManyWaves {
        /// How many there are.
        waves: usize,
    },
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
        let form = &self.primordium;
        let resolution = f64::from(self.resolution);
        let checks: [Check; 8] = [
            ("width", form.width, 0.02, 3.0, "0.02 to 3 (lengths)"),
            ("widest_at", form.widest_at, 0.05, 0.95, "0.05 to 0.95"),
            ("taper_base", form.taper_base, 0.2, 3.0, "0.2 to 3"),
            ("taper_tip", form.taper_tip, 0.2, 3.0, "0.2 to 3"),
            ("growth", self.growth, 1.1, 1000.0, "1.1 to 1000"),
            ("basal_growth", self.basal_growth, -0.9, 0.9, "-0.9 to 0.9"),
            ("irregularity", self.irregularity, 0.0, 1.0, "0 to 1"),
            ("resolution", resolution, 20.0, 400.0, "20 to 400"),
        ];
        for (key, value, low, high, range) in checks {
            if !(low..=high).contains(&value) {
                return Err(DevelopmentError::OutOfRange { key, value, range });
            }
        }
        if self.waves.len() > MOST_WAVES {
            return Err(DevelopmentError::TooManyWaves {
                waves: self.waves.len(),
            });
        }
        for (number, wave) in self.waves.iter().enumerate() {
            wave.validate(number, self.growth)?;
        }
        Ok(())
    }
}

impl Wave {
    fn validate(&self, wave: usize, growth: f64) -> Result<(), DevelopmentError> {
        let lengths = "1 to 1000 (lengths of the primordium)";
        let checks: [Check; 16] = [
            ("from", self.from, 1.0, 1000.0, lengths),
            ("until", self.until, 1.0, 1000.0, lengths),
            ("spacing", self.spacing, 0.01, 10.0, "0.01 to 10"),
            ("zone", self.zone[0], 0.0, 1.0, "0 to 1"),
            ("zone", self.zone[1], 0.0, 1.0, "0 to 1"),
            ("transport", self.transport, 0.0, 1.0, "0 to 1"),
            ("rate_base", self.rates[0], 0.5, 1.5, "0.5 to 1.5"),
            ("rate_tip", self.rates[1], 0.5, 1.5, "0.5 to 1.5"),
            ("hold", self.hold, 0.0, 1.0, "0 to 1"),
            ("hold_base", self.hold_base, 0.0, 1.0, "0 to 1"),
            ("terminal", self.terminal, 0.1, 0.9, "0.1 to 0.9"),
            ("sinus", self.sinus, 0.3, 8.0, "0.3 to 8"),
            ("blunt", self.blunt, 0.3, 8.0, "0.3 to 8"),
            ("lean", self.lean, -0.9, 0.9, "-0.9 to 0.9"),
            ("bow", self.bow, -0.3, 0.3, "-0.3 to 0.3"),
            ("splay", self.splay, -0.3, 0.3, "-0.3 to 0.3"),
        ];
        for (key, value, low, high, range) in checks {
            if !(low..=high).contains(&value) {
                return Err(DevelopmentError::OfWave {
                    wave,
                    key,
                    value,
                    range,
                });
            }
        }
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
