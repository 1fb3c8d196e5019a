//! `[leaves.NAME.outline.growth_algorithm]`: a margin that local growth brings forth.

use leafmodel::shape::growth_form::{
    Axis, GrowthForm, GrowthFormError, GrowthFormProblem, HalfForm, LateralGrowth, SecondaryAxis,
    Side, VeinRow,
};

use crate::scene::document::limits::Limits;
use crate::scene::document::reader::Block;
use crate::scene::document::tree::{Node, Value};
use crate::scene::document::values::{number_at, wrong_length, wrong_type};
use crate::scene::document::venation::read_rates;
use crate::scene::error::SceneError;
use crate::scene::source::Place;

const SLOPES: Limits = Limits::closed(-20.0, 20.0);
const BENDS: Limits = Limits::closed(-100.0, 100.0);
const POSITIONS: Limits = Limits::closed(0.0, 1.0);
const MOST_VEINS: u64 = 200;
const MOST_AXES: usize = 200;
/// The keys of Eq. 3 and their ranges.
const PEAK: [(&str, Limits); 3] = [
    ("rate_ratio", Limits::closed(0.5, 100.0)),
    ("widest_at", Limits::open(0.0, 1.0)),
    ("falloff", Limits::above(0.0, 100.0)),
];

/// Reads the block.
pub(super) fn read_growth_form(block: &Block<'_>) -> Option<GrowthForm> {
    let axial_rate = block.number_or("axial_rate", Limits::closed(0.001, 1.0), 0.1);
    let midrib = read_axis(block, None);
    block.finish();
    Some(GrowthForm {
        axial_rate,
        midrib: midrib?,
    })
}

/// Reads the keys of an axis. One on a `parent` has the rows of the parent's right half for defaults.
fn read_axis(block: &Block<'_>, parent: Option<&Axis>) -> Option<Axis> {
    let usual_rows = parent.map_or(150, |parent| parent.rows as u64);
    let rows = block.integer_or("rows", 3, 10_000, usual_rows) as usize;
    let right = read_half(block, parent.map(|parent| &parent.right));
    // If the half has errors, what builds upon it is read for its own errors all the same.
    let stand_in = right.clone().unwrap_or(HalfForm::entire(1.2, 0.5, 2.0));
    let before_this = block.cx.error_count();
    let left = block.optional_block("left").and_then(|block| {
        let left = read_half(&block, Some(&stand_in));
        block.finish();
        left
    });
    let mut axis = Axis {
        rows,
        right: stand_in,
        left,
        axes: Vec::new(),
    };
    let axes = read_axes(block, &axis);
    right?;
    axis.axes = axes?;
    (block.cx.error_count() == before_this).then_some(axis)
}

/// Reads the keys of a half, each with that of the `usual` half for its default.
fn read_half(block: &Block<'_>, usual: Option<&HalfForm>) -> Option<HalfForm> {
    let lateral = read_lateral(block, usual.map(|half| &half.lateral));
    let decay = usual.map_or(0.0, |half| half.lobe_decay);
    let lobe_decay = block.number_or("lobe_decay", Limits::closed(0.0, 100.0), decay);
    let exponent = usual.map_or(2.0, |half| half.lobe_exponent);
    let lobe_exponent = block.number_or("lobe_exponent", Limits::above(0.0, 10.0), exponent);
    let veins = read_veins(block, usual.map_or(&[], |half| &half.veins));
    Some(HalfForm {
        lateral: lateral?,
        lobe_decay,
        lobe_exponent,
        veins: veins?,
    })
}

/// A growth law of its own, or Eq. 3.
fn read_lateral(block: &Block<'_>, usual: Option<&LateralGrowth>) -> Option<LateralGrowth> {
    for (key, _) in PEAK {
        block.exclude("lateral_rates", key);
    }
    if block.entry("lateral_rates").is_some() {
        return read_rates(block, "lateral_rates").map(LateralGrowth::Curve);
    }
    let defaults = match usual {
        Some(LateralGrowth::Curve(curve)) => {
            if PEAK.iter().all(|(key, _)| block.entry(key).is_none()) {
                return Some(LateralGrowth::Curve(curve.clone()));
            }
            None
        }
        Some(&LateralGrowth::Peak {
            rate_ratio,
            widest_at,
            falloff,
        }) => Some([rate_ratio, widest_at, falloff]),
        None => None,
    };
    let number = |i: usize| {
        let (key, limits) = PEAK[i];
        match defaults {
            Some(defaults) => Some(block.number_or(key, limits, defaults[i])),
            None => block.number(key, limits),
        }
    };
    let [rate_ratio, widest_at, falloff] = [0, 1, 2].map(number);
    Some(LateralGrowth::Peak {
        rate_ratio: rate_ratio?,
        widest_at: widest_at?,
        falloff: falloff?,
    })
}

/// The list `veins`, or `vein_count` veins at equal distances, or the usual ones.
fn read_veins(block: &Block<'_>, usual: &[VeinRow]) -> Option<Vec<VeinRow>> {
    block.exclude("veins", "vein_count");
    block.exclude("veins", "vein_slope");
    if let Some(node) = block.node("veins") {
        return listed_veins(block, node);
    }
    if block.entry("vein_count").is_none() && block.entry("vein_slope").is_none() {
        return Some(usual.to_vec());
    }
    let count = block.integer("vein_count", 1, MOST_VEINS);
    let slope = block.number("vein_slope", SLOPES);
    let (count, slope) = (count?, slope?);
    // Half a distance is left at base and tip, as in the paper's lobed leaves.
    let position = |index: u64| (index as f64 + 0.5) / count as f64;
    Some(
        (0..count)
            .map(|index| VeinRow::straight(position(index), slope))
            .collect(),
    )
}

