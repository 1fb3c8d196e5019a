//! What glTF's materials say of a surface.
//!
//! glTF's surface is a diffuse layer below a coat of Fresnel's reflection, and of what passes the coat
//! the fraction `f` is let through in the colour of the transmission, the rest sent back in the base
//! colour. So the base colour is `r / (1 − f)` and the other `t / f`, where `r` and `t` are what the
//! tissue sends back and lets through below its coat.

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::coarse::{BladePlane, coverage};
use super::colours::{Colorimetry, WAVELENGTHS, stored, stored_number};
use super::document::GltfDocument;
use crate::bsdf::Bsdf;
use crate::bsdf::leaf::Coat;
use crate::geometry::TriangleMesh;
use crate::image::pixels::{Depth, Pixels};
use crate::image::{ImageError, portable_network};
use crate::material::Material;
use crate::material::colour_map::{ColourMap, ColourTexture, Wrap};
use crate::material::contents_texture::ContentsTexture;
use crate::material::leaf::LeafMaterial;
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
pub(in crate::export) enum Arrangement<'a> {
    /// One on all triangles.
    Whole,
    /// That of the adaxial face on all triangles and that of the abaxial one on their backs.
    Faces,
    /// One on the backs of all triangles.
    Backs,
    /// One for each slot of a map of colours.
    Slots(&'a ColourMap),
}

/// A surface: its pictures, and its materials, which name them by number.
#[derive(Clone, Debug)]
pub(in crate::export) struct Surface<'a> {
    pub(in crate::export) name: String,
    pub(in crate::export) arrangement: Arrangement<'a>,
    /// What each shows, its file, and what lies beside it.
    pub(in crate::export) pictures: Vec<(&'static str, Vec<u8>, [Wrap; 2])>,
    pub(in crate::export) finishes: Vec<Finish>,
}

/// One material. Numbers are those of pictures of the surface.
#[derive(Clone, Debug)]
pub(in crate::export) struct Finish {
    name: String,
    pub(in crate::export) base: [f32; 3],
    pub(in crate::export) base_map: Option<usize>,
    /// What is let through: the fraction, and its colour.
    pub(in crate::export) through: Option<(f32, [f32; 3], Option<usize>)>,
    pub(in crate::export) metallic: f32,
    pub(in crate::export) roughness: f32,
    rough_map: Option<usize>,
    /// Whether that map holds the roughness itself, no factor on it.
    has_own_roughness: bool,
    normals: Option<(usize, f32)>,
    /// Refractive index of the coat; 1 is none.
    pub(in crate::export) eta: f32,
    is_clear: bool,
    /// Whether the alpha of its base map says what is there.
    is_masked: bool,
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
            has_own_roughness: false,
            normals: None,
            eta,
            is_clear: false,
            is_masked: false,
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
    /// The surface of a material that is no blade's.
    pub(super) fn of(
        material: &'a Material,
        name: &str,
        seen: Observation<'_>,
    ) -> Result<Self, ImageError> {
        match material {
            Material::Leaf(_) | Material::Solid(_) | Material::Hapke { .. } => {
                body(material, name, seen)
            }
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
        self.add(what, &pixels(width, texels, store), wrap)
    }

    fn add(
        &mut self,
        what: &'static str,
        pixels: &Pixels,
        wrap: [Wrap; 2],
    ) -> Result<usize, ImageError> {
        let bytes = portable_network::encoded_pixels(pixels)?;
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
            "roughnessFactor": if self.has_own_roughness { 1.0 } else { rounded(self.roughness) },
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
        if self.is_masked {
            material["alphaMode"] = "MASK".into();
        }
        if !extensions.is_empty() {
            material["extensions"] = extensions.into();
        }
        material
    }
}

fn pixels(width: usize, texels: &[[f32; 3]], store: fn(f32) -> u16) -> Pixels {
    Pixels {
        width: width as u32,
        height: (texels.len() / width) as u32,
        depth: Depth::Eight,
        channels: 3,
        values: texels.as_flattened().iter().copied().map(store).collect(),
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

/// A blade that is to be shown, and how.
#[derive(Clone, Copy, Debug)]
pub(super) struct Blade<'a> {
    pub(super) leaf: &'a LeafMaterial,
    /// Its own mesh, where a mask has to show what that covers of its texture.
    pub(super) masked: Option<&'a TriangleMesh>,
    /// Whether it is shown by a card, so that its form appears in the map of normals.
    pub(super) is_card: bool,
}

/// What is seen of a blade: for each texel, row by row from the top, what the adaxial and the abaxial face
/// send back and what is let through; and what is covered, with its slope, if there is a mask.
struct BladeTexels<'a> {
    blade: Blade<'a>,
    size: [usize; 2],
    colours: Vec<[[f32; 3]; 3]>,
    covered: Option<Vec<(f32, Vec2)>>,
}

impl<'a> BladeTexels<'a> {
    fn of(blade: Blade<'a>, size: [usize; 2], seen: Observation<'_>) -> Self {
        let look = |uv: Vec2| {
            let bsdf = blade.leaf.whole_bsdf(uv, &seen.wavelengths);
            let [[adaxial, from_above], [abaxial, from_below]] =
                [0, 1].map(|face| bsdf.below_coat(face));
            [adaxial, abaxial, (from_above + from_below) * 0.5]
                .map(|spectrum| seen.colorimetry.linear(&spectrum))
        };
        let colours = if blade.leaf.tissue.map().is_some() {
            each_texel(size, |uv| mean_over_looks(size, uv, look))
        } else {
            vec![look(Vec2::splat(0.5)); size[0] * size[1]]
        };
        let covered = blade.masked.map(|mesh| {
            let plane = BladePlane::of(mesh).filter(|_| blade.is_card);
            coverage(mesh, size, plane.as_ref())
        });
        Self {
            blade,
            size,
            colours,
            covered,
        }
    }

