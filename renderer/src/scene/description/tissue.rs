//! What leaves and bodies of tissue have, grown or of a material.

use std::path::PathBuf;

use leafmodel::document::declared::{Declared, Defaults, Words};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{FileOnly, FilePath, Number};
use leafmodel::optics::Contents;
use leafmodel::optics::fluorescence::RED_OVER_FAR_RED;
use leafmodel::optics::solid::{ETA, SCATTERING_PER_MM, Solid as Tissue};
use leafmodel::plan_file::require_prospect;

use crate::plugin::element::Element;
use crate::plugin::spectra::Spectra;
use crate::plugin::surface::{Exported, FACES};
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::scene::blocks::yields;
use crate::spectrum::written::Spectrum;

/// Least and greatest GGX roughness of a coat.
pub(crate) const ALPHA: [f64; 2] = [0.02, 1.0];

/// How light is scattered by a leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub enum LeafOptics {
    /// At its surface, by the leaf BSDF of the plate model.
    #[default]
    Plates,
    /// On its way through five layers, which it may leave beside the place where it entered.
    Layers,
}

/// The two faces of a leaf, grown or of a material.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct LeafFaces {
    /// `plates`: light is scattered at the surface. `layers`, for close-ups: it is followed through cuticle,
    /// epidermis and mesophyll, and may leave beside the place where it entered.
    #[key("optics", word)]
    #[key(with = Self::refuse_ratio_of_layers)]
    pub optics: LeafOptics,
    /// Abaxial over adaxial reflectance. Left out, it follows what the leaf absorbs: near 1 where that is little,
    /// 1.7 where it is nearly all.
    #[key("abaxial_ratio", SpectrumOf::Ratio)]
    pub abaxial_ratio: Option<Spectrum>,
    /// Reflectance of the abaxial face, if it was measured; then there is no ratio.
    pub abaxial_reflectance: Option<Spectrum>,
    /// Coat of the adaxial face.
    #[key("adaxial", block, at = 0, default = COATS)]
    /// Coat of the abaxial face.
    #[key("abaxial", block, at = 1)]
    pub coats: [Coat; 2],
}

/// The rough dielectric coat of one face of a leaf.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Coat {
    /// Refractive index; 1.35 to 1.5 in leaves.
    #[key("eta", 1.0..=2.5)]
    pub eta: f64,
    #[key(with = Self::declare_alpha)]
    /// GGX roughness across the midrib, in place of `alpha`.
    #[key("alpha_across", ALPHA[0]..=ALPHA[1])]
    pub alpha_across: f64,
    /// GGX roughness along the midrib, in place of `alpha`.
    #[key("alpha_along", ALPHA[0]..=ALPHA[1])]
    pub alpha_along: f64,
}

/// The adaxial coat, which is satin, and the abaxial one, which is matt.
const COATS: [Coat; 2] = [Coat::even(1.45, 0.3), Coat::even(1.45, 0.45)];

impl Coat {
    /// The same roughness in all directions.
    pub const fn even(eta: f64, alpha: f64) -> Self {
        Self {
            eta,
            alpha_across: alpha,
            alpha_along: alpha,
        }
    }

    fn declare_alpha(&mut self, keys: &mut Keys<'_>) {
        keys.exclude("alpha", "alpha_across");
        keys.exclude("alpha", "alpha_along");
        let mut alpha = self.alpha_across;
        let about = "GGX roughness in all directions. Glossy 0.1 to 0.2, satin 0.25 to 0.4, matt 0.45 to 0.6 \
            (our estimates; so are the defaults).";
        let limits = Number(Limits::closed(ALPHA[0], ALPHA[1]));
        keys.key("alpha", &mut alpha, limits, about);
        if alpha != self.alpha_across {
            (self.alpha_across, self.alpha_along) = (alpha, alpha);
        }
    }
}

