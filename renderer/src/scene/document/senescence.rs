//! `[leaves.NAME.senescence]`: how far a leaf has aged.

use leafmodel::blade::senescence::{AgeSource, Senescence};

use super::contents::read_contents;
use super::limits::Limits;
use super::reader::Block;
use crate::scene::error::SceneError;

/// Width of the transition from living to dead where nothing is said.
pub(crate) const BLEND: f64 = 0.08;

/// Reads the block; `None` where it is left out, or has an error. `earns` tells whether the leaf has cells that earn
/// anything, if that is known.
pub(super) fn read_senescence(leaf: &Block<'_>, earns: Option<bool>) -> Option<Senescence> {
    let block = leaf.optional_block("senescence")?;
    let share = block.number("revenue_share", Limits::closed(0.0, 1.0));
    let blend = block.number_or("blend", Limits::closed(0.001, 1.0), BLEND);
    let contents = block
        .block("contents", &[])
        .and_then(|inner| read_contents(&inner));
    block.finish();
    if earns == Some(false) && share.is_some() {
        let error = SceneError::Impossible {
            key: "revenue_share".to_owned(),
            problem: "no cell of this leaf earns any revenue: it is not a transport leaf"
                .to_owned(),
            help: "write [leaves.NAME.outline.transport] or [leaves.NAME.venation.transport], or leave senescence out"
                .to_owned(),
        };
        let at = block
            .node("revenue_share")
            .map_or(&block.at, |node| &node.at);
        block.cx.error(at, error);
        return None;
    }
    Some(Senescence {
        source: AgeSource::Revenue { share: share? },
        blend,
        contents: contents?,
    })
}
