//! The alpha masks of a glTF file's materials.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use gltf_json::material::AlphaMode;
use gltf_json::validation::Checked;

use super::cut_out::{Cut, MOST_OF_ONE, MOST_TRIANGLES, Mask};
use super::error::ModelError;
use super::pictures::Pictures;
use super::surfaces::Patch;
use super::textures::{Of, texture};
use crate::image::portable_network;
use crate::material::colour_map::{ColourTexture, Wrap};

/// Cuts what the mask of its material leaves out off each part.
pub(super) fn cut_out(
    pictures: &Pictures<'_, '_>,
    patches: &mut Vec<Patch>,
) -> Result<(), ModelError> {
    let root = pictures.root;
    let mut masks: BTreeMap<(usize, bool), Mask> = BTreeMap::new();
    for patch in patches.iter_mut() {
        let Some(number) = patch.material else {
            continue;
        };
        if root.materials[number].alpha_mode != Checked::Valid(AlphaMode::Mask) {
            continue;
        }
        let key = (number, patch.has_uvs);
        let mask = match masks.entry(key) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => entry.insert(mask(pictures, key)?),
        };
        cut(patch, mask).ok_or_else(|| {
            let what = format!(
                "its alpha mask cuts a part of the model into too many triangles (at most {MOST_TRIANGLES}, and \
                 {MOST_OF_ONE} of one): use a smaller picture, or let it repeat less often"
            );
            ModelError::invalid(format!("materials[{number}]"), what)
        })?;
    }
    patches.retain(|patch| !patch.triangles.is_empty());
    Ok(())
}

/// The mask of a material, on parts with texture coordinates or on others.
fn mask(pictures: &Pictures<'_, '_>, (number, has_uvs): (usize, bool)) -> Result<Mask, ModelError> {
    let root = pictures.root;
    let material = &root.materials[number];
    let factor = material.pbr_metallic_roughness.base_color_factor.0[3];
    let least = material.alpha_cutoff.unwrap_or_default().0;
    let (mut width, mut values, mut wrap) = (1, vec![1.0], [Wrap::Repeat; 2]);
    if let Some(texture) = texture(root, Some(number), Of::Colour).filter(|_| has_uvs) {
        let image;
        (wrap, image) = texture.source(root);
        // A JPEG has no alpha and is there everywhere.
        let alpha = pictures.decode(image, |bytes| {
            let is_png = bytes.starts_with(b"\x89PNG");
            is_png
                .then(|| portable_network::decode_alpha(bytes))
                .transpose()
        })?;
        if let Some(alpha) = alpha {
            width = alpha.width as usize;
            values = alpha
                .layers
                .into_iter()
                .flat_map(|layer| layer.data)
                .collect();
        }
    }
    let texels = values.into_iter().map(|alpha| [factor * alpha; 3]);
    Ok(Mask::new(
        ColourTexture::new(width, texels.collect(), wrap),
        least,
    ))
}

/// Cuts a part; `None` if it would become too many triangles.
fn cut(patch: &mut Patch, mask: &Mask) -> Option<()> {
    let mut kept = Vec::new();
    let mut added = 0;
    for corners in std::mem::take(&mut patch.triangles) {
        let triangle = corners.map(|corner| patch.vertices[corner as usize]);
        match mask.cut(triangle, MOST_TRIANGLES - added)? {
            Cut::Whole => kept.push(corners),
            Cut::Parts(parts) => {
                added += parts.len();
                for part in parts {
                    let first = patch.vertices.len() as u32;
                    kept.push([first, first + 1, first + 2]);
                    patch.vertices.extend(part);
                }
            }
        }
    }
    patch.triangles = kept;
    Some(())
}
