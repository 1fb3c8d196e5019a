//! Presets for the figures and the rows of Table 1 of Runions et al. 2005.

use super::leaf_traits::{self, LeafTraits};
use super::table_1::{Row, RowGrowth};
use super::{contours, green_leaf};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::venation::plan::{AuxinPlan, Growth, Neighbourhood, Pattern};

const CLOSED: Pattern = Pattern::Closed(Neighbourhood::Relative);

/// Kill distance and darts per 10⁶ segments squared of the parameter searches (Fig. 9a–h).
const fn search(kill_distance: f64, darts: f64) -> Row {
    Row {
        pattern: CLOSED,
        kill_distance,
        birth_distance: 10.0,
        initial_length: 270.0,
        final_length: 1600.0,
        growth: RowGrowth::Marginal(8.0),
        darts,
        murray_exponent: 2.0,
        leaf_unit: 4.0,
    }
}

pub(super) static SEARCH_A: Row = search(40.0, 600.0);
pub(super) static SEARCH_B: Row = search(20.0, 600.0);
pub(super) static SEARCH_C: Row = search(10.0, 600.0);
pub(super) static SEARCH_D: Row = search(5.0, 600.0);
pub(super) static SEARCH_E: Row = search(1.0, 600.0);
pub(super) static SEARCH_F: Row = search(1.0, 60.0);
pub(super) static SEARCH_G: Row = search(1.0, 300.0);
pub(super) static SEARCH_H: Row = search(1.0, 6000.0);

pub(super) static SLOW: Row = Row {
    pattern: Pattern::Open,
    kill_distance: 40.0,
    birth_distance: 1.0,
    initial_length: 4500.0,
    final_length: 112_000.0,
    growth: RowGrowth::Marginal(34.0),
    darts: 300.0,
    murray_exponent: 2.0,
    leaf_unit: 100.0,
};

pub(super) static GINKGO: Row = Row {
    pattern: Pattern::Open,
    kill_distance: 100.0,
    birth_distance: 1.0,
    initial_length: 10.0,
    final_length: 50_000.0,
    growth: RowGrowth::Marginal(15.0),
    darts: 300.0,
    murray_exponent: 2.0,
    leaf_unit: 15.0,
};

pub(super) static ALCHEMILLA: Row = Row {
    pattern: Pattern::Open,
    kill_distance: 10.0,
    birth_distance: 1.0,
    initial_length: 3200.0,
    final_length: 4500.0,
    growth: RowGrowth::Marginal(9.0),
    darts: 200.0,
    murray_exponent: 2.0,
    leaf_unit: 10.0,
};

pub(super) static SWEETGUM: Row = Row {
    pattern: Pattern::Open,
    kill_distance: 1.0,
    birth_distance: 1.0,
    initial_length: 1200.0,
    final_length: 6700.0,
    growth: RowGrowth::Marginal(7.0),
    darts: 200.0,
    murray_exponent: 2.0,
    leaf_unit: 10.0,
};

pub(super) static TOOTHED: Row = Row {
    pattern: CLOSED,
    kill_distance: 1.0,
    birth_distance: 10.0,
    initial_length: 6600.0,
    final_length: 26_000.0,
    growth: RowGrowth::Marginal(40.0),
    darts: 10.0,
    murray_exponent: 2.0,
    leaf_unit: 30.0,
};

pub(super) static TERTIARY: Row = Row {
    pattern: CLOSED,
    kill_distance: 1.0,
    birth_distance: 1.0,
    initial_length: 3500.0,
    final_length: 24_000.0,
    growth: RowGrowth::Marginal(60.0),
    darts: 20.0,
    murray_exponent: 2.0,
    leaf_unit: 30.0,
};

pub(super) static ORCHID: Row = Row {
    pattern: CLOSED,
    kill_distance: 1.0,
    birth_distance: 10.0,
    initial_length: 0.0,
    final_length: 6500.0,
    growth: RowGrowth::None,
    darts: 600.0,
    murray_exponent: 2.0,
    leaf_unit: 10.0,
};

