//! Parameters of a venation simulation. Lengths are in vein segments, `D = 1`.

pub(super) mod check;

use glam::DVec2;

use super::architecture::Architecture;
use super::width::WidthLaw;
use crate::document::{
    Declared, DocumentError, Keys, Limits, ListOf, Number, Numbers, Word, Words,
};
use crate::shape::growth::RateCurve;
use crate::shape::rates::Rates;

/// Whether veins may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Veins branch and never meet (section 3).
    Open,
    /// Veins meet and enclose areoles (section 4).
    Closed(Neighbourhood),
}

/// Which vein nodes a source of a closed pattern drives.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
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

/// How the lamina grows while veins form. Lengths are in segments.
#[derive(Clone, Debug, Declared, PartialEq)]
pub enum Growth {
    /// The lamina has its final size from the start.
    None,
    /// The margin moves outward, tissue inside stays.
    ///
    /// `σ` is linear in time.
    Marginal {
        /// Length at the start.
        #[key("initial_length_segments", required, 0.001..=1e5, default = 1.0)]
        initial_length: f64,
        /// What is added to the length each step.
        ///
        /// Growth takes at most 10⁶ steps.
        #[key("length_step_segments", required, above(0.0, 1e5), default = 1.0)]
        length_step: f64,
    },
    /// The whole lamina is scaled, veins with it.
    Isogonic {
        /// Length at the start.
        #[key("initial_length_segments", required, 0.001..=1e5, default = 1.0)]
        initial_length: f64,
        /// What is added to the length each step.
        ///
        /// Growth takes at most 10⁶ steps.
        #[key("length_step_segments", required, above(0.0, 1e5), default = 1.0)]
        length_step: f64,
    },
    /// Every part is stretched at rates of its own across and along the leaf.
    ///
    /// Veins and sources move with it (Appendix A). Ends when the leaf has its final length.
    Anisotropic {
        /// Length at the start.
        #[key("initial_length_segments", required, 0.001..=1e5, default = 1.0)]
        initial_length: f64,
        /// gx: growth across the leaf per step, over the place along it.
        ///
        /// `RERGx = 1 + gx`; places are those at the start.
        #[key("across", required, Rates, default = even())]
        across: RateCurve,
        /// gy: growth along the leaf per step, likewise.
        #[key("along", required, Rates, default = even())]
        along: RateCurve,
    },
}

fn even() -> RateCurve {
    RateCurve::new(vec![[0.0, 0.01]]).expect("one knot within all ranges")
}

/// Free veinlet endings inside areoles: a last round of growth in which veins do not meet.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct FreeEndings {
    /// Least distance of its sources from each other and from veins.
    #[key("birth_distance_segments", required, 0.01..=1e4)]
    pub birth_distance: f64,
    /// A source is used up when a veinlet comes nearer.
    #[key("kill_distance_segments", required, 0.01..=1e4)]
    pub kill_distance: f64,
    /// Darts thrown at once.
    ///
    /// Darts per unit area (square segments), all thrown at once, > 0 up to 1000.
    #[key("darts_per_segment2", required, 1e-12..=1e3)]
    pub darts_per_area: f64,
}

/// Keeps sources away from the margin of the young leaf, and lets secondary veins meet there in
/// arches.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct MarginClearance {
    /// Least distance of sources from the margin, as a share of the leaf's length at that time.
    #[key("distance", required, 1e-6..=0.5)]
    pub distance: f64,
    /// Share of the final length at which the rule ends.
    #[key("until", required, 0.0..=1.0)]
    pub until: f64,
    /// Closed only: secondary veins a side that are laid out first and joined by arches at that
    /// distance from the margin.
    #[key("arches", 0..=50)]
    pub arches: u32,
}