    /// The normals of a face in its own frame, away from the blade (part 0), or the roughness that its texels
    /// do not resolve (part 1), as stored.
    fn finish(&self, face: usize, part: usize) -> Vec<[f32; 3]> {
        let leaf = self.blade.leaf;
        let relief = leaf.relief.as_ref();
        let coat = leaf.coats()[face].numbers();
        let mut texels = each_texel(self.size, |uv| {
            let (slope, alphas) = relief.map_or((Vec2::ZERO, coat.1), |relief| {
                let seen = relief.seen(uv, None, 1.0 / self.size[1] as f32);
                let own = &relief.faces(&seen)[face];
                (own.slope, [own.coat.ggx.alpha_x, own.coat.ggx.alpha_y])
            });
            (slope, roughness_of(alphas))
        });
        if let Some(covered) = &self.covered {
            for ((slope, _), (_, of_form)) in texels.iter_mut().zip(covered) {
                *slope += *of_form;
            }
        }
        let outward = if face == 0 { -1.0 } else { 1.0 };
        let stored = texels.into_iter().map(|(slope, roughness)| {
            let normal = (slope * outward).extend(1.0).normalize();
            [(normal * 0.5 + 0.5).to_array(), [1.0, roughness, 0.0]][part]
        });
        stored.collect()
    }
}

impl<'a> Surface<'a> {
    /// The surface of a blade.
    pub(super) fn of_blade(
        blade: Blade<'a>,
        name: &str,
        seen: Observation<'_>,
    ) -> Result<Self, ImageError> {
        let map = blade.leaf.tissue.map().map(ContentsTexture::size);
        let size = map.map_or([16; 2], |map| texture_size(map, seen.texture));
        let needs_texture = map.is_some() || blade.masked.is_some();
        let size = if needs_texture { size } else { [1; 2] };
        let texels = BladeTexels::of(blade, size, seen);
        let mut surface = Self::of_texels(name, &[(texels, [0; 2])], size)?;
        if let Some(face) = blade.leaf.half_face() {
            surface.finishes = vec![surface.finishes.swap_remove(face)];
            surface.arrangement = [Arrangement::Whole, Arrangement::Backs][face].clone();
        }
        Ok(surface)
    }