pub(super) static RETICULATE: Row = Row {
    pattern: CLOSED,
    kill_distance: 1.0,
    birth_distance: 15.0,
    initial_length: 225.0,
    final_length: 4500.0,
    growth: RowGrowth::Isogonic(40.5),
    darts: 200.0,
    murray_exponent: 2.0,
    leaf_unit: 5.0,
};

pub(super) static CHERRY: Row = Row {
    pattern: Pattern::Open,
    kill_distance: 30.0,
    birth_distance: 1.0,
    initial_length: 1100.0,
    final_length: 5500.0,
    growth: RowGrowth::Marginal(11.0),
    darts: 40.0,
    murray_exponent: 2.0,
    leaf_unit: 7.0,
};

pub(super) static GRASS: Row = Row {
    pattern: CLOSED,
    kill_distance: 1.0,
    birth_distance: 30.0,
    initial_length: 0.0,
    final_length: 13_000.0,
    growth: RowGrowth::None,
    darts: 100.0,
    murray_exponent: 2.0,
    leaf_unit: 10.0,
};

const fn poplar(pattern: Pattern) -> Row {
    Row {
        pattern,
        kill_distance: 1.0,
        birth_distance: 2.0,
        initial_length: 115.0,
        final_length: 3500.0,
        growth: RowGrowth::Isogonic(9.0),
        darts: 200.0,
        murray_exponent: 2.0,
        leaf_unit: 10.0,
    }
}

pub(super) static POPLAR: Row = poplar(CLOSED);
pub(super) static POPLAR_URQUHART: Row = poplar(Pattern::Closed(Neighbourhood::Urquhart));

pub(super) static DEVELOPMENTAL: Row = Row {
    pattern: CLOSED,
    kill_distance: 1.0,
    birth_distance: 3.0,
    initial_length: 23.0,
    final_length: 184.0,
    growth: RowGrowth::Nonuniform(
        &[[0.0, 0.024], [1.0, 0.02]],
        &[[0.0, 0.015], [0.5, 0.012], [1.0, 0.008]],
    ),
    darts: 5000.0,
    murray_exponent: 3.0,
    leaf_unit: 1.0,
};

pub(super) static TRILLIUM: Row = Row {
    pattern: CLOSED,
    kill_distance: 1.0,
    birth_distance: 30.0,
    initial_length: 0.0,
    final_length: 4500.0,
    growth: RowGrowth::None,
    darts: 100.0,
    murray_exponent: 2.0,
    leaf_unit: 5.0,
};

/// A leaf whose veins follow a row of the table as we read it.
fn leaf(row: &Row, length_mm: f64, seed: u64, veinlet_mm: f64, outline: OutlinePlan) -> LeafPlan {
    green_leaf(
        length_mm,
        seed,
        outline,
        row.plan(row.leaf_unit, veinlet_mm),
    )
}

/// A leaf of a species whose veins follow a row of the table as we read it.
fn species(
    traits: &LeafTraits,
    row: &Row,
    seed: u64,
    veinlet_mm: f64,
    outline: OutlinePlan,
) -> LeafPlan {
    traits.plan(seed, outline, row.plan(row.leaf_unit, veinlet_mm))
}

/// A leaf of the parameter searches.
pub(super) fn searched(row: &Row) -> LeafPlan {
    leaf(row, 80.0, 1, 0.05, contours::lanceolate())
}

pub(super) fn slow() -> LeafPlan {
    let venation = AuxinPlan {
        source_birth_distance: 5.0,
        vein_birth_distance: 5.0,
        ..SLOW.plan(SLOW.leaf_unit, 0.03)
    };
    green_leaf(80.0, 1, contours::ovate(), venation)
}

