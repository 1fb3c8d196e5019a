//! `[leaves.NAME.outline.…]`: the margin of a leaf.

mod curve;
mod growth_algorithm;
mod svg;
mod teeth;

use leafmodel::shape::outline::Outline;
use leafmodel::shape::outline_plan::{Contour, OutlinePlan, OutlinePlanError};

use super::reader::Block;
use crate::scene::error::SceneError;

/// The kinds of contour.
const KINDS: [&str; 3] = ["growth_algorithm", "curve", "svg"];

/// Reads `outline` of a leaf, and tries it: the outline that comes with the plan is one of length 1 mm.
pub(crate) fn read_outline(leaf: &Block<'_>) -> Option<(OutlinePlan, Outline)> {
    let outline = leaf.block("outline", &KINDS)?;
    let teeth = teeth::read_teeth(&outline);
    let (variant, block) = outline.variant(&KINDS)?;
    let contour = match variant {
        "curve" => curve::read_curve(&block).map(Contour::Curve),
        "svg" => svg::read_svg(&block).map(Contour::Svg),
        _ => growth_algorithm::read_growth_shape(&block).map(Contour::GrowthAlgorithm),
    };
    let plan = OutlinePlan {
        contour: contour?,
        teeth: teeth?,
    };
    match plan.grow(1.0) {
        Ok(grown) => Some((plan, grown)),
        Err(error) => {
            report(&outline, &block, &error);
            None
        }
    }
}

/// Reports an outline that each of its numbers allows and that is none all the same, at the key to change.
fn report(outline: &Block<'_>, block: &Block<'_>, error: &OutlinePlanError) {
    let (block, key, help) = match error {
        OutlinePlanError::Teeth(_) => (outline, "teeth", "make the teeth lower, or fewer"),
        OutlinePlanError::Curve(_) => (
            block,
            "points",
            "give the points in order, so that the curve goes around the blade once",
        ),
        OutlinePlanError::SvgEnd { end, .. } => (
            block,
            *end,
            "name a point of the contour by its coordinates in the file, y down",
        ),
        OutlinePlanError::Svg { .. } => (
            block,
            "path",
            "draw one closed curve that does not cross itself",
        ),
        OutlinePlanError::GrowthAlgorithm(_) | OutlinePlanError::Length { .. } => (
            block,
            "veins",
            "put the veins farther apart, with slopes that differ less",
        ),
    };
    let error = SceneError::Impossible {
        key: key.to_owned(),
        problem: error.to_string(),
        help: help.to_owned(),
    };
    let at = block.node(key).map_or(&block.at, |node| &node.at);
    block.cx.error(at, error);
}
