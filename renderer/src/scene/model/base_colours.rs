//! The base colours of a glTF file's materials, side by side along u.

use std::borrow::Cow;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::Vec2;
use gltf_json::Root;

use super::pictures::picture;
use super::surfaces::Patch;
use super::textures::{source, texture};
use super::{Files, ModelError};
use crate::image::{ImageError, Picture, jpeg, portable_network};
use crate::material::colour_map::{ColourMap, ColourTexture, Slot, Wrap};

/// Width of all pictures beyond which their places in single precision are coarser than a
/// thousandth of a picture's width.
const WIDE: f32 = 8192.0;

/// Which picture a part has: that of its material, or its own by its number.
type Key = (Option<usize>, Option<usize>);

/// Where a material's picture lies.
#[derive(Debug)]
pub(super) struct Stand {
    material: Option<usize>,
    begins: f32,
    shift: f32,
    /// Whether all that has it has texture coordinates too.
    has_uvs: bool,
    /// The colours of vertices, of a part that has them.
    painted: Option<Arc<ColourTexture>>,
}

/// Lays the pictures of all materials that are used side by side, and moves the texture coordinates
/// of the patches there.
pub(super) fn side_by_side(
    root: &Root,
    patches: &mut [Patch],
    left_out: &mut BTreeSet<String>,
) -> Vec<Stand> {
    // A part with colours of its vertices has a picture of its own.
    let key = |number: usize, patch: &Patch| -> Key {
        let own = patch.painted.is_some().then_some(number);
        (patch.material, own)
    };
    let mut ranges: BTreeMap<Key, (f32, f32, bool)> = BTreeMap::new();
    for (number, patch) in patches.iter().enumerate() {
        let range = ranges.entry(key(number, patch)).or_insert((0.0, 1.0, true));
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
    let mut shifts = BTreeMap::new();
    let mut at = 0.0_f32;
    for ((material, own), (least, most, has_uvs)) in ranges {
        if !has_uvs && texture(root, material).is_some() {
            left_out.insert("pictures of parts without texture coordinates".to_owned());
        }
        stands.push(Stand {
            material,
            begins: if is_alone { f32::MIN } else { at - 0.5 },
            shift: if is_alone { 0.0 } else { at - least },
            has_uvs,
            painted: own.and_then(|number| patches[number].painted.clone()),
        });
        shifts.insert((material, own), at - least);
        at += most - least + 1.0;
    }
    if at > WIDE && !is_alone {
        left_out.insert(format!(
            "detail of pictures (texture coordinates reach over {at} widths of them in all)"
        ));
    }
    if is_alone {
        return stands;
    }
    for (number, patch) in patches.iter_mut().enumerate() {
        let shift = shifts[&key(number, patch)];
        let count = patch.vertices();
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
        let texture = match info.map(|info| source(root, info)) {
            _ if stand.painted.is_some() => stand.painted.clone(),
            None => None,
            Some((wrap, number)) => {
                let key = (number, wrap.map(Wrap::word));
                if let Entry::Vacant(entry) = known.entry(key) {
                    let picture = picture(root, number, buffers, files, decoded)?;
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

fn texture_of(picture: &Picture, wrap: [Wrap; 2]) -> ColourTexture {
    let channel = |name| picture.layer(name).expect("what is decoded has R, G and B");
    let [r, g, b] = ["R", "G", "B"].map(|name| channel(name).data.iter().copied());
    let texels = r.zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect();
    ColourTexture::new(picture.width as usize, texels, wrap)
}

/// The colours of a picture; its first bytes say which format it has. The format of models demands
/// that what a picture says of its colours is ignored.
fn decoded(bytes: &[u8]) -> Result<Picture, ImageError> {
    if bytes.starts_with(b"\x89PNG") {
        portable_network::decode_as_srgb(bytes)
    } else if bytes.starts_with(b"\xff\xd8") {
        jpeg::decode_as_srgb(bytes)
    } else {
        Err(ImageError::Malformed {
            what: "it is neither PNG nor JPEG".to_owned(),
        })
    }
}
