//! What surfaces are made of: parameters at a hit → a [`Bsdf`](crate::bsdf::Bsdf).

pub mod contents_texture;
pub mod leaf;
pub mod palette;
pub mod solid;

use glam::Vec2;
use leafmodel::optics::Contents;

use crate::bsdf::Bsdf;
use crate::bsdf::dielectric::Dielectric;
use crate::spectrum::{Curve, Wavelengths};
use leaf::{LeafMaterial, LeafOptics};
use palette::Palette;
use solid::SolidMaterial;

/// Palettes whose constants a path keeps. Among more it works some out again at a change of leaf, which costs as much as a hit does.
const KEPT: usize = 4;

/// The materials, a closed set.
#[derive(Clone, Debug)]
pub enum Material {
    /// Lambertian, with a reflectance.
    Diffuse(Curve),
    /// The boundary of a transparent medium.
    Dielectric(Dielectric),
    /// A leaf.
    Leaf(Box<LeafMaterial>),
    /// Solid tissue: fruit rind, a mushroom's cap.
    Solid(Box<SolidMaterial>),
}

/// What a path works out once for its wavelengths and uses at every hit.
#[derive(Clone, Debug)]
pub struct PathSpectra<const N: usize> {
    /// The path's wavelengths.
    pub wavelengths: Wavelengths<N>,
    /// PROSPECT's constants at them, of each palette from its first leaf on, in the slot that its number points at.
    optics: [Option<LeafOptics<N>>; KEPT],
}

impl<const N: usize> PathSpectra<N> {
    /// For a path with these wavelengths.
    pub fn new(wavelengths: Wavelengths<N>) -> Self {
        Self {
            wavelengths,
            optics: [const { None }; KEPT],
        }
    }

    fn optics(&mut self, palette: &Palette) -> &LeafOptics<N> {
        let slot = &mut self.optics[palette.number() % KEPT];
        // Another palette with the same slot makes way.
        slot.take_if(|kept| kept.palette() != palette.number());
        slot.get_or_insert_with(|| LeafOptics::new(palette, &self.wavelengths))
    }

    /// What contents absorb in all at each of the wavelengths, `Σ C K`, ≥ 0.
    fn absorption(&mut self, palette: &Palette, contents: &Contents) -> [f64; N] {
        self.optics(palette).absorption(contents)
    }
}

impl Material {
    /// The BSDF at texture coordinates `uv`, at the path's wavelengths.
    pub fn bsdf<const N: usize>(&self, uv: Vec2, spectra: &mut PathSpectra<N>) -> Bsdf<'_, N> {
        match self {
            Self::Diffuse(reflectance) => Bsdf::Diffuse(reflectance.lanes(&spectra.wavelengths)),
            Self::Dielectric(dielectric) => Bsdf::Dielectric(*dielectric),
            Self::Leaf(leaf) => Bsdf::Leaf(leaf.bsdf(uv, spectra)),
            Self::Solid(solid) => Bsdf::Leaf(solid.bsdf(uv, spectra)),
        }
    }
}
