//! `[leaves.NAME.venation.transport]`: the cheapest transport network that supplies a blade.

use leafmodel::transport::{FilledPlan, TransportError, VeinStyle};

use super::cells::LEAST_CELLS;
use crate::scene::document::limits::Limits;
use crate::scene::document::outline::GrownOutline;
use crate::scene::document::reader::Block;
use crate::scene::error::SceneError;

/// Reads the block. With the outline, it is checked that the grid is not too fine for it.
pub(super) fn read_filled(block: &Block<'_>, outline: Option<&GrownOutline>) -> Option<FilledPlan> {
    let usual = FilledPlan::default();
    let alpha = block.number_or("alpha", Limits::open(0.0, 1.0), usual.alpha);
    let beta = block.number_or("beta", Limits::above(0.0, 20.0), usual.beta);
    let cells_along = block.integer_or("cells_along", 4, 200, usual.cells_along.into()) as u32;
    let base_radius_mm = block.number("base_radius_mm", Limits::closed(1e-4, 100.0));
    let least_cells = block.integer_or("least_cells", 1, 1_000_000, LEAST_CELLS.into()) as u32;
    block.finish();
    let plan = FilledPlan {
        alpha,
        beta,
        cells_along,
        style: VeinStyle {
            base_radius_mm: base_radius_mm?,
            least_cells,
        },
    };
    if let Some(outline) = outline
        && let Err(error @ TransportError::TooFine { .. }) = plan.check(&outline.grown)
    {
        let error = SceneError::Impossible {
            key: "cells_along".to_owned(),
            problem: error.to_string(),
            help: "use fewer cells along the midrib".to_owned(),
        };
        let at = block.node("cells_along").map_or(&block.at, |node| &node.at);
        block.cx.error(at, error);
        return None;
    }
    Some(plan)
}
