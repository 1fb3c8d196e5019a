//! What glTF's materials say of a surface.
//!
//! glTF's surface is a diffuse layer below a coat of Fresnel's reflection, and of what passes the coat
//! the fraction `f` is let through in the colour of the transmission, the rest sent back in the base
//! colour. So the base colour is `r / (1 − f)` and the other `t / f`, where `r` and `t` are what the
//! tissue sends back and lets through below its coat.

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::colours::{Colorimetry, WAVELENGTHS, stored, stored_number};
use super::document::GltfDocument;
use crate::bsdf::Bsdf;
use crate::bsdf::leaf::{Coat, LeafBsdf};
use crate::image::pixels::{Depth, Pixels};
use crate::image::{ImageError, portable_network};
use crate::material::Material;
use crate::material::colour_map::{ColourMap, ColourTexture, Wrap};
use crate::material::leaf::LeafMaterial;
use crate::material::relief::Relief;
use crate::spectrum::{Lanes, Wavelengths};

/// Looks at a texel, across and down: several, because the map is finer where textures are small and
/// each looks at another way of light that spreads in the blade.
const LOOKS: usize = 3;
/// Most that may be let through, so that the base colour stays finite.
const MOST_THROUGH: f32 = 0.95;
/// What glTF takes for the refractive index of a coat.
const USUAL_ETA: f32 = 1.5;

/// With what surfaces are looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Observation<'a> {
    pub(super) colorimetry: &'a Colorimetry,
    pub(super) wavelengths: Wavelengths<WAVELENGTHS>,
    /// Most texels along a side, a power of two.
    pub(super) texture: u32,
}

/// How the materials of a surface lie on its meshes.
#[derive(Clone, Debug)]
pub(super) enum Arrangement<'a> {
    /// One on all triangles.
    Whole,
    /// That of the adaxial face on all triangles and that of the abaxial one on their backs.
    Faces,
    /// That of one face of a closed blade, the abaxial one on the backs of its triangles.
    Face(usize),
    /// One for each slot of a map of colours.
    Slots(&'a ColourMap),
}

/// A surface: its pictures, and its materials, which name them by number.
#[derive(Clone, Debug)]
pub(super) struct Surface<'a> {
    name: String,
    pub(super) arrangement: Arrangement<'a>,
    pictures: Vec<(&'static str, Vec<u8>, [Wrap; 2])>,
    finishes: Vec<Finish>,
}

/// One material. Numbers are those of pictures of the surface.
#[derive(Clone, Debug)]
struct Finish {
    name: String,
    base: [f32; 3],
    base_map: Option<usize>,
    /// What is let through: the fraction, and its colour.
    through: Option<(f32, [f32; 3], Option<usize>)>,
    metallic: f32,
    roughness: f32,
    rough_map: Option<usize>,
    normals: Option<(usize, f32)>,
    /// Refractive index of the coat; 1 is none.
    eta: f32,
    is_clear: bool,
}

impl Finish {
    fn new(name: &str, base: [f32; 3], eta: f32, roughness: f32) -> Self {
        Self {
            name: name.to_owned(),
            base: base.map(|value| value.clamp(0.0, 1.0)),
            base_map: None,
            through: None,
            metallic: 0.0,
            roughness,
            rough_map: None,
            normals: None,
            eta,
            is_clear: false,
        }
    }

    /// A face of tissue below its coat.
    fn coated(name: &str, base: [f32; 3], coat: &Coat) -> Self {
        let (eta, alphas) = coat.numbers();
        Self::new(name, base, eta, roughness_of(alphas))
    }
}

/// glTF's roughness of a coat that is so rough across and along.
fn roughness_of([across, along]: [f32; 2]) -> f32 {
    (across * along).sqrt().sqrt().min(1.0)
}

impl<'a> Surface<'a> {
    /// The surface of a material; `is_sheet` says of a leaf's whether it is a blade or a tube.
    pub(super) fn of(
        material: &'a Material,
        name: &str,
        is_sheet: bool,
        seen: Observation<'_>,
    ) -> Result<Self, ImageError> {
        match material {
            Material::Leaf(leaf) if is_sheet => sheet(leaf, name, seen),
            Material::Leaf(_) | Material::Solid(_) => body(material, name, seen),
            Material::Diffuse(_) | Material::Plastic(_) | Material::Model(_) => {
                painted(material, name, seen)
            }
            Material::Dielectric(glass) => Ok(Self::plain(Finish {
                is_clear: true,
                ..Finish::new(name, [1.0; 3], glass.eta, glass.alpha.sqrt())
            })),
        }
    }

    fn plain(finish: Finish) -> Self {
        Self {
            name: finish.name.clone(),
            arrangement: Arrangement::Whole,
            pictures: Vec::new(),
            finishes: vec![finish],
        }
    }

