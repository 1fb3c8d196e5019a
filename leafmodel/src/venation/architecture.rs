//! Vein architecture: which coarse veins a leaf has, in the terms of the Manual of Leaf
//! Architecture.
//!
//! The architecture decides where sources of auxin appear and when; veins still grow towards them.
//! Primaries come first, then secondaries, their agrophic veins, tertiaries and quaternaries: the
//! sources of a vein appear one after another along its course and draw the tip of that vein only.
//! What is left of the blade is filled by the ordinary loop while the lamina grows, so that fine
//! veins stay irregular.
//!
//! - **In**: an [`Architecture`], a blade in segments, base at the origin.
//! - **Out**: the courses of its veins, order by order.
//! - **Always true**: courses of one order start from a vein that was laid out before; the same
//!   plan and seed give the same bits.
//! - **Left out**: veins of order 5 and finer, which the ordinary loop lays out.
//!
//! # Source
//!
//! \[ellis2009\] for terms and classes; the layout is ours.

mod check;
pub(crate) mod course;
pub(crate) mod ends;
mod fan;
pub(crate) mod festoons;
pub(crate) mod ground;
pub(crate) mod margin;
pub(crate) mod primaries;
pub(crate) mod quaternaries;
pub(crate) mod secondaries;
pub(crate) mod tertiaries;
#[cfg(test)]
mod tests;

use crate::document::{Declared, Limits, ListOf, Number, Words};
use crate::random::{Use, uniform};

/// How primary veins run.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum PrimaryPattern {
    /// One primary vein, the midrib.
    Pinnate,
    /// Three or more primaries diverge from one place.
    Actinodromous,
    /// As actinodromous, but the outer lateral primaries part from the innermost one of their side.
    Palinactinodromous,
    /// Three or more primaries run in arches that converge towards the apex.
    Acrodromous,
    /// Many primaries from the base run beside each other and converge at the apex.
    Parallelodromous,
    /// Several primaries turn back at the base and run in wide arches that converge at the apex.
    Campylodromous,
    /// Many equal veins radiate from the base and fork again and again towards the margin.
    Flabellate,
}

/// Angles of lateral primaries.
const ANGLES: ListOf<Number> = ListOf {
    of: Number(Limits::closed(5.0, 175.0)),
    least: 0,
    most: 6,
    wanted: "a list of at most 6 angles",
};

/// The primary veins.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct Primaries {
    /// Primary veins: the midrib only (pinnate), several that diverge from one place
    /// (actinodromous) or from the innermost lateral (palinactinodromous), several in arches that
    /// converge towards the apex (acrodromous), many beside each other (parallelodromous) or in
    /// wide arches that turn back at the base (campylodromous), or many that radiate and fork
    /// (flabellate).
    #[key("primaries", required, word)]
    pub pattern: PrimaryPattern,
    /// Angles between the midrib and the lateral primaries of one side, ascending; for
    /// actinodromous, palinactinodromous and acrodromous leaves. Of flabellate ones the veins at
    /// the base; the last bounds the fan.
    ///
    /// Angles between the midrib and the lateral primaries of one side, ascending; both sides have
    /// the same. None for pinnate, parallelodromous and campylodromous leaves, at most 6. For
    /// flabellate leaves those of the veins at the base; the last bounds the fan.
    #[key("lateral_primary_angles_deg", ANGLES)]
    pub lateral_angles_deg: Vec<f64>,
    /// Lateral primaries a side of parallelodromous and campylodromous leaves.
    #[key("lateral_primaries", 0..=30)]
    pub laterals: u32,
    /// Distance between the veins of flabellate leaves, share of the leaf's length; a vein forks
    /// where it is twice that away from the next.
    #[key("fork_spacing", 0.004..=0.2)]
    pub fork_spacing: f64,
    /// Where lateral primaries part from the midrib, share of its length: 0 is basal, more
    /// suprabasal.
    #[key("part_at", 0.0..=0.3)]
    pub part_at: f64,
}

/// How a secondary vein runs.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum SecondaryCourse {
    /// Without a bend.
    Straight,
    /// Bent evenly towards the apex.
    Arching,
    /// Straight at first, bent towards the apex near the margin.
    Upturned,
}

/// How secondary veins follow one another along the midrib.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum SecondarySpacing {
    /// At even distances.
    Regular,
    /// Farther apart towards the base.
    IncreasingProximally,
    /// Nearer to each other towards the base.
    DecreasingProximally,
}

/// How a secondary vein leaves its primary.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum Attachment {
    /// At its angle at once.
    Excurrent,
    /// Beside the primary at first.
    Decurrent,
}

