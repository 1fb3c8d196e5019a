//! Venations as blocks.

use leafmodel::transport::{FilledPlan, VeinStyle};
use leafmodel::venation::arcuate::ArcuatePlan;
use leafmodel::venation::plan::{AuxinPlan, Growth, Neighbourhood, Pattern};

use super::{Keys, list, pair};
use crate::scene::document::tree::Value;
use crate::scene::document::venation::LEAST_CELLS;

pub(super) fn arcuate(plan: &ArcuatePlan) -> Keys {
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

pub(super) fn vein_style(style: VeinStyle) -> Keys {
    let mut keys = Keys::default();
    keys.number("base_radius_mm", style.base_radius_mm);
    if style.least_cells != LEAST_CELLS {
        keys.integer("least_cells", style.least_cells.into());
    }
    keys
}

pub(super) fn filled(plan: &FilledPlan) -> Keys {
    let usual = FilledPlan::default();
    let mut keys = vein_style(plan.style);
    keys.number_unless("alpha", plan.alpha, usual.alpha);
    keys.number_unless("beta", plan.beta, usual.beta);
    if plan.cells_along != usual.cells_along {
        keys.integer("cells_along", plan.cells_along.into());
    }
    keys
}

pub(super) fn auxin(plan: &AuxinPlan) -> (&'static str, Keys) {
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
