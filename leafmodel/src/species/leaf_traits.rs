//! Traits of each species' mature leaf in summer: sizes, contents and thickness, each number with
//! its source.
//!
//! - **In**: the name of a preset.
//! - **Out**: its [`LeafTraits`]. The preset's plan is made from it, so that documented and grown
//!   numbers agree.
//! - **Always true**: every value lies within its range.
//! - **Left out**: the form of the blade (fold, curl, ruffle, relief), which is all by eye.

pub(super) mod coloured;
mod others;
pub(super) mod sources;
mod trees;

use super::surfaces;
use crate::blade::BladeForm;
use crate::blade::stance::Stance;
use crate::blade::tissue::Tissue;
use crate::blade::vein_body::VeinBody;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::optics::Constituent::{
    Anthocyanins, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
};
use crate::optics::{Contents, Pigments, VeinFactors};
use crate::venation::plan::AuxinPlan;

pub(super) use self::others::{ALCHEMILLA, CROTON, GRASS, IVY, ORCHID, TRILLIUM};
pub(super) use self::trees::{
    ASPEN, BIRCH, CHERRY, COTTONWOOD, GINKGO, MAGNOLIA, MAPLE, POPLAR, RED_OAK, SWEETGUM,
    WHITE_OAK, WILLOW,
};

/// All of them, in the order of the book.
static SPECIES: [&LeafTraits; 18] = [
    &POPLAR,
    &COTTONWOOD,
    &ASPEN,
    &MAPLE,
    &WHITE_OAK,
    &RED_OAK,
    &GINKGO,
    &BIRCH,
    &WILLOW,
    &CHERRY,
    &SWEETGUM,
    &ALCHEMILLA,
    &IVY,
    &MAGNOLIA,
    &GRASS,
    &ORCHID,
    &TRILLIUM,
    &CROTON,
];

/// A publication, by its key in `docs/references.bib`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// Key of the bibliography.
    pub key: &'static str,
    /// What it says, and for which leaves.
    pub says: &'static str,
}

/// Where a number comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Provenance {
    /// The range was measured on leaves of the species; the value is chosen in it.
    Measured(Source),
    /// The range is from a flora of the species; the value is chosen in it.
    Flora(Source),
    /// Computed from another number by a relation that was fitted to leaves of other species.
    Fitted(Source),
    /// The range is close to what was measured on a related species.
    Relative(Source),
    /// A choice by eye. The range is that of a collection of other leaves.
    Estimate(Source),
    /// A choice by eye without a publication; the text gives the reason.
    ByEye(&'static str),
}

/// A number, the range that its provenance allows, and that provenance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// The preset's value.
    pub value: f64,
    /// From least to greatest.
    pub range: [f64; 2],
    /// Provenance of the range.
    pub from: Provenance,
}

/// A range within which a measure of the grown leaf must lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// From least to greatest.
    pub range: [f64; 2],
    /// Provenance of the range.
    pub from: Provenance,
}

/// The form of the blade in space, all by eye.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lie {
    /// Angle by which each half is raised, degrees.
    fold: f64,
    /// Angle through which the midrib bends, degrees.
    curl: f64,
    /// Height of the marginal wave over the length of the leaf, and number of waves per side.
    ruffle: [f64; 2],
    /// Height of veins over their diameter.
    relief: f64,
}

/// How veins differ from the lamina, all by eye.
#[derive(Clone, Copy, Debug, PartialEq)]
struct VeinLook {
    /// Factor on chlorophyll and carotenoids over a fully developed vein.
    pigments: f64,
    /// Radius of a fully developed vein over that of the finest.
    full_over_finest: f64,
    /// Width over which a vein blends into the lamina, over the radius of the finest.
    sheath_over_finest: f64,
}

impl Lie {
    const fn new(fold: f64, curl: f64, ruffle: [f64; 2], relief: f64) -> Self {
        Self {
            fold,
            curl,
            ruffle,
            relief,
        }
    }
}

/// A thin leaf with bundle sheath extensions, whose veins are bright against the light.
const BRIGHT_VEINS: VeinLook = VeinLook {
    pigments: 0.1,
    full_over_finest: 4.0,
    sheath_over_finest: 5.0,
};
/// A thick leaf, in which fine veins are buried.
const BURIED_VEINS: VeinLook = VeinLook {
    pigments: 0.15,
    full_over_finest: 6.0,
    sheath_over_finest: 5.0,
};
/// A leaf without bundle sheath extensions (homobaric).
const HOMOBARIC_VEINS: VeinLook = VeinLook {
    pigments: 0.3,
    full_over_finest: 7.0,
    sheath_over_finest: 4.0,
};

/// The traits of a species' leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafTraits {
    /// Name of the preset.
    pub preset: &'static str,
    /// The species, in Latin, and the part if it is not a whole leaf.
    pub species: &'static str,
    /// Length of the midrib, mm.
    pub length_mm: Quantity,
    /// Greatest width, mm.
    pub width_mm: Span,
    /// Where it is widest, as a share of the midrib from the base.
    pub widest_at: Span,
    /// Thickness between veins, mm.
    pub thickness_mm: Quantity,
    /// Structure of the mesophyll, PROSPECT's `N`.
    pub structure: Quantity,
    /// Chlorophyll a and b, µg/cm².
    pub chlorophyll: Quantity,
    /// Carotenoids, µg/cm².
    pub carotenoids: Quantity,
    /// Anthocyanins, µg/cm².
    pub anthocyanins: Quantity,
    /// Water, cm.
    pub water: Quantity,
    /// Dry matter, g/cm².
    pub dry_matter: Quantity,
    lie: Lie,
    veins: VeinLook,
}

