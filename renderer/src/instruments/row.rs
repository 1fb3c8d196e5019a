//! One figure of an instrument.

use std::fmt;

/// The light of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// Parallel light at this angle from the instrument's normal, rad.
    Beam(f64),
    /// Even light from the whole hemisphere.
    Diffuse,
}

impl fmt::Display for Direction {
    /// Degrees, or the word `diffuse`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // Degrees as they were written: a conversion leaves errors of some 1e-14.
            Self::Beam(angle) => write!(f, "{}", (angle.to_degrees() * 1e9).round() / 1e9),
            Self::Diffuse => write!(f, "diffuse"),
        }
    }
}

/// One figure of an instrument.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the instrument.
    pub instrument: String,
    /// The light.
    pub incidence: Direction,
    /// The face that is lit, of a sphere.
    pub face: Option<&'static str>,
    /// The object or layer that the figure is about, of a canopy.
    pub part: Option<String>,
    /// Wavelength, nm.
    pub wavelength_nm: f64,
    /// What it is.
    pub quantity: &'static str,
    /// Its value.
    pub value: f64,
    /// Standard error of the value.
    pub error: f64,
    /// Unit of both; 1 is a share of the incident flux.
    pub unit: &'static str,
}
