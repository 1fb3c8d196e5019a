//! Mosaics as blocks of a file.

use glam::DVec3;
use leafmodel::mosaic::control::{ControlImage, CylinderControl, Steered};
use leafmodel::mosaic::growth::{GrowthCourse, SurfaceGrowth};
use leafmodel::mosaic::pattern::{LeafFaces, MosaicPattern};
use leafmodel::mosaic::plan::{CellType, MosaicPlan, RadiusRule};

use super::{Keys, contents, list, number};
use crate::scene::document::mosaic::BLEND_MM;
use crate::scene::document::tree::Value;

pub(in crate::scene::document) fn mosaic(pattern: &MosaicPattern) -> Keys {
    let (plan, default) = (&pattern.plan, MosaicPlan::default());
    let mut keys = Keys::default();
    keys.integer("cells", plan.initial_cells as u64);
    keys.number("days", plan.days);
    keys.number_unless("radius_weight", plan.radius_weight, default.radius_weight);
    if plan.relaxations_per_day != default.relaxations_per_day {
        keys.integer("relaxations_per_day", plan.relaxations_per_day.into());
    }
    keys.number_unless("step", plan.step, default.step);
    if plan.initial_relaxations != default.initial_relaxations {
        keys.integer("initial_relaxations", plan.initial_relaxations.into());
    }
    keys.number_unless("initial_step", plan.initial_step, default.initial_step);
    match plan.radius {
        RadiusRule::Initial => {}
        RadiusRule::Daily => text(&mut keys, "radius", "daily"),
    }
    keys.number_unless("blend_mm", pattern.blend_mm, BLEND_MM);
    match pattern.faces {
        LeafFaces::Through => {}
        LeafFaces::Both => text(&mut keys, "faces", "both"),
    }
    let names: Vec<&str> = plan.types.iter().map(|kind| kind.name.as_str()).collect();
    let types = plan.types.iter().zip(&pattern.contents);
    let types = types.fold(Keys::default(), |keys, (kind, held)| {
        let mut block = cell_type(kind, &names);
        block.block("contents", contents(held));
        keys.with(&kind.name, block)
    });
    keys.block("types", types);
    let controls = plan.controls.iter().zip(1..);
    let controls = controls.fold(Keys::default(), |keys, (one, count)| {
        keys.with(&format!("control-{count}"), control(one, &names))
    });
    keys.block_if_any("controls", controls);
    if let SurfaceGrowth::Anisotropic { start, course } = plan.growth {
        keys.block("growth", growth(start, course));
    }
    keys
}

fn text(keys: &mut Keys, key: &str, text: &str) {
    keys.value(key, Value::Text(text.to_owned()));
}

fn place(keys: &mut Keys, key: &str, place: DVec3) {
    keys.value(key, list(place.to_array().map(number)));
}

fn cell_type(kind: &CellType, names: &[&str]) -> Keys {
    let mut keys = Keys::default();
    keys.number("initial_share", kind.initial_probability);
    if kind.division_days.is_finite() {
        keys.number("division_days", kind.division_days);
    }
    for (key, row) in [("switching", &kind.switching), ("adhesion", &kind.adhesion)] {
        let mut block = Keys::default();
        for (name, value) in names.iter().zip(row) {
            block.number_unless(name, *value, 0.0);
        }
        keys.block_if_any(key, block);
    }
    keys
}

fn growth(start: DVec3, course: GrowthCourse) -> Keys {
    let mut keys = Keys::default();
    place(&mut keys, "start", start);
    if let GrowthCourse::Logistic { middle, steepness } = course {
        keys.number("middle", middle);
        keys.number("steepness", steepness);
    }
    keys
}

fn control(control: &CylinderControl, names: &[&str]) -> Keys {
    let mut keys = Keys::default();
    place(&mut keys, "from_mm", control.from);
    place(&mut keys, "to_mm", control.to);
    if let Some(radius) = control.radius_mm {
        keys.number("radius_mm", radius);
    }
    let name = |kind: u16| names[usize::from(kind)];
    let mut factors = None;
    match control.steers {
        Steered::InitialType(kind) => {
            text(&mut keys, "steers", "initial_type");
            text(&mut keys, "type", name(kind));
        }
        Steered::DivisionRate { kind, low, high } => {
            text(&mut keys, "steers", "division_rate");
            if let Some(kind) = kind {
                text(&mut keys, "type", name(kind));
            }
            factors = Some((low, high));
        }
        Steered::Adhesion { pair, low, high } => {
            text(&mut keys, "steers", "adhesion");
            text(&mut keys, "type", name(pair[0]));
            text(&mut keys, "other_type", name(pair[1]));
            factors = Some((low, high));
        }
        Steered::Blocked => text(&mut keys, "steers", "blocked"),
    }
    if let Some((low, high)) = factors {
        keys.number("low", low);
        keys.number("high", high);
    }
    image(&mut keys, &control.image);
    keys
}

fn image(keys: &mut Keys, image: &ControlImage) {
    let mut block = Keys::default();
    let kind = match image {
        ControlImage::Constant(value) => {
            keys.number("constant", *value);
            return;
        }
        ControlImage::Picture { file, .. } => {
            text(&mut block, "path", file);
            "picture"
        }
        ControlImage::Stripes {
            count,
            share,
            waviness,
            bends,
            seed,
        } => {
            block.integer("count", (*count).into());
            block.number("share", *share);
            block.number("waviness", *waviness);
            block.number("bends", *bends);
            block.integer("seed", *seed);
            "stripes"
        }
        ControlImage::Rings { count, share } => {
            block.integer("count", (*count).into());
            block.number("share", *share);
            "rings"
        }
        ControlImage::Noise {
            around,
            octaves,
            threshold,
            seed,
        } => {
            block.integer("around", (*around).into());
            block.integer("octaves", (*octaves).into());
            if let Some(threshold) = threshold {
                block.number("threshold", *threshold);
            }
            block.integer("seed", *seed);
            "noise"
        }
    };
    keys.block(kind, block);
}
