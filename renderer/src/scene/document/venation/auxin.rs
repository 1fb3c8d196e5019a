//! `[leaves.NAME.venation.closed]` and `open`: veins that grow towards auxin.

use leafmodel::shape::growth::GrowthError;
use leafmodel::shape::outline::Outline;
use leafmodel::venation::plan::{
    AuxinPlan, FreeEndings, MarginClearance, Neighbourhood, Pattern, PlanError,
};
use leafmodel::venation::{self, VenationError};

use super::growth::read_growth;
use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;
use crate::scene::document::tree::{Node, Value};
use crate::scene::document::values::{listed, numbers_at, wrong_length, wrong_type};
use crate::scene::error::SceneError;
use crate::scene::nearest::nearest;

/// Length of the grown leaf, in vein segments.
const FINAL_LENGTHS: Limits = Limits::closed(2.0, 1e5);
/// Kill distance and birth distances, in vein segments.
const DISTANCES: Limits = Limits::closed(0.01, 1e4);
/// Darts per segment squared.
const DARTS: Limits = Limits::closed(1e-12, 1e3);

/// Reads the block. With the outline of a leaf of any length, what needs it is checked too.
pub(super) fn read_auxin(
    block: &Block<'_>,
    closed: bool,
    outline: Option<&Outline>,
) -> Option<AuxinPlan> {
    let defaults = AuxinPlan::default();
    let final_length = block.number("final_length_segments", FINAL_LENGTHS);
    let kill_distance = block.number("kill_distance_segments", DISTANCES);
    let (source_birth, vein_birth) = read_birth_distances(block);
    let darts_per_area = block.number("darts_per_segment2", DARTS);
    let murray_exponent = block.number_or(
        "murray_exponent",
        Limits::closed(0.5, 10.0),
        defaults.murray_exponent,
    );
    let veinlet_radius_mm = block.number("veinlet_radius_mm", Limits::closed(1e-6, 10.0));
    let pattern = if closed {
        read_neighbourhood(block).map(Pattern::Closed)
    } else {
        Some(Pattern::Open)
    };
    let origins = read_origins(block);
    let joined_origins = block.flag_or("joined_origins", false);
    let unseen_veinlets = block.number_or("unseen_veinlets", Limits::closed(0.0, 1e3), 0.0);
    let gaussian_curvature = block.number_or("gaussian_curvature", Limits::closed(-2.0, 8.0), 0.0);
    // Only areoles have room for them.
    let free_endings = closed.then(|| read_free_endings(block)).flatten();
    let margin_clearance = read_margin_clearance(block);
    let growth = read_growth(block, final_length);
    block.finish();
    let plan = AuxinPlan {
        pattern: pattern?,
        origins: origins?,
        final_length: final_length?,
        kill_distance: kill_distance?,
        source_birth_distance: source_birth?,
        vein_birth_distance: vein_birth?,
        darts_per_area: darts_per_area?,
        growth: growth?,
        murray_exponent,
        veinlet_radius_mm: veinlet_radius_mm?,
        joined_origins,
        unseen_veinlets,
        free_endings,
        margin_clearance,
        gaussian_curvature,
    };
    if let Some(outline) = outline
        && let Err(VenationError::Plan(error)) = venation::check(outline, &plan)
    {
        report(block, &error);
        return None;
    }
    Some(plan)
}

/// `bs` and `bv`: one key for both, or one for each.
fn read_birth_distances(block: &Block<'_>) -> (Option<f64>, Option<f64>) {
    const BOTH: &str = "birth_distance_segments";
    const SOURCE: &str = "source_birth_distance_segments";
    const VEIN: &str = "vein_birth_distance_segments";
    if block.entry(SOURCE).is_none() && block.entry(VEIN).is_none() {
        let both = block.number(BOTH, DISTANCES);
        return (both, both);
    }
    block.exclude(BOTH, SOURCE);
    block.exclude(BOTH, VEIN);
    (
        block.number(SOURCE, DISTANCES),
        block.number(VEIN, DISTANCES),
    )
}

