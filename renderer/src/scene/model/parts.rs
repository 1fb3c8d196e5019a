//! What the materials of a glTF file say of the parts of its mesh, side by side along u.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec2;
use gltf_json::Root;

use super::error::ModelError;
use super::pictures::Pictures;
use super::surfaces::Patch;
use super::textures::{Of, Texture, texture};
use crate::image::Stored;
use crate::material::colour_map::{ColourMap, Slot};
use crate::material::model::Finish;

/// Width of all pictures beyond which their places in single precision are coarser than a
/// thousandth of a picture's width.
const WIDE: f32 = 8192.0;

/// Greatest factor on the light that a material emits.
const STRONGEST: f32 = 1e12;

/// Where a material's pictures lie.
#[derive(Debug)]
pub(super) struct Part {
    material: Option<usize>,
    begins: f32,
    shift: f32,
    /// Whether all that has it has texture coordinates too.
    has_uvs: bool,
}

/// Lays the pictures of all materials that are used side by side, and moves the texture coordinates
/// of the patches there.
pub(super) fn side_by_side(patches: &mut [Patch], left_out: &mut BTreeSet<String>) -> Vec<Part> {
    let mut ranges: BTreeMap<Option<usize>, (f32, f32, bool)> = BTreeMap::new();
    for patch in patches.iter() {
        let range = ranges.entry(patch.material).or_insert((0.0, 1.0, true));
        range.2 &= patch.has_uvs;
        let us = patch.vertices.iter().map(|vertex| vertex.uv.x);
        for u in us.filter(|u| u.is_finite()) {
            range.0 = range.0.min(u.floor());
            range.1 = range.1.max(u.ceil());
        }
    }
    let is_alone = ranges.len() == 1;
    let mut parts = Vec::new();
    let mut shifts = BTreeMap::new();
    let mut at = 0.0_f32;
    for (material, (least, most, has_uvs)) in ranges {
        parts.push(Part {
            material,
            begins: if is_alone { f32::MIN } else { at - 0.5 },
            shift: if is_alone { 0.0 } else { at - least },
            has_uvs,
        });
        shifts.insert(material, at - least);
        at += most - least + 1.0;
    }
    if at > WIDE && !is_alone {
        left_out.insert(format!(
            "detail of pictures (texture coordinates reach over {at} widths of them in all)"
        ));
    }
    if is_alone {
        return parts;
    }
    for patch in patches {
        let shift = shifts[&patch.material];
        patch.has_uvs = true;
        for vertex in &mut patch.vertices {
            vertex.uv.x += shift;
        }
    }
    parts
}

impl Part {
    /// A texture of its material, if it can be looked up.
    fn texture(&self, root: &Root, of: Of, left_out: &mut BTreeSet<String>) -> Option<Texture> {
        let texture = texture(root, self.material, of)?;
        if !self.has_uvs {
            left_out.insert("pictures of parts without texture coordinates".to_owned());
            return None;
        }
        if !texture.fits(root, self.material) {
            let what = match of {
                Of::Colour => "base colours",
                Of::Finish => "roughness and metal",
                Of::Normals => "normals",
                Of::Emission => "emitted light",
            };
            left_out.insert(format!(
                "maps of {what} with other texture coordinates than the first map of their material"
            ));
            return None;
        }
        Some(texture)
    }

    /// Its place in a map of colours, with a factor on a texture.
    fn slot(
        &self,
        factor: [f32; 3],
        texture: Option<Texture>,
        pictures: &mut Pictures<'_, '_>,
    ) -> Result<Slot, ModelError> {
        let texture = texture.map(|texture| pictures.texture(texture, Stored::Srgb));
        Ok(Slot {
            begins: self.begins,
            shift: self.shift,
            factor,
            texture: texture.transpose()?,
        })
    }

    /// Refuses numbers of its material that are below 0 or above `most`.
    fn check(&self, key: &str, values: &[f32], most: f32) -> Result<(), ModelError> {
        let Some(material) = self.material else {
            return Ok(());
        };
        if values.iter().all(|value| (0.0..=most).contains(value)) {
            return Ok(());
        }
        let place = format!("materials[{material}].{key}");
        let written: Vec<String> = values.iter().map(f32::to_string).collect();
        let mut written = written.join(", ");
        if values.len() > 1 {
            written = format!("[{written}]");
        }
        Err(ModelError::invalid(
            place,
            format!("is {written}; allowed is 0 to {most}"),
        ))
    }
}

