//! The keys of a plant, and its presets.

use super::presets::Chosen;
use crate::document::{Declared, Keys};
use crate::plant::PlantPlan;
use crate::plant::presets::PRESETS;

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
        error.or_at("nodes", "choose another").report(keys);
    }
}
