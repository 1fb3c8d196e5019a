//! `[leaves.NAME.outline.growth_algorithm]`: a margin that local growth brings forth.

use leafmodel::shape::growth_shape::{GrowthShape, VeinRow};

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;
use crate::scene::document::tree::{Node, Value};
use crate::scene::document::values::{number_at, wrong_type};
use crate::scene::error::SceneError;

const SLOPES: Limits = Limits::closed(-20.0, 20.0);
const POSITIONS: Limits = Limits::closed(0.0, 1.0);
const MOST_VEINS: u64 = 200;

/// Reads the block.
pub(super) fn read_growth_shape(block: &Block<'_>) -> Option<GrowthShape> {
    let rows = block.integer_or("rows", 3, 10_000, 150) as usize;
    let axial_rate = block.number_or("axial_rate", Limits::closed(0.001, 1.0), 0.1);
    let rate_ratio = block.number("rate_ratio", Limits::closed(0.5, 100.0));
    let widest_at = block.number("widest_at", Limits::closed(1e-6, 1.0 - 1e-6));
    let falloff = block.number("falloff", Limits::closed(1e-6, 100.0));
    let lobe_decay = block.number_or("lobe_decay", Limits::closed(0.0, 100.0), 0.0);
    let lobe_exponent = block.number_or("lobe_exponent", Limits::closed(1e-6, 10.0), 2.0);
    let veins = read_veins(block);
    block.finish();
    Some(GrowthShape {
        rows,
        axial_rate,
        rate_ratio: rate_ratio?,
        widest_at: widest_at?,
        falloff: falloff?,
        lobe_decay,
        lobe_exponent,
        veins: veins?,
    })
}

/// The list `veins`, or `vein_count` veins at equal distances, or none.
fn read_veins(block: &Block<'_>) -> Option<Vec<VeinRow>> {
    block.exclude("veins", "vein_count");
    block.exclude("veins", "vein_slope");
    if let Some(node) = block.node("veins") {
        return listed_veins(block, node);
    }
    if block.entry("vein_count").is_none() && block.entry("vein_slope").is_none() {
        return Some(Vec::new());
    }
    let count = block.integer("vein_count", 1, MOST_VEINS);
    let slope = block.number("vein_slope", SLOPES);
    let (count, slope) = (count?, slope?);
    // Half a distance is left at base and tip, as in the paper's lobed leaves.
    let position = |index: u64| (index as f64 + 0.5) / count as f64;
    let vein = |index| VeinRow {
        position: position(index),
        slope,
    };
    Some((0..count).map(vein).collect())
}

fn listed_veins(block: &Block<'_>, node: &Node) -> Option<Vec<VeinRow>> {
    const WANTED: &str = "a list of [position, slope], at most 200";
    let Value::List(list) = &node.value else {
        wrong_type(block.cx, node, "veins", WANTED);
        return None;
    };
    if list.len() as u64 > MOST_VEINS {
        wrong_type(block.cx, node, "veins", WANTED);
        return None;
    }
    let before_this = block.cx.error_count();
    let mut veins: Vec<VeinRow> = Vec::with_capacity(list.len());
    for pair in list {
        let Value::List(numbers) = &pair.value else {
            wrong_type(block.cx, pair, "veins", WANTED);
            continue;
        };
        let [position_node, slope_node] = numbers.as_slice() else {
            wrong_type(block.cx, pair, "veins", WANTED);
            continue;
        };
        let position = number_at(block.cx, position_node, "veins, position", POSITIONS);
        let slope = number_at(block.cx, slope_node, "veins, slope", SLOPES);
        let (Some(position), Some(slope)) = (position, slope) else {
            continue;
        };
        if let Some(last) = veins.last().filter(|last| last.position >= position) {
            let error = SceneError::NotRising {
                key: "vein positions".to_owned(),
                before: last.position,
                after: position,
            };
            block.cx.error(&position_node.at, error);
            break;
        }
        veins.push(VeinRow { position, slope });
    }
    (block.cx.error_count() == before_this).then_some(veins)
}
