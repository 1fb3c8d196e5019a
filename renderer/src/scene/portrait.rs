//! Scenes that show a preset by itself, on a stage.

use clap::ValueEnum;
use leafmodel::plant;
use leafmodel::species;

/// A stage of portraits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Stage {
    /// Before a grey backdrop between soft boxes: form, gloss, hairs
    #[default]
    Studio,
    /// On a light table: veins and colours in light that comes through
    Backlit,
    /// Flat, from above, in even light on white paper: outline and colours
    Scanner,
}

/// The text of a scene with a leaf or a plant by the name of its preset; `None` if there is no such preset.
pub fn portrait(preset: &str, stage: Stage) -> Option<String> {
    if let Some(found) = species::find(preset) {
        let length_m = found.plan().length_mm * 1e-3;
        return Some(of_leaf(found.name, length_m, stage));
    }
    let found = plant::presets::find(preset)?;
    Some(of_plant(found.name, found.leaf?))
}

/// The text of a scene with nothing but a leaf or a plant by the name of its preset, for exports.
pub fn alone(preset: &str) -> Option<String> {
    let (name, blocks) = if let Some(found) = species::find(preset) {
        let name = found.name;
        (
            name,
            format!("[leaves.{name}]\npreset = \"{name}\"\n[objects.{name}]\nleaf = \"{name}\"\n"),
        )
    } else {
        let found = plant::presets::find(preset)?;
        (found.name, plant_blocks(found.name, found.leaf?))
    };
    Some(format!(
        "format = 1\n[film.rgb]\nsize = [64, 64]\nspp = 1\n\
         [camera.perspective]\nposition_m = [0, 0, 1]\nlook_at_m = [0, 0.001, 0]\nvertical_fov_deg = 30\nframe = \"{name}\"\n\
         {blocks}[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n"
    ))
}

/// A plant with its leaves.
fn plant_blocks(preset: &str, leaf: &str) -> String {
    format!(
        "[leaves.leaf]\npreset = \"{leaf}\"\nmap_size = 768\n[plants.{preset}]\npreset = \"{preset}\"\nleaf = \"leaf\"\n\
         [objects.{preset}]\nplant = \"{preset}\"\n"
    )
}

fn of_leaf(preset: &str, length_m: f64, stage: Stage) -> String {
    let leaf = format!("[leaves.leaf]\npreset = \"{preset}\"\nmap_size = 2048\n");
    let whole = match stage {
        Stage::Studio => format!(
            "[picture]\ntone = \"agx\"\nexposure_ev = 1\n\
             [camera.perspective]\nposition_m = [0.15, -1, 0.12]\nlook_at_m = [0, 0, 0]\nfocal_length_mm = 85\nf_number = 11\n\
             frame = \"leaf\"\nframe_margin = 0.08\n\
             [lights.set.rig]\npreset = \"studio\"\nsize_m = {size}\nsubject_m = [0, 0, {middle}]\n\
             [materials.backdrop.diffuse]\nreflectance = 0.2\n\
             [meshes.backdrop.rectangle]\nwidth_m = {wide}\nheight_m = {wide}\n\
             [objects.backdrop]\nmesh = \"backdrop\"\nmaterial = \"backdrop\"\nposition_m = [0, {behind}, 0]\nrotate_deg = [90, 0, 0]\n\
             [objects.leaf]\nleaf = \"leaf\"\nrotate_deg = [72, -4, 10]\n",
            size = 1.3 * length_m,
            middle = 0.5 * length_m,
            wide = 100.0 * length_m,
            behind = 1.5 * length_m,
        ),
        Stage::Backlit => format!(
            "[picture]\ntone = \"agx\"\nexposure_ev = 0.3\n\
             [camera.perspective]\nposition_m = [0, 0, 1]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\nfocal_length_mm = 100\n\
             frame = \"leaf\"\n\
             [lights.table.rig]\npreset = \"lightbox\"\nsize_m = {size}\nsubject_m = [0, {middle}, 0]\n\
             [objects.leaf]\nleaf = \"leaf\"\n",
            size = 1.6 * length_m,
            middle = 0.5 * length_m,
        ),
        Stage::Scanner => format!(
            "[picture]\ntone = \"standard\"\nexposure_ev = 0.15\n\
             [camera.orthographic]\nposition_m = [0, 0, 1]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\nframe = \"leaf\"\n\
             [lights.lamp.rig]\npreset = \"overcast\"\n\
             [materials.paper.diffuse]\nreflectance = 0.9\n\
             [meshes.paper.rectangle]\nwidth_m = {wide}\nheight_m = {wide}\n\
             [objects.paper]\nmesh = \"paper\"\nmaterial = \"paper\"\nposition_m = [0, 0, {down}]\n\
             [objects.leaf]\nleaf = \"leaf\"\n",
            wide = 60.0 * length_m,
            down = -0.25 * length_m,
        ),
    };
    format!("format = 1\n[film.rgb]\nsize = [750, 1000]\nspp = 128\n{leaf}{whole}")
}

/// A bough below an overcast sky.
fn of_plant(preset: &str, leaf: &str) -> String {
    format!(
        "format = 1\n[film.rgb]\nsize = [1000, 1000]\nspp = 128\n\
         [picture]\ntone = \"agx\"\nauto_exposure = true\n\
         [camera.perspective]\nposition_m = [1, -0.35, 0.15]\nlook_at_m = [0, 0, 0]\nfocal_length_mm = 85\nf_number = 8\n\
         frame = \"{preset}\"\n{}\
         [lights.day.rig]\npreset = \"overcast\"\n",
        plant_blocks(preset, leaf)
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use leafmodel::plant::presets;
    use leafmodel::species::PRESETS;

    use super::*;
    use crate::scene::load::parse;

    fn check(name: &str, text: Option<String>) {
        let text = text.unwrap_or_else(|| panic!("{name} is a preset"));
        let loaded = parse(&text, "portrait.toml", Path::new("."), &[]);
        let loaded = loaded.unwrap_or_else(|errors| panic!("{name}: {errors}"));
        assert!(loaded.warnings.is_empty(), "{name}: {:?}", loaded.warnings);
    }

    #[test]
    fn every_preset_makes_a_good_scene() {
        let plants = presets::PRESETS.iter();
        let plants = plants.filter(|plant| plant.leaf.is_some());
        let names = PRESETS.iter().map(|preset| preset.name);
        for name in names.chain(plants.map(|plant| plant.name)) {
            check(name, portrait(name, Stage::Studio));
            check(name, alone(name));
        }
        for stage in Stage::value_variants() {
            check("poplar", portrait("poplar", *stage));
        }
        assert_eq!(portrait("no-such-leaf", Stage::Studio), None);
        assert_eq!(alone("no-such-leaf"), None);
    }
}
