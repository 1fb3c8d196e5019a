//! Outlines as blocks.

use leafmodel::leaf::outline_plan::{Contour, OutlinePlan};
use leafmodel::shape::contour_curve::ContourCurve;
use leafmodel::shape::cubic_margin::CubicMargin;
use leafmodel::shape::growth_form::{Axis, GrowthForm, HalfForm, LateralGrowth, VeinRow};
use leafmodel::shape::svg_path::SvgContour;
use leafmodel::transport::{Ladder, TransportPlan};

use super::{Keys, degrees, list, number, pair};
use crate::scene::document::outline::STEPS;
use crate::scene::document::tree::Value;

pub(super) fn outline(plan: &OutlinePlan) -> Keys {
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
