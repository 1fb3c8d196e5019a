//! The surface of a glTF model, each part as its own material says: base colour, metal, roughness and
//! a map of normals.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::colour_map::{ColourMap, ColourTexture, Slot};
use super::leaf::Site;
use crate::bsdf::coat_table::{Bloom, CoatTable};
use crate::bsdf::metallic_roughness::MetallicRoughness;
use crate::spectrum::{WavelengthGrid, Wavelengths};

/// Refractive index of the coat of what is no metal, as glTF has it: 4 % are reflected upright.
const ETA: f32 = 1.5;
/// Index of a coat that reflects all light.
const MIRROR: f32 = f32::INFINITY;

/// The normal of the surface itself, as stored.
const FLAT: [f32; 3] = [0.5, 0.5, 1.0];

/// Least part of a normal of a map that points away from the surface.
const LEAST_UPWARD: f32 = 0.02;

/// What a material of a model says besides its base colour.
#[derive(Clone, Debug)]
pub struct Finish {
    /// Roughness, whose square is that of GGX, in [0, 1].
    pub roughness: f32,
    /// Fraction of metal, in [0, 1].
    pub metallic: f32,
    /// Factors on the roughness, in its second channel, and on the metal, in its third.
    pub texture: Option<Arc<ColourTexture>>,
    /// Normals, x and y along [`Site::map_axes`], that are stored as ½ + ½ n, and a factor on x and y.
    pub normals: Option<(Arc<ColourTexture>, f32)>,
}

/// The surface of a model.
#[derive(Clone, Debug)]
pub struct ModelMaterial {
    colours: ColourMap,
    /// For each slot of the colours.
    finishes: Arc<[Finish]>,
    has_normals: bool,
    coat: Coats,
    mirror: Coats,
}

/// Coats of any roughness without bloom.
#[derive(Clone, Debug)]
struct Coats {
    table: Arc<CoatTable>,
    bare: Bloom,
}

impl Coats {
    fn of(eta: f32) -> Self {
        let table = CoatTable::of(eta);
        let bare = Bloom::new(0.0, &table);
        Self { table, bare }
    }
}

impl ModelMaterial {
    /// A surface of base colours, with a finish for each of their slots.
    pub fn new(colours: ColourMap, finishes: Arc<[Finish]>) -> Self {
        Self {
            colours,
            has_normals: finishes.iter().any(|finish| finish.normals.is_some()),
            finishes,
            coat: Coats::of(ETA),
            mirror: Coats::of(MIRROR),
        }
    }

    /// Its base colours.
    pub fn colours(&self) -> &ColourMap {
        &self.colours
    }

    /// For each slot of the colours what its material says besides.
    pub fn finishes(&self) -> &[Finish] {
        &self.finishes
    }

    /// Roughness and metal of all slots as a map of which they are green and blue, and the normals as
    /// stored.
    pub fn finish_maps(&self) -> [ColourMap; 2] {
        let map = |of: &dyn Fn(&Finish) -> Slot| {
            let slots = self.colours.slots().iter().zip(&*self.finishes);
            let slots = slots.map(|(slot, finish)| Slot {
                begins: slot.begins,
                shift: slot.shift,
                ..of(finish)
            });
            ColourMap::new(slots.collect(), Vec2::ONE)
        };
        let slot = |factor, texture| Slot {
            begins: 0.0,
            shift: 0.0,
            factor,
            texture,
        };
        [
            map(&|finish| {
                let factor = [1.0, finish.roughness, finish.metallic];
                slot(factor, finish.texture.clone())
            }),
            map(&|finish| match &finish.normals {
                Some((texture, _)) => slot([1.0; 3], Some(Arc::clone(texture))),
                None => slot(FLAT, None),
            }),
        ]
    }

    /// Factors on x and y of the normals of all slots.
    pub fn normal_scales(&self) -> impl Iterator<Item = f32> + '_ {
        let finishes = self.finishes.iter();
        finishes.map(|finish| finish.normals.as_ref().map_or(1.0, |(_, scale)| *scale))
    }

    /// Whether any part has a map of normals.
    #[inline]
    pub fn has_normals(&self) -> bool {
        self.has_normals
    }

    /// Evaluates what depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.colours.tabulate(grid);
    }

    /// The BSDF at a site.
    pub fn bsdf<const N: usize>(
        &self,
        site: &Site<N>,
        wavelengths: &Wavelengths<N>,
    ) -> MetallicRoughness<'_, N> {
        let (slot, uv) = self.colours.place(site.uv);
        let finish = &self.finishes[slot];
        let [_, rough, metal] = finish
            .texture
            .as_ref()
            .map_or([1.0; 3], |texture| texture.at(uv));
        let roughness = finish.roughness * rough;
        let alphas = [roughness * roughness; 2];
        let normals = finish.normals.as_ref();
        let slope = normals.map_or(Vec2::ZERO, |(texture, scale)| {
            let [x, y] = slope_of(texture.at(uv), *scale).to_array();
            site.map_axes[0] * x + site.map_axes[1] * y
        });
        MetallicRoughness {
            colour: self.colours.spectrum(site.uv, site.tint, wavelengths),
            metallic: finish.metallic * metal,
            coat: self.coat.table.coat(ETA, alphas, &self.coat.bare),
            mirror: self.mirror.table.coat(MIRROR, alphas, &self.mirror.bare),
            slope,
        }
    }
}

/// The slope of a stored normal.
fn slope_of(stored: [f32; 3], scale: f32) -> Vec2 {
    let normal = 2.0 * Vec3::from_array(stored) - 1.0;
    let normal = normal * Vec3::new(scale, scale, 1.0);
    let upward = normal.z.max(LEAST_UPWARD * normal.length());
    if upward > 0.0 {
        -normal.truncate() / upward
    } else {
        Vec2::ZERO
    }
}
