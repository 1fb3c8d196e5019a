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

pub(crate) mod axis;
mod check;
pub(crate) mod course;
pub(crate) mod ends;
mod error;
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

pub use self::error::ArchitectureError;
use crate::random::{Use, uniform};

/// How primary veins run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// The primary veins.
#[derive(Clone, Debug, PartialEq)]
pub struct Primaries {
    /// How they run.
    pub pattern: PrimaryPattern,
    /// Angles between the midrib and the lateral primaries of one side, degrees, 5 to 175,
    /// ascending; both sides have the same. None for pinnate, parallelodromous and campylodromous
    /// leaves, at most 6. For flabellate leaves those of the veins at the base; the last bounds the
    /// fan.
    pub lateral_angles_deg: Vec<f64>,
    /// Lateral primaries a side of parallelodromous and campylodromous leaves, 1 to 30; else 0.
    pub laterals: u32,
    /// Distance between the veins of flabellate leaves, share of the leaf's length, 0.004 to 0.2;
    /// a vein forks where it is twice that away from the next.
    pub fork_spacing: f64,
    /// Where lateral primaries part from the midrib, share of its length, 0 to 0.3; 0 is basal,
    /// more suprabasal.
    pub part_at: f64,
}

/// How a secondary vein runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SecondaryCourse {
    /// Without a bend.
    Straight,
    /// Bent evenly towards the apex.
    Arching,
    /// Straight at first, bent towards the apex near the margin.
    Upturned,
}

/// How secondary veins follow one another along the midrib.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SecondarySpacing {
    /// At even distances.
    Regular,
    /// Farther apart towards the base.
    IncreasingProximally,
    /// Nearer to each other towards the base.
    DecreasingProximally,
}

/// How a secondary vein leaves its primary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attachment {
    /// At its angle at once.
    Excurrent,
    /// Beside the primary at first.
    Decurrent,
}

/// Where a secondary vein ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Agrophic {
    /// None of them.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// In pairs.
    Opposite,
    /// Those of one side between those of the other.
    Alternate,
}

/// The secondary veins.
#[derive(Clone, Debug, PartialEq)]
pub struct Secondaries {
    /// How many a side of the midrib, 1 to 40, or 0 where there are many primaries. Lateral primaries have as many as their length
    /// allows at the same spacing.
    pub pairs: u32,
    /// Angle to the midrib's direction in its lower, middle and upper third, degrees, 10 to 120.
    pub angles_deg: [f64; 3],
    /// How they run.
    pub course: SecondaryCourse,
    /// How they leave their primary.
    pub attachment: Attachment,
    /// Where they end.
    pub ending: SecondaryEnding,
    /// How they follow one another.
    pub spacing: SecondarySpacing,
    /// How both sides stand to each other.
    pub arrangement: Arrangement,
    /// Where the lowest and the highest depart, shares of the midrib's length, ascending.
    pub span: [f64; 2],
    /// Distance of arches and dwindling ends from the margin, share of the leaf's length, 0.005
    /// to 0.2.
    pub inset: f64,
    /// Intersecondary veins to an intercostal area, 0 to 3.
    pub intersecondaries: f64,
    /// Which of them bear agrophic veins.
    pub agrophic: Agrophic,
}

/// How tertiary veins run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tertiaries {
    /// How they run.
    pub course: TertiaryCourse,
    /// Distance between neighbours, share of the leaf's length, 0.004 to 0.2. Percurrent only.
    pub spacing: f64,
    /// Angle to the secondary that they leave, measured from its direction, degrees, 40 to 140.
    /// Percurrent only.
    pub angle_deg: f64,
}

/// How quaternary veins run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternaries {
    /// How they run.
    pub course: QuaternaryCourse,
    /// Distance between neighbours, share of the leaf's length, 0.002 to 0.1. Unless reticulate.
    pub spacing: f64,
}

/// The coarse veins of a species.
#[derive(Clone, Debug, PartialEq)]
pub struct Architecture {
    /// Order 1.
    pub primaries: Primaries,
    /// Order 2.
    pub secondaries: Secondaries,
    /// Order 3.
    pub tertiaries: Tertiaries,
    /// Order 4.
    pub quaternaries: Quaternaries,
    /// Whether a vein runs all along the margin.
    pub is_fimbrial: bool,
    /// How far chance moves places, angles and courses, 0 to 1.
    pub irregularity: f64,
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
}
