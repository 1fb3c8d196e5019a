//! Instruments that measure how a scene scatters and absorbs light.

use glam::DVec2;
use leafmodel::optics::fluorescence::EXCITED_NM;

use super::Spectrum;

/// An instrument with the wavelengths at which it measures.
#[derive(Clone, Debug)]
pub struct Instrument {
    /// Where its block stands, as `file:line:column`, for messages about what only shows once the
    /// scene is built.
    pub at: String,
    /// Wavelengths, nm, rising, at least one.
    pub wavelengths_nm: Vec<f64>,
    /// What it measures.
    pub kind: InstrumentKind,
    /// What it measures of fluorescence, if anything.
    pub fluorescence: Option<FluorescenceReading>,
}

/// What an instrument measures of fluorescence.
#[derive(Clone, Debug)]
pub struct FluorescenceReading {
    /// The light that excites.
    pub light: ExcitationLight,
    /// Wavelengths of emission, nm, rising, at least one.
    pub emission_nm: Vec<f64>,
}

/// Light that excites fluorescence.
#[derive(Clone, Debug)]
pub enum ExcitationLight {
    /// Monochromatic light of these wavelengths, nm, one after the other.
    Monochromatic(Vec<f64>),
    /// Light of a spectral irradiance, W m⁻² nm⁻¹.
    Spectrum(Spectrum),
}

impl Instrument {
    /// First and last of its wavelengths, of excitation and emission too, nm; `None` if the file
    /// lacks them.
    pub fn range_nm(&self) -> Option<[f64; 2]> {
        let ends = |list: &[f64]| Some([*list.first()?, *list.last()?]);
        let own = ends(&self.wavelengths_nm)?;
        let Some(reading) = &self.fluorescence else {
            return Some(own);
        };
        let excited = match &reading.light {
            ExcitationLight::Monochromatic(list) => ends(list)?,
            ExcitationLight::Spectrum(_) => EXCITED_NM,
        };
        let all = [own, excited, ends(&reading.emission_nm)?];
        all.into_iter()
            .reduce(|[low, high], [from, to]| [low.min(from), high.max(to)])
    }
}

/// The kinds of instruments, a closed set.
#[derive(Clone, Debug)]
pub enum InstrumentKind {
    /// An integrating sphere.
    Sphere(Sphere),
    /// Fluxes of an unbounded canopy.
    Canopy(Canopy),
}

/// The directions from which light comes, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Incidence {
    /// Angles of parallel beams from the instrument's normal, rad, each in [0, π/2).
    pub angles: Vec<f64>,
    /// Azimuth of these beams, rad.
    pub azimuth: f64,
    /// Whether even light from the whole hemisphere is measured too.
    pub diffuse: bool,
}

/// An integrating sphere, which gathers what one object reflects and transmits.
#[derive(Clone, Debug)]
pub struct Sphere {
    /// The sample, index into [`Description::objects`](super::Description::objects).
    pub object: usize,
    /// The light; angles from the normal of the port.
    pub incidence: Incidence,
    /// Whether the adaxial and the abaxial face are lit, one after the other; one at least.
    pub faces: [bool; 2],
    /// The spot that is lit; `None` is the whole object.
    pub spot: Option<Spot>,
}

/// A round spot on a surface.
#[derive(Clone, Debug)]
pub struct Spot {
    /// Where the block stands, as `file:line:column`.
    pub at: String,
    /// Diameter, m, > 0.
    pub diameter: f64,
    /// Its middle.
    pub middle: SpotMiddle,
}

/// The middle of a spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpotMiddle {
    /// Texture coordinates.
    Uv(DVec2),
    /// x and y in the object's own frame, m; the point of its surface that is seen from +z.
    Point(DVec2),
}

/// Fluxes of a canopy that repeats itself without end along x and y.
#[derive(Clone, Debug)]
pub struct Canopy {
    /// Least and greatest x and y of the box that repeats itself, m.
    pub within: [DVec2; 2],
    /// The light; angles from +z.
    pub incidence: Incidence,
    /// The object that is the soil, index into
    /// [`Description::objects`](super::Description::objects).
    pub soil: Option<usize>,
    /// Heights between layers, m, rising.
    pub layers: Vec<f64>,
}