/// The map of all base colours.
pub(super) fn colours(
    parts: &[Part],
    pictures: &mut Pictures<'_, '_>,
    left_out: &mut BTreeSet<String>,
) -> Result<ColourMap, ModelError> {
    let root = pictures.root;
    let mut slots = Vec::new();
    for part in parts {
        let factor = part.material.map(|material| {
            let colour = &root.materials[material].pbr_metallic_roughness;
            colour.base_color_factor.0
        });
        let [r, g, b, _] = factor.unwrap_or([1.0; 4]);
        part.check("pbrMetallicRoughness.baseColorFactor", &[r, g, b], 1.0)?;
        let texture = part.texture(root, Of::Colour, left_out);
        slots.push(part.slot([r, g, b], texture, pictures)?);
    }
    Ok(ColourMap::new(slots, Vec2::ONE))
}

/// The map of all light that is emitted, in units of what an emission of 1 stands for.
pub(super) fn emission(
    parts: &[Part],
    pictures: &mut Pictures<'_, '_>,
    left_out: &mut BTreeSet<String>,
) -> Result<ColourMap, ModelError> {
    let root = pictures.root;
    let mut slots = Vec::new();
    for part in parts {
        let material = part.material.map(|material| &root.materials[material]);
        let factor = material.map_or([0.0; 3], |material| material.emissive_factor.0);
        part.check("emissiveFactor", &factor, 1.0)?;
        let extensions = material.and_then(|material| material.extensions.as_ref());
        let strength = extensions.and_then(|of| of.emissive_strength.as_ref());
        let strength = strength.map_or(1.0, |of| of.emissive_strength.0);
        let key = "extensions.KHR_materials_emissive_strength.emissiveStrength";
        part.check(key, &[strength], STRONGEST)?;
        let is_lit = factor.iter().any(|value| *value > 0.0);
        if is_lit && material.is_some_and(|material| material.double_sided) {
            left_out
                .insert("light that backs of faces emit (lamps shine from the front)".to_owned());
        }
        let texture = part.texture(root, Of::Emission, left_out);
        let texture = texture.filter(|_| is_lit);
        let factor = factor.map(|value| value * strength);
        slots.push(part.slot(factor, texture, pictures)?);
    }
    Ok(ColourMap::new(slots, Vec2::ONE))
}

/// Roughness, metal and normals of each part.
pub(super) fn finishes(
    parts: &[Part],
    pictures: &mut Pictures<'_, '_>,
    left_out: &mut BTreeSet<String>,
) -> Result<Vec<Finish>, ModelError> {
    let root = pictures.root;
    let mut finishes = Vec::new();
    for part in parts {
        let material = part.material.map(|material| &root.materials[material]);
        // A part without a material has that of glTF, a rough metal.
        let numbers = material.map_or([1.0; 2], |material| {
            let colour = &material.pbr_metallic_roughness;
            [colour.roughness_factor.0, colour.metallic_factor.0]
        });
        let [roughness, metallic] = numbers;
        part.check("pbrMetallicRoughness.roughnessFactor", &[roughness], 1.0)?;
        part.check("pbrMetallicRoughness.metallicFactor", &[metallic], 1.0)?;
        let texture = part.texture(root, Of::Finish, left_out);
        let texture = texture.map(|texture| pictures.texture(texture, Stored::Numbers));
        let scale = material.and_then(|material| material.normal_texture.as_ref());
        let scale = scale.map_or(1.0, |normals| normals.scale);
        let normals = part.texture(root, Of::Normals, left_out);
        let normals = normals.map(|texture| pictures.texture(texture, Stored::Numbers));
        finishes.push(Finish {
            roughness,
            metallic,
            texture: texture.transpose()?,
            normals: normals.transpose()?.map(|texture| (texture, scale)),
        });
    }
    Ok(finishes)
}