    /// Whether a map of normals needs tangents beside the vertices.
    pub(super) fn has_normals(&self) -> bool {
        self.finishes.iter().any(|finish| finish.normals.is_some())
    }

    /// Whether any of its materials has a picture.
    pub(super) fn has_pictures(&self) -> bool {
        !self.pictures.is_empty()
    }

    /// Adds a picture of numbers in [0, 1] or of linear colours, row by row from the top.
    fn picture(
        &mut self,
        what: &'static str,
        width: usize,
        texels: &[[f32; 3]],
        wrap: [Wrap; 2],
        store: fn(f32) -> u16,
    ) -> Result<usize, ImageError> {
        let pixels = Pixels {
            width: width as u32,
            height: (texels.len() / width) as u32,
            depth: Depth::Eight,
            channels: 3,
            values: texels.as_flattened().iter().copied().map(store).collect(),
        };
        let bytes = portable_network::encoded_pixels(&pixels)?;
        self.pictures.push((what, bytes, wrap));
        Ok(self.pictures.len() - 1)
    }

    fn with_texture(
        &mut self,
        what: &'static str,
        texture: &ColourTexture,
        store: fn(f32) -> u16,
    ) -> Result<usize, ImageError> {
        let [width, _] = texture.size();
        self.picture(what, width, texture.texels(), texture.wrap(), store)
    }

    /// Adds its materials to the file, visible from both sides or from their own alone, and returns
    /// their numbers.
    pub(super) fn written(&self, file: &mut GltfDocument, is_double_sided: bool) -> Vec<usize> {
        let mode = |wrap: Wrap| match wrap {
            Wrap::Repeat => 10497,
            Wrap::Mirror => 33648,
            Wrap::Clamp => 33071,
        };
        let name = |what: &str| format!("{}.{what}", self.name);
        let pictures = self.pictures.iter();
        let textures: Vec<usize> = pictures
            .map(|(what, bytes, wrap)| file.texture(&name(what), bytes, wrap.map(mode)))
            .collect();
        let finishes = self.finishes.iter();
        finishes
            .map(|finish| {
                let material = finish.written(file, &textures, is_double_sided);
                file.add("materials", material)
            })
            .collect()
    }
}

impl Finish {
    fn written(&self, file: &mut GltfDocument, textures: &[usize], is_double_sided: bool) -> Value {
        let colour = |colour: [f32; 3]| colour.map(rounded);
        let texture = |picture: usize| json!({ "index": textures[picture] });
        let [r, g, b] = colour(self.base);
        let mut surface = json!({
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": rounded(self.metallic),
            "roughnessFactor": rounded(self.roughness),
        });
        let maps = [
            ("baseColorTexture", self.base_map),
            ("metallicRoughnessTexture", self.rough_map),
        ];
        for (key, map) in maps {
            if let Some(picture) = map {
                surface[key] = texture(picture);
            }
        }
        let mut extensions = Map::new();
        if let Some((fraction, of_light, map)) = self.through {
            let mut through = json!({ "diffuseTransmissionFactor": rounded(fraction) });
            match map {
                Some(picture) => through["diffuseTransmissionColorTexture"] = texture(picture),
                None => through["diffuseTransmissionColorFactor"] = json!(colour(of_light)),
            }
            let key = file.uses("KHR_materials_diffuse_transmission");
            extensions.insert(key.to_owned(), through);
        }
        if self.eta == 1.0 {
            let key = file.uses("KHR_materials_specular");
            extensions.insert(key.to_owned(), json!({ "specularFactor": 0.0 }));
        } else if self.eta != USUAL_ETA {
            let key = file.uses("KHR_materials_ior");
            extensions.insert(key.to_owned(), json!({ "ior": rounded(self.eta) }));
        }
        if self.is_clear {
            let key = file.uses("KHR_materials_transmission");
            extensions.insert(key.to_owned(), json!({ "transmissionFactor": 1.0 }));
        }
        let mut material = json!({
            "name": self.name,
            "pbrMetallicRoughness": surface,
            "doubleSided": is_double_sided,
        });
        if let Some((picture, scale)) = self.normals {
            material["normalTexture"] = texture(picture);
            material["normalTexture"]["scale"] = rounded(scale).into();
        }
        if !extensions.is_empty() {
            material["extensions"] = extensions.into();
        }
        material
    }
}

/// Six digits are more than a texture has.
fn rounded(number: f32) -> f64 {
    (f64::from(number) * 1e6).round() / 1e6
}

/// Sides of the texture of a map of this size.
fn texture_size(map: (usize, usize), most: u32) -> [usize; 2] {
    [map.0, map.1].map(|side| side.next_power_of_two().min(most as usize))
}

