//! What a film records: colour or bands.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

pub use super::band::{Band, spectral_channel_name};
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
