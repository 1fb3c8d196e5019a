//! Where secondary veins leave their primaries, how they run and where they end.

pub(crate) mod agrophic;
mod between;
mod laid;
mod row;
mod targets;

use glam::DVec2;

pub(crate) use self::laid::{Laid, Secondary, Site};
use self::row::{Row, one_side};
use super::course::Axis;
use super::{Architecture, Arrangement, Secondaries};
use super::{PrimaryPattern, SecondarySpacing};

/// Exponent of uneven spacing.
const UNEVEN: f64 = 1.4;

impl Secondaries {
    /// Angle at a share of the axis, degrees: the thirds' in their middles, even between.
    fn angle_at(&self, share: f64) -> f64 {
        let [base, middle, apex] = self.angles_deg;
        let place = (share - 1.0 / 6.0) * 3.0;
        if place < 1.0 {
            base + (middle - base) * place.max(-0.5)
        } else {
            middle + (apex - middle) * (place - 1.0).min(1.5)
        }
    }

    /// Places of `count` veins of one side, shares of the axis, ascending.
    fn places(&self, count: u32, span: [f64; 2], shifted: f64) -> Vec<f64> {
        let even = |k: u32| {
            let t = if count > 1 {
                (f64::from(k) + shifted) / (f64::from(count) - 1.0 + 0.5)
            } else {
                0.5
            };
            match self.spacing {
                SecondarySpacing::Regular => t,
                SecondarySpacing::IncreasingProximally => 1.0 - libm::pow(1.0 - t, UNEVEN),
                SecondarySpacing::DecreasingProximally => libm::pow(t, UNEVEN),
            }
        };
        (0..count)
            .map(|k| span[0] + (span[1] - span[0]) * even(k))
            .collect()
    }
}

/// The secondaries of all primaries.
pub(crate) fn lay_out(architecture: &Architecture, site: Site<'_>) -> Laid {
    let mut laid = Laid::default();
    let mut taken: Vec<DVec2> = site.axes.iter().map(|axis| axis.course.at(1.0).0).collect();
    for axis in 0..site.axes.len() {
        for side in [1.0, -1.0] {
            let row = Row {
                axis,
                side,
                places: places(architecture, site.axes, axis, side),
            };
            one_side(&architecture.secondaries, site, &row, &mut taken, &mut laid);
        }
    }
    agrophic::lay_out(architecture, site, &mut taken, &mut laid);
    laid
}

/// How many veins a side of an axis bears, and where.
fn places(architecture: &Architecture, axes: &[Axis], axis: usize, side: f64) -> Vec<f64> {
    let plan = &architecture.secondaries;
    let shifted = match plan.arrangement {
        Arrangement::Opposite => 0.25,
        Arrangement::Alternate if side > 0.0 => 0.0,
        Arrangement::Alternate => 0.5,
    };
    if axis == 0 {
        return plan.places(plan.pairs, plan.span, shifted);
    }
    match architecture.primaries.pattern {
        PrimaryPattern::Pinnate
        | PrimaryPattern::Actinodromous
        | PrimaryPattern::Palinactinodromous => {}
        PrimaryPattern::Acrodromous
        | PrimaryPattern::Parallelodromous
        | PrimaryPattern::Campylodromous
        | PrimaryPattern::Flabellate => return Vec::new(),
    }
    if plan.pairs == 0 {
        return Vec::new();
    }
    let share = axes[axis].course.length() / axes[0].course.length();
    let gap = (plan.span[1] - plan.span[0]) / f64::from(plan.pairs.max(2) - 1);
    let span = [plan.span[0].max(0.18), plan.span[1]];
    let count = ((span[1] - span[0]) * share / gap).round().max(1.0) as u32;
    plan.places(count, span, shifted)
}
