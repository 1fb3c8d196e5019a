//! `venation`: how the veins of a leaf come to be.

mod architecture;
mod auxin;

use self::auxin::{auxin, report};
use crate::development::MainVeinStyle;
use crate::document::keys::{Keys, Variant};
use crate::document::limits::Limits;
use crate::document::value_kind::{Integer, Number};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::shape::outline::Outline;
use crate::transport::{FilledPlan, TransportError, VeinStyle};
use crate::variant;
use crate::venation::arcuate::{ArcuatePlan, PalmateVeins};
use crate::venation::plan::{AuxinPlan, Pattern};
use crate::venation::{self, VenationError};

/// Veins that supply fewer cells are left out where nothing is said.
const LEAST_CELLS: u32 = 3;
const SHARE: Number = Number(Limits::closed(0.0, 1.0));
const RADII_MM: Number = Number(Limits::closed(1e-4, 100.0));

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
                auxin(plan, keys, true);
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
                auxin(plan, keys, false);
            }
        },
    },
    variant!(
        "arcuate",
        VenationPlan::Arcuate,
        arcuate,
        "Veins are splines."
    ),
    Variant {
        name: "cells",
        about: "The network that the outline of a transport leaf was grown with.",
        new: || VenationPlan::Cells(usual_style()),
        is: |plan| matches!(plan, VenationPlan::Cells(_)),
        declare: |plan, keys| {
            if let VenationPlan::Cells(plan) = plan {
                style(plan, keys);
            }
        },
    },
    variant!(
        "transport",
        VenationPlan::Transport,
        filled,
        "The cheapest transport network that supplies the blade."
    ),
    variant!(
        "development",
        VenationPlan::Development,
        main_veins,
        "The main veins alone of a leaf that develops from its margin."
    ),
];

fn usual_style() -> VeinStyle {
    VeinStyle {
        base_radius_mm: FilledPlan::default().style.base_radius_mm,
        least_cells: LEAST_CELLS,
    }
}

fn style(style: &mut VeinStyle, keys: &mut Keys<'_>) {
    let about =
        "Radius of the midrib at the base; elsewhere it goes with the root of what is supplied.";
    keys.required("base_radius_mm", &mut style.base_radius_mm, RADII_MM, about);
    let count = Integer::within(1, 1_000_000);
    let about = "Veins that supply fewer cells are left out.";
    keys.key("least_cells", &mut style.least_cells, count, about);
}

fn main_veins(style: &mut MainVeinStyle, keys: &mut Keys<'_>) {
    let about = "Radius of the midrib at the base.";
    keys.key("base_radius_mm", &mut style.base_radius_mm, RADII_MM, about);
    let limits = Number(Limits::closed(0.5, 10.0));
    let about = "n of Murray's law: rⁿ adds up from the tips to the base.";
    keys.key("murray_exponent", &mut style.murray_exponent, limits, about);
}

fn filled(plan: &mut FilledPlan, keys: &mut Keys<'_>) {
    let limits = Number(Limits::open(0.0, 1.0));
    let about = "α: how little it saves to transport much together.";
    keys.key("alpha", &mut plan.alpha, limits, about);
    let limits = Number(Limits::above(0.0, 20.0));
    let about = "β: how dearly a change of direction is paid.";
    keys.key("beta", &mut plan.beta, limits, about);
    let count = Integer::within(4, 200);
    let about = "Cells along the midrib.";
    keys.key("cells_along", &mut plan.cells_along, count, about);
    style(&mut plan.style, keys);
}

fn arcuate(plan: &mut ArcuatePlan, keys: &mut Keys<'_>) {
    let count = Integer::within(1, 100);
    keys.key(
        "laterals",
        &mut plan.veins,
        count,
        "Veins: lateral veins a side of each primary.",
    );
    let count = Integer::within(0, u32::MAX as u64);
    keys.key("seed", &mut plan.seed, count, "Seed of their irregularity.");
    let limits = Number(Limits::closed(1e-4, 0.5));
    let about = "Width: half width of the midrib at the base. The default is the article's, \
        where veins merge; a leaf's is about 0.006.";
    let [variation, squish] = [
        "How irregular they are.",
        "Squish: how end points are spread over the margin: 1 evenly (pinnate), 0 all at the tip \
            (arcuate).",
    ];
    keys.key("variation", &mut plan.variation, SHARE, variation);
    keys.key("width", &mut plan.width, limits, about);
    let about = "NWidth: how far from veins the finer net reaches (field `net` only).";
    keys.key("net_width", &mut plan.net_width, SHARE, about);
    keys.key("squish", &mut plan.squish, SHARE, squish);
    let about = "Squish2: the same of control points.";
    keys.key("squish2", &mut plan.squish2, SHARE, about);
    let about = "Squish3: the same of starting points on the midrib; 0 all near the base.";
    keys.key("squish3", &mut plan.squish3, SHARE, about);
    let limits = Number(Limits::closed(0.0, 2.0));
    let about = "Up: how far control points are from the midrib, over the margin's distance.";
    keys.key("up", &mut plan.up, limits, about);
    let about = "Share of a vein's width that is left at its tip.";
    keys.key("tip_width", &mut plan.tip_width, SHARE, about);
    let new = || PalmateVeins {
        per_side: 1,
        spread: 0.5,
        bow: 0.0,
    };
    let about = "Primary veins from the base, beside the midrib.";
    keys.optional_block("palmate", &mut plan.palmate, new, about, |palmate, keys| {
        let count = Integer::within(1, 12);
        let about = "Primaries a side.";
        keys.required("per_side", &mut palmate.per_side, count, about);
        let limits = Number(Limits::closed(0.05, 1.0));
        let about = "How far down the margin they end: 1 spreads them evenly from base to tip.";
        keys.required("spread", &mut palmate.spread, limits, about);
        let limits = Number(Limits::closed(-0.8, 0.8));
        keys.key(
            "bow",
            &mut palmate.bow,
            limits,
            "How much they bow outwards, in shares of half \
            their length.",
        );
    });
}

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
