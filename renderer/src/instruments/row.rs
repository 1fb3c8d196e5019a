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
    /// What it is.
    pub quantity: &'static str,
    /// The object, layer or constituent that the figure is about; of an index, the quantity.
    pub part: Option<String>,
    /// The face that is lit, of a sample.
    pub face: Option<&'static str>,
    /// The light.
    pub incidence: Direction,
    /// Where it is seen from; `None` if the figure is about all directions.
    pub view: Option<ViewAngles>,
    /// Distance from the adaxial face, µm, of a figure within a leaf.
    pub depth_um: Option<f64>,
    /// The band over which the figure is a mean or a sum.
    pub band: Option<String>,
    /// Wavelength, nm, of a band its middle; `None` for what has none.
    pub wavelength_nm: Option<f64>,
    /// Its value.
    pub value: f64,
    /// Standard error of the value.
    pub error: f64,
    /// Of a mean over several draws of the leaves: what that error consists of.
    pub parts: Option<ErrorParts>,
    /// Unit of both; 1 is a share of the incident flux, or a factor.
    pub unit: &'static str,
}

impl Row {
    /// A figure without a unit, of all of a measurement in a light, and as yet without a value.
    pub(super) fn new(instrument: &str, quantity: &'static str, incidence: Direction) -> Self {
        Self {
            instrument: instrument.to_owned(),
            quantity,
            part: None,
            face: None,
            incidence,
            view: None,
            depth_um: None,
            band: None,
            wavelength_nm: None,
            value: f64::NAN,
            error: f64::NAN,
            parts: None,
            unit: "1",
        }
    }
}

impl Row {
    /// Whether another row is the same figure, whatever its value.
    pub(super) fn is_of_the_same(&self, other: &Self) -> bool {
        let bare = |row: &Self| Self {
            value: 0.0,
            error: 0.0,
            parts: None,
            ..row.clone()
        };
        bare(self) == bare(other)
    }
}

/// What the standard error of a mean over several draws of the leaves consists of; its square is the
/// sum of the squares of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorParts {
    /// Number of draws.
    pub draws: u32,
    /// The error by the light that was followed.
    pub by_rays: f64,
    /// The error by the leaves that were drawn.
    pub by_draws: f64,
}

/// Paths that a limit cut in a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutPaths {
    /// Their number.
    pub paths: u64,
    /// The most that they could change a figure by, as a fraction of the light.
    pub at_most: f64,
}

impl CutPaths {
    /// No path was cut.
    pub(super) const NONE: Self = Self {
        paths: 0,
        at_most: 0.0,
    };
}

/// What an instrument reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Its figures.
    pub rows: Vec<Row>,
    /// Paths that were cut; what they carried counts as absorbed, or is missing from the figures of a
    /// canopy.
    pub cut: CutPaths,
    /// Draws of the leaves over which they are means.
    pub draws: u32,
}
