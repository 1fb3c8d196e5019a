//! The keys of `outline.growth_algorithm`.

use super::form::{Axis, GrowthForm, HalfForm, LateralGrowth, SecondaryAxis, VeinRow};
use crate::document::keys::Keys;
use crate::document::keys::lists::BlockList;
use crate::document::schema::Type;
use crate::document::values::{list, number, number_at, wrong_type};
use crate::document::{
    Context, Declared, Degrees, DocumentError, Flag, Integer, Kind, Limits, Node, Number, Value,
};
use crate::shape::rates::Rates;

const SLOPES: Limits = Limits::closed(-20.0, 20.0);
const BENDS: Limits = Limits::closed(-100.0, 100.0);
const POSITIONS: Limits = Limits::closed(0.0, 1.0);
const MOST_VEINS: u64 = 200;
const MOST_AXES: usize = 200;

impl Default for GrowthForm {
    /// A form of which nothing is said.
    fn default() -> Self {
        HalfForm::entire(1.2, 0.5, 2.0).into()
    }
}

impl Declared for GrowthForm {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let limits = Number(Limits::closed(0.001, 1.0));
        let about = "g_y: growth of the midrib per step.";
        keys.key("axial_rate", &mut self.axial_rate, limits, about);
        let limits = Number(Limits::closed(1.0, 1e6));
        let about = "Length of the midrib at which growth ends, in lengths of the primordium: the \
            less, the younger the form.";
        keys.key("maturity", &mut self.maturity, limits, about);
        axis(&mut self.midrib, keys, false);
    }
}

/// The keys of an axis. One on another starts with the rows of that one's right half.
fn axis(axis: &mut Axis, keys: &mut Keys<'_>, is_secondary: bool) {
    let rows = Integer::within(3, 10_000);
    keys.key(
        "rows",
        &mut axis.rows,
        rows,
        "N: rows of cells along the midrib.",
    );
    half(&mut axis.right, keys, is_secondary);
    let right = axis.right.clone();
    let about = "The left half, apex up; a key that is left out is that of the right half.";
    keys.optional_block(
        "left",
        &mut axis.left,
        || right.clone(),
        about,
        |left, keys| half(left, keys, true),
    );
    let parent = Axis {
        axes: Vec::new(),
        left: None,
        ..axis.clone()
    };
    let new = || SecondaryAxis {
        position: 0.0,
        angle: 0.0,
        paired: true,
        length: 1.0,
        axis: parent.clone(),
    };
    let axes = BlockList {
        most: MOST_AXES,
        new: &new,
        wanted: "a list of at most 200 axes, such as { angle_deg = 50, length = 0.8 }",
        is_inside_itself: is_secondary,
    };
    let about = "Axes that repeat the midrib, as in palmate leaves; the blade is the union of \
        all lobes.";
    keys.blocks("axes", &mut axis.axes, &axes, about, |one, keys| {
        let limits = Number(POSITIONS);
        let about = "Where it starts along the parent.";
        keys.key("position", &mut one.position, limits, about);
        let limits = Degrees(Limits::closed(-180.0, 180.0));
        let about = "Direction from that of the parent, towards the right.";
        keys.required("angle_deg", &mut one.angle, limits, about);
        let about = "Its mirror image about the parent is there too.";
        keys.key("paired", &mut one.paired, Flag, about);
        let limits = Number(Limits::closed(0.01, 100.0));
        keys.required(
            "length",
            &mut one.length,
            limits,
            "How long it gets, in lengths of the \
            midrib.",
        );
        self::axis(&mut one.axis, keys, true);
    });
}

/// The keys of a half. One that `follows` another has that one's values where nothing is said.
fn half(half: &mut HalfForm, keys: &mut Keys<'_>, follows: bool) {
    lateral(&mut half.lateral, keys, follows);
    let limits = Number(Limits::closed(0.0, 100.0));
    let about = "a: how fast growth falls off away from a vein; 0 is an entire leaf, 0.0003 \
        lobed.";
    keys.key("lobe_decay", &mut half.lobe_decay, limits, about);
    let limits = Number(Limits::above(0.0, 10.0));
    let about = "n: 1 pointed lobes, 2 rounded.";
    keys.key("lobe_exponent", &mut half.lobe_exponent, limits, about);
    veins(&mut half.veins, keys);
}

