//! Names of what is exported.

use crate::scene::description::Description;
use crate::scene::world::{MaterialOwner, World};

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
