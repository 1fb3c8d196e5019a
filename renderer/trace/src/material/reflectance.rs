//! The reflectance of a surface: the same everywhere, or by texture coordinates.

use super::colour_map::ColourMap;
use super::leaf::Site;
use crate::spectrum::{Curve, Lanes, Spectrum, WavelengthGrid, Wavelengths};

/// Share of light that a surface reflects, in [0, 1].
#[derive(Clone, Debug)]
pub enum Reflectance {
    /// The same everywhere.
    Even(Spectrum),
    /// The spectra of a picture's colours.
    Picture(Box<ColourMap>),
}

impl From<Curve> for Reflectance {
    fn from(curve: Curve) -> Self {
        Self::Even(curve.into())
    }
}

impl Reflectance {
    /// Its map of colours, if it has one.
    pub fn colour_map(&self) -> Option<&ColourMap> {
        match self {
            Self::Even(_) => None,
            Self::Picture(map) => Some(map),
        }
    }

    /// Evaluates what depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        match self {
            Self::Even(spectrum) => spectrum.tabulate(grid),
            Self::Picture(map) => map.tabulate(grid),
        }
    }

    /// Values at a site and a path's wavelengths.
    #[inline]
    pub fn at<const N: usize>(&self, site: &Site<N>, wavelengths: &Wavelengths<N>) -> Lanes<N> {
        match self {
            Self::Even(spectrum) => spectrum.lanes(wavelengths),
            Self::Picture(map) => map.spectrum(site.uv, site.tint, wavelengths),
        }
    }
}
