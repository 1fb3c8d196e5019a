//! `[leaves.NAME.venation.…]`: how the veins of a leaf come to be.

mod arcuate;
mod auxin;
mod cells;
mod growth;
mod transport;

use leafmodel::leaf::outline_plan::Contour;
use leafmodel::leaf::venation_plan::VenationPlan;

pub(crate) use self::cells::LEAST_CELLS;
pub(crate) use self::growth::read_rates;
use super::outline::GrownOutline;
use super::reader::Block;
use crate::scene::error::SceneError;

/// The kinds of venation.
const KINDS: [&str; 5] = ["closed", "open", "arcuate", "cells", "transport"];

/// Reads `venation` of a leaf. With the outline of a leaf of any length, what needs it is checked too.
pub(crate) fn read_venation(
    leaf: &Block<'_>,
    outline: Option<&GrownOutline>,
) -> Option<VenationPlan> {
    let venation = leaf.block("venation", &KINDS)?;
    let (variant, block) = venation.variant(&KINDS)?;
    match variant {
        "arcuate" => arcuate::read_arcuate(&block).map(VenationPlan::Arcuate),
        "transport" => transport::read_filled(&block, outline).map(VenationPlan::Transport),
        "cells" => {
            let style = cells::read_vein_style(&block);
            if let Some(outline) = outline
                && !matches!(outline.plan.contour, Contour::Transport(_))
            {
                let error = SceneError::Impossible {
                    key: "cells".to_owned(),
                    problem: "the outline has no cells: it is not that of a transport leaf"
                        .to_owned(),
                    help: "write [leaves.NAME.outline.transport], or choose another venation"
                        .to_owned(),
                };
                block.cx.error(&block.at, error);
                return None;
            }
            style.map(VenationPlan::Cells)
        }
        _ => {
            let outline = outline.map(|outline| &outline.grown);
            auxin::read_auxin(&block, variant == "closed", outline).map(VenationPlan::Auxin)
        }
    }
}