impl LeafFaces {
    fn refuse_ratio_of_layers(&mut self, keys: &mut Keys<'_>) {
        if self.optics == LeafOptics::Layers && keys.has("abaxial_ratio") {
            let problem = "layers have two faces of their own";
            impossible(keys, problem, "leave `abaxial_ratio` out, or `optics`");
        }
    }

    /// Reports that a leaf of layers fluoresces.
    pub(in crate::scene) fn refuse_light_of(&self, own: Option<Fluorescence>, keys: &Keys<'_>) {
        if self.optics == LeafOptics::Layers && own.is_some() {
            let problem = "fluorescence is worked out for plates, not for layers";
            impossible(keys, problem, "leave `fluorescence` out, or `optics`");
        }
    }

    /// Adds them to Mitsuba's plugin of a leaf.
    pub(crate) fn written(&self, bsdf: Element, spectra: &mut Spectra) -> Element {
        let coats = FACES.into_iter().zip(&self.coats);
        let bsdf = coats.fold(bsdf, |bsdf, (face, coat)| {
            bsdf.float(&format!("{face}_eta"), coat.eta)
                .float(&format!("{face}_alpha_across"), coat.alpha_across)
                .float(&format!("{face}_alpha_along"), coat.alpha_along)
        });
        let known = [
            ("abaxial_ratio", &self.abaxial_ratio),
            ("abaxial_reflectance", &self.abaxial_reflectance),
        ];
        let known = known.into_iter();
        let known = known.filter_map(|(name, spectrum)| Some((name, spectrum.as_ref()?)));
        known.fold(bsdf, |bsdf, (name, spectrum)| {
            bsdf.holding(spectra.element(name, spectrum, 1.0))
        })
    }
}

/// Reports what a leaf of layers cannot be.
pub(in crate::scene) fn impossible(keys: &Keys<'_>, problem: &str, help: &str) {
    let error = DocumentError::Impossible {
        key: "optics".to_owned(),
        problem: problem.to_owned(),
        help: help.to_owned(),
    };
    keys.report(&["optics"], error);
}

/// Chlorophyll fluorescence of a leaf.
#[derive(Clone, Copy, Debug, Declared, Defaults, PartialEq)]
pub struct Fluorescence {
    /// Photons emitted for each photon that chlorophyll absorbs.
    #[key(with = quantum_efficiency, default = 0.01)]
    pub quantum_efficiency: f64,
    /// Emission within the leaf at 685 nm over that at 737 nm, in photons: about 2 in leaves, more if photosystem
    /// II emits more of it, as in the dark, and less if photosystem I does.
    #[key("red_over_far_red", 0.2..=50.0, default = RED_OVER_FAR_RED)]
    pub red_over_far_red: f64,
}

fn quantum_efficiency(own: &mut Fluorescence, keys: &mut Keys<'_>) {
    yields::declare(&mut own.quantum_efficiency, keys);
}

impl Fluorescence {
    /// The block of a leaf.
    pub(in crate::scene) fn declare_of(leaf: &mut Option<Self>, keys: &mut Keys<'_>) {
        let about = "Chlorophyll fluorescence; left out, there is none.";
        keys.optional_block("fluorescence", leaf, Self::default, about, Self::declare);
    }
}

/// The optics of solid tissue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidOptics {
    /// Depth, scattering and refractive index, in range.
    pub tissue: Tissue,
    /// The skin's surface, the same in all directions.
    pub coat: Coat,
}

impl Default for SolidOptics {
    fn default() -> Self {
        Self {
            tissue: Tissue {
                depth_mm: 1.0,
                scattering_per_mm: SCATTERING_PER_MM,
                eta: ETA,
            },
            coat: Coat::even(ETA, 0.3),
        }
    }
}

