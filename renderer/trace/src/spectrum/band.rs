//! Bands of films.

use serde::{Deserialize, Serialize};

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
