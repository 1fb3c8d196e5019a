//! What a plan may ask for.

use super::plan::{DevelopmentPlan, Wave};
use crate::document::Declared;
use crate::not_grown::{NotGrown, not_grown};

/// An error of a wave, at one of its keys or at all waves.
pub(super) fn of_wave(error: NotGrown, wave: usize, key: &str, help: &'static str) -> NotGrown {
    let error = error.mend(&format!("waves.{wave}.{key}"), help);
    error.mend("waves", help)
}

/// The error of a margin that is none.
pub(super) fn no_margin(error: impl std::fmt::Display) -> NotGrown {
    bent(not_grown!(
        "the leaf develops a margin that is none: {error}"
    ))
}

/// An error of a blade that bends too much.
pub(super) fn bent(error: NotGrown) -> NotGrown {
    error.mend(
        "waves",
        "use less splay, rates that differ less, or less hold",
    )
}

impl DevelopmentPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming the parameter and its range.
    pub fn validate(&self) -> Result<(), NotGrown> {
        self.in_range()?;
        for (number, wave) in self.waves.iter().enumerate() {
            wave.validate(number, self.growth)?;
        }
        Ok(())
    }
}

impl Wave {
    fn validate(&self, wave: usize, growth: f64) -> Result<(), NotGrown> {
        let Self { from, until, .. } = *self;
        if from >= until {
            let error = not_grown!(
                "wave {wave} lasts from a length of {from} until {until}; until must be the larger"
            );
            return Err(of_wave(
                error,
                wave,
                "until",
                "let the wave end at a larger length",
            ));
        }
        if from >= growth {
            let error = not_grown!(
                "wave {wave} starts at a length of {from}, but the full-grown leaf is {growth} long"
            );
            let help = "let the wave start earlier, or the leaf grow longer";
            return Err(of_wave(error, wave, "from", help));
        }
        let [from, to] = self.zone;
        if from >= to {
            let error = not_grown!(
                "zone of wave {wave} goes from {from} to {to}; the second must be the larger"
            );
            return Err(of_wave(error, wave, "zone", "give the lower end first"));
        }
        Ok(())
    }
}