/// Segments ten times as long only make the pattern coarser. Lengths and the kill distance, in
/// segments, fall to a tenth. So does the number of steps, and the margin still moves one segment
/// per step.
pub(super) fn ginkgo() -> LeafPlan {
    const COARSER: f64 = 10.0;
    let venation = AuxinPlan {
        kill_distance: GINKGO.kill_distance / COARSER,
        darts_per_area: GINKGO.darts / 1e6 * COARSER * COARSER,
        growth: Growth::Marginal {
            initial_length: GINKGO.initial_length / GINKGO.leaf_unit,
            length_step: 1.0,
        },
        ..GINKGO.plan(GINKGO.leaf_unit * COARSER, 0.03)
    };
    leaf_traits::GINKGO.plan(1, contours::fan(), venation)
}

pub(super) fn alchemilla() -> LeafPlan {
    species(
        &leaf_traits::ALCHEMILLA,
        &ALCHEMILLA,
        1,
        0.02,
        contours::lobed_round(),
    )
}

pub(super) fn sweetgum() -> LeafPlan {
    species(
        &leaf_traits::SWEETGUM,
        &SWEETGUM,
        1,
        0.006,
        contours::star(),
    )
}

pub(super) fn toothed() -> LeafPlan {
    leaf(&TOOTHED, 70.0, 1, 0.02, contours::one_lobe())
}

pub(super) fn tertiary() -> LeafPlan {
    leaf(&TERTIARY, 80.0, 1, 0.015, contours::ovate())
}

pub(super) fn orchid() -> LeafPlan {
    species(&leaf_traits::ORCHID, &ORCHID, 1, 0.03, contours::elliptic())
}

pub(super) fn reticulate() -> LeafPlan {
    leaf(&RETICULATE, 80.0, 1, 0.02, contours::ovate())
}

pub(super) fn cherry() -> LeafPlan {
    let venation = AuxinPlan {
        unseen_veinlets: 0.1,
        ..CHERRY.plan(CHERRY.leaf_unit, 0.03)
    };
    leaf_traits::CHERRY.plan(2, contours::obovate(), venation)
}

pub(super) fn grass() -> LeafPlan {
    // Veins one birth distance apart.
    let apart = GRASS.birth_distance / (GRASS.final_length / GRASS.leaf_unit);
    let venation = AuxinPlan {
        origins: (-6..=6).map(|i| [f64::from(i) * apart, 0.0]).collect(),
        ..GRASS.plan(GRASS.leaf_unit, 0.025)
    };
    leaf_traits::GRASS.plan(1, contours::strip(), venation)
}

pub(super) fn poplar_leaf() -> LeafPlan {
    species(&leaf_traits::POPLAR, &POPLAR, 40, 0.02, contours::deltoid())
}

pub(super) fn poplar_urquhart() -> LeafPlan {
    species(
        &leaf_traits::POPLAR,
        &POPLAR_URQUHART,
        40,
        0.02,
        contours::deltoid(),
    )
}

pub(super) fn poplar_fine() -> LeafPlan {
    let fine = Row {
        leaf_unit: 3.0,
        ..POPLAR
    };
    species(&leaf_traits::POPLAR, &fine, 24, 0.006, contours::deltoid())
}

/// A tenth of the growth per step, so that veins keep up with it; a tenth of the darts per step, so
/// that equally many fall on the same tissue.
pub(super) fn poplar_x10() -> LeafPlan {
    let fine = Row {
        leaf_unit: 1.0,
        growth: RowGrowth::Isogonic(0.9),
        darts: 20.0,
        ..POPLAR
    };
    species(&leaf_traits::POPLAR, &fine, 2, 0.0015, contours::deltoid())
}

pub(super) fn developmental() -> LeafPlan {
    leaf(&DEVELOPMENTAL, 2.0, 68, 0.0015, contours::circular())
}

pub(super) fn trillium() -> LeafPlan {
    species(
        &leaf_traits::TRILLIUM,
        &TRILLIUM,
        1,
        0.03,
        contours::petal(),
    )
}
