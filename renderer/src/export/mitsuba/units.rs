//! The unit of length and the names of materials and maps in an export.

use crate::scene::description::Description;
use crate::scene::world::{MaterialOwner, World};

/// Mitsuba's units per metre: the exported scene is in millimetres.
///
/// Mitsuba moves the origin of every new ray off its surface by 9e-5 (1 + largest coordinate). In
/// metres that is a tenth of a millimetre, as much as the height of veins, so light would pass
/// below them (an error of 0.25 % of the mean in a close-up). In millimetres it is some
/// micrometres. Radiance does not depend on the unit.
pub(super) const UNITS_PER_METRE: f64 = 1000.0;

/// Name of a material in the export: the scene's, or that of a grown leaf, whose further parts are
/// numbered from 2.
pub(super) fn material_id(scene: &Description, world: &World, number: usize) -> String {
    match world.owners[number] {
        MaterialOwner::Scene(material) => format!("material-{}", scene.materials[material].name),
        MaterialOwner::Leaf { leaf, part: 0 } => format!("leaf-{}", scene.leaves[leaf].name),
        MaterialOwner::Leaf { leaf, part } => {
            // No name in a scene contains a point.
            format!("leaf-{}.{}", scene.leaves[leaf].name, part + 1)
        }
        MaterialOwner::Solid(solid) => format!("solid-{}", scene.solids[solid].name),
    }
}

/// Name of a light in the export.
pub(super) fn light_id(light: &str) -> String {
    format!("light-{light}")
}

/// Path, within the export, of the weights of a light.
pub(super) fn weights_file(light: &str) -> String {
    format!("maps/{}.exr", light_id(light))
}
