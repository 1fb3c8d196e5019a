//! `[[leaves.NAME.outline.teeth]]`: waves of teeth along a margin.

use leafmodel::shape::teeth::ToothWave;

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;
use crate::scene::document::tree::Value;
use crate::scene::document::values::{wrong_length, wrong_type};

/// Reads the list, which may be left out.
pub(super) fn read_teeth(outline: &Block<'_>) -> Option<Vec<ToothWave>> {
    const WANTED: &str = "a list of at most 20 waves, such as { per_side = 20, height = 0.02 }";
    const SHARE: Limits = Limits::closed(0.0, 1.0);
    let Some(node) = outline.node("teeth") else {
        return Some(Vec::new());
    };
    let Value::List(list) = &node.value else {
        wrong_type(outline.cx, node, "teeth", WANTED);
        return None;
    };
    if list.len() > 20 {
        wrong_length(outline.cx, &node.at, "teeth", "a list", list.len(), WANTED);
        return None;
    }
    let mut waves = Vec::with_capacity(list.len());
    for node in list {
        let Some(table) = node.table() else {
            wrong_type(outline.cx, node, "teeth", WANTED);
            continue;
        };
        let block = Block::new(outline.cx, table, outline.path_of("teeth"), node.at.clone());
        let per_side = block.integer("per_side", 1, 1000);
        let height = block.number("height", Limits::closed(1e-6, 0.5));
        let lean = block.number_or("lean", Limits::closed(-1.0, 1.0), 0.0);
        let fade_base = block.number_or("fade_base", SHARE, 0.0);
        let fade_apex = block.number_or("fade_apex", SHARE, 0.0);
        block.finish();
        if let (Some(per_side), Some(height)) = (per_side, height) {
            waves.push(ToothWave {
                per_side: per_side as u32,
                height,
                lean,
                fade_base,
                fade_apex,
            });
        }
    }
    // A wave with an error is one short.
    (waves.len() == list.len()).then_some(waves)
}