    /// The surface of cards of blades, whose pictures lie in one, and the place of each there: its first
    /// corner and its sides in texture coordinates.
    pub(super) fn of_cards(
        blades: &[Blade<'a>],
        name: &str,
        seen: Observation<'_>,
    ) -> Result<(Self, Vec<[Vec2; 2]>), ImageError> {
        let side = seen.texture as usize;
        let across = (1..=blades.len())
            .find(|across| across * across >= blades.len())
            .unwrap_or(1);
        let cell = side / across;
        let corner = |number: usize| [number % across * cell, number / across * cell];
        let cards = blades
            .iter()
            .enumerate()
            .map(|(number, &blade)| (BladeTexels::of(blade, [cell; 2], seen), corner(number)));
        let cards: Vec<_> = cards.collect();
        let places = (0..blades.len()).map(|number| {
            let [x, y] = corner(number).map(|at| at as f32);
            // Rows are counted from the top, v from below.
            let lowest = side as f32 - y - cell as f32;
            [Vec2::new(x, lowest), Vec2::splat(cell as f32)].map(|of| of / side as f32)
        });
        let places = places.collect();
        Ok((Self::of_texels(name, &cards, [side; 2])?, places))
    }

    /// A surface whose pictures hold the texels of blades at places of theirs.
    fn of_texels(
        name: &str,
        blades: &[(BladeTexels<'a>, [usize; 2])],
        size: [usize; 2],
    ) -> Result<Self, ImageError> {
        let colours = || blades.iter().flat_map(|(blade, _)| &blade.colours);
        let back = greatest(colours().flat_map(|[adaxial, abaxial, _]| [adaxial, abaxial]));
        let through = greatest(colours().map(|[_, _, through]| through));
        // Where both together exceed 1, which no wavelength does, both are clipped alike.
        let fraction = (through / (back + through).max(1.0)).min(MOST_THROUGH);
        let over = |colour: [f32; 3], part: f32| colour.map(|value| value / part.max(1e-6));
        let (first, _) = &blades[0];
        let mut surface = Surface {
            name: name.to_owned(),
            arrangement: Arrangement::Faces,
            pictures: Vec::new(),
            finishes: Vec::new(),
        };
        for (face, word) in ["adaxial", "abaxial"].into_iter().enumerate() {
            let own = format!("{name}.{word}");
            let base = over(first.colours[0][face], 1.0 - fraction);
            let of_light = over(first.colours[0][2], fraction);
            surface.finishes.push(Finish {
                through: (fraction > 0.0).then_some((fraction, of_light, None)),
                ..Finish::coated(&own, base, &first.blade.leaf.coats()[face])
            });
        }
        if size == [1; 2] {
            return Ok(surface);
        }
        let laid = |texels: &dyn Fn(&BladeTexels<'a>) -> Vec<[f32; 3]>| {
            let mut picture = vec![[0.0; 3]; size[0] * size[1]];
            for (blade, [x, y]) in blades {
                for (row, texels) in texels(blade).chunks(blade.size[0]).enumerate() {
                    picture[(y + row) * size[0] + x..][..texels.len()].copy_from_slice(texels);
                }
            }
            picture
        };
        let colours = |part: usize, of: f32| {
            laid(&|blade| {
                blade
                    .colours
                    .iter()
                    .map(|texel| over(texel[part], of))
                    .collect()
            })
        };
        let has_mask = blades.iter().any(|(blade, _)| blade.covered.is_some());
        let mask = has_mask.then(|| {
            let covered = |blade: &BladeTexels<'_>| match &blade.covered {
                Some(covered) => covered.iter().map(|(part, _)| [*part; 3]).collect(),
                None => vec![[1.0; 3]; blade.colours.len()],
            };
            laid(&covered)
        });
        let clamped = [Wrap::Clamp; 2];
        let light = surface.picture(
            "transmission",
            size[0],
            &colours(2, fraction),
            clamped,
            stored,
        )?;
        let has_finish =
            blades.len() > 1 || first.blade.leaf.relief.is_some() || first.blade.is_card;
        let words = [
            ["adaxial", "adaxial.normals", "adaxial.roughness"],
            ["abaxial", "abaxial.normals", "abaxial.roughness"],
        ];
        for (face, [base, normals, roughness]) in words.into_iter().enumerate() {
            let mut pixels = pixels(size[0], &colours(face, 1.0 - fraction), stored);
            if let Some(mask) = &mask {
                pixels = with_alpha(&pixels, mask);
            }
            let map = surface.add(base, &pixels, clamped)?;
            let finish = &mut surface.finishes[face];
            finish.is_masked = mask.is_some();
            (finish.base, finish.base_map) = ([1.0; 3], Some(map));
            if let Some((_, _, of_light)) = &mut finish.through {
                *of_light = Some(light);
            }
            if has_finish {
                let [slopes, rough] = [0, 1].map(|part| laid(&|blade| blade.finish(face, part)));
                let slopes = surface.picture(normals, size[0], &slopes, clamped, stored_number)?;
                let rough = surface.picture(roughness, size[0], &rough, clamped, stored_number)?;
                let finish = &mut surface.finishes[face];
                finish.normals = Some((slopes, 1.0));
                finish.rough_map = Some(rough);
                finish.has_own_roughness = true;
            }
        }
        Ok(surface)
    }
}

/// The same pixels with alpha.
fn with_alpha(pixels: &Pixels, mask: &[[f32; 3]]) -> Pixels {
    let colours = pixels.values.chunks(3).zip(mask);
    let values = colours.flat_map(|(colour, [alpha, ..])| {
        let alpha = stored_number(*alpha);
        [colour[0], colour[1], colour[2], alpha]
    });
    Pixels {
        channels: 4,
        values: values.collect(),
        ..*pixels
    }
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
