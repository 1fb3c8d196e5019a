//! `venation`: how the veins of a leaf come to be.

mod auxin;

use self::auxin::report;
use crate::document::keys::Keys;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::shape::outline::Outline;
use crate::venation::{self, VenationError};

/// Checks veins that each of their numbers allows against the outline; `keys` are the leaf's.
pub(super) fn check(plan: &LeafPlan, outline: Option<&Outline>, keys: &Keys<'_>) {
    match &plan.venation {
        VenationPlan::Auxin(auxin) => {
            if let Some(Err(VenationError::Plan(error))) =
                outline.map(|outline| venation::check(outline, auxin))
            {
                report(keys, &error);
            }
        }
        VenationPlan::Transport(filled) => {
            if let Some(Err(error)) = outline.map(|outline| filled.check(outline)) {
                error.within("venation.transport").report(keys);
            }
        }
        VenationPlan::Cells(_) => {
            if !matches!(plan.outline.contour, Contour::Transport(_)) {
                let problem = "the outline has no cells: it is not that of a transport leaf";
                let help = "write [leaves.NAME.outline.transport], or choose another venation";
                keys.refuse(&["venation", "cells"], problem.to_owned(), help);
            }
        }
        VenationPlan::Development(_) => {
            if !matches!(plan.outline.contour, Contour::Development(_)) {
                let problem = "the outline has no main veins: it does not develop from its margin";
                let help = "write [leaves.NAME.outline.development], or choose another venation";
                keys.refuse(&["venation", "development"], problem.to_owned(), help);
            }
        }
        VenationPlan::Arcuate(_) => {}
    }
}
