//! Leaves in other colours than summer's green.

use super::super::colours::COLOURED;
use super::super::{PlanOf, Preset};

const SOURCE: &str = "contents each with its own source (--about); outline, veins, form and where the colours lie by eye";

/// Descriptions, in the order of [`COLOURED`].
const ABOUT: [&str; COLOURED.len()] = [
    "Ginkgo in autumn: clear yellow, browning at the upper margin",
    "Silver birch in autumn: brownish yellow, green along the veins",
    "Eastern cottonwood in autumn: yellow with brown spots",
    "Sugar maple in autumn: orange, some of it still yellow and green",
    "Red maple in autumn: scarlet, paler veins",
    "Sweetgum in autumn: purple-red over some green",
    "White oak, fallen: brown and dry",
    "Smoke tree, a purple-leaved one in summer: green and red together",
    "Box elder with white margins: five leaflets, each with sectors of its own",
    "Ivy with a cream margin",
    "Red maple that lacks iron: green veins in a pale blade",
    "Croton with yellow blotches: a clonal mosaic",
    "Joseph's coat: red, yellow and green with betalains",
];

/// The presets of coloured leaves.
pub(super) static COLOURS: [Preset; COLOURED.len()] = {
    let mut presets = [preset(0); COLOURED.len()];
    let mut i = 1;
    while i < presets.len() {
        presets[i] = preset(i);
        i += 1;
    }
    presets
};

const fn preset(i: usize) -> Preset {
    Preset {
        name: COLOURED[i].preset,
        about: ABOUT[i],
        source: SOURCE,
        row: None,
        plan: PlanOf::Coloured(&COLOURED[i]),
    }
}