impl Declared for SolidOptics {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let Self { tissue, coat } = self;
        let limits = Number(Limits::closed(0.001, 1000.0));
        let about = "Depth over which the contents are spread.";
        keys.key("depth_mm", &mut tissue.depth_mm, limits, about);
        let about = "µs′: reduced scattering.";
        let scattering = &mut tissue.scattering_per_mm;
        keys.key("scattering_per_mm", scattering, limits, about);
        // By default the skin has the refractive index of the tissue.
        let same = coat.eta == tissue.eta;
        let index = Number(Limits::closed(1.0, 2.0));
        let about = "Refractive index of the tissue.";
        keys.key("eta", &mut tissue.eta, index, about);
        if same {
            coat.eta = tissue.eta;
        }
        keys.block("coat", "The surface of its skin.", |keys| {
            let limits = Number(Limits::closed(1.0, 2.5));
            let about = "Refractive index; left out, that of the tissue.";
            keys.key("eta", &mut coat.eta, limits, about);
            let limits = Number(Limits::closed(ALPHA[0], ALPHA[1]));
            keys.key("alpha", &mut coat.alpha_across, limits, "GGX roughness.");
            coat.alpha_along = coat.alpha_across;
        });
    }
}

impl SolidOptics {
    /// Mitsuba's plugin for solid tissue, grown or of a material.
    pub(crate) fn plugin(&self, extrapolate: bool, surface: &Exported<'_>) -> Element {
        // In `reference/`.
        surface
            .plugin("lamina_solid", extrapolate)
            .float("depth_mm", self.tissue.depth_mm)
            .float("scattering_per_mm", self.tissue.scattering_per_mm)
            .float("eta", self.tissue.eta)
            .float("coat_eta", self.coat.eta)
            .float("coat_alpha", self.coat.alpha_across)
    }
}

/// Contents of tissue per area of its surface.
#[derive(Clone, Debug)]
pub enum Held {
    /// Uniform contents.
    Contents {
        /// The contents.
        contents: Contents,
        /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
        extrapolate: bool,
    },
    /// Contents read from a map: an EXR with a channel for each
    /// [`leafmodel::optics::Constituent`].
    Map {
        /// The map's file, resolved and inside the scene's folder.
        file: PathBuf,
        /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
        extrapolate: bool,
    },
}

/// A map of contents, up to 4 GiB.
const MAP: FileOnly = FileOnly(FilePath::of(
    "the path of an EXR with contents",
    &["exr"],
    4 << 30,
));

impl Default for Held {
    fn default() -> Self {
        Self::Contents {
            contents: Contents::NOTHING,
            extrapolate: false,
        }
    }
}

impl Held {
    /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
    pub fn extrapolates(&self) -> bool {
        match self {
            Self::Contents { extrapolate, .. } | Self::Map { extrapolate, .. } => *extrapolate,
        }
    }

    /// The block `contents`, over the contents that are there without it.
    pub(super) fn declare_contents(
        &mut self,
        mut contents: Contents,
        declare: fn(&mut Contents, &mut Keys<'_>),
        keys: &mut Keys<'_>,
    ) {
        let extrapolate = extrapolate(keys);
        keys.required_block("contents", "What it holds.", &[], |keys| {
            require_prospect(keys);
            declare(&mut contents, keys);
            *self = Self::Contents {
                contents,
                extrapolate,
            };
        });
    }

    /// The block `map`.
    pub(super) fn declare_map(&mut self, keys: &mut Keys<'_>) {
        let extrapolate = extrapolate(keys);
        keys.required_block("map", "A map of what it holds.", &[], |keys| {
            require_prospect(keys);
            let mut file = PathBuf::new();
            let about = "A channel for each of the contents, by its name without the unit, over uv; \
                those that contents may leave out may be absent; the first row of the picture is v = 0.";
            keys.required("file", &mut file, MAP, about);
            *self = Self::Map { file, extrapolate };
        });
    }
}

/// Whether the scene continues tables beyond their ends.
pub(in crate::scene) fn extrapolate(keys: &Keys<'_>) -> bool {
    let block = keys.reader();
    block.is_some_and(|block| block.cx.extrapolate.get())
}
