//! Parameters of a venation simulation. Lengths are in vein segments, `D = 1`.

mod check;

use glam::DVec2;

pub use self::check::PlanError;
use super::architecture::Architecture;
use super::width::WidthLaw;
use crate::shape::growth::RateCurve;

/// Whether veins may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Veins branch and never meet (section 3).
    Open,
    /// Veins meet and enclose areoles (section 4).
    Closed(Neighbourhood),
}

/// Which vein nodes a source of a closed pattern drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbourhood {
    /// Its relative neighbours, exactly (Eq. 2).
    Relative,
    /// Those of its Delaunay neighbours that no other Delaunay neighbour excludes: Urquhart's
    /// approximation (section 5.2).
    Urquhart,
    /// The nearest node on either side along an axis of its own, so that new veins cross areoles
    /// from side to side. Not in the paper.
    Bipolar,
}

/// How the lamina grows while veins form.
#[derive(Clone, Debug, PartialEq)]
pub enum Growth {
    /// The lamina has its final size from the start.
    None,
    /// The margin moves outward, tissue inside stays where it is; `σ` is linear in time.
    Marginal {
        /// Length of the leaf at the start, in segments, > 0 up to the final length.
        initial_length: f64,
        /// Growth in length per step, in segments, > 0; growth takes at most 10⁶ steps.
        length_step: f64,
    },
    /// The whole lamina is scaled, veins and sources with it.
    Isogonic {
        /// Length of the leaf at the start, in segments, > 0 up to the final length.
        initial_length: f64,
        /// Growth in length per step, in segments, > 0; growth takes at most 10⁶ steps.
        length_step: f64,
    },
    /// Tissue is stretched at local rates that differ across and along the leaf; veins and sources
    /// move with it (Appendix A). Ends when the leaf has its final length.
    Anisotropic {
        /// Length of the leaf at the start, in segments, > 0, below the final length.
        initial_length: f64,
        /// `gx`, growth across the leaf per step as a function of where tissue lies at the start;
        /// `RERGx = 1 + gx`.
        across: RateCurve,
        /// `gy`, growth along the leaf per step, likewise.
        along: RateCurve,
    },
}

/// Free veinlet endings inside areoles: a last round of growth in which veins do not meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeEndings {
    /// Least distance of its sources from each other and from veins, in segments, 0.01 to 10 000.
    pub birth_distance: f64,
    /// A source is used up when a veinlet is nearer than this, in segments, 0.01 to 10 000.
    pub kill_distance: f64,
    /// Darts per unit area (square segments), all thrown at once, > 0 up to 1000.
    pub darts_per_area: f64,
}

/// Keeps sources away from the margin of the young leaf, and lets secondary veins meet there in
/// arches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarginClearance {
    /// Least distance of sources from the margin as a share of the leaf's length, > 0 up to 0.5.
    pub distance: f64,
    /// The rule holds until the leaf has this share of its final length, 0 to 1.
    pub until: f64,
    /// Number of secondary veins per side, 0 to 50, that are laid out before the lamina grows and
    /// joined by arches at that distance from the margin. With 0 all veins come from random
    /// sources. Needs a closed pattern.
    pub arches: u32,
}