/// A growth law of its own, or Eq. 3.
fn lateral(lateral: &mut LateralGrowth, keys: &mut Keys<'_>, follows: bool) {
    const PEAK: [&str; 3] = ["rate_ratio", "widest_at", "falloff"];
    for key in PEAK {
        keys.exclude("lateral_rates", key);
    }
    let mut curve = match lateral {
        LateralGrowth::Curve(curve) => Some(curve.clone()),
        LateralGrowth::Peak { .. } => None,
    };
    let is_read = keys.reader().is_some();
    let has_curve = is_read && keys.has("lateral_rates");
    let has_peak = is_read && PEAK.iter().any(|key| keys.has(key));
    let about = "g_L: `[[place, rate], …]`: any growth law per step, a smooth curve through these, instead of the three keys of Eq. 3.";
    keys.optional("lateral_rates", &mut curve, Rates, about);
    let stays_a_curve = !has_peak && (follows || keys.base().is_some());
    let is_curve = has_curve || (curve.is_some() && (!is_read || stays_a_curve));
    if is_curve && !keys.is_description() {
        keys.leave(&PEAK);
        if let Some(curve) = curve {
            *lateral = LateralGrowth::Curve(curve);
        }
        return;
    }
    let (mut values, known) = match lateral {
        LateralGrowth::Peak {
            rate_ratio,
            widest_at,
            falloff,
        } => ([*rate_ratio, *widest_at, *falloff], follows),
        LateralGrowth::Curve(_) => ([1.2, 0.5, 2.0], false),
    };
    let limits = [
        Limits::closed(0.5, 100.0),
        Limits::open(0.0, 1.0),
        Limits::above(0.0, 100.0),
    ];
    let about = [
        "R: axial over greatest lateral rate; 1.07 is broad, 1.7 slender.",
        "y_d: where along the midrib lateral growth is fastest, 0 at the petiole.",
        "k: how late lateral growth falls off from there; 1 is concave, 9 nearly a box.",
    ];
    for (i, key) in PEAK.into_iter().enumerate() {
        // What another half says need not be said again.
        if known {
            keys.key(key, &mut values[i], Number(limits[i]), about[i]);
        } else {
            keys.required(key, &mut values[i], Number(limits[i]), about[i]);
        }
    }
    let [rate_ratio, widest_at, falloff] = values;
    *lateral = LateralGrowth::Peak {
        rate_ratio,
        widest_at,
        falloff,
    };
}

/// The list `veins`, or `vein_count` veins at equal distances.
fn veins(veins: &mut Vec<VeinRow>, keys: &mut Keys<'_>) {
    keys.exclude("veins", "vein_count");
    keys.exclude("veins", "vein_slope");
    let about = "s: `[[position, slope], [position, slope, bend], …]`: veins from base to tip, \
        each with its rise along the midrib per unit away from it; with a bend the slope changes \
        by that much per midrib's length. Veins must not cross.";
    keys.key("veins", veins, VeinRows, about);
    let has_list = keys.reader().is_some() && keys.has("veins");
    if !has_list && (keys.has("vein_count") || keys.has("vein_slope")) {
        let (mut count, mut slope) = (1, 0.0);
        let about = "Secondary veins at equal distances.";
        keys.needed(
            "vein_count",
            &mut count,
            Integer::within(1, MOST_VEINS),
            about,
        );
        let about = "Their slope: rise along the axis per unit away from it.";
        keys.needed("vein_slope", &mut slope, Number(SLOPES), about);
        // Half a distance is left at base and tip, as in the paper's lobed leaves.
        let position = |index: u64| (index as f64 + 0.5) / count as f64;
        if !keys.is_description() {
            *veins = (0..count)
                .map(|index| VeinRow::straight(position(index), slope))
                .collect();
        }
    } else {
        keys.leave(&["vein_count", "vein_slope"]);
    }
}

/// `[[position, slope], [position, slope, bend], …]`.
#[derive(Clone, Copy, Debug)]
struct VeinRows;

impl VeinRows {
    const WANTED: &str = "a list of [position, slope] or [position, slope, bend], at most 200";
}

impl Kind for VeinRows {
    type Of = Vec<VeinRow>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Vec<VeinRow>> {
        let nodes = if let Value::List(nodes) = &node.value
            && nodes.len() as u64 <= MOST_VEINS
        {
            nodes
        } else {
            wrong_type(cx, node, key, Self::WANTED);
            return None;
        };
        let errors = cx.error_count();
        let mut veins: Vec<VeinRow> = Vec::with_capacity(nodes.len());
        for vein in nodes {
            let parts = if let Value::List(parts) = &vein.value {
                &parts[..]
            } else {
                &[]
            };
            if !(2..=3).contains(&parts.len()) {
                wrong_type(cx, vein, key, Self::WANTED);
                continue;
            }
            let position = number_at(cx, &parts[0], "veins, position", POSITIONS);
            let slope = number_at(cx, &parts[1], "veins, slope", SLOPES);
            let bend = parts
                .get(2)
                .map_or(Some(0.0), |node| number_at(cx, node, "veins, bend", BENDS));
            let (Some(position), Some(slope), Some(bend)) = (position, slope, bend) else {
                continue;
            };
            if let Some(last) = veins.last().filter(|last| last.position >= position) {
                let error = DocumentError::NotRising {
                    key: "vein positions".to_owned(),
                    before: last.position,
                    after: position,
                };
                cx.error(&parts[0].at, error);
                break;
            }
            veins.push(VeinRow {
                position,
                slope,
                bend,
            });
        }
        (cx.error_count() == errors).then_some(veins)
    }

    fn write(&self, veins: &Vec<VeinRow>) -> Value {
        list(veins.iter().map(|vein| {
            let bend = (vein.bend != 0.0).then_some(vein.bend);
            let numbers = [vein.position, vein.slope].into_iter().chain(bend);
            list(numbers.map(number))
        }))
    }

    fn describe(&self) -> Type {
        let straight = vec![Type::Number(POSITIONS), Type::Number(SLOPES)];
        let mut bent = straight.clone();
        bent.push(Type::Number(BENDS));
        let one = "[position, slope] or [position, slope, bend]";
        Type::List {
            of: Box::new(Type::AnyOf(
                vec![Type::Tuple(straight), Type::Tuple(bent)],
                one,
            )),
            least: 0,
            most: MOST_VEINS as usize,
            wanted: Self::WANTED,
        }
    }
}