/// Parameters of Runions et al. 2005; the letters are the paper's.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct AuxinPlan {
    /// Length of the grown leaf; more gives a finer net.
    ///
    /// Length of the full-grown leaf in vein segments 000; this sets the length of a segment in mm.
    #[key("final_length_segments", required, 2.0..=1e5)]
    pub final_length: f64,
    /// `dk`, kill distance: a source is used up when a vein is nearer than this, 0.01 to 10 000.
    #[key(
        "kill_distance_segments", required, 0.01..=1e4,
        about = "d_k: a source is used up when a vein comes nearer."
    )]
    pub kill_distance: f64,
    /// `bs`, least distance of a new source from other sources, 0.01 to 10 000.
    #[key(with = birth_distances)]
    pub source_birth_distance: f64,
    /// `bv`, least distance of a new source from vein nodes, 0.01 to 10 000.
    pub vein_birth_distance: f64,
    /// ρ: tries to place a source per step.
    ///
    /// `ρ`, darts per unit area (square segments) and step, > 0 up to 1000.
    #[key("darts_per_segment2", required, 1e-12..=1e3)]
    pub darts_per_area: f64,
    /// n: exponent of Murray's law: the parent's radius to this power is the sum of the children's.
    #[key("murray_exponent", 0.5..=10.0)]
    pub murray_exponent: f64,
    /// The same of the finest veins: the exponent changes towards this where veins are a few times
    /// as wide as the finest. Left out, it is the same everywhere.
    #[key("murray_exponent_finest", 0.5..=10.0)]
    pub murray_exponent_finest: Option<f64>,
    /// Radius of the finest veins.
    #[key("veinlet_radius_mm", required, 1e-6..=10.0)]
    pub veinlet_radius_mm: f64,
    /// Open or closed.
    #[key(with = neighbourhood)]
    pub pattern: Pattern,
    /// Bipolar only: share of the sources whose veins run along the nearest vein; more makes
    /// areoles longer.
    ///
    /// Share of the sources whose axis runs along the nearest vein; more makes areoles longer. Only
    /// for [`Neighbourhood::Bipolar`].
    #[key("axis_along_vein", 0.0..=1.0, when = self.is_closed())]
    pub axis_along_vein: f64,
    /// Rounds in which finer veins, each under a tension proportional to its width, move towards
    /// balance: they straighten and their angles open.
    ///
    /// Rounds in which veins, each under a tension proportional to its width, move towards balance
    /// It straightens them and opens their angles over about as many segments as the root of the
    /// rounds; veins that were laid out stay.
    #[key("tension_rounds", 0..=1000, when = self.is_closed())]
    pub tension_rounds: u32,
    /// `[[x, y], …]`: where veins start, in shares of the midrib's length across it and along it;
    /// several for parallel veins.
    ///
    /// Empty means one node at the base.
    #[key("origins", ORIGINS)]
    pub origins: Vec<[f64; 2]>,
    /// Whether straight veins lead from the base to all of them, as where the bundles of a petiole
    /// part; then none may lie at the base.
    #[key("joined_origins")]
    pub joined_origins: bool,
    /// Veinlets that each node of a vein of order 1 or 2 bears unseen and is widened for, where
    /// tertiary veins are left out (section 3.5).
    #[key("unseen_veinlets", 0.0..=1e3)]
    pub unseen_veinlets: f64,
    /// K L²: curvature of the blade times its length squared: above 0 a bowl, below 0 a saddle.
    ///
    /// `K L²`: Gaussian curvature of the blade times its length squared; 0 is a flat or rolled
    /// blade. Cannot be combined with anisotropic growth. If it is not 0, the outline is that of
    /// the blade's conformal map.
    #[key("gaussian_curvature", -2.0..=8.0)]
    pub gaussian_curvature: f64,
    /// Veinlets that end freely inside areoles.
    #[key("free_endings", block, default = FreeEndings::USUAL, when = self.is_closed())]
    pub free_endings: Option<FreeEndings>,
    /// Coarse veins laid out before the lamina grows, in the terms of the Manual of Leaf
    /// Architecture.
    #[key("architecture", block, when = self.is_closed())]
    pub architecture: Option<Architecture>,
    /// Sources kept off the margin of the young leaf.
    #[key("margin_clearance", block, default = MarginClearance::USUAL)]
    pub margin_clearance: Option<MarginClearance>,
    /// How the lamina grows.
    #[key(with = growth)]
    pub growth: Growth,
}

/// Kill distance and birth distances.
const DISTANCES: Number = Number(Limits::closed(0.01, 1e4));
/// Where veins start.
const ORIGINS: ListOf<Numbers<2>> = ListOf {
    of: Numbers(Limits::closed(-10.0, 10.0)),
    least: 0,
    most: 1000,
    wanted: "a list of at most 1000 places [x, y]",
};

