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
    /// Wavelengths whose figures are told, nm, rising; none if only bands are.
    pub wavelengths_nm: Vec<f64>,
    /// Bands whose figures are told.
    pub bands: Vec<Response>,
    /// Indices of these bands.
    pub indices: Vec<Index>,
    /// The incident light in absolute terms; `None` tells shares alone.
    pub incident: Option<Incident>,
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
    /// All wavelengths at which it measures, nm: those that are told, then those of each band, then
    /// those of the photon flux.
    pub fn measured_nm(&self) -> Vec<f64> {
        let mut all = self.wavelengths_nm.clone();
        for band in &self.bands {
            all.extend(band.nodes.iter().map(|(nm, _)| *nm));
        }
        if self.incident.is_some() {
            all.extend(Incident::nodes_nm());
        }
        all
    }

    /// Least and greatest of its wavelengths, of excitation and emission too, nm; `None` if the file
    /// lacks them.
    pub fn range_nm(&self) -> Option<[f64; 2]> {
        let mut all = self.measured_nm();
        if let Some(reading) = &self.fluorescence {
            match &reading.light {
                ExcitationLight::Monochromatic(list) => all.extend(list),
                ExcitationLight::Spectrum(_) => all.extend(EXCITED_NM),
            }
            all.extend(&reading.emission_nm);
        }
        let first = *all.first()?;
        let fold = |[low, high]: [f64; 2], &nm: &f64| [low.min(nm), high.max(nm)];
        Some(all.iter().fold([first; 2], fold))
    }
}

/// The response of a sensor's band.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Its name.
    pub name: String,
    /// Its middle, nm.
    pub centre_nm: f64,
    /// Wavelengths, nm, and weights of sum 1 by which a mean over the response is taken.
    pub nodes: Vec<(f64, f64)>,
}

/// An index of two bands, their difference over their sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Index {
    /// Its name.
    pub name: &'static str,
    /// Numbers of the band that counts and of the one that is taken off.
    pub bands: [usize; 2],
}

/// Incident light in absolute terms, on a level plane.
#[derive(Clone, Debug)]
pub struct Incident {
    /// Its spectrum, relative.
    pub spectrum: Spectrum,
    /// The light whose spectrum that is, index into the lights as the file has them.
    pub light: Option<usize>,
    /// How much there is of it.
    pub amount: Amount,
}

/// How much incident light there is from 400 to 700 nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Irradiance, W m⁻².
    Irradiance(f64),
    /// Photon flux, µmol m⁻² s⁻¹.
    Photons(f64),
}

impl Incident {
    /// First and last wavelength of photosynthetically active light, nm.
    pub const PAR_NM: [f64; 2] = [400.0, 700.0];
    /// From one wavelength to the next at which its absorption is measured, nm.
    pub const STEP_NM: f64 = 10.0;

    /// The wavelengths at which its absorption is measured, nm.
    pub fn nodes_nm() -> impl Iterator<Item = f64> {
        let [first, last] = Self::PAR_NM;
        let steps = ((last - first) / Self::STEP_NM).round() as u32;
        (0..=steps).map(move |i| first + Self::STEP_NM * f64::from(i))
    }
}

/// The kinds of instruments, a closed set.
#[derive(Clone, Debug)]
pub enum InstrumentKind {
    /// An integrating sphere.
    Sphere(Sample),
    /// A goniometer.
    Gonio(Gonio),
    /// Light by depth within a leaf.
    Depth(DepthProfile),
    /// Fluxes of an unbounded canopy.
    Canopy(Canopy),
}

impl InstrumentKind {
    /// Its word in scenes.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Gonio(_) => "gonio",
            Self::Canopy(_) => "canopy",
            Self::Depth(_) => "depth",
        }
    }
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

/// One object, and how it is lit.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The sample, index into [`Description::objects`](super::Description::objects).
    pub object: usize,
    /// The light; angles from the normal of the spot, or of the object's xy plane.
    pub incidence: Incidence,
    /// Whether the adaxial and the abaxial face are lit, one after the other; one at least.
    pub faces: [bool; 2],
    /// The spot that is lit; `None` is the whole object.
    pub spot: Option<Spot>,
    /// Whether absorption is told by constituents of tissue.
    pub constituents: bool,
}

/// A goniometer, which looks at one object from many directions.
#[derive(Clone, Debug)]
pub struct Gonio {
    /// The object and its light.
    pub sample: Sample,
    /// The directions; the same from behind the sample, counted from its other normal.
    pub detector: Detector,
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
    /// Whether absorption is told by constituents of tissue.
    pub constituents: bool,
    /// Whether absorption is told by instances: leaf by leaf.
    pub instances: bool,
    /// Directions from which it is seen; `None` measures fluxes alone.
    pub detector: Option<Detector>,
}

/// A detector far away, in several directions one after the other: all zeniths at all azimuths.
#[derive(Clone, Debug, PartialEq)]
pub struct Detector {
    /// Angles from the normal, rad, rising, each within (-π/2, π/2); a negative one lies on the other
    /// side of the normal.
    pub zeniths: Vec<f64>,
    /// Azimuths from that of the light, rad; at 0 a positive zenith is on the side of the light.
    pub azimuths: Vec<f64>,
    /// Half-angle of the cone about each direction over which figures are means, rad; 0 is the
    /// direction itself. The cone lies above the surface's plane.
    pub half_angle: f64,
    /// How figures are estimated.
    pub estimator: Estimator,
}

/// Light by depth within a leaf of layers that has the contents of an object's tissue.
#[derive(Clone, Debug)]
pub struct DepthProfile {
    /// The object, of tissue, index into
    /// [`Description::objects`](super::Description::objects).
    pub object: usize,
    /// Texture coordinates of the place whose contents are taken; `None` takes the mean.
    pub uv: Option<DVec2>,
    /// The light; angles from the normal of the leaf.
    pub incidence: Incidence,
    /// Whether the adaxial and the abaxial face are lit, one after the other; one at least.
    pub faces: [bool; 2],
    /// Slices of each layer.
    pub slices: usize,
}

impl Detector {
    /// Whether it looks at each surface that scatters light, besides counting what arrives.
    pub fn has_next_events(&self) -> bool {
        self.estimator == Estimator::NextEvent
    }
}

/// How a detector's figures are estimated; both are unbiased.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Estimator {
    /// By what each scattering event sends towards the detector.
    NextEvent,
    /// By counting light that leaves within the detector's cone.
    Count,
}
