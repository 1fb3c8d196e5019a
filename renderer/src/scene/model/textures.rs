//! Which textures a glTF file's materials have, and where they are looked up.

use std::collections::BTreeSet;

use glam::Vec2;
use gltf_json::Root;
use gltf_json::extensions::texture::TextureTransform;
use gltf_json::texture::{Info, WrappingMode};
use gltf_json::validation::Checked;

use crate::material::colour_map::Wrap;

/// What a material has a texture of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// Its base colour and alpha.
    Colour,
    /// Its roughness and metal.
    Finish,
    /// Its normals.
    Normals,
    /// The light that it emits.
    Emission,
}

impl Of {
    /// All of them. The first that a material has says where its parts have their texture coordinates.
    const ALL: [Self; 4] = [Self::Colour, Self::Finish, Self::Normals, Self::Emission];
}

/// A texture of a material.
#[derive(Clone, Copy, Debug)]
pub(super) struct Texture {
    /// Its number in the file.
    number: usize,
    /// Where it is looked up; `None` if that cannot be read.
    place: Option<Place>,
}

/// Where a material looks up a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Place {
    /// Number of the set of texture coordinates.
    pub(super) set: u32,
    /// `KHR_texture_transform`: scale, turn (cosine, sine), offset.
    transform: Option<[[f32; 2]; 3]>,
}

impl Place {
    /// Where a part of a material has its texture coordinates.
    pub(super) fn of(root: &Root, material: Option<usize>) -> Self {
        let mut textures = Of::ALL
            .into_iter()
            .filter_map(|of| texture(root, material, of));
        textures
            .find_map(|texture| texture.place)
            .unwrap_or_default()
    }

    fn new(set: u32, transform: Option<&TextureTransform>) -> Self {
        Self {
            set: transform.and_then(|of| of.tex_coord).unwrap_or(set),
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

/// A texture of a material.
pub(super) fn texture(root: &Root, material: Option<usize>, of: Of) -> Option<Texture> {
    let material = &root.materials[material?];
    let colour = &material.pbr_metallic_roughness;
    match of {
        Of::Colour => colour.base_color_texture.as_ref().map(described),
        Of::Emission => material.emissive_texture.as_ref().map(described),
        Of::Finish => colour.metallic_roughness_texture.as_ref().map(described),
        Of::Normals => material.normal_texture.as_ref().map(|normals| {
            let others = normals.extensions.as_ref().map(|of| &of.others);
            let place = match others.and_then(|of| of.get("KHR_texture_transform")) {
                None => Some(Place::new(normals.tex_coord, None)),
                Some(value) => {
                    let transform = serde_json::from_value(value.clone()).ok();
                    transform.map(|of| Place::new(normals.tex_coord, Some(&of)))
                }
            };
            Texture {
                number: normals.index.value(),
                place,
            }
        }),
    }
}

fn described(info: &Info) -> Texture {
    let extensions = info.extensions.as_ref();
    let transform = extensions.and_then(|of| of.texture_transform.as_ref());
    Texture {
        number: info.index.value(),
        place: Some(Place::new(info.tex_coord, transform)),
    }
}

impl Texture {
    /// Whether it is looked up where the parts of this material have their texture coordinates.
    pub(super) fn fits(&self, root: &Root, material: Option<usize>) -> bool {
        self.place == Some(Place::of(root, material))
    }

    /// What lies beside its picture, across and down, and the picture's number.
    pub(super) fn source(&self, root: &Root) -> ([Wrap; 2], usize) {
        let texture = &root.textures[self.number];
        let wrap = texture.sampler.map_or([Wrap::Repeat; 2], |sampler| {
            let sampler = &root.samplers[sampler.value()];
            [sampler.wrap_s, sampler.wrap_t].map(beside)
        });
        (wrap, texture.source.value())
    }
}

/// Numbers of the pictures that are read.
pub(super) fn images(root: &Root) -> BTreeSet<usize> {
    let materials = 0..root.materials.len();
    let textures =
        materials.flat_map(|material| Of::ALL.map(|of| texture(root, Some(material), of)));
    let images = textures.flatten().map(|texture| texture.source(root).1);
    images.collect()
}

fn beside(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}
