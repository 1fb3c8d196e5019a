//! Agrophic veins: combs that basal secondaries bear on their outer side.
//!
//! A comb ends as the secondaries do: in teeth of its own, in arches, or dwindling inside the
//! margin.
//!
//! # Source
//!
//! \[ellis2009\]: two or more veins that leave a lateral primary or basal secondary on its outer
//! side, on roughly parallel courses towards the margin; simple if one pair of veins bears them,
//! else compound.

use glam::DVec2;

use super::laid::{Laid, Secondary, Site};
use super::row::{Row, one_side};
use crate::venation::architecture::course::Axis;
use crate::venation::architecture::{Architecture, Attachment, Secondaries};

/// A comb has at least so many veins.
pub(crate) const LEAST: usize = 2;

/// The part of a bearing secondary along which they leave, shares of its length: of the lowest, and
/// of the next, whose inner part has the lowest beside it.
const SPANS: [[f64; 2]; 2] = [[0.16, 0.86], [0.5, 0.9]];

/// Their angle to the bearing secondary over that of the secondaries to the midrib, likewise: the
/// outer comb runs out between its secondary and the lowest.
const TURNS: [f64; 2] = [1.0, 0.62];

/// The numbers of the secondaries that bear combs.
pub(crate) fn bearers(plan: &Secondaries, veins: &[Secondary]) -> Vec<usize> {
    let mut found = Vec::new();
    for side in [1.0, -1.0] {
        let of_midrib = |&i: &usize| veins[i].axis == 0 && veins[i].side == side;
        let of_side = (0..veins.len()).filter(of_midrib);
        found.extend(of_side.take(plan.agrophic.combs()));
    }
    found
}

/// Adds the combs that an architecture asks for.
pub(super) fn lay_out(
    architecture: &Architecture,
    site: Site<'_>,
    taken: &mut Vec<DVec2>,
    laid: &mut Laid,
) {
    let plan = &architecture.secondaries;
    let combs = plan.agrophic.combs();
    if combs == 0 {
        return;
    }
    let bearers = bearers(plan, &laid.veins);
    let mut axes = site.axes.to_vec();
    axes.extend(bearers.iter().map(|&bearer| {
        let vein = &laid.veins[bearer];
        Axis::new(vein.course.clone(), vein.side, 1)
    }));
    let midrib = site.axes[0].course.length();
    let gap = (plan.span[1] - plan.span[0]) / f64::from(plan.pairs.max(2) - 1);
    for (i, &bearer) in bearers.iter().enumerate() {
        let axis = site.axes.len() + i;
        let span = SPANS[i % combs];
        // As far apart as the secondaries, but enough for a comb.
        let length = axes[axis].course.length() / midrib;
        let fit = ((span[1] - span[0]) * length / (0.8 * gap)).round();
        let count = (fit as u32 + 1).max(LEAST as u32 + 1);
        let row = Row {
            axis,
            side: laid.veins[bearer].side,
            places: plan.places(count, span, 0.25),
        };
        let site = Site {
            axes: &axes,
            ..site
        };
        let comb = Secondaries {
            angles_deg: plan.angles_deg.map(|angle| TURNS[i % combs] * angle),
            attachment: Attachment::Excurrent,
            intersecondaries: 0.0,
            ..plan.clone()
        };
        let mut found = Laid::default();
        one_side(&comb, site, &row, taken, &mut found);
        laid.finer.extend(found.finer);
        let of_bearer = found.veins.into_iter().map(|vein| Secondary {
            axis: bearer,
            ..vein
        });
        laid.agrophic.veins.extend(of_bearer);
    }
}
