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

/// The direction of a detector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewAngles {
    /// Angle from the normal, rad; a negative one lies on the other side of the normal.
    pub zenith: f64,
    /// Azimuth from that of the light, rad.
    pub azimuth: f64,
}

impl ViewAngles {
    /// Zenith and azimuth, degrees as they were written.
    pub fn degrees(&self) -> [f64; 2] {
        [self.zenith, self.azimuth].map(written_degrees)
    }
}

/// Degrees as they were written: a conversion leaves errors of some 1e-14.
fn written_degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e9).round() / 1e9
}

impl fmt::Display for Direction {
    /// Degrees, or the word `diffuse`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Beam(angle) => write!(f, "{}", written_degrees(*angle)),
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
    /// Where it is seen from; `None` if the figure is about all directions.
    pub view: Option<ViewAngles>,
    /// Wavelength, nm; `None` for what is no figure of one.
    pub wavelength_nm: Option<f64>,
    /// What it is.
    pub quantity: &'static str,
    /// Its value.
    pub value: f64,
    /// Standard error of the value.
    pub error: f64,
    /// Unit of both; 1 is a share of the incident flux.
    pub unit: &'static str,
}
