//! What fills bodies.

use super::Spectrum;

/// A homogeneous medium that absorbs and scatters light.
#[derive(Clone, Debug)]
pub struct Medium {
    /// Absorption coefficient, m⁻¹.
    pub absorption: Spectrum,
    /// Scattering coefficient, m⁻¹.
    pub scattering: Spectrum,
    /// Where scattered light goes.
    pub phase: MediumPhase,
    /// Mean cosine of the angle of scattering, for Henyey–Greenstein.
    pub g: f64,
}

/// The phase functions of media, a closed set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MediumPhase {
    /// Henyey and Greenstein's function.
    HenyeyGreenstein,
    /// Particles far smaller than the wavelength.
    Rayleigh,
}

impl MediumPhase {
    /// Their names in a file.
    pub const WORDS: [(&'static str, Self); 2] = [
        ("henyey-greenstein", Self::HenyeyGreenstein),
        ("rayleigh", Self::Rayleigh),
    ];
}