fn read_neighbourhood(block: &Block<'_>) -> Option<Neighbourhood> {
    const WORDS: [&str; 2] = ["relative", "urquhart"];
    if block.entry("neighbourhood").is_none() {
        return Some(Neighbourhood::Relative);
    }
    let (word, at) = block.optional_text("neighbourhood")?;
    match word {
        "relative" => Some(Neighbourhood::Relative),
        "urquhart" => Some(Neighbourhood::Urquhart),
        _ => {
            let node = block.node("neighbourhood")?;
            let error = SceneError::UnknownWord {
                key: "neighbourhood".to_owned(),
                word: block.cx.quoted(node).trim_matches('"').to_owned(),
                nearest: nearest(word, WORDS).map(str::to_owned),
                known: listed(WORDS),
            };
            block.cx.error(at, error);
            None
        }
    }
}

/// Places where veins start; none is one at the base.
fn read_origins(block: &Block<'_>) -> Option<Vec<[f64; 2]>> {
    const WANTED: &str = "a list of at most 1000 places [x, y]";
    let Some(node) = block.node("origins") else {
        return Some(Vec::new());
    };
    let Value::List(list) = &node.value else {
        wrong_type(block.cx, node, "origins", WANTED);
        return None;
    };
    if list.len() > 1000 {
        wrong_length(block.cx, &node.at, "origins", "a list", list.len(), WANTED);
        return None;
    }
    let places: Vec<Option<[f64; 2]>> = list
        .iter()
        .map(|node| numbers_at(block.cx, node, "origins", Limits::closed(-10.0, 10.0)))
        .collect();
    places.into_iter().collect()
}

/// `None` where the block is left out, or has an error.
fn read_free_endings(venation: &Block<'_>) -> Option<FreeEndings> {
    let block = venation.optional_block("free_endings")?;
    let birth_distance = block.number("birth_distance_segments", DISTANCES);
    let kill_distance = block.number("kill_distance_segments", DISTANCES);
    let darts_per_area = block.number("darts_per_segment2", DARTS);
    block.finish();
    Some(FreeEndings {
        birth_distance: birth_distance?,
        kill_distance: kill_distance?,
        darts_per_area: darts_per_area?,
    })
}

/// `None` where the block is left out, or has an error.
fn read_margin_clearance(venation: &Block<'_>) -> Option<MarginClearance> {
    let block = venation.optional_block("margin_clearance")?;
    let distance = block.number("distance", Limits::closed(1e-6, 0.5));
    let until = block.number("until", Limits::closed(0.0, 1.0));
    let arches = block.integer_or("arches", 0, 50, 0) as u32;
    block.finish();
    Some(MarginClearance {
        distance: distance?,
        until: until?,
        arches,
    })
}

/// Reports a plan that each of its numbers allows and that cannot be carried out all the same, at the key to change.
fn report(block: &Block<'_>, error: &PlanError) {
    let (keys, help): (&[&str], &str) = match error {
        PlanError::OriginOffBlade { .. } => (
            &["origins"],
            "places are shares of the midrib's length across and along it: [0, 0] is the base, [0, 1] the apex",
        ),
        PlanError::TooManySteps { .. } => (&["growth", "length_step_segments"], "use larger steps"),
        PlanError::Growth(GrowthError::NeverArrives { .. }) => {
            (&["growth", "along"], "use higher rates along the leaf")
        }
        PlanError::Growth(
            GrowthError::KnotCount { .. }
            | GrowthError::BadPlace { .. }
            | GrowthError::BadRate { .. },
        ) => (&["growth"], "mend the growth functions"),
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
            &["growth", "across"],
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
        // Ranges of single numbers are checked where they are read, and only closed patterns have `free_endings`.
        PlanError::OutOfRange { .. } | PlanError::Incompatible { .. } => {
            (&[], "change or leave out what the message names")
        }
    };
    let mut node = keys
        .first()
        .and_then(|key| Some(&block.table.get(key)?.node));
    if let [_, inner] = keys {
        // Behind the kind of growth, of which there is one.
        let kind = node.and_then(|growth| growth.table()?.0.first());
        node = kind
            .and_then(|kind| Some(&kind.node.table()?.get(inner)?.node))
            .or(node);
    }
    if let (
        PlanError::OriginOffBlade { index, .. },
        Some(Node {
            value: Value::List(list),
            ..
        }),
    ) = (error, node)
    {
        node = list.get(*index).or(node);
    }
    let error = SceneError::Impossible {
        key: keys.last().copied().unwrap_or("venation").to_owned(),
        problem: error.to_string(),
        help: help.to_owned(),
    };
    block
        .cx
        .error(node.map_or(&block.at, |node| &node.at), error);
}
