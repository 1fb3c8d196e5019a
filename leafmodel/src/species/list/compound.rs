//! Extensions of Young 2010, then compound leaves.

use super::super::{PlanOf, Preset, compound_leaves, extended, maple};

pub(super) static COMPOUND: &[Preset] = &[
    Preset {
        name: "maple-palmate",
        about: "A maple that grows: five lobes on axes of their own, a primary vein along each",
        source: "palmate axes as section IV of Young 2010 asks for; all numbers by eye",
        row: None,
        plan: PlanOf::Function(maple::plan),
    },
    Preset {
        name: "begonia",
        about: "Unlike halves: a broad one that hangs down beside the petiole, and a narrow one",
        source: "left–right asymmetry as section V of Young 2010 names it; all numbers by eye",
        row: None,
        plan: PlanOf::Function(extended::begonia),
    },
    Preset {
        name: "dogwood",
        about: "Veins that bend towards the tip, in the outline's growth as in the venation",
        source: "nonlinear veins as section V of Young 2010 names them; all numbers by eye",
        row: None,
        plan: PlanOf::Function(extended::dogwood),
    },
    Preset {
        name: "ash",
        about: "Ash: five pairs of leaflets and one at the end of the rachis",
        source: "kind of leaf, number and length of leaflets as generally known, no flora consulted; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::ash),
    },
    Preset {
        name: "rose",
        about: "Rose: seven toothed leaflets",
        source: "kind of leaf, number and length of leaflets as generally known, no flora consulted; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::rose),
    },
    Preset {
        name: "horse-chestnut",
        about: "Horse chestnut: seven leaflets from one point",
        source: "kind of leaf, number and length of leaflets as generally known, no flora consulted; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::horse_chestnut),
    },
    Preset {
        name: "mimosa",
        about: "A mimosa: twice feathered, 360 small leaflets",
        source: "kind of leaf, number and length of leaflets as generally known, no flora consulted; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::mimosa),
    },
    Preset {
        name: "clover",
        about: "White clover: three leaflets shaped like inverted hearts",
        source: "kind of leaf, number and length of leaflets as generally known, no flora consulted; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::clover),
    },
];
