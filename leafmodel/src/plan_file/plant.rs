//! The keys of a plant, and its presets.

use super::presets::Chosen;
use crate::document::{Declared, Keys};
use crate::plant::presets::PRESETS;
use crate::plant::{PlantError, PlantPlan};

/// The key `preset` of a plant. Where it is there, no other key is required.
pub fn plant_preset(plan: &mut PlantPlan, keys: &mut Keys<'_>) {
    let chosen = Chosen {
        kind: "preset",
        all: PRESETS,
        name_of: |preset| preset.name,
        about: |preset| preset.about,
    };
    let mut preset = None;
    let about = "A plant whose numbers hold where nothing else is said.";
    keys.optional("preset", &mut preset, chosen, about);
    if let Some(preset) = preset {
        *plan = preset.plan();
        keys.set_base(preset.name);
    } else if keys.has_path(&["preset"]) {
        keys.set_unknown_base();
    }
}

/// A plant of which nothing is said.
pub fn usual_plant() -> PlantPlan {
    PlantPlan::usual()
}

/// The keys of a plant's numbers.
pub fn plant(plan: &mut PlantPlan, keys: &mut Keys<'_>) {
    plan.declare(keys);
    if keys.is_sound()
        && let Err(error) = plan.validate()
    {
        let (path, help): (&[&str], _) = match error {
            PlantError::NoRoom { .. } => (
                &["nodes"],
                "use fewer nodes, a longer or thinner axis, or a \
                `shortening` nearer to 1",
            ),
            PlantError::NoPot => (
                &["pot"],
                "make the pot wider or higher, its wall thinner, its rim lower or the soil deeper",
            ),
            PlantError::Range(_)
            | PlantError::TooLarge
            | PlantError::NoLeaf
            | PlantError::Bent(_)
            | PlantError::NotBorne(_) => (&["nodes"], "choose another"),
        };
        keys.refuse(path, error.to_string(), help);
    }
}
