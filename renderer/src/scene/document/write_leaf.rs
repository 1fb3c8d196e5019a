//! A leaf's plan as the blocks of a file that read back to it.
//!
//! The mirror image of [`super::leaf`], [`super::outline`] and [`super::venation`]: same keys, same defaults.

mod layers;
mod mosaic;
mod outline;
mod pigments;
mod venation;

use leafmodel::blade::BladeForm;
use leafmodel::blade::ageing::Delay;
use leafmodel::blade::ageing_courses::{LITTER, YELLOW};
use leafmodel::blade::senescence::{AgeSource, Senescence};
use leafmodel::blade::tissue::Tissue;
use leafmodel::leaf::LeafPlan;
use leafmodel::leaf::venation_plan::VenationPlan;
use leafmodel::optics::Contents;

use self::layers::layers;
pub(super) use self::mosaic::mosaic;
use self::outline::outline;
pub(super) use self::pigments::pigments;
use self::venation::{arcuate, auxin, filled, vein_style};
use super::leaf::{MAP_SIZE, default_form, default_tissue};
use super::senescence::{BLEND, BLEND_DAYS, delays, numbers};
use super::tree::{Entry, Node, Table, Value};
use super::{write, write_compound};
use crate::scene::source::Place;

/// Text of a file with `format = 1` and the one leaf.
pub(crate) fn to_toml(name: &str, plan: &LeafPlan) -> String {
    let mut root = Keys::default();
    root.integer("format", 1);
    root.block("leaves", Keys::default().with(name, leaf(plan)));
    write::to_toml(&root.0)
}

/// A table in the making.
#[derive(Default)]
pub(super) struct Keys(pub(super) Table);

impl Keys {
    pub(super) fn value(&mut self, key: &str, value: Value) {
        let node = node(value);
        self.0.0.push(Entry {
            key: key.to_owned(),
            key_at: node.at.clone(),
            node,
        });
    }

    pub(super) fn block(&mut self, key: &str, block: Self) {
        self.value(key, Value::Table(block.0));
    }

    pub(super) fn with(mut self, key: &str, block: Self) -> Self {
        self.block(key, block);
        self
    }

    /// A block only if there is something in it.
    pub(super) fn block_if_any(&mut self, key: &str, block: Self) {
        if !block.0.0.is_empty() {
            self.block(key, block);
        }
    }

    pub(super) fn integer(&mut self, key: &str, value: u64) {
        self.value(key, Value::Integer(value.into()));
    }

    pub(super) fn number(&mut self, key: &str, value: f64) {
        self.value(key, number(value));
    }

    pub(super) fn number_unless(&mut self, key: &str, value: f64, default: f64) {
        if value != default {
            self.number(key, value);
        }
    }
}

fn node(value: Value) -> Node {
    let at = Place {
        source: 0,
        span: 0..0,
    };
    Node { at, value }
}

/// A number as one would write it: without a point if it is whole.
pub(super) fn number(value: f64) -> Value {
    // Every whole number so small is exact either way.
    if value.fract() == 0.0 && value.abs() < 1e15 {
        Value::Integer(value as i128)
    } else {
        Value::Number(value)
    }
}

pub(super) fn list(values: impl IntoIterator<Item = Value>) -> Value {
    Value::List(values.into_iter().map(node).collect())
}

fn pair(numbers: [f64; 2]) -> Value {
    list(numbers.map(number))
}

fn leaf(plan: &LeafPlan) -> Keys {
    let mut keys = Keys::default();
    keys.number("length_mm", plan.length_mm);
    if plan.seed != 0 {
        keys.integer("seed", plan.seed);
    }
    if u64::from(plan.map_size) != MAP_SIZE {
        keys.integer("map_size", plan.map_size.into());
    }
    keys.block("outline", outline(&plan.outline));
    let (kind, block) = match &plan.venation {
        VenationPlan::Auxin(plan) => auxin(plan),
        VenationPlan::Arcuate(plan) => ("arcuate", arcuate(plan)),
        VenationPlan::Cells(style) => ("cells", vein_style(*style)),
        VenationPlan::Transport(plan) => ("transport", filled(plan)),
    };
    keys.block("venation", Keys::default().with(kind, block));
    keys.block("contents", contents(&plan.tissue.lamina));
    keys.block_if_any("pigments", pigments(&plan.pigments));
    let (veins, mottle) = tissue(&plan.tissue);
    keys.block_if_any("veins", veins);
    keys.block_if_any("mottle", mottle);
    if let Some(pattern) = &plan.mosaic {
        keys.block("mosaic", mosaic(pattern));
    }
    keys.block_if_any("layers", layers(&plan.layers));
    if let Some(aged) = &plan.senescence {
        keys.block("senescence", senescence(aged));
    }
    keys.block_if_any("blade", form(&plan.form, plan.length_mm));
    if let Some(petiole) = &plan.petiole {
        keys.block("petiole", write_compound::petiole(petiole));
    }
    if let Some(form) = &plan.compound {
        keys.block("compound", write_compound::compound(form));
    }
    keys
}