/// The traits of a preset that stands for a species.
pub fn traits(preset: &str) -> Option<&'static LeafTraits> {
    SPECIES
        .iter()
        .copied()
        .find(|traits| traits.preset == preset || is_grown_from(preset, traits.preset))
}

/// Whether a preset is the leaf of a species whose own name is a row of a paper.
fn is_grown_from(preset: &str, species: &str) -> bool {
    let organs = ["-leaf", "-blade", "-petal"];
    let named = organs.iter().find_map(|organ| preset.strip_suffix(organ));
    named == Some(species)
}

/// All species, in the order of the book's table.
#[cfg(test)]
pub(crate) fn all() -> impl Iterator<Item = &'static LeafTraits> {
    SPECIES.iter().copied()
}

impl LeafTraits {
    /// The quantities that go into the plan, with name and unit.
    pub fn quantities(&self) -> [(&'static str, &'static str, Quantity); 8] {
        [
            ("length", "mm", self.length_mm),
            ("thickness", "mm", self.thickness_mm),
            ("structure", "", self.structure),
            ("chlorophyll", "µg/cm²", self.chlorophyll),
            ("carotenoids", "µg/cm²", self.carotenoids),
            ("anthocyanins", "µg/cm²", self.anthocyanins),
            ("water", "cm", self.water),
            ("dry matter", "g/cm²", self.dry_matter),
        ]
    }

    /// Contents of the lamina between veins in summer.
    pub fn contents(&self) -> Contents {
        Contents::of(&[
            (Structure, self.structure.value),
            (Chlorophyll, self.chlorophyll.value),
            (Carotenoids, self.carotenoids.value),
            (Anthocyanins, self.anthocyanins.value),
            (Water, self.water.value),
            (DryMatter, self.dry_matter.value),
        ])
    }

    /// The ranges against which the grown outline is tested, with name and unit.
    pub fn spans(&self) -> [(&'static str, &'static str, Span); 2] {
        [
            ("width", "mm", self.width_mm),
            ("widest at", "", self.widest_at),
        ]
    }

    /// The plan of a leaf of this species with the given outline and venation.
    pub fn plan(&self, seed: u64, outline: OutlinePlan, venation: AuxinPlan) -> LeafPlan {
        let length_mm = self.length_mm.value;
        let finest = venation.veinlet_radius_mm;
        let mut vein_factors = VeinFactors::default();
        vein_factors[Chlorophyll] = self.veins.pigments;
        vein_factors[Carotenoids] = 1.2 * self.veins.pigments;
        LeafPlan {
            length_mm,
            seed,
            outline,
            venation: venation.into(),
            tissue: Tissue {
                lamina: self.contents(),
                vein_factors,
                vein_body: Some(VeinBody::USUAL),
                full_vein_radius_mm: (self.veins.full_over_finest * finest).clamp(0.001, 0.2),
                sheath_width_mm: (self.veins.sheath_over_finest * finest).clamp(0.001, 0.15),
                mottle: 0.1,
                mottle_scale_mm: 1.5,
            },
            unevenness: surfaces::unevenness(self.preset),
            layers: Vec::new(),
            mosaic: None,
            senescence: None,
            surface: surfaces::surface(self.preset),
            hairs: surfaces::hairs(self.preset),
            petiole: None,
            compound: None,
            damage: None,
            form: BladeForm {
                fold: self.lie.fold.to_radians(),
                curl: self.lie.curl.to_radians(),
                ruffle: self.lie.ruffle[0],
                ruffle_waves: self.lie.ruffle[1],
                pleat: 0.0,
                relief: surfaces::meshed_relief(self.preset, self.lie.relief),
                thickness_mm: self.thickness_mm.value,
                margin: crate::blade::MarginThickness::EVEN,
                closed: false,
                max_edge_mm: length_mm / 80.0,
                meshed_vein_radius_mm: 0.12,
            },
            stance: Stance::default(),
            pigments: Pigments::default(),
            map_size: 1600,
        }
    }
}

impl Provenance {
    /// One word for tables, such as `measured`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Measured(_) => "measured",
            Self::Flora(_) => "flora",
            Self::Fitted(_) => "fitted",
            Self::Relative(_) => "relative",
            Self::Estimate(_) => "estimate",
            Self::ByEye(_) => "by eye",
        }
    }

    /// The reason or source in words, with the bibliography key if it is published.
    pub fn words(self) -> String {
        match self {
            Self::Measured(source)
            | Self::Flora(source)
            | Self::Fitted(source)
            | Self::Relative(source)
            | Self::Estimate(source) => format!("{} [{}]", source.says, source.key),
            Self::ByEye(why) => why.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests;
