//! What a film records: colour or bands.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::observer::Observer;
use super::sensor::Sensor;

/// Colour or bands.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub enum FilmKind {
    /// Linear sRGB as an observer sees it, from wavelengths in this range (nm).
    Rgb {
        /// First and last wavelength, nm.
        range_nm: [f64; 2],
        /// The observer: the eye or a camera.
        observer: Observer,
    },
    /// Mean spectral radiance over each band.
    Spectral {
        /// The bands, 1 to [`MOST_BANDS`].
        bands: Vec<Band>,
    },
    /// Spectral radiance by the bands of a sensor, each its mean by the band's response.
    Sensor(Arc<Sensor>),
}

/// Most bands of a film.
pub const MOST_BANDS: usize = 1024;

/// A box-shaped band.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Band {
    /// Middle, nm.
    pub center_nm: f64,
    /// Full width, nm; 0 is a single wavelength.
    pub width_nm: f64,
}

/// Name of the channel of a picture that holds spectral radiance at a wavelength.
///
/// # Source
///
/// \[fichet2021\]: `S0.` for the unpolarised component, a comma as decimal mark, the unit.
pub fn spectral_channel_name(nm: f64) -> String {
    format!("S0.{}nm", format!("{nm:.6}").replace('.', ","))
}
