//! What a glTF file has and a model lacks.

use std::collections::BTreeSet;

use gltf_json::accessor::Type;
use gltf_json::material::{AlphaMode, Material};
use gltf_json::mesh::Semantic;
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};

use super::error::shown;

/// Most extensions that are named.
const MOST_NAMED: usize = 10;

/// Extensions that are read, or change nothing of what is.
const HARMLESS: [&str; 2] = ["KHR_texture_transform", "KHR_mesh_quantization"];

/// The extension by which materials emit more than 1, read with the light that they emit.
const STRENGTH: &str = "KHR_materials_emissive_strength";

/// What a scene uses of a model besides its triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The base colours.
    pub colours: bool,
    /// Roughness, metal and normals, with the colours.
    pub finishes: bool,
    /// Emitted light.
    pub emission: bool,
}

impl Wanted {
    /// All that is read.
    pub const ALL: Self = Self {
        colours: true,
        finishes: true,
        emission: true,
    };
}

/// What is left out of a document of which this is wanted, in words.
pub(super) fn of_document(root: &Root, wanted: Wanted) -> BTreeSet<String> {
    let mut left_out = BTreeSet::new();
    let mut add = |is_there: bool, what: &str| {
        if is_there {
            left_out.insert(what.to_owned());
        }
    };
    add(!root.animations.is_empty(), "animations");
    add(!root.skins.is_empty(), "skins (bones)");
    add(!root.cameras.is_empty(), "cameras");
    add(root.scenes.len() > 1, "further scenes");
    for primitive in root.meshes.iter().flat_map(|mesh| &mesh.primitives) {
        add(
            primitive.targets.iter().any(|targets| !targets.is_empty()),
            "morph targets",
        );
        let mut attributes = primitive.attributes.keys();
        let is_further =
            |key: &Checked<Semantic>| matches!(key, Checked::Valid(Semantic::Colors(1..)));
        add(attributes.any(is_further), "further colours of vertices");
        let material = primitive
            .material
            .map(|material| &root.materials[material.value()]);
        let is_masked = material.is_some_and(|of| of.alpha_mode == Checked::Valid(AlphaMode::Mask));
        let colours = primitive
            .attributes
            .get(&Checked::Valid(Semantic::Colors(0)));
        let has_alpha =
            |of: &Index<Accessor>| root.accessors[of.value()].type_ == Checked::Valid(Type::Vec4);
        add(
            is_masked && colours.is_some_and(has_alpha),
            "alpha of vertices in masks",
        );
    }
    for material in &root.materials {
        of_material(material, wanted, &mut add);
    }
    let extensions = root.extensions_used.iter().chain(&root.extensions_required);
    let extensions = extensions.map(String::as_str);
    let is_read = |name: &str| HARMLESS.contains(&name) || (name == STRENGTH && wanted.emission);
    let extensions: BTreeSet<&str> = extensions.filter(|name| !is_read(name)).collect();
    let count = extensions.len();
    for name in extensions.into_iter().take(MOST_NAMED) {
        left_out.insert(format!("extension {}", shown(name)));
    }
    if count > MOST_NAMED {
        left_out.insert(format!("{} extensions more", count - MOST_NAMED));
    }
    left_out
}

fn of_material(material: &Material, wanted: Wanted, add: &mut impl FnMut(bool, &str)) {
    let colour = &material.pbr_metallic_roughness;
    let is_plain = !wanted.finishes;
    // Pictures of roughness and metal are one; without one the factors hold.
    let is_metal = colour.metallic_factor.0 > 0.0;
    add(
        is_plain && is_metal,
        "metal (its base colour is taken as that of paint; the material `gltf` uses it)",
    );
    let is_rough = colour.roughness_factor.0 == 1.0 && colour.metallic_roughness_texture.is_none();
    add(
        is_plain && !is_rough,
        "roughness (that of the scene's material holds; the material `gltf` uses it)",
    );
    add(
        material.alpha_mode == Checked::Valid(AlphaMode::Blend),
        "partial transparency (alpha mode BLEND is taken as opaque)",
    );
    add(material.occlusion_texture.is_some(), "maps of occlusion");
    add(
        is_plain && material.normal_texture.is_some(),
        "maps of normals (the material `gltf` uses them)",
    );
    let glows = material.emissive_factor.0.iter().any(|part| *part > 0.0);
    add(
        glows && !wanted.emission,
        "emitted light (`emission = true` of an area light uses it)",
    );
}
