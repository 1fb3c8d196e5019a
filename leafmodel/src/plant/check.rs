//! Whether the numbers of a plant fit together.

use glam::DVec3;

use super::error::PlantError;
use super::plan::PlantPlan;
use crate::document::{Declared, RangeError};

impl PlantPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`PlantError::Range`] for the first that is out of range, [`PlantError::NoRoom`],
    /// [`PlantError::NoPot`].
    pub fn validate(&self) -> Result<(), PlantError> {
        self.in_range()?;
        let climbing = self.climbing.as_ref().map(|climbing| climbing.away);
        for (path, direction) in [
            ("posture.light", Some(self.posture.light)),
            ("climbing.away", climbing),
        ] {
            let length = direction.map_or(1.0, DVec3::length);
            let valid = (0.999..=1.001).contains(&length);
            RangeError::unless(valid, path, length, "a unit vector")?;
        }
        if let Some(relief) = self.relief.as_ref().filter(|relief| relief.is_crowded()) {
            let limits = "so few that they leave some bark free";
            let many = relief.lenticels_per_cm2;
            RangeError::unless(false, "relief.lenticels_per_cm2", many, limits)?;
        }
        if self.pot.as_ref().is_some_and(|pot| !pot.is_hollow()) {
            return Err(PlantError::NoPot);
        }
        self.axis.has_room()
    }
}
