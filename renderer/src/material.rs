//! What surfaces are made of: parameters at a hit → a [`Bsdf`].
//!
//! ```
//! use glam::Vec2;
//! use renderer::bsdf::Bsdf;
//! use renderer::material::Material;
//! use renderer::spectrum::{Curve, Wavelengths};
//!
//! // Red paint: little below 600 nm, much above.
//! let reflectance = Curve::from_points(&[(590.0, 0.1), (610.0, 0.7)]);
//! let paint = Material::Diffuse(reflectance.into());
//! let wavelengths = Wavelengths::new([450.0, 550.0, 650.0, 750.0]);
//! let bsdf: Bsdf<'_, 4> = paint.bsdf(Vec2::splat(0.5), &wavelengths);
//! assert_eq!(bsdf.albedo().0, [0.1, 0.1, 0.7, 0.7]);
//! ```

pub mod contents_texture;
pub mod leaf;
pub mod palette;
pub mod solid;

use glam::Vec2;

use crate::bsdf::Bsdf;
use crate::bsdf::dielectric::Dielectric;
use crate::spectrum::{Spectrum, WavelengthGrid, Wavelengths};
use leaf::LeafMaterial;
use solid::SolidMaterial;

/// The materials, a closed set.
#[derive(Clone, Debug)]
pub enum Material {
    /// Lambertian, with a reflectance.
    Diffuse(Spectrum),
    /// The boundary of a transparent medium.
    Dielectric(Dielectric),
    /// A leaf.
    Leaf(Box<LeafMaterial>),
    /// Solid tissue: fruit rind, a mushroom's cap.
    Solid(Box<SolidMaterial>),
}

impl Material {
    /// Works out what depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        match self {
            Self::Diffuse(reflectance) => reflectance.tabulate(grid),
            Self::Dielectric(_) => {}
            Self::Leaf(leaf) => leaf.tabulate(grid),
            Self::Solid(solid) => solid.tabulate(grid),
        }
    }

    /// The BSDF at texture coordinates `uv`, at a path's wavelengths.
    #[inline]
    pub fn bsdf<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Bsdf<'_, N> {
        match self {
            Self::Diffuse(reflectance) => Bsdf::Diffuse(reflectance.lanes(wavelengths)),
            Self::Dielectric(dielectric) => Bsdf::Dielectric(*dielectric),
            Self::Leaf(leaf) => Bsdf::Leaf(leaf.bsdf(uv, wavelengths)),
            Self::Solid(solid) => Bsdf::Leaf(solid.bsdf(uv, wavelengths)),
        }
    }
}
