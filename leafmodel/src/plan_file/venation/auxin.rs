//! `venation.closed` and `venation.open`: veins that grow towards auxin.

use super::SHARE;
use super::architecture::{architecture, remedy};
use crate::document::error::DocumentError;
use crate::document::keys::{Keys, Variant};
use crate::document::limits::Limits;
use crate::document::value_kind::{Flag, Integer, ListOf, Number, Numbers, Word};
use crate::plan_file::rates::Rates;
use crate::shape::growth::{GrowthError, RateCurve};
use crate::venation::architecture::Architecture;
use crate::venation::plan::{
    AuxinPlan, FreeEndings, Growth, MarginClearance, Neighbourhood, Pattern, PlanError,
};

/// Kill distance and birth distances.
const DISTANCES: Number = Number(Limits::closed(0.01, 1e4));
/// Darts per segment squared.
const DARTS: Number = Number(Limits::closed(1e-12, 1e3));

/// The keys of both kinds; areoles are there only in closed patterns.
pub(super) fn auxin(plan: &mut AuxinPlan, keys: &mut Keys<'_>, closed: bool) {
    let limits = Number(Limits::closed(2.0, 1e5));
    let about = "Length of the grown leaf; more gives a finer net.";
    keys.required(
        "final_length_segments",
        &mut plan.final_length,
        limits,
        about,
    );
    let about = "d_k: a source is used up when a vein comes nearer.";
    keys.required(
        "kill_distance_segments",
        &mut plan.kill_distance,
        DISTANCES,
        about,
    );
    birth_distances(plan, keys);
    let about = "ρ: tries to place a source per step.";
    keys.required("darts_per_segment2", &mut plan.darts_per_area, DARTS, about);
    let limits = Number(Limits::closed(0.5, 10.0));
    let about = "n: exponent of Murray's law: the parent's radius to this power is the sum of \
        the children's.";
    keys.key("murray_exponent", &mut plan.murray_exponent, limits, about);
    let about = "The same of the finest veins: the exponent changes towards this where veins are a \
        few times as wide as the finest. Left out, it is the same everywhere.";
    let finest = &mut plan.murray_exponent_finest;
    keys.optional("murray_exponent_finest", finest, limits, about);
    let limits = Number(Limits::closed(1e-6, 10.0));
    let about = "Radius of the finest veins.";
    keys.required(
        "veinlet_radius_mm",
        &mut plan.veinlet_radius_mm,
        limits,
        about,
    );
    if closed {
        let mut neighbourhood = match plan.pattern {
            Pattern::Closed(neighbourhood) => neighbourhood,
            Pattern::Open => Neighbourhood::Relative,
        };
        let words = [
            ("relative", Neighbourhood::Relative),
            ("urquhart", Neighbourhood::Urquhart),
            ("bipolar", Neighbourhood::Bipolar),
        ];
        let about = "Closed only: which veins a source draws, its relative neighbours (Eq. 2), \
            Urquhart's approximation of them (section 5.2), or one on either side (bipolar).";
        keys.key("neighbourhood", &mut neighbourhood, Word(&words), about);
        plan.pattern = Pattern::Closed(neighbourhood);
        let limits = Number(Limits::closed(0.0, 1.0));
        let about = "Bipolar only: share of the sources whose veins run along the nearest vein; \
            more makes areoles longer.";
        keys.key("axis_along_vein", &mut plan.axis_along_vein, limits, about);
        let limits = Integer::within(0, 1000);
        let about = "Rounds in which finer veins, each under a tension proportional to its width, \
            move towards balance: they straighten and their angles open.";
        keys.key("tension_rounds", &mut plan.tension_rounds, limits, about);
    }
    let places = ListOf {
        of: Numbers::<2>(Limits::closed(-10.0, 10.0)),
        least: 0,
        most: 1000,
        wanted: "a list of at most 1000 places [x, y]",
    };
    let about = "`[[x, y], …]`: where veins start, in shares of the midrib's length across it \
        and along it; several for parallel veins.";
    keys.key("origins", &mut plan.origins, places, about);
    let about = "Whether straight veins lead from the base to all of them, as where the bundles \
        of a petiole part; then none may lie at the base.";
    keys.key("joined_origins", &mut plan.joined_origins, Flag, about);
    let limits = Number(Limits::closed(0.0, 1e3));
    let about = "Veinlets that each node of a vein of order 1 or 2 bears unseen and is widened \
        for, where tertiary veins are left out (section 3.5).";
    keys.key("unseen_veinlets", &mut plan.unseen_veinlets, limits, about);
    let limits = Number(Limits::closed(-2.0, 8.0));
    let about = "K L²: curvature of the blade times its length squared: above 0 a bowl, below 0 \
        a saddle.";
    keys.key(
        "gaussian_curvature",
        &mut plan.gaussian_curvature,
        limits,
        about,
    );
    rules(plan, keys, closed);
    let names = GROWTH.map(|kind| kind.name);
    let final_length = plan.final_length;
    let about = "How the lamina grows while veins form.";
    keys.required_block("growth", about, &names, |keys| {
        keys.kind(&mut plan.growth, &GROWTH);
        starts_shorter(&plan.growth, keys, final_length);
    });
}

