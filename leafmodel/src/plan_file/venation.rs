//! `venation`: how the veins of a leaf come to be.

mod auxin;

use self::auxin::report;
use crate::document::declared::Declared;
use crate::document::keys::{Keys, Variant};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::shape::outline::Outline;
use crate::transport::{FilledPlan, TransportError};
use crate::variant;
use crate::venation::plan::{AuxinPlan, Pattern};
use crate::venation::{self, VenationError};

/// The kinds of venation.
pub(super) const KINDS: [Variant<VenationPlan>; 6] = [
    Variant {
        name: "closed",
        about: "Veins grow towards auxin and meet.",
        new: || AuxinPlan::default().into(),
        is: |plan| {
            let plan = plan.auxin();
            plan.is_some_and(|plan| matches!(plan.pattern, Pattern::Closed(_)))
        },
        declare: |plan, keys| {
            if let VenationPlan::Auxin(plan) = plan {
                plan.declare(keys);
            }
        },
    },
    Variant {
        name: "open",
        about: "Veins grow towards auxin and never meet.",
        new: || {
            let pattern = Pattern::Open;
            VenationPlan::Auxin(AuxinPlan {
                pattern,
                ..AuxinPlan::default()
            })
        },
        is: |plan| {
            let plan = plan.auxin();
            plan.is_some_and(|plan| plan.pattern == Pattern::Open)
        },
        declare: |plan, keys| {
            if let VenationPlan::Auxin(plan) = plan {
                plan.declare(keys);
            }
        },
    },
    variant!(
        "arcuate",
        VenationPlan::Arcuate,
        Declared::declare,
        "Veins are splines."
    ),
    Variant {
        name: "cells",
        about: "The network that the outline of a transport leaf was grown with.",
        new: || VenationPlan::Cells(FilledPlan::default().style),
        is: |plan| matches!(plan, VenationPlan::Cells(_)),
        declare: |plan, keys| {
            if let VenationPlan::Cells(plan) = plan {
                plan.declare(keys);
            }
        },
    },
    variant!(
        "transport",
        VenationPlan::Transport,
        Declared::declare,
        "The cheapest transport network that supplies the blade."
    ),
    variant!(
        "development",
        VenationPlan::Development,
        Declared::declare,
        "The main veins alone of a leaf that develops from its margin."
    ),
];

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
            if let Some(Err(error @ TransportError::TooFine { .. })) =
                outline.map(|outline| filled.check(outline))
            {
                let help = "use fewer cells along the midrib";
                let path = ["venation", "transport", "cells_along"];
                keys.refuse(&path, error.to_string(), help);
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
