//! The leaves of Xia 2007: blades that grow as transport networks, with these networks as veins.
//!
//! Examples 1 and 2 have the paper's parameters. It prints none for Examples 3 and 4, and of
//! Example 5 it only says that `α` varies while `β` does not. `docs/src/theory/transport-leaf.md`
//! describes the search for the parameters used here. Lengths, radii, contents and forms are our
//! own.

use super::{green_leaf, trees};
use crate::blade::senescence::{AgeSource, Senescence};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::optics::Constituent::{
    Anthocyanins, Brown, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
};
use crate::optics::Contents;
use crate::transport::{FilledPlan, TransportPlan, VeinStyle, example};
use crate::venation::plan::AuxinPlan;

/// How large a leaf is, and how its veins are drawn.
struct Look {
    length_mm: f64,
    base_radius_mm: f64,
    least_cells: u32,
    /// About how many cells it has.
    cells: f64,
}

fn leaf(plan: TransportPlan, look: &Look) -> LeafPlan {
    let finest = f64::from(look.least_cells) / look.cells;
    let style = VeinStyle {
        base_radius_mm: look.base_radius_mm,
        least_cells: look.least_cells,
    };
    // Only the radius of the finest veins is used, for the contents and relief of veins.
    let usual = AuxinPlan {
        veinlet_radius_mm: look.base_radius_mm * finest.sqrt(),
        ..AuxinPlan::default()
    };
    LeafPlan {
        venation: VenationPlan::Cells(style),
        ..green_leaf(look.length_mm, 1, Contour::Transport(plan).into(), usual)
    }
}

fn plan(number: usize) -> TransportPlan {
    example(number).expect("there are five examples")
}

pub(super) fn example_1() -> LeafPlan {
    let look = Look {
        length_mm: 60.0,
        base_radius_mm: 0.6,
        least_cells: 1,
        cells: 554.0,
    };
    leaf(plan(1), &look)
}

pub(super) fn example_2() -> LeafPlan {
    let look = Look {
        length_mm: 120.0,
        base_radius_mm: 1.0,
        least_cells: 3,
        cells: 3860.0,
    };
    leaf(plan(2), &look)
}

pub(super) fn example_3() -> LeafPlan {
    let look = Look {
        length_mm: 90.0,
        base_radius_mm: 0.9,
        least_cells: 2,
        cells: 1907.0,
    };
    leaf(plan(3), &look)
}

pub(super) fn example_4() -> LeafPlan {
    // The paper scales both of its leaves to 4.5 cm from end to end.
    let look = Look {
        length_mm: 39.8,
        base_radius_mm: 0.45,
        least_cells: 2,
        cells: 980.0,
    };
    leaf(plan(4), &look)
}

/// Example 1 after its outer cells have died. The paper mentions this (Remark 3.6) but does not
/// show it.
pub(super) fn autumn() -> LeafPlan {
    let mut leaf = example_1();
    leaf.tissue.lamina[Chlorophyll] = 20.0;
    leaf.tissue.lamina[Carotenoids] = 8.0;
    leaf.senescence = Some(Senescence {
        source: AgeSource::Revenue { share: 0.84 },
        blend: 0.09,
        contents: Contents::of(&[
            (Structure, 2.0),
            (Chlorophyll, 0.5),
            (Carotenoids, 6.0),
            (Anthocyanins, 1.0),
            (Brown, 0.7),
            (Water, 0.002),
            (DryMatter, 0.005),
        ]),
    });
    leaf
}

/// The maple of `trees` with transport-optimal veins.
pub(super) fn maple() -> LeafPlan {
    let plan = FilledPlan {
        alpha: 0.6,
        beta: 0.5,
        cells_along: 90,
        style: VeinStyle {
            base_radius_mm: 0.9,
            least_cells: 2,
        },
    };
    let mut leaf = trees::maple();
    leaf.venation = plan.into();
    leaf
}

/// A member of the sweep of Example 5, and how many cells it has.
pub(super) fn example_5(alpha: f64, cells: f64) -> LeafPlan {
    let look = Look {
        length_mm: 60.0,
        base_radius_mm: 0.6,
        least_cells: if cells > 1500.0 { 3 } else { 1 },
        cells,
    };
    let plan = TransportPlan { alpha, ..plan(5) };
    leaf(plan, &look)
}