/// `bs` and `bv`: one key for both, or one for each.
fn birth_distances(plan: &mut AuxinPlan, keys: &mut Keys<'_>) {
    const BOTH: &str = "birth_distance_segments";
    const SOURCE: &str = "source_birth_distance_segments";
    const VEIN: &str = "vein_birth_distance_segments";
    let AuxinPlan {
        source_birth_distance: source,
        vein_birth_distance: vein,
        ..
    } = plan;
    let about = [
        "b_s, b_v: least distance of a new source from other sources and from veins.",
        "bs: least distance of a new source from other sources.",
        "bv: least distance of a new source from veins.",
    ];
    if keys.is_description() {
        keys.optional(BOTH, &mut None, DISTANCES, about[0]);
        keys.optional(SOURCE, &mut None, DISTANCES, about[1]);
        keys.optional(VEIN, &mut None, DISTANCES, about[2]);
        keys.group(&[BOTH, SOURCE]);
        return;
    }
    let apart = if keys.reader().is_some() {
        let has_both = keys.has(BOTH);
        keys.has(SOURCE) || keys.has(VEIN) || (source != vein && !has_both)
    } else {
        source != vein
    };
    if apart {
        keys.exclude(BOTH, SOURCE);
        keys.exclude(BOTH, VEIN);
        keys.required(SOURCE, source, DISTANCES, about[1]);
        keys.required(VEIN, vein, DISTANCES, about[2]);
    } else {
        keys.required(BOTH, vein, DISTANCES, about[0]);
        keys.leave(&[SOURCE, VEIN]);
        *source = *vein;
    }
}

/// The neighbourhood of a closed pattern.
fn neighbourhood(plan: &mut AuxinPlan, keys: &mut Keys<'_>) {
    if let Pattern::Closed(neighbourhood) = &mut plan.pattern {
        let about = "Closed only: which veins a source draws, its relative neighbours (Eq. 2), \
            Urquhart's approximation of them (section 5.2), or one on either side (bipolar).";
        keys.key("neighbourhood", neighbourhood, Word(Words::WORDS), about);
    }
}

/// The keys of `growth`.
fn growth(plan: &mut AuxinPlan, keys: &mut Keys<'_>) {
    let final_length = plan.final_length;
    let about = "How the lamina grows while veins form.";
    keys.required_block("growth", about, &Growth::kinds(), |keys| {
        plan.growth.declare(keys);
        starts_shorter(&plan.growth, keys, final_length);
    });
}

/// Reports a leaf that is longer at the start than at the end.
fn starts_shorter(growth: &Growth, keys: &Keys<'_>, final_length: f64) {
    let (Growth::Marginal { initial_length, .. }
    | Growth::Isogonic { initial_length, .. }
    | Growth::Anisotropic { initial_length, .. }) = growth
    else {
        return;
    };
    if keys.is_sound() && *initial_length > final_length {
        let error = DocumentError::OutOfRange {
            key: "initial_length_segments".to_owned(),
            value: initial_length.to_string(),
            range: format!("the values up to `final_length_segments`, {final_length}"),
            help: "a leaf grows: let it start shorter than it ends".to_owned(),
        };
        keys.report(&["*", "initial_length_segments"], error);
    }
}

impl AuxinPlan {
    fn is_closed(&self) -> bool {
        matches!(self.pattern, Pattern::Closed(_))
    }

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
    /// Numbers of which nothing is said.
    const USUAL: Self = Self {
        birth_distance: 1.0,
        kill_distance: 1.0,
        darts_per_area: 1.0,
    };

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

impl MarginClearance {
    /// Numbers of which nothing is said.
    const USUAL: Self = Self {
        distance: 0.1,
        until: 1.0,
        arches: 0,
    };
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

/// The size of the leaf when its veins are laid out, over its full size.
pub(crate) fn young_size(growth: &Growth, final_length: f64) -> f64 {
    match growth {
        Growth::None | Growth::Marginal { .. } => 1.0,
        // The frame of anisotropic growth has one unit, and the leaf starts short in it.
        Growth::Isogonic { initial_length, .. } | Growth::Anisotropic { initial_length, .. } => {
            (initial_length / final_length).min(1.0)
        }
    }
}
