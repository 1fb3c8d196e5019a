//! Whether the numbers of a plant fit together.

use glam::DVec3;

use super::{AxisPlan, Branching, Phyllotaxis, PlantError, PlantPlan, Posture};
use crate::document::declared::Declared;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::ranges::RangeError;
use crate::document::value_kind::{Degrees, Integer, Word};

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

/// The keys of a phyllotaxis, and what it is by its name.
pub(super) fn phyllotaxis(axis: &mut AxisPlan, keys: &mut Keys<'_>) {
    let known = [
        ("distichous", Phyllotaxis::DISTICHOUS),
        ("decussate", Phyllotaxis::DECUSSATE),
        ("spiral", Phyllotaxis::SPIRAL),
        ("whorled", Phyllotaxis::WHORLED),
    ];
    // A file says so much of what no word stands for.
    let own = keys.reader().is_none() && known.iter().all(|(_, one)| *one != axis.phyllotaxis);
    let about = "How leaves follow one another: in two rows, in pairs at right angles, one by one \
        by the golden angle, or in whorls of three.";
    if !own {
        keys.key("phyllotaxis", &mut axis.phyllotaxis, Word(&known), about);
    }
    let about = "Leaves of a node, instead of what `phyllotaxis` says.";
    let mut per_node = own.then_some(axis.phyllotaxis.per_node);
    keys.optional("per_node", &mut per_node, Integer::within(1, 12), about);
    let about = "Angle about the axis from node to node, instead of what `phyllotaxis` says.";
    let mut divergence = own.then_some(axis.phyllotaxis.divergence);
    let limits = Degrees(Limits::closed(-180.0, 180.0));
    keys.optional("divergence_deg", &mut divergence, limits, about);
    axis.phyllotaxis = Phyllotaxis {
        per_node: per_node.unwrap_or(axis.phyllotaxis.per_node),
        divergence: divergence.unwrap_or(axis.phyllotaxis.divergence),
    };
}

/// Reports branches that begin behind their end.
pub(super) fn rising(branches: &Branching, keys: &Keys<'_>) {
    let [from, to] = branches.between;
    if from > to {
        let problem = format!("there is nothing from {from} up to {to}");
        keys.refuse(&["between"], problem, "write the smaller share first");
    }
}

/// Gives the direction of the light the length 1.
pub(super) fn towards_light(posture: &mut Posture, keys: &Keys<'_>) {
    match posture.light.try_normalize() {
        Some(light) => posture.light = light,
        None => keys.refuse(
            &["light"],
            "a direction of length 0 is none".to_owned(),
            "write where the light comes from, such as `[0, 0, 1]`",
        ),
    }
}