/// A number for each texel of a texture, row by row from the top, from its texture coordinates.
fn each_texel<T: Send>([width, height]: [usize; 2], at: impl Fn(Vec2) -> T + Sync) -> Vec<T> {
    let places = (0..width * height).into_par_iter();
    places
        .map(|place| {
            let at_centre = Vec2::new((place % width) as f32, (place / width) as f32) + 0.5;
            let share = at_centre / Vec2::new(width as f32, height as f32);
            at(Vec2::new(share.x, 1.0 - share.y))
        })
        .collect()
}

/// The mean over looks at a texel.
fn mean_over_looks<const K: usize>(
    [width, height]: [usize; 2],
    uv: Vec2,
    at: impl Fn(Vec2) -> [[f32; 3]; K],
) -> [[f32; 3]; K] {
    let texel = Vec2::new(width as f32, height as f32).recip();
    let mut sums = [[0.0; 3]; K];
    for look in 0..LOOKS * LOOKS {
        let place = Vec2::new((look % LOOKS) as f32, (look / LOOKS) as f32) + 0.5;
        let seen = at(uv + (place / LOOKS as f32 - 0.5) * texel);
        for (sum, value) in sums.as_flattened_mut().iter_mut().zip(seen.as_flattened()) {
            *sum += value / (LOOKS * LOOKS) as f32;
        }
    }
    sums
}

fn greatest<'c>(colours: impl Iterator<Item = &'c [f32; 3]>) -> f32 {
    colours.flatten().copied().fold(0.0, f32::max)
}

/// A leaf: what both faces send back, and what it lets through.
fn sheet<'a>(
    leaf: &'a LeafMaterial,
    name: &str,
    seen: Observation<'_>,
) -> Result<Surface<'a>, ImageError> {
    let look = |uv: Vec2| {
        let bsdf = leaf.whole_bsdf(uv, &seen.wavelengths);
        let [[adaxial, from_above], [abaxial, from_below]] =
            [0, 1].map(|face| bsdf.below_coat(face));
        [adaxial, abaxial, (from_above + from_below) * 0.5]
            .map(|spectrum| seen.colorimetry.linear(&spectrum))
    };
    let map = leaf.tissue.map();
    let size = map.map(|map| texture_size(map.size(), seen.texture));
    let texels = match size {
        Some(size) => each_texel(size, |uv| mean_over_looks(size, uv, look)),
        None => vec![look(Vec2::ZERO)],
    };
    let back = greatest(
        texels
            .iter()
            .flat_map(|[adaxial, abaxial, _]| [adaxial, abaxial]),
    );
    let through = greatest(texels.iter().map(|[_, _, through]| through));
    // Where both together exceed 1, which no wavelength does, both are clipped alike.
    let fraction = (through / (back + through).max(1.0)).min(MOST_THROUGH);
    let over = |colour: [f32; 3], part: f32| colour.map(|value| value / part.max(1e-6));
    let bsdf: LeafBsdf<'_, WAVELENGTHS> = leaf.whole_bsdf(Vec2::ZERO, &seen.wavelengths);
    let faces = ["adaxial", "abaxial"].into_iter().zip(bsdf.coats());
    let mut surface = Surface {
        name: name.to_owned(),
        arrangement: leaf
            .half_face()
            .map_or(Arrangement::Faces, Arrangement::Face),
        pictures: Vec::new(),
        finishes: Vec::new(),
    };
    for (face, (word, coat)) in faces.enumerate() {
        let own = format!("{name}.{word}");
        let base = over(texels[0][face], 1.0 - fraction);
        surface.finishes.push(Finish {
            through: (fraction > 0.0).then(|| (fraction, over(texels[0][2], fraction), None)),
            ..Finish::coated(&own, base, coat)
        });
    }
    let Some(size) = size else {
        return Ok(surface);
    };
    let colours = |part: usize, of: f32| -> Vec<[f32; 3]> {
        texels.iter().map(|texel| over(texel[part], of)).collect()
    };
    let clamped = [Wrap::Clamp; 2];
    let light = surface.picture(
        "transmission",
        size[0],
        &colours(2, fraction),
        clamped,
        stored,
    )?;
    let words = [
        ["adaxial", "adaxial.normals", "adaxial.roughness"],
        ["abaxial", "abaxial.normals", "abaxial.roughness"],
    ];
    for (face, [base, normals, roughness]) in words.into_iter().enumerate() {
        let map = surface.picture(
            base,
            size[0],
            &colours(face, 1.0 - fraction),
            clamped,
            stored,
        )?;
        let finish = &mut surface.finishes[face];
        (finish.base, finish.base_map) = ([1.0; 3], Some(map));
        if let Some((_, _, of_light)) = &mut finish.through {
            *of_light = Some(light);
        }
        if let Some(relief) = &leaf.relief {
            let (slopes, rough) = relief_texels(relief, face, size);
            let slopes = surface.picture(normals, size[0], &slopes, clamped, stored_number)?;
            let rough = surface.picture(roughness, size[0], &rough, clamped, stored_number)?;
            let finish = &mut surface.finishes[face];
            finish.normals = Some((slopes, 1.0));
            (finish.roughness, finish.rough_map) = (1.0, Some(rough));
        }
    }
    Ok(surface)
}