fn listed_veins(block: &Block<'_>, node: &Node) -> Option<Vec<VeinRow>> {
    const WANTED: &str = "a list of [position, slope] or [position, slope, bend], at most 200";
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
    for vein in list {
        let Value::List(numbers) = &vein.value else {
            wrong_type(block.cx, vein, "veins", WANTED);
            continue;
        };
        let (position_node, slope_node, bend_node) = match numbers.as_slice() {
            [position, slope] => (position, slope, None),
            [position, slope, bend] => (position, slope, Some(bend)),
            _ => {
                wrong_type(block.cx, vein, "veins", WANTED);
                continue;
            }
        };
        let position = number_at(block.cx, position_node, "veins, position", POSITIONS);
        let slope = number_at(block.cx, slope_node, "veins, slope", SLOPES);
        let bend = bend_node.map_or(Some(0.0), |node| {
            number_at(block.cx, node, "veins, bend", BENDS)
        });
        let (Some(position), Some(slope), Some(bend)) = (position, slope, bend) else {
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
        veins.push(VeinRow {
            position,
            slope,
            bend,
        });
    }
    (block.cx.error_count() == before_this).then_some(veins)
}

/// The list `axes` on a parent, which may be left out.
fn read_axes(block: &Block<'_>, parent: &Axis) -> Option<Vec<SecondaryAxis>> {
    const WANTED: &str = "a list of at most 200 axes, such as { angle_deg = 50, length = 0.8 }";
    let Some(node) = block.node("axes") else {
        return Some(Vec::new());
    };
    let Value::List(list) = &node.value else {
        wrong_type(block.cx, node, "axes", WANTED);
        return None;
    };
    if list.len() > MOST_AXES {
        wrong_length(block.cx, &node.at, "axes", "a list", list.len(), WANTED);
        return None;
    }
    let mut axes = Vec::with_capacity(list.len());
    for (number, node) in list.iter().enumerate() {
        let Some(table) = node.table() else {
            wrong_type(block.cx, node, "axes", WANTED);
            continue;
        };
        let path = format!("{}[{number}]", block.path_of("axes"));
        let block = Block::new(block.cx, table, path, node.at.clone());
        let position = block.number_or("position", POSITIONS, 0.0);
        let angle = block.number("angle_deg", Limits::closed(-180.0, 180.0));
        let paired = block.flag_or("paired", true);
        let length = block.number("length", Limits::closed(0.01, 100.0));
        let axis = read_axis(&block, Some(parent));
        block.finish();
        if let (Some(angle), Some(length), Some(axis)) = (angle, length, axis) {
            axes.push(SecondaryAxis {
                position,
                angle: angle.to_radians(),
                paired,
                length,
                axis,
            });
        }
    }
    // An axis with an error is one short.
    (axes.len() == list.len()).then_some(axes)
}

/// Reports a form that each of its numbers allows and that grows to no leaf all the same.
pub(super) fn report(block: &Block<'_>, error: &GrowthFormError) {
    let (keys, help): (&[&str], _) = match &error.problem {
        GrowthFormProblem::VeinOrder { .. } => (
            &["veins", "vein_count"],
            "put the veins farther apart, or use more `rows`",
        ),
        GrowthFormProblem::VeinsCross { .. } => (
            &["veins"],
            "change the slope as far as that, or put the veins farther apart",
        ),
        GrowthFormProblem::TooWide { .. } => (
            &["lateral_rates", "rate_ratio"],
            "use lower lateral rates, or a larger `rate_ratio`",
        ),
        GrowthFormProblem::Apart => (
            &["position"],
            "place the axis nearer to the middle of the blade, or widen its base",
        ),
        GrowthFormProblem::OutOfRange { .. } => (&["axes"], "use fewer axes"),
        GrowthFormProblem::NoMargin(_) => (
            &["veins", "axes"],
            "put the veins farther apart, with slopes that differ less",
        ),
    };
    let (at, key) = place_of(block, error, keys);
    let error = SceneError::Impossible {
        key: key.to_owned(),
        problem: error.to_string(),
        help: help.to_owned(),
    };
    block.cx.error(at, error);
}

/// Where the first of these keys is written that the faulty part has; else where that part is.
fn place_of<'a, 'k>(
    block: &'a Block<'_>,
    error: &GrowthFormError,
    keys: &[&'k str],
) -> (&'a Place, &'k str) {
    let (mut table, mut at) = (block.table, &block.at);
    for &number in &error.part.axes {
        let node = table.get("axes").map(|entry| &entry.node.value);
        let Some(Value::List(list)) = node else {
            break;
        };
        let Some((inner, node)) = list
            .get(number)
            .and_then(|node| Some((node.table()?, node)))
        else {
            break;
        };
        (table, at) = (inner, &node.at);
    }
    let left = table.get("left").filter(|_| error.part.side == Side::Left);
    // What the left half does not have is written beside it.
    let halves = left.and_then(|entry| entry.node.table()).into_iter();
    for table in halves.chain([table]) {
        for key in keys {
            if let Some(entry) = table.get(key) {
                return (&entry.node.at, key);
            }
        }
    }
    (at, keys[0])
}
