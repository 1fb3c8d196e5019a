//! Extensions of Runions et al. 2005, then trees and shrubs.

use super::super::{PlanOf, Preset, beyond, trees};

pub(super) static PLANTS: &[Preset] = &[
    Preset {
        name: "brochidodromous",
        about: "Secondary veins that join in arches along the margin, as section 7 of Runions et al. 2005 asks for",
        source: "ours: arches as in docs/src/theory/venation.md; outline by eye",
        row: None,
        plan: PlanOf::Function(beyond::brochidodromous),
    },
    Preset {
        name: "free-endings",
        about: "Veinlets that end freely inside the areoles of a closed net",
        source: "ours; areoles of about 0.6 mm as in many broad leaves; outline by eye",
        row: None,
        plan: PlanOf::Function(beyond::free_endings),
    },
    Preset {
        name: "cupped",
        about: "Veins grown on a dome with the metric of a sphere: straight ways bend in its map",
        source: "ours: Gaussian curvature 6 over the length squared; outline by eye",
        row: None,
        plan: PlanOf::Function(beyond::cupped),
    },
    Preset {
        name: "maple",
        about: "A maple with five pointed lobes; a primary vein into each",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::maple),
    },
    Preset {
        name: "white-oak",
        about: "White oak: rounded lobes, pinnate veins",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::white_oak),
    },
    Preset {
        name: "red-oak",
        about: "Red oak: lobes with bristle-pointed teeth",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::red_oak),
    },
    Preset {
        name: "cottonwood",
        about: "Eastern cottonwood, a poplar as it grows: triangular, coarsely toothed, a fine net",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::cottonwood),
    },
    Preset {
        name: "birch",
        about: "Silver birch: twice toothed, a vein into each large tooth",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::birch),
    },
    Preset {
        name: "willow",
        about: "White willow: narrow, finely toothed",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::willow),
    },
    Preset {
        name: "ivy",
        about: "Ivy: five shallow lobes, thick and dark",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::ivy),
    },
    Preset {
        name: "magnolia",
        about: "Magnolia: large, leathery, secondaries in arches, veinlets that end freely",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::magnolia),
    },
    Preset {
        name: "croton",
        about: "Croton, green",
        source: "length and kind of venation as floras give them; contents each with its own source (--about); outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::croton),
    },
];
