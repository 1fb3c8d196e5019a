//! `[leaves.NAME.venation.arcuate]`: veins as splines.

use leafmodel::venation::arcuate::{ArcuatePlan, PalmateVeins};

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;

const SHARES: Limits = Limits::closed(0.0, 1.0);

/// Reads the block; every key may be left out.
pub(super) fn read_arcuate(block: &Block<'_>) -> Option<ArcuatePlan> {
    let usual = ArcuatePlan::default();
    let plan = ArcuatePlan {
        veins: block.integer_or("laterals", 1, 100, usual.veins.into()) as u32,
        seed: block.integer_or("seed", 0, u32::MAX.into(), usual.seed.into()) as u32,
        variation: block.number_or("variation", SHARES, usual.variation),
        width: block.number_or("width", Limits::closed(1e-4, 0.5), usual.width),
        net_width: block.number_or("net_width", SHARES, usual.net_width),
        squish: block.number_or("squish", SHARES, usual.squish),
        squish2: block.number_or("squish2", SHARES, usual.squish2),
        squish3: block.number_or("squish3", SHARES, usual.squish3),
        up: block.number_or("up", Limits::closed(0.0, 2.0), usual.up),
        tip_width: block.number_or("tip_width", SHARES, usual.tip_width),
        palmate: None,
    };
    let is_palmate = block.entry("palmate").is_some();
    let palmate = read_palmate(block);
    block.finish();
    if is_palmate && palmate.is_none() {
        return None;
    }
    Some(ArcuatePlan { palmate, ..plan })
}

/// `None` where the block is left out, or has an error.
fn read_palmate(venation: &Block<'_>) -> Option<PalmateVeins> {
    let block = venation.optional_block("palmate")?;
    let per_side = block.integer("per_side", 1, 12);
    let spread = block.number("spread", Limits::closed(0.05, 1.0));
    let bow = block.number_or("bow", Limits::closed(-0.8, 0.8), 0.0);
    block.finish();
    Some(PalmateVeins {
        per_side: per_side? as u32,
        spread: spread?,
        bow,
    })
}
