//! What surfaces are made of: parameters at a hit → a [`Bsdf`](crate::bsdf::Bsdf).

pub mod contents_texture;
pub mod leaf;
pub mod solid;

use glam::Vec2;
use leafmodel::optics::Contents;

use crate::bsdf::Bsdf;
use crate::bsdf::dielectric::Dielectric;
use crate::spectrum::{Curve, Wavelengths};
use leaf::{LeafMaterial, LeafOptics};
use solid::SolidMaterial;

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
    /// PROSPECT's tables at them, from the first leaf on.
    optics: Option<LeafOptics<N>>,
}

impl<const N: usize> PathSpectra<N> {
    /// For a path with these wavelengths.
    pub fn new(wavelengths: Wavelengths<N>) -> Self {
        Self {
            wavelengths,
            optics: None,
        }
    }

    fn optics(&mut self) -> &LeafOptics<N> {
        self.optics
            .get_or_insert_with(|| LeafOptics::new(&self.wavelengths))
    }

    /// What contents absorb in all at each of the wavelengths, `Σ C K`, ≥ 0.
    fn absorption(&mut self, contents: &Contents) -> [f64; N] {
        self.optics().absorption(contents)
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
