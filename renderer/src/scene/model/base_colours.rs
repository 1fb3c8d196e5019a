//! The base colours of a glTF file's materials, side by side along u.

use std::borrow::Cow;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::Vec2;
use gltf_json::Root;
use gltf_json::texture::WrappingMode;
use gltf_json::validation::Checked;

use super::accessors::view;
use super::container::resource;
use super::surfaces::Patch;
use super::textures::texture;
use super::{Files, ModelError};
use crate::image::{ImageError, Picture, jpeg, portable_network};
use crate::material::colour_map::{ColourMap, ColourTexture, Slot, Wrap};

/// Width of all pictures beyond which their places in single precision are coarser than a
/// thousandth of a picture's width.
const WIDE: f32 = 8192.0;

/// Where a material's picture lies.
#[derive(Debug)]
pub(super) struct Stand {
    material: Option<usize>,
    begins: f32,
    shift: f32,
    /// Whether all that has it has texture coordinates too.
    has_uvs: bool,
}

/// Lays the pictures of all materials that are used side by side, and moves the texture coordinates
/// of the patches there.
pub(super) fn side_by_side(
    root: &Root,
    patches: &mut [Patch],
    left_out: &mut BTreeSet<String>,
) -> Vec<Stand> {
    let mut ranges: BTreeMap<Option<usize>, (f32, f32, bool)> = BTreeMap::new();
    for patch in patches.iter() {
        let range = ranges.entry(patch.material).or_insert((0.0, 1.0, true));
        match &patch.uvs {
            Some(uvs) => {
                for u in uvs.iter().map(|uv| uv.x).filter(|u| u.is_finite()) {
                    range.0 = range.0.min(u.floor());
                    range.1 = range.1.max(u.ceil());
                }
            }
            None => range.2 = false,
        }
    }
    let is_alone = ranges.len() == 1;
    let mut stands = Vec::new();
    let mut at = 0.0_f32;
    for (material, (least, most, has_uvs)) in ranges {
        if !has_uvs && texture(root, material).is_some() {
            left_out.insert("pictures of parts without texture coordinates".to_owned());
        }
        stands.push(Stand {
            material,
            begins: if is_alone { f32::MIN } else { at - 0.5 },
            shift: if is_alone { 0.0 } else { at - least },
            has_uvs,
        });
        at += most - least + 1.0;
    }
    if at > WIDE && !is_alone {
        left_out.insert(format!(
            "detail of pictures (texture coordinates reach over {at} widths of them in all)"
        ));
    }
    for patch in patches {
        let stand = stands.iter().find(|stand| stand.material == patch.material);
        let shift = stand.map_or(0.0, |stand| stand.shift);
        let count = patch.vertices();
        if is_alone {
            continue;
        }
        let uvs = patch.uvs.get_or_insert_with(|| vec![Vec2::ZERO; count]);
        for uv in uvs {
            uv.x += shift;
        }
    }
    stands
}

/// The map of all colours.
pub(super) fn colours(
    root: &Root,
    stands: &[Stand],
    buffers: &[Cow<'_, [u8]>],
    files: Files<'_>,
) -> Result<ColourMap, ModelError> {
    // A picture that several materials have is decoded once.
    let mut known: BTreeMap<(usize, [&str; 2]), Arc<ColourTexture>> = BTreeMap::new();
    let mut slots = Vec::new();
    for stand in stands {
        let factor = stand.material.map(|material| {
            let colour = &root.materials[material].pbr_metallic_roughness;
            colour.base_color_factor.0
        });
        let [r, g, b, _] = factor.unwrap_or([1.0; 4]);
        if let Some(material) = stand.material
            && ![r, g, b].iter().all(|share| (0.0..=1.0).contains(share))
        {
            let place = format!("materials[{material}].pbrMetallicRoughness.baseColorFactor");
            let what = format!("is [{r}, {g}, {b}]; allowed is 0 to 1");
            return Err(ModelError::invalid(place, what));
        }
        let info = texture(root, stand.material).filter(|_| stand.has_uvs);
        let texture = match info.map(|info| &root.textures[info.index.value()]) {
            None => None,
            Some(texture) => {
                let wrap = match texture.sampler {
                    Some(sampler) => {
                        let sampler = &root.samplers[sampler.value()];
                        [beside(sampler.wrap_s), beside(sampler.wrap_t)]
                    }
                    None => [Wrap::Repeat; 2],
                };
                let number = texture.source.value();
                let key = (number, wrap.map(Wrap::word));
                if let Entry::Vacant(entry) = known.entry(key) {
                    let picture = picture(root, number, buffers, files)?;
                    entry.insert(Arc::new(texture_of(&picture, wrap)));
                }
                known.get(&key).cloned()
            }
        };
        slots.push(Slot {
            begins: stand.begins,
            shift: stand.shift,
            factor: [r, g, b],
            texture,
        });
    }
    Ok(ColourMap::new(slots, Vec2::ONE))
}

fn beside(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}

fn texture_of(picture: &Picture, wrap: [Wrap; 2]) -> ColourTexture {
    let channel = |name| picture.layer(name).expect("what is decoded has R, G and B");
    let [r, g, b] = ["R", "G", "B"].map(|name| channel(name).data.iter().copied());
    let texels = r.zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect();
    ColourTexture::new(picture.width as usize, texels, wrap)
}

/// A picture of the file, decoded; its first bytes tell what it is.
fn picture(
    root: &Root,
    number: usize,
    buffers: &[Cow<'_, [u8]>],
    files: Files<'_>,
) -> Result<Picture, ModelError> {
    let image = &root.images[number];
    let bytes = match (&image.uri, image.buffer_view) {
        (Some(uri), _) => resource(uri, files, &|| format!("images[{number}]"))?,
        (None, Some(of)) => Cow::Borrowed(view(root, buffers, of.value())?),
        (None, None) => {
            let what = "has neither a uri nor a view of a buffer";
            return Err(ModelError::invalid(format!("images[{number}]"), what));
        }
    };
    let decoded = if bytes.starts_with(b"\x89PNG") {
        portable_network::decode(&bytes)
    } else if bytes.starts_with(b"\xff\xd8") {
        jpeg::decode(&bytes)
    } else {
        Err(ImageError::Malformed {
            what: "it is neither PNG nor JPEG".to_owned(),
        })
    };
    decoded.map_err(|source| ModelError::Picture { number, source })
}