/// Where a secondary vein ends.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum SecondaryEnding {
    /// In a tooth or lobe.
    Craspedodromous,
    /// In the sinus between two teeth or lobes.
    Sinus,
    /// Joined to the next in an arch, from which a branch runs into a tooth.
    Semicraspedodromous,
    /// Inside the margin, upturned and dwindling, not joined to the next.
    Eucamptodromous,
    /// Joined to the next in an arch.
    Brochidodromous,
    /// The same, with a second row of loops outside the arches.
    Festooned,
}

impl SecondaryEnding {
    /// Whether secondaries join in arches.
    pub(crate) fn has_arches(self) -> bool {
        match self {
            Self::Craspedodromous | Self::Sinus | Self::Eucamptodromous => false,
            Self::Semicraspedodromous | Self::Brochidodromous | Self::Festooned => true,
        }
    }

    /// Whether each secondary runs to a place of its own on the margin.
    pub(crate) fn has_targets(self) -> bool {
        match self {
            Self::Craspedodromous | Self::Sinus => true,
            Self::Semicraspedodromous
            | Self::Eucamptodromous
            | Self::Brochidodromous
            | Self::Festooned => false,
        }
    }
}

/// Which secondaries bear agrophic veins: a comb of two or more veins that leave a basal secondary
/// on its outer side and run beside each other towards the margin.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq, Words)]
pub enum Agrophic {
    /// None of them.
    #[default]
    Absent,
    /// The lowest of each side.
    Simple,
    /// The two lowest of each side.
    Compound,
}

impl Agrophic {
    /// Combs a side.
    pub(crate) fn combs(self) -> usize {
        match self {
            Self::Absent => 0,
            Self::Simple => 1,
            Self::Compound => 2,
        }
    }
}

/// How secondaries of both sides stand to each other.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum Arrangement {
    /// In pairs.
    Opposite,
    /// Those of one side between those of the other.
    Alternate,
}

/// The secondary veins.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct Secondaries {
    /// How many a side of the midrib; lateral primaries bear as many as their length allows at the
    /// same spacing. None where primaries run beside each other or fork.
    #[key("pairs", required, 0..=40)]
    pub pairs: u32,
    /// Angle to the midrib in its lower, middle and upper third.
    #[key("angles_deg", required, 10.0..=120.0)]
    pub angles_deg: [f64; 3],
    /// Where they end: in teeth or lobes (craspedodromous), in the sinuses between them (sinus),
    /// joined in arches with branches into teeth (semicraspedodromous), upturned inside the margin
    /// (eucamptodromous), joined in arches (brochidodromous), the same with a second row of loops
    /// (festooned).
    #[key("ending", required, word)]
    pub ending: SecondaryEnding,
    /// How they leave the primary: at their angle, or beside it at first (decurrent).
    #[key("attachment", word)]
    pub attachment: Attachment,
    /// How they run; upturned ones bend near the margin.
    #[key("course", word)]
    pub course: SecondaryCourse,
    /// How they follow one another; proximally is towards the base.
    #[key("spacing", word)]
    pub spacing: SecondarySpacing,
    /// How both sides stand to each other.
    #[key("arrangement", word)]
    pub arrangement: Arrangement,
    /// Where the lowest and the highest leave the midrib, shares of its length.
    #[key("span", 0.0..=1.0)]
    pub span: [f64; 2],
    /// Distance of arches and of ends without a tooth from the margin, share of the leaf's length.
    #[key("inset", 0.005..=0.2)]
    pub inset: f64,
    /// Shorter veins between two secondaries, on average.
    #[key("intersecondaries", 0.0..=3.0)]
    pub intersecondaries: f64,
    /// Agrophic veins, combs of two or more veins on the outer side of the lowest secondary
    /// (simple) or of the two lowest (compound) of each side; they end as the secondaries do.
    /// Pinnate leaves only: elsewhere the outer secondaries of lateral primaries are such veins.
    #[key("agrophic", word)]
    pub agrophic: Agrophic,
}

/// How tertiary veins run.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum TertiaryCourse {
    /// They join in a net; chance lays them out.
    Reticulate,
    /// Straight across from secondary to secondary.
    OppositePercurrent,
    /// Across with an offset midway.
    AlternatePercurrent,
    /// Across in a wave.
    SinuousPercurrent,
    /// Across with a sharp bend midway that points away from the primary.
    ChevronPercurrent,
}