fn contents(contents: &Contents) -> Keys {
    let mut keys = Keys::default();
    for (constituent, value) in **contents {
        match constituent.if_left_out() {
            None => keys.number(constituent.key(), value),
            Some(default) => keys.number_unless(constituent.key(), value, default),
        }
    }
    keys
}

/// The blocks `veins` and `mottle`.
fn tissue(tissue: &Tissue) -> (Keys, Keys) {
    let default = default_tissue(tissue.lamina);
    let mut veins = Keys::default();
    for (constituent, factor) in *tissue.vein_factors {
        veins.number_unless(
            constituent.name(),
            factor,
            default.vein_factors[constituent],
        );
    }
    let full = tissue.full_vein_radius_mm;
    veins.number_unless("full_radius_mm", full, default.full_vein_radius_mm);
    let sheath = tissue.sheath_width_mm;
    veins.number_unless("sheath_width_mm", sheath, default.sheath_width_mm);
    let mut mottle = Keys::default();
    let scale = tissue.mottle_scale_mm;
    if tissue.mottle != default.mottle || scale != default.mottle_scale_mm {
        mottle.number("share", tissue.mottle);
        mottle.number_unless("scale_mm", scale, default.mottle_scale_mm);
    }
    (veins, mottle)
}

/// The block `senescence`.
fn senescence(senescence: &Senescence) -> Keys {
    let mut keys = Keys::default();
    match senescence.source {
        AgeSource::Revenue { share } => {
            keys.number("revenue_share", share);
            keys.number_unless("blend", senescence.blend, BLEND);
            keys.block("contents", contents(&senescence.contents));
        }
        AgeSource::Day { day, mut course } => {
            keys.number("day", day);
            keys.number_unless("blend_days", senescence.blend, BLEND_DAYS);
            let mut usual = YELLOW;
            let defaults = numbers(&mut usual).map(|(_, value, ..)| *value);
            for ((key, value, ..), default) in numbers(&mut course).into_iter().zip(defaults) {
                keys.number_unless(key, *value, default);
            }
            keys.block_if_any("onset", delay(course.onset, YELLOW.onset));
            keys.block_if_any("death", delay(course.death, YELLOW.death));
            if senescence.contents != LITTER {
                keys.block("contents", contents(&senescence.contents));
            }
        }
    }
    keys
}

/// What of a delay is other than usual.
fn delay(mut delay: Delay, mut usual: Delay) -> Keys {
    let mut keys = Keys::default();
    let order = f64::from(usual.veins_order);
    keys.number_unless("veins_order", f64::from(delay.veins_order), order);
    for ((key, value, ..), (_, default, ..)) in
        delays(&mut delay).into_iter().zip(delays(&mut usual))
    {
        keys.number_unless(key, *value, *default);
    }
    keys
}

/// The block `blade`.
fn form(form: &BladeForm, length_mm: f64) -> Keys {
    let default = default_form(length_mm);
    let mut keys = Keys::default();
    keys.number_unless("fold_deg", degrees(form.fold), 0.0);
    keys.number_unless("curl_deg", degrees(form.curl), 0.0);
    keys.number_unless("ruffle", form.ruffle, default.ruffle);
    keys.number_unless("ruffle_waves", form.ruffle_waves, default.ruffle_waves);
    keys.number_unless("relief", form.relief, default.relief);
    keys.number_unless("thickness_mm", form.thickness_mm, default.thickness_mm);
    keys.number_unless("max_edge_mm", form.max_edge_mm, default.max_edge_mm);
    let meshed = form.meshed_vein_radius_mm;
    keys.number_unless(
        "meshed_vein_radius_mm",
        meshed,
        default.meshed_vein_radius_mm,
    );
    keys
}

/// Degrees that read back to the same radians if any do; the shortest that do if they are short.
pub(super) fn degrees(radians: f64) -> f64 {
    let near = radians.to_degrees();
    let short = (near * 1e6).round() / 1e6;
    [short, near, near.next_up(), near.next_down()]
        .into_iter()
        .find(|degrees| degrees.to_radians() == radians)
        .unwrap_or(near)
}

#[cfg(test)]
pub(super) mod tests;
