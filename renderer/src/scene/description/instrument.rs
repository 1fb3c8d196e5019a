//! Instruments that measure how a scene scatters and absorbs light: `[instruments.NAME.…]`.

mod bands;
mod canopy;
mod depth;
mod detector;
mod fluorescence;
mod incidence;
pub(in crate::scene) mod incident;
mod sample;
mod wavelengths;

use leafmodel::document::declared::Declared;
use leafmodel::document::value_kind::Flag;
use leafmodel::document::{Keys, Variant};
use leafmodel::optics::fluorescence::EXCITED_NM;

pub use self::bands::{Index, Response};
pub use self::canopy::Canopy;
pub use self::depth::DepthProfile;
pub use self::detector::{Detector, Estimator};
pub use self::fluorescence::{ExcitationLight, FluorescenceReading};
pub use self::incidence::Incidence;
pub use self::incident::{Amount, Incident};
pub use self::sample::{Gonio, Sample, Spot, SpotMiddle};

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

const KINDS: [Variant<Instrument>; 4] = [
    Variant {
        name: "sphere",
        about: "An integrating sphere: reflectance, transmittance and absorptance of an object.",
        new: Instrument::default,
        is: |own| matches!(own.kind, InstrumentKind::Sphere(_)),
        declare: Instrument::declare_kind,
    },
    Variant {
        name: "gonio",
        about: "A goniometer: BRDF, BTDF and reflectance factors of an object by direction.",
        new: || Instrument::of(InstrumentKind::Gonio(Gonio::default())),
        is: |own| matches!(own.kind, InstrumentKind::Gonio(_)),
        declare: Instrument::declare_kind,
    },
    Variant {
        name: "canopy",
        about: "Fluxes of a canopy that repeats itself without end along x and y.",
        new: || Instrument::of(InstrumentKind::Canopy(Canopy::default())),
        is: |own| matches!(own.kind, InstrumentKind::Canopy(_)),
        declare: Instrument::declare_kind,
    },
    Variant {
        name: "depth",
        about: "Light by depth within a leaf of layers.",
        new: || Instrument::of(InstrumentKind::Depth(DepthProfile::default())),
        is: |own| matches!(own.kind, InstrumentKind::Depth(_)),
        declare: Instrument::declare_kind,
    },
];

impl Default for Instrument {
    fn default() -> Self {
        Self::of(InstrumentKind::Sphere(Sample::default()))
    }
}

impl Declared for Instrument {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        keys.kind(self, &KINDS);
        // The kind makes a new one, so the place comes last.
        if let Some(block) = keys.reader() {
            self.at = block.cx.shown(&block.at);
        }
    }
}

impl Instrument {
    /// One of the kind with all defaults.
    fn of(kind: InstrumentKind) -> Self {
        Self {
            at: String::new(),
            wavelengths_nm: wavelengths::usual(),
            bands: Vec::new(),
            indices: Vec::new(),
            incident: None,
            kind,
            fluorescence: None,
        }
    }

    /// The word for its kind.
    pub fn word(&self) -> &'static str {
        let own = KINDS.iter().find(|kind| (kind.is)(self));
        own.map_or("", |kind| kind.name)
    }

    /// Independent draws of what is scattered over which its figures are means.
    pub fn realisations(&self) -> u32 {
        match &self.kind {
            InstrumentKind::Canopy(canopy) => canopy.realisations,
            InstrumentKind::Sphere(_) | InstrumentKind::Gonio(_) | InstrumentKind::Depth(_) => 1,
        }
    }

    fn declare_kind(&mut self, keys: &mut Keys<'_>) {
        wavelengths::declare(&mut self.wavelengths_nm, keys, |keys| {
            bands::declare(&mut self.bands, &mut self.indices, keys);
            !self.bands.is_empty()
        });
        match &mut self.kind {
            InstrumentKind::Sphere(sample) => {
                sample.declare(keys);
                keys.key(
                    "constituents",
                    &mut sample.constituents,
                    Flag,
                    canopy::BY_CONSTITUENT,
                );
            }
            InstrumentKind::Canopy(canopy) => canopy.declare(keys),
            InstrumentKind::Gonio(gonio) => return gonio.declare(keys),
            InstrumentKind::Depth(depth) => return depth.declare(keys),
        }
        let about = "How much light there is on a level plane, for absorbed photons.";
        let new = Incident::default;
        keys.optional_block(
            "incident",
            &mut self.incident,
            new,
            about,
            Incident::declare,
        );
        let about = "What leaves that fluoresce emit, besides the figures of this instrument.";
        let new = FluorescenceReading::default;
        let declare = FluorescenceReading::declare;
        keys.optional_block("fluorescence", &mut self.fluorescence, new, about, declare);
    }

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
