//! Whether the numbers of a plant fit together.

use glam::DVec3;

use super::plan::PlantPlan;
use crate::document::{Declared, RangeError};
use crate::not_grown::NotGrown;

impl PlantPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the first that is out of range, for nodes without room, and for a pot without an
    /// inside.
    pub fn validate(&self) -> Result<(), NotGrown> {
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
            let problem = "the walls of the pot leave no room for soil";
            let help =
                "make the pot wider or higher, its wall thinner, its rim lower or the soil deeper";
            return Err(NotGrown::because(problem).mend("pot", help));
        }
        self.axis.has_room()
    }
}
