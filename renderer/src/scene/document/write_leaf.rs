//! A leaf's plan as the blocks of a file that read back to it.
//!
//! The mirror image of [`super::leaf`], [`super::outline`] and [`super::venation`]: same keys, same defaults.

use leafmodel::blade::BladeForm;
use leafmodel::blade::senescence::{AgeSource, Senescence};
use leafmodel::blade::tissue::Tissue;
use leafmodel::leaf::LeafPlan;
use leafmodel::leaf::outline_plan::{Contour, OutlinePlan};
use leafmodel::leaf::venation_plan::VenationPlan;
use leafmodel::optics::Contents;
use leafmodel::shape::contour_curve::ContourCurve;
use leafmodel::shape::cubic_margin::CubicMargin;
use leafmodel::shape::growth_form::{Axis, GrowthForm, HalfForm, LateralGrowth, VeinRow};
use leafmodel::shape::svg_path::SvgContour;
use leafmodel::transport::{FilledPlan, Ladder, TransportPlan, VeinStyle};
use leafmodel::venation::arcuate::ArcuatePlan;
use leafmodel::venation::plan::{AuxinPlan, Growth, Neighbourhood, Pattern};

use super::leaf::{MAP_SIZE, default_form, default_tissue};
use super::outline::STEPS;
use super::senescence::BLEND;
use super::tree::{Entry, Node, Table, Value};
use super::venation::LEAST_CELLS;
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
pub(super) struct Keys(Table);

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
    fn block_if_any(&mut self, key: &str, block: Self) {
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
    let (veins, mottle) = tissue(&plan.tissue);
    keys.block_if_any("veins", veins);
    keys.block_if_any("mottle", mottle);
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

fn outline(plan: &OutlinePlan) -> Keys {
    let mut keys = Keys::default();
    if !plan.teeth.is_empty() {
        let waves = plan.teeth.iter().map(|wave| {
            let mut keys = Keys::default();
            keys.integer("per_side", wave.per_side.into());
            keys.number("height", wave.height);
            keys.number_unless("lean", wave.lean, 0.0);
            keys.number_unless("fade_base", wave.fade_base, 0.0);
            keys.number_unless("fade_apex", wave.fade_apex, 0.0);
            Value::Table(keys.0)
        });
        keys.value("teeth", list(waves));
    }
    match &plan.contour {
        Contour::GrowthAlgorithm(form) => keys.block("growth_algorithm", growth_form(form)),
        Contour::Curve(contour) => keys.block("curve", curve(contour)),
        Contour::Svg(contour) => keys.block("svg", svg(contour)),
        Contour::Cubic(margin) => keys.block("cubic", cubic(margin)),
        Contour::Transport(plan) => keys.block("transport", transport(plan)),
    }
    keys
}

fn growth_form(form: &GrowthForm) -> Keys {
    let mut keys = Keys::default();
    keys.number_unless("axial_rate", form.axial_rate, 0.1);
    axis(&mut keys, &form.midrib, None);
    keys
}

/// The keys of an axis on a parent.
fn axis(keys: &mut Keys, axis_form: &Axis, parent: Option<&Axis>) {
    if axis_form.rows != parent.map_or(150, |parent| parent.rows) {
        keys.integer("rows", axis_form.rows as u64);
    }
    half(keys, &axis_form.right, parent.map(|parent| &parent.right));
    if let Some(left) = &axis_form.left {
        let mut block = Keys::default();
        half(&mut block, left, Some(&axis_form.right));
        keys.block("left", block);
    }
    if !axis_form.axes.is_empty() {
        let axes = axis_form.axes.iter().map(|secondary| {
            let mut keys = Keys::default();
            keys.number_unless("position", secondary.position, 0.0);
            keys.number("angle_deg", degrees(secondary.angle));
            if !secondary.paired {
                keys.value("paired", Value::Flag(false));
            }
            keys.number("length", secondary.length);
            axis(&mut keys, &secondary.axis, Some(axis_form));
            Value::Table(keys.0)
        });
        keys.value("axes", list(axes));
    }
}

/// The keys of a half that differ from the usual one's.
fn half(keys: &mut Keys, half: &HalfForm, usual: Option<&HalfForm>) {
    match (&half.lateral, usual.map(|usual| &usual.lateral)) {
        (own, Some(usual)) if own == usual => {}
        (LateralGrowth::Curve(curve), _) => {
            let knots = curve.knots().iter().copied().map(pair);
            keys.value("lateral_rates", list(knots));
        }
        (
            LateralGrowth::Peak {
                rate_ratio,
                widest_at,
                falloff,
            },
            usual,
        ) => {
            let usual = match usual {
                Some(&LateralGrowth::Peak {
                    rate_ratio,
                    widest_at,
                    falloff,
                }) => [rate_ratio, widest_at, falloff],
                // Unlike every number, so that all three are written.
                Some(LateralGrowth::Curve(_)) | None => [f64::NAN; 3],
            };
            keys.number_unless("rate_ratio", *rate_ratio, usual[0]);
            keys.number_unless("widest_at", *widest_at, usual[1]);
            keys.number_unless("falloff", *falloff, usual[2]);
        }
    }
    let decay = usual.map_or(0.0, |usual| usual.lobe_decay);
    keys.number_unless("lobe_decay", half.lobe_decay, decay);
    let exponent = usual.map_or(2.0, |usual| usual.lobe_exponent);
    keys.number_unless("lobe_exponent", half.lobe_exponent, exponent);
    let veins = usual.map_or(&[][..], |usual| &usual.veins);
    if half.veins != veins {
        let vein = |vein: &VeinRow| {
            let bend = (vein.bend != 0.0).then_some(vein.bend);
            let numbers = [vein.position, vein.slope].into_iter().chain(bend);
            list(numbers.map(number))
        };
        keys.value("veins", list(half.veins.iter().map(vein)));
    }
}

fn curve(contour: &ContourCurve) -> Keys {
    let mut keys = Keys::default();
    let points = contour.points.iter().map(|point| {
        let corner = point.corner.then(|| Value::Text("corner".to_owned()));
        list(point.place.map(number).into_iter().chain(corner))
    });
    keys.value("points", list(points));
    if !contour.mirrored {
        keys.value("mirrored", Value::Flag(false));
    }
    keys
}

fn svg(contour: &SvgContour) -> Keys {
    let mut keys = Keys::default();
    keys.value("path", Value::Text(contour.file.clone()));
    if let Some(id) = &contour.id {
        keys.value("id", Value::Text(id.clone()));
    }
    let [base, apex] = SvgContour::ends_of(&contour.points);
    for (key, place, default) in [("base", contour.base, base), ("apex", contour.apex, apex)] {
        if place != default {
            keys.value(key, pair(place));
        }
    }
    keys
}

fn cubic(margin: &CubicMargin) -> Keys {
    let usual = CubicMargin::default();
    let mut keys = Keys::default();
    keys.number_unless("angle1_deg", margin.angle1_deg, usual.angle1_deg);
    keys.number_unless("length1", margin.length1, usual.length1);
    keys.number_unless("angle2_deg", margin.angle2_deg, usual.angle2_deg);
    keys.number_unless("length2", margin.length2, usual.length2);
    keys
}

fn transport(plan: &TransportPlan) -> Keys {
    let usual = TransportPlan::default();
    let mut keys = Keys::default();
    keys.number("alpha", plan.alpha);
    keys.number("beta", plan.beta);
    keys.number("epsilon", plan.epsilon);
    keys.number_unless("cell", plan.cell, usual.cell);
    match plan.ladder {
        Ladder::Equal(STEPS) => {}
        Ladder::Equal(steps) => keys.integer("steps", steps.into()),
        Ladder::Events => keys.value("events", Value::Flag(true)),
    }
    if !plan.mirrored {
        keys.value("mirrored", Value::Flag(false));
    }
    keys.number_unless("noise", plan.noise, usual.noise);
    keys.number_unless("noise_cells", plan.noise_cells, usual.noise_cells);
    if plan.most_cells != usual.most_cells {
        keys.integer("most_cells", plan.most_cells as u64);
    }
    keys
}

fn arcuate(plan: &ArcuatePlan) -> Keys {
    let usual = ArcuatePlan::default();
    let mut keys = Keys::default();
    for (key, value, usual) in [
        ("laterals", plan.veins, usual.veins),
        ("seed", plan.seed, usual.seed),
    ] {
        if value != usual {
            keys.integer(key, value.into());
        }
    }
    keys.number_unless("variation", plan.variation, usual.variation);
    keys.number_unless("width", plan.width, usual.width);
    keys.number_unless("net_width", plan.net_width, usual.net_width);
    keys.number_unless("squish", plan.squish, usual.squish);
    keys.number_unless("squish2", plan.squish2, usual.squish2);
    keys.number_unless("squish3", plan.squish3, usual.squish3);
    keys.number_unless("up", plan.up, usual.up);
    keys.number_unless("tip_width", plan.tip_width, usual.tip_width);
    if let Some(palmate) = &plan.palmate {
        let mut block = Keys::default();
        block.integer("per_side", palmate.per_side.into());
        block.number("spread", palmate.spread);
        block.number_unless("bow", palmate.bow, 0.0);
        keys.block("palmate", block);
    }
    keys
}

fn vein_style(style: VeinStyle) -> Keys {
    let mut keys = Keys::default();
    keys.number("base_radius_mm", style.base_radius_mm);
    if style.least_cells != LEAST_CELLS {
        keys.integer("least_cells", style.least_cells.into());
    }
    keys
}

fn filled(plan: &FilledPlan) -> Keys {
    let usual = FilledPlan::default();
    let mut keys = vein_style(plan.style);
    keys.number_unless("alpha", plan.alpha, usual.alpha);
    keys.number_unless("beta", plan.beta, usual.beta);
    if plan.cells_along != usual.cells_along {
        keys.integer("cells_along", plan.cells_along.into());
    }
    keys
}

fn auxin(plan: &AuxinPlan) -> (&'static str, Keys) {
    let mut keys = Keys::default();
    keys.number("final_length_segments", plan.final_length);
    keys.number("kill_distance_segments", plan.kill_distance);
    if plan.source_birth_distance == plan.vein_birth_distance {
        keys.number("birth_distance_segments", plan.vein_birth_distance);
    } else {
        keys.number("source_birth_distance_segments", plan.source_birth_distance);
        keys.number("vein_birth_distance_segments", plan.vein_birth_distance);
    }
    keys.number("darts_per_segment2", plan.darts_per_area);
    keys.number_unless("murray_exponent", plan.murray_exponent, 2.0);
    keys.number("veinlet_radius_mm", plan.veinlet_radius_mm);
    let pattern = match plan.pattern {
        Pattern::Open => "open",
        Pattern::Closed(Neighbourhood::Relative) => "closed",
        Pattern::Closed(Neighbourhood::Urquhart) => {
            keys.value("neighbourhood", Value::Text("urquhart".to_owned()));
            "closed"
        }
    };
    if !plan.origins.is_empty() {
        keys.value("origins", list(plan.origins.iter().copied().map(pair)));
    }
    if plan.joined_origins {
        keys.value("joined_origins", Value::Flag(true));
    }
    keys.number_unless("unseen_veinlets", plan.unseen_veinlets, 0.0);
    keys.number_unless("gaussian_curvature", plan.gaussian_curvature, 0.0);
    if let Some(free) = &plan.free_endings {
        let mut block = Keys::default();
        block.number("birth_distance_segments", free.birth_distance);
        block.number("kill_distance_segments", free.kill_distance);
        block.number("darts_per_segment2", free.darts_per_area);
        keys.block("free_endings", block);
    }
    if let Some(clearance) = &plan.margin_clearance {
        let mut block = Keys::default();
        block.number("distance", clearance.distance);
        block.number("until", clearance.until);
        if clearance.arches > 0 {
            block.integer("arches", u64::from(clearance.arches));
        }
        keys.block("margin_clearance", block);
    }
    keys.block("growth", growth(&plan.growth));
    (pattern, keys)
}

fn growth(growth: &Growth) -> Keys {
    let mut keys = Keys::default();
    let kind = match growth {
        Growth::None => "none",
        Growth::Marginal {
            initial_length,
            length_step,
        } => {
            keys.number("initial_length_segments", *initial_length);
            keys.number("length_step_segments", *length_step);
            "marginal"
        }
        Growth::Isogonic {
            initial_length,
            length_step,
        } => {
            keys.number("initial_length_segments", *initial_length);
            keys.number("length_step_segments", *length_step);
            "isogonic"
        }
        Growth::Anisotropic {
            initial_length,
            across,
            along,
        } => {
            keys.number("initial_length_segments", *initial_length);
            for (key, rates) in [("across", across), ("along", along)] {
                keys.value(key, list(rates.knots().iter().copied().map(pair)));
            }
            "anisotropic"
        }
    };
    Keys::default().with(kind, keys)
}

fn contents(contents: &Contents) -> Keys {
    let mut keys = Keys::default();
    keys.number("structure", contents.structure);
    keys.number("chlorophyll_ug_per_cm2", contents.chlorophyll);
    keys.number("carotenoids_ug_per_cm2", contents.carotenoids);
    keys.number_unless("anthocyanins_ug_per_cm2", contents.anthocyanins, 0.0);
    keys.number_unless("brown", contents.brown, 0.0);
    keys.number("water_cm", contents.water);
    keys.number("dry_matter_g_per_cm2", contents.dry_matter);
    keys
}

/// The blocks `veins` and `mottle`.
fn tissue(tissue: &Tissue) -> (Keys, Keys) {
    let default = default_tissue(tissue.lamina);
    let mut veins = Keys::default();
    let (own, usual) = (tissue.vein_factors, default.vein_factors);
    for (key, (value, default)) in Contents::NAMES
        .into_iter()
        .zip(own.to_array().into_iter().zip(usual.to_array()))
    {
        veins.number_unless(key, value, default);
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
    let AgeSource::Revenue { share } = senescence.source;
    keys.number("revenue_share", share);
    keys.number_unless("blend", senescence.blend, BLEND);
    keys.block("contents", contents(&senescence.contents));
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
mod tests;
