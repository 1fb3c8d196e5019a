//! A diffuse body below a rough clear coat: glazed pots, varnish, smooth bark and rinds.
//!
//! It reflects like a leaf that transmits nothing, with the same coat on both sides;
//! `docs/src/theory/leaf-bsdf.md` describes the model. Unlike a leaf's, its reflectance is that of
//! the body alone, so that 0 is a black body below a coat that shines all the same.

use super::leaf::Site;
use super::reflectance::Reflectance;
use crate::bsdf::leaf::{Coat, LeafBsdf, LeafShape, Tissue};
use crate::spectrum::{WavelengthGrid, Wavelengths};

/// A body below a coat.
#[derive(Clone, Debug)]
pub struct PlasticMaterial {
    reflectance: Reflectance,
    /// The same on both sides.
    coats: [Coat; 2],
}

impl PlasticMaterial {
    /// A body of which light that has passed the coat comes back by this share.
    pub fn new(reflectance: Reflectance, coat: Coat) -> Self {
        Self {
            reflectance,
            coats: [coat.clone(), coat],
        }
    }

    /// The reflectance of the body.
    pub fn reflectance(&self) -> &Reflectance {
        &self.reflectance
    }

    /// Evaluates everything that depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.reflectance.tabulate(grid);
    }

    /// The BSDF at a site.
    #[inline]
    pub fn bsdf<const N: usize>(
        &self,
        site: &Site<N>,
        wavelengths: &Wavelengths<N>,
    ) -> LeafBsdf<'_, N> {
        let reflectance = self.reflectance.at(site, wavelengths);
        LeafBsdf::new(&self.coats, &LeafShape::EVEN, Tissue::opaque(reflectance))
    }
}