/// The tertiary veins.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Tertiaries {
    /// How they run: in a net (reticulate), or across from secondary to secondary, straight
    /// (opposite), with an offset (alternate), in a wave (sinuous) or with a sharp bend (chevron).
    #[key("course", word)]
    pub course: TertiaryCourse,
    /// Percurrent only: distance between neighbours, share of the leaf's length.
    #[key("spacing", 0.004..=0.2)]
    pub spacing: f64,
    /// Percurrent only: angle to the secondary that they leave.
    ///
    /// Angle to the secondary that they leave, measured from its direction Percurrent only.
    #[key("angle_deg", 40.0..=140.0)]
    pub angle_deg: f64,
}

/// How quaternary veins run.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum QuaternaryCourse {
    /// They join in a net; chance lays them out.
    Reticulate,
    /// Straight across from tertiary to tertiary.
    OppositePercurrent,
    /// Across with an offset midway.
    AlternatePercurrent,
    /// They branch and end between the tertiaries, joined to neither.
    FreelyRamified,
}

/// The quaternary veins. Unless reticulate, they lie between percurrent tertiaries.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Quaternaries {
    /// How they run: in a net, as chance has it (reticulate), or between percurrent tertiaries:
    /// across from one to the next, straight (opposite) or with an offset (alternate), or branched
    /// and ending between them (freely ramified).
    #[key("course", word)]
    pub course: QuaternaryCourse,
    /// Unless reticulate: distance between neighbours, share of the leaf's length.
    #[key("spacing", 0.002..=0.1)]
    pub spacing: f64,
}

/// The coarse veins of a species.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct Architecture {
    /// Order 1.
    #[key(flat)]
    pub primaries: Primaries,
    /// How far chance moves places, angles and courses.
    #[key("irregularity", 0.0..=1.0)]
    pub irregularity: f64,
    /// Whether a vein runs all along the margin.
    #[key("fimbrial")]
    pub is_fimbrial: bool,
    /// Secondary veins.
    #[key("secondaries", required, block)]
    pub secondaries: Secondaries,
    /// Tertiary veins.
    #[key("tertiaries", block)]
    pub tertiaries: Tertiaries,
    /// Quaternary veins.
    #[key("quaternaries", block)]
    pub quaternaries: Quaternaries,
}

impl Default for Architecture {
    /// A pinnate leaf with eight pairs of secondaries that meet in arches.
    fn default() -> Self {
        Self {
            primaries: Primaries {
                pattern: PrimaryPattern::Pinnate,
                lateral_angles_deg: Vec::new(),
                laterals: 0,
                fork_spacing: 0.02,
                part_at: 0.0,
            },
            secondaries: Secondaries {
                pairs: 8,
                angles_deg: [60.0, 55.0, 45.0],
                course: SecondaryCourse::Arching,
                attachment: Attachment::Excurrent,
                ending: SecondaryEnding::Brochidodromous,
                spacing: SecondarySpacing::Regular,
                arrangement: Arrangement::Alternate,
                span: [0.06, 0.85],
                inset: 0.03,
                intersecondaries: 0.0,
                agrophic: Agrophic::Absent,
            },
            tertiaries: Tertiaries {
                course: TertiaryCourse::AlternatePercurrent,
                spacing: 0.022,
                angle_deg: 90.0,
            },
            quaternaries: Quaternaries {
                course: QuaternaryCourse::Reticulate,
                spacing: 0.012,
            },
            is_fimbrial: false,
            irregularity: 0.3,
        }
    }
}

/// Random numbers of an architecture, each for its order, its vein and what it decides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lots {
    seed: u64,
    strength: f64,
}

impl Lots {
    pub(crate) fn new(seed: u64, strength: f64) -> Self {
        Self { seed, strength }
    }

    /// Uniform in [−1, 1) times the plan's irregularity.
    pub(crate) fn jitter(self, order: u8, vein: u64, what: u64) -> f64 {
        self.strength * (2.0 * self.share(order, vein, what) - 1.0)
    }

    /// Uniform in [−1, 1) times the root of the plan's irregularity: fine veins are looser than
    /// coarse ones.
    pub(crate) fn loose(self, order: u8, vein: u64, what: u64) -> f64 {
        self.strength.sqrt() * (2.0 * self.share(order, vein, what) - 1.0)
    }

    /// Uniform in [0, 1).
    pub(crate) fn share(self, order: u8, vein: u64, what: u64) -> f64 {
        let counter = (u64::from(order) << 56) | (vein << 8) | what;
        uniform(self.seed, Use::Architecture, counter)
    }

    /// −1 or 1.
    pub(crate) fn side(self, order: u8, vein: u64, what: u64) -> f64 {
        if self.share(order, vein, what) < 0.5 {
            -1.0
        } else {
            1.0
        }
    }
}
