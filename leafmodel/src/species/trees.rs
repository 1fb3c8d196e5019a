//! Presets of trees and shrubs: outline, veins, contents and blade form of a mature leaf in summer.
//!
//! Nothing here is measured on one specimen. [`leaf_traits`] gives the sources of lengths and
//! contents; outlines, vein plans and forms are fitted by eye.

use super::leaf_traits::{self, LeafTraits};
use super::trees_contours as contours;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::venation::plan::{AuxinPlan, FreeEndings, Growth, MarginClearance};

/// A closed net under isogonic growth from `initial_length` to `final_length` segments.
pub(super) fn net(initial_length: f64, final_length: f64, birth_distance: f64) -> AuxinPlan {
    AuxinPlan {
        final_length,
        source_birth_distance: birth_distance,
        vein_birth_distance: birth_distance,
        darts_per_area: 0.01,
        growth: Growth::Isogonic {
            initial_length,
            length_step: 2.5,
        },
        murray_exponent: 2.3,
        ..AuxinPlan::default()
    }
}

/// A leaf whose finest veins have a diameter of a fifth of a segment.
pub(super) fn leaf(
    traits: &LeafTraits,
    seed: u64,
    outline: OutlinePlan,
    venation: AuxinPlan,
) -> LeafPlan {
    let venation = AuxinPlan {
        veinlet_radius_mm: 0.09 * traits.length_mm.value / venation.final_length,
        ..venation
    };
    traits.plan(seed, outline, venation)
}

pub(super) fn maple() -> LeafPlan {
    leaf(
        &leaf_traits::MAPLE,
        3,
        contours::maple(),
        net(80.0, 620.0, 4.0),
    )
}

pub(super) fn cottonwood() -> LeafPlan {
    leaf(
        &leaf_traits::COTTONWOOD,
        2,
        contours::cottonwood(),
        net(85.0, 560.0, 3.5),
    )
}

pub(super) fn ivy() -> LeafPlan {
    leaf(&leaf_traits::IVY, 2, contours::ivy(), net(70.0, 420.0, 4.0))
}

pub(super) fn white_oak() -> LeafPlan {
    leaf(
        &leaf_traits::WHITE_OAK,
        1,
        contours::white_oak(),
        net(80.0, 620.0, 4.0),
    )
}

pub(super) fn red_oak() -> LeafPlan {
    leaf(
        &leaf_traits::RED_OAK,
        1,
        contours::red_oak(),
        net(80.0, 620.0, 4.0),
    )
}

pub(super) fn birch() -> LeafPlan {
    leaf(
        &leaf_traits::BIRCH,
        4,
        contours::birch(),
        net(90.0, 480.0, 3.5),
    )
}

pub(super) fn willow() -> LeafPlan {
    leaf(
        &leaf_traits::WILLOW,
        1,
        contours::willow(),
        net(140.0, 900.0, 3.5),
    )
}

pub(super) fn magnolia() -> LeafPlan {
    let venation = AuxinPlan {
        margin_clearance: Some(MarginClearance {
            distance: 0.05,
            until: 0.3,
            arches: 9,
        }),
        free_endings: Some(FreeEndings {
            birth_distance: 1.6,
            kill_distance: 0.8,
            darts_per_area: 0.03,
        }),
        murray_exponent: 2.6,
        ..net(110.0, 620.0, 4.0)
    };
    leaf(&leaf_traits::MAGNOLIA, 2, contours::magnolia(), venation)
}

/// A green croton; its patterns are added by the coloured presets.
pub(super) fn croton() -> LeafPlan {
    leaf(
        &leaf_traits::CROTON,
        1,
        contours::croton(),
        net(110.0, 620.0, 4.0),
    )
}