/// Parameters of Runions et al. 2005; the letters are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct AuxinPlan {
    /// Open or closed.
    pub pattern: Pattern,
    /// Where veins start, as shares of the midrib's length: across it (to the right) and along it
    /// from the base. At most 1000. Empty means one node at the base.
    pub origins: Vec<[f64; 2]>,
    /// Whether straight veins lead from the base to all origins, as where the vascular bundles of a
    /// petiole separate. If so, no origin may lie at the base.
    pub joined_origins: bool,
    /// Length of the full-grown leaf in vein segments, 2 to 100 000; this sets the length of a
    /// segment in mm.
    pub final_length: f64,
    /// `dk`, kill distance: a source is used up when a vein is nearer than this, 0.01 to 10 000.
    pub kill_distance: f64,
    /// Share of the sources whose axis runs along the nearest vein, 0 to 1; more makes areoles
    /// longer. Only for [`Neighbourhood::Bipolar`].
    pub axis_along_vein: f64,
    /// Rounds in which veins, each under a tension proportional to its width, move towards
    /// balance, 0 to 1000. It straightens them and opens their angles over about as many segments
    /// as the root of the rounds; veins that were laid out stay.
    pub tension_rounds: u32,
    /// `bs`, least distance of a new source from other sources, 0.01 to 10 000.
    pub source_birth_distance: f64,
    /// `bv`, least distance of a new source from vein nodes, 0.01 to 10 000.
    pub vein_birth_distance: f64,
    /// `ρ`, darts per unit area (square segments) and step, > 0 up to 1000.
    pub darts_per_area: f64,
    /// How the lamina grows.
    pub growth: Growth,
    /// Murray's exponent `n`, 0.5 to 10; 2 in most of the paper's leaves, 3 in Murray's law.
    pub murray_exponent: f64,
    /// Murray's exponent of the finest veins, 0.5 to 10: the exponent changes towards this where
    /// veins are a few times as wide as the finest. Without it, it is the same everywhere.
    pub murray_exponent_finest: Option<f64>,
    /// Radius of the finest veins in mm, 10⁻⁶ to 10.
    pub veinlet_radius_mm: f64,
    /// Number of unmodelled veinlets at each node of a vein of order 1 or 2, which widen the vein,
    /// 0 to 1000. For plans without a detailed pattern of tertiary veins (section 3.5).
    pub unseen_veinlets: f64,
    /// Free veinlet endings. Needs a closed pattern.
    pub free_endings: Option<FreeEndings>,
    /// Coarse veins that are laid out before the lamina grows. Needs a closed pattern.
    pub architecture: Option<Architecture>,
    /// Sources kept away from the margin at first, and arches.
    pub margin_clearance: Option<MarginClearance>,
    /// `K L²`: Gaussian curvature of the blade times its length squared, −2 to 8; 0 is a flat or
    /// rolled blade. Cannot be combined with anisotropic growth. If it is not 0, the outline is
    /// that of the blade's conformal map.
    pub gaussian_curvature: f64,
}

impl AuxinPlan {
    /// How wide veins are for what they carry.
    pub(crate) fn width_law(&self) -> WidthLaw {
        WidthLaw {
            coarse: self.murray_exponent,
            finest: self.murray_exponent_finest.unwrap_or(self.murray_exponent),
        }
    }

    /// Where veins start, in segments, base at the origin.
    pub(crate) fn origins_in_segments(&self) -> Vec<DVec2> {
        if self.origins.is_empty() {
            return vec![DVec2::ZERO];
        }
        let place = |&[x, y]: &[f64; 2]| DVec2::new(x, y) * self.final_length;
        self.origins.iter().map(place).collect()
    }
}

impl FreeEndings {
    /// The plan of the last round: an open pattern on the full-grown leaf.
    pub(crate) fn as_plan(&self, plan: &AuxinPlan) -> AuxinPlan {
        AuxinPlan {
            pattern: Pattern::Open,
            kill_distance: self.kill_distance,
            source_birth_distance: self.birth_distance,
            vein_birth_distance: self.birth_distance,
            growth: Growth::None,
            free_endings: None,
            margin_clearance: None,
            ..plan.clone()
        }
    }
}

impl Default for AuxinPlan {
    /// A closed pattern on a leaf of 350 segments that grows isogonically: the paper's poplar at
    /// ten units of Table 1 per segment.
    fn default() -> Self {
        Self {
            pattern: Pattern::Closed(Neighbourhood::Relative),
            origins: Vec::new(),
            joined_origins: false,
            final_length: 350.0,
            kill_distance: 1.0,
            axis_along_vein: 0.0,
            tension_rounds: 0,
            source_birth_distance: 2.0,
            vein_birth_distance: 2.0,
            darts_per_area: 200e-6,
            growth: Growth::Isogonic {
                initial_length: 11.5,
                length_step: 0.9,
            },
            murray_exponent: 2.0,
            murray_exponent_finest: None,
            veinlet_radius_mm: 0.02,
            unseen_veinlets: 0.0,
            free_endings: None,
            architecture: None,
            margin_clearance: None,
            gaussian_curvature: 0.0,
        }
    }
}
