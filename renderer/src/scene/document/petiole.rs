//! `[leaves.NAME.petiole]`: the stalk of a simple leaf.

use leafmodel::blade::petiole::PetiolePlan;

use super::limits::Limits;
use super::reader::Block;

/// Radii of stalks, mm.
pub(super) const RADII_MM: Limits = Limits::closed(0.001, 100.0);

/// Reads `petiole` of a leaf; `None` where it is left out, or has an error.
pub(super) fn read_petiole(leaf: &Block<'_>) -> Option<PetiolePlan> {
    let block = leaf.optional_block("petiole")?;
    let length = block.number("length", Limits::closed(0.0, 10.0));
    let radius_mm = block.optional_number("radius_mm", RADII_MM);
    let curl = block.number_or("curl_deg", Limits::closed(-170.0, 170.0), 0.0);
    block.finish();
    Some(PetiolePlan {
        length: length?,
        radius_mm,
        curl: curl.to_radians(),
    })
}
