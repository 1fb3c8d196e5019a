//! Materials.

use crate::export::names::material_id;
use crate::plugin::element::Element;
use crate::plugin::spectra::Spectra;
use crate::plugin::surface::Exported;
use crate::scene::description::{Description, LeafOptics, Material};
use crate::scene::world::{MaterialOwner, World};

/// The block of a leaf through whose layers light is followed, which Mitsuba does not do.
pub(super) fn layered(scene: &Description) -> Option<String> {
    let leaves = scene.leaves.iter();
    let leaves = leaves.map(|leaf| ("leaves", &leaf.name, Some(&leaf.value.faces)));
    let materials = scene.materials.iter().map(|material| {
        let faces = if let Material::Leaf(leaf) = &material.value {
            Some(&leaf.faces)
        } else {
            None
        };
        ("materials", &material.name, faces)
    });
    let mut all = leaves.chain(materials);
    let found =
        all.find(|(_, _, faces)| faces.is_some_and(|faces| faces.optics == LeafOptics::Layers));
    found.map(|(block, name, _)| match block {
        "materials" => format!("{block}.{name}.leaf"),
        _ => format!("{block}.{name}"),
    })
}

/// Whether light that a material takes up comes out at other wavelengths. Measured spectra do not
/// say what chlorophyll absorbs.
pub(super) fn fluoresces(material: &Material) -> bool {
    matches!(material, Material::Leaf(leaf) if leaf.fluorescence.is_some() && material.held().is_some())
}

/// Whether the material with this number becomes a BSDF of Mitsuba's own that scatters.
pub(super) fn is_stock(scene: &Description, world: &World, material: usize) -> bool {
    match world.owners[material] {
        MaterialOwner::Scene(number) => scene.materials[number].value.is_stock(),
        MaterialOwner::Leaf { .. } | MaterialOwner::Solid(_) => false,
    }
}

/// The material with this number.
pub(super) fn bsdf(
    scene: &Description,
    world: &World,
    material: usize,
    spectra: &mut Spectra,
) -> Element {
    let mut surface = Exported {
        id: &material_id(scene, world, material),
        material: &world.materials[material],
        spectra,
    };
    match world.owners[material] {
        MaterialOwner::Leaf { leaf, .. } => {
            let leaf = &scene.leaves[leaf].value;
            let bsdf = surface.leaf(leaf.extrapolate);
            leaf.faces_by_age().written(bsdf, surface.spectra)
        }
        MaterialOwner::Solid(solid) => {
            let solid = &scene.solids[solid].value;
            solid.optics.plugin(solid.extrapolate, &surface)
        }
        MaterialOwner::Scene(number) => scene.materials[number].value.plugin(&mut surface),
    }
}
