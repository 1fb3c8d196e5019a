//! The surface of a glTF model.

use std::sync::Arc;

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;

use super::sources::Sources;
use crate::material::Material;
use crate::material::model::ModelMaterial;
use crate::plugin::colours;
use crate::plugin::element::Element;
use crate::plugin::surface::Exported;
use crate::scene::description::reflectance::{MODEL, require_colours};

/// All that a mesh from a glTF file says of its surface.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = require_colours_of_mesh)]
pub struct GltfSurface {
    /// Each part of that mesh has its own material.
    ///
    /// Index into [`Description::meshes`](crate::scene::description::Description::meshes); its default is
    /// replaced when the key is read.
    #[key("mesh", required, MODEL, default = usize::MAX)]
    pub mesh: usize,
}

impl GltfSurface {
    pub(super) fn built(sources: &Sources<'_>) -> ModelMaterial {
        let both = sources.colours.zip(sources.finishes);
        let (colours, finishes) = both.expect("a mesh whose surface is wanted was read with it");
        ModelMaterial::new(colours.clone(), Arc::clone(finishes))
    }

    pub(super) fn plugin(surface: &Exported<'_>) -> Element {
        let Material::Model(model) = surface.material else {
            unreachable!("it was built of one")
        };
        let maps = ["colours", "finish", "normals"].into_iter();
        let maps = maps.zip(colours::maps(surface.id, surface.material));
        let maps = maps.map(|(name, (id, map))| colours::texture(&id, name, Some(&map)));
        // In `reference/`.
        let bsdf = Element::plugin("bsdf", "lamina_model")
            .called(surface.id)
            .holding_all(maps);
        let scales = model.normal_scales().enumerate();
        scales.fold(bsdf, |bsdf, (slot, scale)| {
            bsdf.float(&format!("normal_scale_{slot}"), f64::from(scale))
        })
    }
}

fn require_colours_of_mesh(_: &mut GltfSurface, keys: &mut Keys<'_>) {
    require_colours("mesh", keys);
}