/// Rules that a plan may leave out.
fn rules(plan: &mut AuxinPlan, keys: &mut Keys<'_>, closed: bool) {
    // Only areoles have room for them.
    if closed {
        let new = || FreeEndings {
            birth_distance: 1.0,
            kill_distance: 1.0,
            darts_per_area: 1.0,
        };
        let about = "Veinlets that end freely inside areoles.";
        keys.optional_block(
            "free_endings",
            &mut plan.free_endings,
            new,
            about,
            free_endings,
        );
    }
    if closed {
        let about = "Coarse veins laid out before the lamina grows, in the terms of the Manual of \
            Leaf Architecture.";
        let value = &mut plan.architecture;
        keys.optional_block(
            "architecture",
            value,
            Architecture::default,
            about,
            architecture,
        );
    }
    let new = || MarginClearance {
        distance: 0.1,
        until: 1.0,
        arches: 0,
    };
    let about = "Sources kept off the margin of the young leaf.";
    let clearance = &mut plan.margin_clearance;
    keys.optional_block("margin_clearance", clearance, new, about, margin_clearance);
}

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

fn free_endings(free: &mut FreeEndings, keys: &mut Keys<'_>) {
    let about = "Least distance of its sources from each other and from veins.";
    keys.required(
        "birth_distance_segments",
        &mut free.birth_distance,
        DISTANCES,
        about,
    );
    let about = "A source is used up when a veinlet comes nearer.";
    keys.required(
        "kill_distance_segments",
        &mut free.kill_distance,
        DISTANCES,
        about,
    );
    let about = "Darts thrown at once.";
    keys.required("darts_per_segment2", &mut free.darts_per_area, DARTS, about);
}

fn margin_clearance(clearance: &mut MarginClearance, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(1e-6, 0.5));
    let about = "Least distance of sources from the margin, as a share of the leaf's length at \
        that time.";
    keys.required("distance", &mut clearance.distance, limits, about);
    let about = "Share of the final length at which the rule ends.";
    keys.required("until", &mut clearance.until, SHARE, about);
    let count = Integer::within(0, 50);
    let about = "Closed only: secondary veins a side that are laid out first and joined by \
        arches at that distance from the margin.";
    keys.key("arches", &mut clearance.arches, count, about);
}

/// Lengths at the start.
const INITIAL: Number = Number(Limits::closed(0.001, 1e5));
/// What is added in a step.
const STEPS: Number = Number(Limits::above(0.0, 1e5));

