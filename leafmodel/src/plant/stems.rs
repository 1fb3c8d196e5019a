//! The stems of a plant: where each begins, how it leans, how long it gets.

use glam::DVec3;

use super::climbing::Wall;
use super::plan::{AxisPlan, Phyllotaxis, PlantPlan};
use crate::random::{Use, uniform};
use crate::rotation::about;

/// Least length of the stems of a plant over that of the first.
const SHORTEST_STEM: f64 = 0.6;
/// How deep a stem begins below the soil of its pot, in radii.
const PLANTED: f64 = 2.0;

/// A stem: its plan, its foot and its direction there.
pub(super) fn stem_of(
    plan: &PlantPlan,
    stem: u32,
    wall: Option<&Wall>,
) -> (AxisPlan, DVec3, DVec3) {
    let (sin, cos) = libm::sincos(plan.axis.inclination);
    let mut along = DVec3::new(0.0, sin, cos);
    if let Some(wall) = wall {
        along = wall.within(along);
    }
    let mut axis = plan.axis;
    let mut at = DVec3::ZERO;
    let stems = &plan.stems;
    let chance = |what: u64| uniform(plan.seed, Use::Stem, 4 * u64::from(stem) + what);
    if stems.count > 1 {
        let share = (f64::from(stem) + 0.5) / f64::from(stems.count);
        if let Some(wall) = wall {
            let across = wall.beside(DVec3::Z);
            // Left and right by turns, so that the first stands in the middle.
            let side = if stem.is_multiple_of(2) { 1.0 } else { -1.0 };
            let out = side * (f64::from(stem.div_ceil(2)) + 0.4 * (chance(0) - 0.5))
                / f64::from(stems.count / 2).max(1.0);
            at = wall.below(across * (out * stems.spread_mm));
            let lean = stems.fan * (out + 0.3 * (chance(1) - 0.5));
            along = about(wall.away(), -lean) * along;
        } else {
            let turned = f64::from(stem) * Phyllotaxis::SPIRAL.divergence + chance(0);
            let (sin, cos) = libm::sincos(turned);
            let out = DVec3::new(cos, sin, 0.0);
            at = out * (share.sqrt() * stems.spread_mm);
            along = (along + out * libm::tan(share * stems.fan)).normalize();
        }
        if stem > 0 {
            let ratio = SHORTEST_STEM + (1.0 - SHORTEST_STEM) * chance(2);
            axis = shortened(&axis, ratio);
        }
    }
    if let Some(pot) = &plan.pot {
        let within = 0.8 * pot.soil_radius();
        at = at.clamp_length_max(within);
        at.z = pot.soil_height() - PLANTED * axis.radius_mm[0];
    }
    (axis, at, along)
}

/// A shorter axis with as many nodes as that length has on it.
fn shortened(axis: &AxisPlan, ratio: f64) -> AxisPlan {
    let nodes = ((f64::from(axis.nodes) * ratio).round() as u32).max(1);
    let shorter = AxisPlan {
        length_mm: (axis.length_mm * ratio).max(1.0),
        nodes,
        ..*axis
    };
    (1..=nodes)
        .rev()
        .map(|nodes| AxisPlan { nodes, ..shorter })
        .find(|axis| axis.has_room().is_ok())
        .unwrap_or(*axis)
}
