//! Which textures the base colours of a glTF file's materials have, and where they are looked up.

use std::collections::BTreeSet;

use glam::Vec2;
use gltf_json::Root;
use gltf_json::texture::{Info, WrappingMode};
use gltf_json::validation::Checked;

use crate::material::colour_map::Wrap;

/// Where a material looks up its base colour.
pub(super) struct Place {
    /// Number of the set of texture coordinates.
    pub(super) set: u32,
    /// `KHR_texture_transform`: scale, turn (cosine, sine), offset.
    transform: Option<[[f32; 2]; 3]>,
}

impl Place {
    pub(super) fn of(root: &Root, material: Option<usize>) -> Self {
        let Some(info) = texture(root, material) else {
            let transform = None;
            return Self { set: 0, transform };
        };
        let transform = info.extensions.as_ref();
        let transform = transform.and_then(|of| of.texture_transform.as_ref());
        let set = transform.and_then(|of| of.tex_coord);
        Self {
            set: set.unwrap_or(info.tex_coord),
            transform: transform.map(|of| {
                let turn = f64::from(of.rotation.0);
                let turn = [libm::cos(turn) as f32, libm::sin(turn) as f32];
                [of.scale.0, turn, of.offset.0]
            }),
        }
    }

    /// The coordinates of a picture, v upwards. glTF's v runs down.
    pub(super) fn uv(&self, [mut u, mut v]: [f32; 2]) -> Vec2 {
        if let Some([scale, [cos, sin], offset]) = self.transform {
            let (x, y) = (u * scale[0], v * scale[1]);
            // Counter-clockwise, as one looks at it with v downwards.
            u = cos * x + sin * y + offset[0];
            v = cos * y - sin * x + offset[1];
        }
        Vec2::new(u, 1.0 - v)
    }
}

/// The texture of a material's base colour.
pub(super) fn texture(root: &Root, material: Option<usize>) -> Option<&Info> {
    let colour = &root.materials[material?].pbr_metallic_roughness;
    colour.base_color_texture.as_ref()
}

/// Numbers of the pictures of base colours.
pub(super) fn images(root: &Root) -> BTreeSet<usize> {
    let materials = 0..root.materials.len();
    let textures = materials.filter_map(|material| texture(root, Some(material)));
    let images = textures.map(|info| root.textures[info.index.value()].source.value());
    images.collect()
}

/// What lies beside the picture of a texture, across and down, and the picture's number.
pub(super) fn source(root: &Root, info: &Info) -> ([Wrap; 2], usize) {
    let texture = &root.textures[info.index.value()];
    let wrap = texture.sampler.map_or([Wrap::Repeat; 2], |sampler| {
        let sampler = &root.samplers[sampler.value()];
        [sampler.wrap_s, sampler.wrap_t].map(beside)
    });
    (wrap, texture.source.value())
}

fn beside(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}
