//! `[leaves.NAME.venation.…]`: how the veins of a leaf are grown.

use leafmodel::venation::plan::{Growth, Neighbourhood, Pattern, VenationPlan};

use super::limits::Limits;
use super::reader::Block;
use crate::scene::error::SceneError;

/// Lengths in vein segments. A leaf this long has some hundred million nodes.
const SEGMENTS: Limits = Limits::above(0.0, 20_000.0);

/// Reads `venation` of a leaf.
pub(crate) fn read_venation(leaf: &Block<'_>) -> Option<VenationPlan> {
    let venation = leaf.block("venation", &["closed", "open"])?;
    let (variant, block) = venation.variant(&["closed", "open"])?;
    let final_length = block.number("final_length_segments", Limits::closed(2.0, 20_000.0));
    let kill_distance = block.number("kill_distance_segments", SEGMENTS);
    let (source_birth, vein_birth) = read_birth_distances(&block);
    let darts_per_area = block.number("darts_per_segment2", Limits::above(0.0, 1e4));
    let murray_exponent = block.number_or("murray_exponent", Limits::closed(0.5, 10.0), 2.0);
    let veinlet_radius_mm = block.number("veinlet_radius_mm", Limits::above(0.0, 10.0));
    let growth = read_growth(&block, final_length);
    block.finish();
    Some(VenationPlan {
        pattern: if variant == "closed" {
            Pattern::Closed(Neighbourhood::Relative)
        } else {
            Pattern::Open
        },
        final_length: final_length?,
        kill_distance: kill_distance?,
        source_birth_distance: source_birth?,
        vein_birth_distance: vein_birth?,
        darts_per_area: darts_per_area?,
        growth: growth?,
        murray_exponent,
        veinlet_radius_mm: veinlet_radius_mm?,
        ..VenationPlan::default()
    })
}

/// `bs` and `bv`: one key for both, or one for each.
fn read_birth_distances(block: &Block<'_>) -> (Option<f64>, Option<f64>) {
    const BOTH: &str = "birth_distance_segments";
    const SOURCE: &str = "source_birth_distance_segments";
    const VEIN: &str = "vein_birth_distance_segments";
    if block.entry(SOURCE).is_none() && block.entry(VEIN).is_none() {
        let both = block.number(BOTH, SEGMENTS);
        return (both, both);
    }
    block.exclude(BOTH, SOURCE);
    block.exclude(BOTH, VEIN);
    (block.number(SOURCE, SEGMENTS), block.number(VEIN, SEGMENTS))
}

fn read_growth(block: &Block<'_>, final_length: Option<f64>) -> Option<Growth> {
    let growth = block.block("growth", &["none", "marginal", "isogonic"])?;
    let (variant, inner) = growth.variant(&["none", "marginal", "isogonic"])?;
    if variant == "none" {
        inner.finish();
        return Some(Growth::None);
    }
    let initial = inner.number("initial_length_segments", SEGMENTS);
    let length_step = inner.number("length_step_segments", SEGMENTS);
    inner.finish();
    let (initial_length, length_step) = (initial?, length_step?);
    if let Some(final_length) = final_length
        && initial_length > final_length
    {
        let node = inner.node("initial_length_segments");
        let error = SceneError::OutOfRange {
            key: "initial_length_segments".to_owned(),
            value: node.map_or_else(String::new, |node| block.cx.quoted(node)),
            range: format!("the values up to `final_length_segments`, {final_length}"),
            help: "a leaf grows: let it start shorter than it ends".to_owned(),
        };
        block
            .cx
            .error(node.map_or(&inner.at, |node| &node.at), error);
        return None;
    }
    Some(if variant == "marginal" {
        Growth::Marginal {
            initial_length,
            length_step,
        }
    } else {
        Growth::Isogonic {
            initial_length,
            length_step,
        }
    })
}
