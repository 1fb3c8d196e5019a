//! `[leaves.NAME.outline.cubic]`: a margin of two cubic splines.

use leafmodel::shape::cubic_margin::CubicMargin;

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;

/// Reads the block; every key may be left out.
pub(super) fn read_cubic(block: &Block<'_>) -> CubicMargin {
    const ANGLES: Limits = Limits::open(0.0, 180.0);
    const LENGTHS: Limits = Limits::closed(0.01, 10.0);
    let usual = CubicMargin::default();
    let margin = CubicMargin {
        angle1_deg: block.number_or("angle1_deg", ANGLES, usual.angle1_deg),
        length1: block.number_or("length1", LENGTHS, usual.length1),
        angle2_deg: block.number_or("angle2_deg", ANGLES, usual.angle2_deg),
        length2: block.number_or("length2", LENGTHS, usual.length2),
    };
    block.finish();
    margin
}