const GROWTH: [Variant<Growth>; 4] = [
    Variant {
        name: "none",
        about: "The lamina has its final size from the start.",
        new: || Growth::None,
        is: |growth| *growth == Growth::None,
        declare: |_, _| {},
    },
    Variant {
        name: "marginal",
        about: "The margin moves outward, tissue inside stays.",
        new: || Growth::Marginal {
            initial_length: 1.0,
            length_step: 1.0,
        },
        is: |growth| matches!(growth, Growth::Marginal { .. }),
        declare: steps,
    },
    Variant {
        name: "isogonic",
        about: "The whole lamina is scaled, veins with it.",
        new: || Growth::Isogonic {
            initial_length: 1.0,
            length_step: 1.0,
        },
        is: |growth| matches!(growth, Growth::Isogonic { .. }),
        declare: steps,
    },
    Variant {
        name: "anisotropic",
        about: "Every part is stretched at rates of its own across and along the leaf.",
        new: || Growth::Anisotropic {
            initial_length: 1.0,
            across: even(),
            along: even(),
        },
        is: |growth| matches!(growth, Growth::Anisotropic { .. }),
        declare: |growth, keys| {
            if let Growth::Anisotropic {
                initial_length,
                across,
                along,
            } = growth
            {
                initial(initial_length, keys);
                let about = "gx: growth across the leaf per step, over the place along it.";
                keys.required("across", across, Rates, about);
                let about = "gy: growth along the leaf per step, likewise.";
                keys.required("along", along, Rates, about);
            }
        },
    },
];

fn even() -> RateCurve {
    RateCurve::new(vec![[0.0, 0.01]]).expect("one knot within all ranges")
}

fn initial(initial_length: &mut f64, keys: &mut Keys<'_>) {
    let about = "Length at the start.";
    keys.required("initial_length_segments", initial_length, INITIAL, about);
}

fn steps(growth: &mut Growth, keys: &mut Keys<'_>) {
    if let Growth::Marginal {
        initial_length,
        length_step,
    }
    | Growth::Isogonic {
        initial_length,
        length_step,
    } = growth
    {
        initial(initial_length, keys);
        let about = "What is added to the length each step.";
        keys.required("length_step_segments", length_step, STEPS, about);
    }
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

/// Reports a plan that cannot be carried out, at the key to change.
pub(super) fn report(keys: &Keys<'_>, error: &PlanError) {
    let index;
    let (path, help): (&[&str], &str) = match error {
        PlanError::OriginOffBlade { index: number, .. } => {
            index = number.to_string();
            (
                &["origins", &index],
                "places are shares of the midrib's length across and along it: [0, 0] is the base, [0, 1] the apex",
            )
        }
        PlanError::TooManySteps { .. } => {
            (&["growth", "*", "length_step_segments"], "use larger steps")
        }
        PlanError::Growth(GrowthError::NeverArrives { .. }) => {
            (&["growth", "*", "along"], "use higher rates along the leaf")
        }
        PlanError::Growth(
            GrowthError::KnotCount { .. }
            | GrowthError::BadPlace { .. }
            | GrowthError::BadRate { .. },
        ) => (&["growth"], "mend the growth functions"),
        PlanError::Architecture(error) => remedy(error),
        PlanError::Incompatible {
            key: "architecture",
            ..
        } => (
            &["architecture"],
            "leave out one of the two; growth may be none, isogonic or anisotropic",
        ),
        PlanError::TooManyDarts { .. } => (
            &["darts_per_segment2"],
            "use fewer darts, or larger segments or steps",
        ),
        PlanError::OriginAtBase => (
            &["origins"],
            "leave out joined_origins, or the place [0, 0]",
        ),
        PlanError::OriginsMeet { .. } => (&["origins"], "veins start from different places"),
        PlanError::YoungLeaf { .. } => (
            &["growth", "*", "across"],
            "let tissue expand: rates above 0 across and along the leaf, of the same kind",
        ),
        PlanError::OutOfRange {
            key: "gaussian_curvature",
            ..
        }
        | PlanError::Incompatible {
            key: "gaussian_curvature",
            ..
        } => (
            &["gaussian_curvature"],
            "use a value nearer to 0, or leave it out",
        ),
        // Ranges of single numbers are checked where they are read, and only closed patterns have
        // `free_endings`.
        PlanError::OutOfRange { .. } | PlanError::Incompatible { .. } => {
            (&[], "change or leave out what the message names")
        }
    };
    let path = [&["venation", "*"], path].concat();
    keys.refuse(&path, error.to_string(), help);
}
