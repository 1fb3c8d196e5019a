//! `[leaves.NAME.outline.curve]`: a margin through control points.

use leafmodel::shape::contour_curve::{ContourCurve, ControlPoint};

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;
use crate::scene::document::tree::{Node, Value};
use crate::scene::document::values::{number_at, text_at, wrong_length, wrong_type};
use crate::scene::error::SceneError;
use crate::scene::nearest::nearest;

const SHARES: Limits = Limits::closed(-10.0, 10.0);
const WANTED: &str = "a list of 3 to 1000 points, [x, y] or [x, y, \"corner\"]";

/// Reads the block.
pub(super) fn read_curve(block: &Block<'_>) -> Option<ContourCurve> {
    let mirrored = block.flag_or("mirrored", true);
    let points = block
        .needed("points", || format!("`points = […]`, {WANTED}"))
        .and_then(|node| read_points(block, node));
    block.finish();
    Some(ContourCurve {
        points: points?,
        mirrored,
    })
}

fn read_points(block: &Block<'_>, node: &Node) -> Option<Vec<ControlPoint>> {
    let Value::List(list) = &node.value else {
        wrong_type(block.cx, node, "points", WANTED);
        return None;
    };
    if !(3..=1000).contains(&list.len()) {
        wrong_length(block.cx, &node.at, "points", "a list", list.len(), WANTED);
        return None;
    }
    let points: Vec<Option<ControlPoint>> =
        list.iter().map(|node| read_point(block, node)).collect();
    points.into_iter().collect()
}

fn read_point(block: &Block<'_>, node: &Node) -> Option<ControlPoint> {
    const ONE: &str = "a point, [x, y] or [x, y, \"corner\"]";
    let Value::List(parts) = &node.value else {
        wrong_type(block.cx, node, "points", ONE);
        return None;
    };
    let (x, y, corner) = match parts.as_slice() {
        [x, y] => (x, y, Some(false)),
        [x, y, word] => (x, y, read_corner(block, word)),
        _ => {
            wrong_length(block.cx, &node.at, "points", "a list", parts.len(), ONE);
            return None;
        }
    };
    let [x, y] = [x, y].map(|node| number_at(block.cx, node, "points", SHARES));
    Some(ControlPoint {
        place: [x?, y?],
        corner: corner?,
    })
}

/// The word `"corner"`.
fn read_corner(block: &Block<'_>, node: &Node) -> Option<bool> {
    let (word, at) = text_at(block.cx, node, "points")?;
    if word == "corner" {
        return Some(true);
    }
    let error = SceneError::UnknownWord {
        key: "points".to_owned(),
        word: block.cx.quoted(node).trim_matches('"').to_owned(),
        nearest: nearest(word, ["corner"]).map(str::to_owned),
        known: "`corner`".to_owned(),
    };
    block.cx.error(at, error);
    None
}
