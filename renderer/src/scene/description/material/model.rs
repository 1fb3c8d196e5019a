//! The surface of a glTF model.

use std::sync::Arc;

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;

use super::Sources;
use crate::material::model::ModelMaterial;
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
}

fn require_colours_of_mesh(_: &mut GltfSurface, keys: &mut Keys<'_>) {
    require_colours("mesh", keys);
}
