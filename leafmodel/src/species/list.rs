//! The presets, in the order in which a list shows them.

use super::young::FORMS;
use super::{PlanOf, Preset, beyond, compound_leaves, runions, trees};

/// All presets: the figures of Runions et al. 2005 in their order, what goes beyond, trees and shrubs, compound leaves, then
/// the figures of Young 2010.
pub static PRESETS: &[Preset] = &with_forms();

/// The presets with a function of their own, then the forms.
const fn with_forms() -> [Preset; GROWN.len() + FORMS.len()] {
    let mut presets = [GROWN[0]; GROWN.len() + FORMS.len()];
    let mut i = 1;
    while i < presets.len() {
        presets[i] = if i < GROWN.len() {
            GROWN[i]
        } else {
            let form = &FORMS[i - GROWN.len()];
            Preset {
                name: form.name,
                about: form.about,
                source: form.source(),
                row: None,
                plan: PlanOf::Form(form),
            }
        };
        i += 1;
    }
    presets
}

/// The figures of Runions et al. 2005 in their order, what goes beyond, trees and shrubs, then compound leaves.
static GROWN: &[Preset] = &[
    Preset {
        name: "runions-9a",
        about: "Fig. 9a: kill distance 40. The sparsest of the five leaves a to e, and without loops",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_A),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_A)),
    },
    Preset {
        name: "runions-9b",
        about: "Fig. 9b: kill distance 20",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_B),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_B)),
    },
    Preset {
        name: "runions-9c",
        about: "Fig. 9c: kill distance 10",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_C),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_C)),
    },
    Preset {
        name: "runions-9d",
        about: "Fig. 9d: kill distance 5",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_D),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_D)),
    },
    Preset {
        name: "runions-9e",
        about: "Fig. 9e: kill distance 1. Higher-order veins emerge and join",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_E),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_E)),
    },
    Preset {
        name: "runions-9f",
        about: "Fig. 9f: few darts, 60 in 10⁶ segments squared and step",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_F),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_F)),
    },
    Preset {
        name: "runions-9g",
        about: "Fig. 9g: 300 darts",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_G),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_G)),
    },
    Preset {
        name: "runions-9h",
        about: "Fig. 9h: 6000 darts. Denser, more regular sources; smoother primary and secondary veins",
        source: "Table 1 of Runions et al. 2005, 4 units to a segment; outline by eye",
        row: Some(&runions::SEARCH_H),
        plan: PlanOf::Function(|| runions::searched(&runions::SEARCH_H)),
    },
    Preset {
        name: "runions-9i",
        about: "Fig. 9i: slow marginal growth. All vein tips follow the margin closely",
        source: "Table 1 of Runions et al. 2005, 100 units to a segment; birth distance 5 instead of 1, with which veins zigzag from source to source; outline by eye",
        row: Some(&runions::SLOW),
        plan: PlanOf::Function(runions::slow),
    },
    Preset {
        name: "ginkgo",
        about: "Fig. 10: open dichotomous veins, forking where the gap between tips grows too wide",
        source: "Table 1 of Runions et al. 2005, 15 units to a segment, so that the margin moves one segment a step; then segments and steps ten times as long, with kill distance and lengths in segments a tenth; outline by eye",
        row: Some(&runions::GINKGO),
        plan: PlanOf::Function(runions::ginkgo),
    },
    Preset {
        name: "alchemilla",
        about: "Fig. 11: lady's mantle. Major veins radiate from the petiole into a rounded blade",
        source: "Table 1 of Runions et al. 2005, 10 units to a segment; outline by eye",
        row: Some(&runions::ALCHEMILLA),
        plan: PlanOf::Function(runions::alchemilla),
    },
    Preset {
        name: "sweetgum",
        about: "Fig. 12: a major vein into each lobe of a digitate blade",
        source: "Table 1 of Runions et al. 2005, 10 units to a segment; outline by eye",
        row: Some(&runions::SWEETGUM),
        plan: PlanOf::Function(runions::sweetgum),
    },
    Preset {
        name: "toothed",
        about: "Fig. 13a: a toothed leaf; the venation reaches into its lobe",
        source: "Table 1 of Runions et al. 2005, 30 units to a segment; outline by eye",
        row: Some(&runions::TOOTHED),
        plan: PlanOf::Function(runions::toothed),
    },
    Preset {
        name: "tertiary",
        about: "Fig. 13b: sequences of tertiary veins off the lowest secondary veins, towards the margin",
        source: "Table 1 of Runions et al. 2005, 30 units to a segment; outline by eye",
        row: Some(&runions::TERTIARY),
        plan: PlanOf::Function(runions::tertiary),
    },
    Preset {
        name: "orchid",
        about: "Fig. 14: hierarchical primary and secondary veins, percurrent tertiaries between them",
        source: "Table 1 of Runions et al. 2005, 10 units to a segment; outline by eye",
        row: Some(&runions::ORCHID),
        plan: PlanOf::Function(runions::orchid),
    },
    Preset {
        name: "reticulate",
        about: "Fig. 15: a reticulate net of tertiary veins in a leaf that grows isogonically",
        source: "Table 1 of Runions et al. 2005, 5 units to a segment; outline by eye",
        row: Some(&runions::RETICULATE),
        plan: PlanOf::Function(runions::reticulate),
    },
    Preset {
        name: "cherry",
        about: "Fig. 16: Nankin cherry, a few open veins, widened for veinlets that are not drawn",
        source: "Table 1 of Runions et al. 2005, 7 units to a segment; 0.1 unseen veinlets a node; outline by eye",
        row: Some(&runions::CHERRY),
        plan: PlanOf::Function(runions::cherry),
    },
    Preset {
        name: "grass",
        about: "Figs. 14 and 17: parallel veins from a row of nodes at the base",
        source: "Table 1 of Runions et al. 2005, 10 units to a segment; 13 origins, 30 segments apart as sources are; outline by eye",
        row: Some(&runions::GRASS),
        plan: PlanOf::Function(runions::grass),
    },
    Preset {
        name: "poplar",
        about: "Fig. 18 left: a fine reticulate net, exact relative neighbourhoods",
        source: "Table 1 of Runions et al. 2005, 10 units to a segment; outline by eye",
        row: Some(&runions::POPLAR),
        plan: PlanOf::Function(runions::poplar_leaf),
    },
    Preset {
        name: "poplar-urquhart",
        about: "Fig. 18 right: the same with Urquhart's approximation; other secondaries, the same character",
        source: "Table 1 of Runions et al. 2005, 10 units to a segment; outline by eye",
        row: Some(&runions::POPLAR_URQUHART),
        plan: PlanOf::Function(runions::poplar_urquhart),
    },
    Preset {
        name: "poplar-fine",
        about: "The poplar with segments a third as long: smoother secondaries, a finer net",
        source: "Table 1 of Runions et al. 2005, 3 units to a segment; outline by eye",
        row: None,
        plan: PlanOf::Function(runions::poplar_fine),
    },
    Preset {
        name: "poplar-x10",
        about: "The poplar with segments a tenth as long, which has the vein density of a real leaf",
        source: "Table 1 of Runions et al. 2005, 1 unit to a segment, a tenth of the growth a step and of the darts; outline by eye",
        row: None,
        plan: PlanOf::Function(runions::poplar_x10),
    },
    Preset {
        name: "developmental",
        about: "Fig. 20: veins of rising order in a leaf that grows from narrow to nearly round",
        source: "Table 1 of Runions et al. 2005, 1 unit to a segment; growth functions by eye after Fig. 5, whose curves are not printed as numbers; outline by eye",
        row: Some(&runions::DEVELOPMENTAL),
        plan: PlanOf::Function(runions::developmental),
    },
    Preset {
        name: "trillium",
        about: "Fig. 21: a petal",
        source: "Table 1 of Runions et al. 2005, 5 units to a segment; outline by eye",
        row: Some(&runions::TRILLIUM),
        plan: PlanOf::Function(runions::trillium),
    },
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
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::maple),
    },
    Preset {
        name: "white-oak",
        about: "White oak: rounded lobes, pinnate veins",
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::white_oak),
    },
    Preset {
        name: "red-oak",
        about: "Red oak: lobes with bristle-pointed teeth",
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::red_oak),
    },
    Preset {
        name: "birch",
        about: "Silver birch: twice toothed, a vein into each large tooth",
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::birch),
    },
    Preset {
        name: "willow",
        about: "White willow: narrow, finely toothed",
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::willow),
    },
    Preset {
        name: "ivy",
        about: "Ivy: five shallow lobes, thick and dark",
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::ivy),
    },
    Preset {
        name: "magnolia",
        about: "Magnolia: large, leathery, secondaries in arches, veinlets that end freely",
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::magnolia),
    },
    Preset {
        name: "croton",
        about: "Croton, green",
        source: "length and kind of venation as floras give them; contents within the range of broad leaves; outline, veins and form by eye",
        row: None,
        plan: PlanOf::Function(trees::croton),
    },
    Preset {
        name: "ash",
        about: "Ash: five pairs of leaflets and one at the end of the rachis",
        source: "kind of leaf, usual number and length of leaflets as floras give them; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::ash),
    },
    Preset {
        name: "rose",
        about: "Rose: seven toothed leaflets",
        source: "kind of leaf, usual number and length of leaflets as floras give them; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::rose),
    },
    Preset {
        name: "horse-chestnut",
        about: "Horse chestnut: seven leaflets from one point",
        source: "kind of leaf, usual number and length of leaflets as floras give them; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::horse_chestnut),
    },
    Preset {
        name: "mimosa",
        about: "A mimosa: twice feathered, 360 small leaflets",
        source: "kind of leaf, usual number and length of leaflets as floras give them; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::mimosa),
    },
    Preset {
        name: "clover",
        about: "White clover: three leaflets shaped like inverted hearts",
        source: "kind of leaf, usual number and length of leaflets as floras give them; contents within the range of broad leaves; outline, veins, stalks and form by eye",
        row: None,
        plan: PlanOf::Function(compound_leaves::clover),
    },
];
