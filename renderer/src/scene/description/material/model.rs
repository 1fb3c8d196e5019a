//! The surface of a glTF model.

use std::sync::Arc;

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;

use super::Sources;
use crate::material::model::ModelMaterial;
use crate::scene::description::reflectance::{MODEL, require_colours};

/// All that a mesh from a glTF file says of its surface.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::require_colours)]
pub struct GltfSurface {
    /// Each part of that mesh has its own material.
    ///
    /// Index into [`Description::meshes`](crate::scene::description::Description::meshes); its default is
    /// replaced when the key is read.
    #[key("mesh", required, MODEL, default = usize::MAX)]
    pub mesh: usize,
}

impl GltfSurface {
    fn require_colours(&mut self, keys: &mut Keys<'_>) {
        require_colours("mesh", keys);
    }

    pub(super) fn built(&self, sources: &Sources<'_>) -> ModelMaterial {
        let both = sources.colours.zip(sources.finishes);
        let (colours, finishes) = both.expect("a mesh whose surface is wanted was read with it");
        ModelMaterial::new(colours.clone(), Arc::clone(finishes))
    }
}
