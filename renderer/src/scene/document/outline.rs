//! `[leaves.NAME.outline.…]`: the margin of a leaf.

mod cubic;
mod curve;
mod growth_algorithm;
mod svg;
mod teeth;
mod transport;

use leafmodel::leaf::outline_plan::{Contour, OutlinePlan, OutlinePlanError};
use leafmodel::shape::outline::Outline;
use leafmodel::transport::TransportError;

pub(crate) use self::transport::STEPS;
use super::reader::Block;
use crate::scene::error::SceneError;

/// The kinds of contour.
const KINDS: [&str; 5] = ["growth_algorithm", "curve", "svg", "cubic", "transport"];

/// An outline that can be grown: its plan, and one of length 1 mm.
#[derive(Debug)]
pub(crate) struct GrownOutline {
    pub(crate) plan: OutlinePlan,
    pub(crate) grown: Outline,
}

/// Reads `outline` of a leaf, and tries it.
pub(crate) fn read_outline(leaf: &Block<'_>, seed: u64) -> Option<GrownOutline> {
    let outline = leaf.block("outline", &KINDS)?;
    let teeth = teeth::read_teeth(&outline);
    let (variant, block) = outline.variant(&KINDS)?;
    let contour = match variant {
        "curve" => curve::read_curve(&block).map(Contour::Curve),
        "svg" => svg::read_svg(&block).map(Contour::Svg),
        "cubic" => Some(Contour::Cubic(cubic::read_cubic(&block))),
        "transport" => transport::read_transport(&block).map(Contour::Transport),
        _ => growth_algorithm::read_growth_form(&block).map(Contour::GrowthAlgorithm),
    };
    let plan = OutlinePlan {
        contour: contour?,
        teeth: teeth?,
    };
    match plan.grow(1.0, seed) {
        Ok(grown) => Some(GrownOutline { plan, grown }),
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
        OutlinePlanError::Cubic(_) => (
            block,
            "angle1_deg",
            "use shorter handles, or angles that lead away from the midrib",
        ),
        OutlinePlanError::Transport(TransportError::OutOfRange { .. }) => {
            (block, "epsilon", "use a lower revenue, or a larger cell")
        }
        OutlinePlanError::Transport(TransportError::TooManyCells { .. }) => (
            block,
            "epsilon",
            "use a lower revenue, a larger alpha, or allow more cells",
        ),
        OutlinePlanError::Transport(
            TransportError::Outline(_) | TransportError::TooFine { .. },
        ) => (block, "epsilon", "let the leaf grow larger"),
        OutlinePlanError::GrowthAlgorithm(error) => {
            growth_algorithm::report(block, error);
            return;
        }
        // Reported where the length is read.
        OutlinePlanError::Length { .. } => (block, "length_mm", "use the length of a leaf"),
    };
    let error = SceneError::Impossible {
        key: key.to_owned(),
        problem: error.to_string(),
        help: help.to_owned(),
    };
    let at = block.node(key).map_or(&block.at, |node| &node.at);
    block.cx.error(at, error);
}
