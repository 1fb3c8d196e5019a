//! `[leaves.NAME.venation.cells]`: the transport network of a transport leaf.

use leafmodel::transport::VeinStyle;

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;

/// Veins that supply fewer cells are left out where nothing is said.
pub(crate) const LEAST_CELLS: u32 = 3;

/// Reads the block.
pub(super) fn read_vein_style(block: &Block<'_>) -> Option<VeinStyle> {
    let base_radius_mm = block.number("base_radius_mm", Limits::closed(1e-4, 100.0));
    let least_cells = block.integer_or("least_cells", 1, 1_000_000, LEAST_CELLS.into()) as u32;
    block.finish();
    Some(VeinStyle {
        base_radius_mm: base_radius_mm?,
        least_cells,
    })
}
