//! `[leaves.NAME.outline.transport]`: a leaf that grows as the cheapest transport network.

use leafmodel::transport::{Ladder, TransportPlan};

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;

/// Equal steps in which the revenue rises where nothing is said.
pub(crate) const STEPS: u32 = 80;

/// Reads the block.
pub(super) fn read_transport(block: &Block<'_>) -> Option<TransportPlan> {
    let usual = TransportPlan::default();
    let alpha = block.number("alpha", Limits::open(0.0, 1.0));
    let beta = block.number("beta", Limits::above(0.0, 20.0));
    let epsilon = block.number("epsilon", Limits::above(0.0, 1e9));
    let cell = block.number_or("cell", Limits::closed(1e-6, 1e6), usual.cell);
    block.exclude("steps", "events");
    let steps = block.integer_or("steps", 1, 10_000, STEPS.into()) as u32;
    let ladder = if block.flag_or("events", false) {
        Ladder::Events
    } else {
        Ladder::Equal(steps)
    };
    let mirrored = block.flag_or("mirrored", usual.mirrored);
    let noise = block.number_or("noise", Limits::below(0.0, 1.0), usual.noise);
    let noise_cells = block.number_or(
        "noise_cells",
        Limits::closed(1.0, 1000.0),
        usual.noise_cells,
    );
    let most_cells = block.integer_or("most_cells", 1, 1_000_000, usual.most_cells as u64) as usize;
    block.finish();
    Some(TransportPlan {
        alpha: alpha?,
        beta: beta?,
        epsilon: epsilon?,
        cell,
        ladder,
        mirrored,
        noise,
        noise_cells,
        most_cells,
    })
}