/// The normals of a face in its own frame, away from the blade, and the roughness that its texels do not
/// resolve, as stored.
fn relief_texels(relief: &Relief, face: usize, size: [usize; 2]) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    let texels = each_texel(size, |uv| {
        let [adaxial, abaxial] = relief.faces(&relief.seen(uv, None, 1.0 / size[1] as f32));
        let (seen, outward) = if face == 0 {
            (adaxial, -1.0)
        } else {
            (abaxial, 1.0)
        };
        let normal = (seen.slope * outward).extend(1.0).normalize();
        let ggx = seen.coat.ggx;
        let roughness = roughness_of([ggx.alpha_x, ggx.alpha_y]);
        ((normal * 0.5 + 0.5).to_array(), [1.0, roughness, 0.0])
    });
    texels.into_iter().unzip()
}

/// Solid tissue, and the walls of stalks and hairs. Of the light that a wall lets into its tube all
/// leaves again that the wall does not absorb: `r + t² / (1 − r)` in all.
fn body<'a>(
    material: &'a Material,
    name: &str,
    seen: Observation<'_>,
) -> Result<Surface<'a>, ImageError> {
    let at = |uv: Vec2| {
        let bsdf = material.bsdf(uv, &seen.wavelengths);
        let Bsdf::Leaf(tissue) = &bsdf else {
            return (seen.colorimetry.linear(&bsdf.albedo(Vec3::Z)), None);
        };
        let [back, through] = tissue.below_coat(0);
        let all = Lanes::from_fn(|lane| {
            let (r, t) = (back.0[lane], through.0[lane]);
            r + t * t / (1.0 - r).max(1e-6)
        });
        (seen.colorimetry.linear(&all), Some(&tissue.coats()[0]))
    };
    let (colour, coat) = at(Vec2::ZERO);
    let finish = match coat {
        Some(coat) => Finish::coated(name, colour, coat),
        None => Finish::new(name, colour, 1.0, 1.0),
    };
    let mut surface = Surface::plain(finish);
    if let Some(map) = material.contents_map() {
        let size = texture_size(map.size(), seen.texture);
        let texels = each_texel(size, |uv| mean_over_looks(size, uv, |uv| [at(uv).0])[0]);
        let map = surface.picture("colours", size[0], &texels, [Wrap::Clamp; 2], stored)?;
        let finish = &mut surface.finishes[0];
        (finish.base, finish.base_map) = ([1.0; 3], Some(map));
    }
    Ok(surface)
}

/// What has a spectrum or a map of colours.
fn painted<'a>(
    material: &'a Material,
    name: &str,
    seen: Observation<'_>,
) -> Result<Surface<'a>, ImageError> {
    let Some(map) = material.colour_map() else {
        return body(material, name, seen);
    };
    let bsdf = material.bsdf(Vec2::ZERO, &seen.wavelengths);
    let (eta, alphas) = if let Bsdf::Leaf(tissue) = &bsdf {
        tissue.coats()[0].numbers()
    } else {
        (1.0, [1.0; 2])
    };
    let mut surface = Surface {
        name: name.to_owned(),
        arrangement: Arrangement::Slots(map),
        pictures: Vec::new(),
        finishes: Vec::new(),
    };
    for (number, slot) in map.slots().iter().enumerate() {
        let own = match number {
            0 => name.to_owned(),
            number => format!("{name}.{}", number + 1),
        };
        let mut finish = Finish::new(&own, slot.factor, eta, roughness_of(alphas));
        if let Some(texture) = &slot.texture {
            finish.base_map = Some(surface.with_texture("colours", texture, stored)?);
        }
        if let Material::Model(model) = material {
            let own = &model.finishes()[number];
            finish.eta = USUAL_ETA;
            (finish.metallic, finish.roughness) = (own.metallic, own.roughness);
            if let Some(texture) = &own.texture {
                finish.rough_map = Some(surface.with_texture("finish", texture, stored_number)?);
            }
            if let Some((texture, scale)) = &own.normals {
                let map = surface.with_texture("normals", texture, stored_number)?;
                finish.normals = Some((map, *scale));
            }
        }
        surface.finishes.push(finish);
    }
    Ok(surface)
}
