//! `[leaves.NAME.venation.KIND.growth.…]`: how the lamina grows while veins form.

use leafmodel::shape::growth::RateCurve;
use leafmodel::venation::plan::Growth;

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;
use crate::scene::document::tree::Value;
use crate::scene::document::values::{number_at, wrong_length, wrong_type};
use crate::scene::error::SceneError;

const KINDS: [&str; 4] = ["none", "marginal", "isogonic", "anisotropic"];
/// Lengths at the start, in segments.
const LENGTHS: Limits = Limits::closed(0.001, 1e5);
/// What is added in a step, in segments.
const STEPS: Limits = Limits::above(0.0, 1e5);

/// Reads `growth` of a venation whose leaf gets `final_length` segments long.
pub(super) fn read_growth(venation: &Block<'_>, final_length: Option<f64>) -> Option<Growth> {
    let growth = venation.block("growth", &KINDS)?;
    let (variant, block) = growth.variant(&KINDS)?;
    if variant == "none" {
        block.finish();
        return Some(Growth::None);
    }
    let initial = block.number("initial_length_segments", LENGTHS);
    let growth = if variant == "anisotropic" {
        let across = read_rates(&block, "across");
        let along = read_rates(&block, "along");
        block.finish();
        Growth::Anisotropic {
            initial_length: initial?,
            across: across?,
            along: along?,
        }
    } else {
        let length_step = block.number("length_step_segments", STEPS);
        block.finish();
        let (initial_length, length_step) = (initial?, length_step?);
        if variant == "marginal" {
            Growth::Marginal {
                initial_length,
                length_step,
            }
        } else {
            Growth::Isogonic {
                initial_length,
                length_step,
            }
        }
    };
    starts_shorter(&block, initial?, final_length?).then_some(growth)
}

/// Reports a leaf that is longer at the start than at the end.
fn starts_shorter(block: &Block<'_>, initial_length: f64, final_length: f64) -> bool {
    let shorter = initial_length <= final_length;
    if !shorter && let Some(node) = block.node("initial_length_segments") {
        let error = SceneError::OutOfRange {
            key: "initial_length_segments".to_owned(),
            value: block.cx.quoted(node),
            range: format!("the values up to `final_length_segments`, {final_length}"),
            help: "a leaf grows: let it start shorter than it ends".to_owned(),
        };
        block.cx.error(&node.at, error);
    }
    shorter
}

/// A growth function: `[[place, rate], …]`.
pub(crate) fn read_rates(block: &Block<'_>, key: &'static str) -> Option<RateCurve> {
    const WANTED: &str = "a list of 1 to 1000 pairs [place, rate]";
    const PLACES: Limits = Limits::closed(0.0, 1.0);
    // At -1 tissue would shrink to nothing in one step.
    const RATES: Limits = Limits::above(-1.0, 1.0);
    let node = block.needed(key, || format!("`{key} = [[0, …], [1, …]]`, {WANTED}"))?;
    let Value::List(list) = &node.value else {
        wrong_type(block.cx, node, key, WANTED);
        return None;
    };
    if !(1..=1000).contains(&list.len()) {
        wrong_length(block.cx, &node.at, key, "a list", list.len(), WANTED);
        return None;
    }
    let before_this = block.cx.error_count();
    let mut knots: Vec<[f64; 2]> = Vec::with_capacity(list.len());
    for pair in list {
        let Value::List(numbers) = &pair.value else {
            wrong_type(block.cx, pair, key, "a pair [place, rate]");
            continue;
        };
        let [place_node, rate_node] = numbers.as_slice() else {
            wrong_type(block.cx, pair, key, "a pair [place, rate]");
            continue;
        };
        let place = number_at(block.cx, place_node, &format!("{key}, place"), PLACES);
        let rate = number_at(block.cx, rate_node, &format!("{key}, rate"), RATES);
        let (Some(place), Some(rate)) = (place, rate) else {
            continue;
        };
        if let Some([last, _]) = knots.last().copied().filter(|[last, _]| *last >= place) {
            let error = SceneError::NotRising {
                key: format!("{key}, place"),
                before: last,
                after: place,
            };
            block.cx.error(&place_node.at, error);
            break;
        }
        knots.push([place, rate]);
    }
    if block.cx.error_count() > before_this {
        return None;
    }
    match RateCurve::new(knots) {
        Ok(curve) => Some(curve),
        Err(error) => {
            let error = SceneError::Impossible {
                key: key.to_owned(),
                problem: error.to_string(),
                help: format!("write {WANTED}"),
            };
            block.cx.error(&node.at, error);
            None
        }
    }
}
