//! Presets of trees and shrubs: outline, veins, contents and blade form of a mature leaf in summer.
//!
//! Nothing here is measured on one specimen. [`leaf_traits`] gives the sources of lengths and
//! contents; outlines, vein plans and forms are fitted by eye.

use super::architectures;
use super::leaf_traits::{self, LeafTraits};
use super::specimens;
use super::trees_contours as contours;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::venation::architecture::Architecture;
use crate::venation::plan::{AuxinPlan, FreeEndings, Growth, Neighbourhood, Pattern};

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

/// A net as dense as nature's between the veins of an architecture; `density` is about what comes
/// out, mm of vein per mm² of blade.
pub(super) fn dense(traits: &LeafTraits, architecture: Architecture, density: f64) -> AuxinPlan {
    dense_net(traits.length_mm.value, architecture, density)
}

/// The same for a leaf of this length, mm.
pub(super) fn dense_net(length_mm: f64, architecture: Architecture, density: f64) -> AuxinPlan {
    // A segment is so much shorter than veins are apart.
    let final_length = 4.0 * density * length_mm;
    let initial_length = 0.3 * final_length;
    AuxinPlan {
        final_length,
        pattern: Pattern::Closed(Neighbourhood::Bipolar),
        axis_along_vein: 0.15,
        tension_rounds: 120,
        kill_distance: 0.75,
        source_birth_distance: 2.0,
        vein_birth_distance: 2.0,
        darts_per_area: 0.0004,
        growth: Growth::Isogonic {
            initial_length,
            length_step: (final_length - initial_length) / 280.0,
        },
        murray_exponent: 2.0,
        murray_exponent_finest: Some(3.0),
        architecture: Some(architecture),
        ..AuxinPlan::default()
    }
}

pub(super) fn maple() -> LeafPlan {
    leaf(
        &leaf_traits::MAPLE,
        3,
        specimens::maple(contours::maple()),
        dense(&leaf_traits::MAPLE, architectures::maple(), 3.4),
    )
}

pub(super) fn cottonwood() -> LeafPlan {
    leaf(
        &leaf_traits::COTTONWOOD,
        2,
        specimens::cottonwood(contours::cottonwood()),
        dense(&leaf_traits::COTTONWOOD, architectures::cottonwood(), 3.5),
    )
}

pub(super) fn aspen() -> LeafPlan {
    leaf(
        &leaf_traits::ASPEN,
        5,
        specimens::aspen(contours::aspen()),
        dense(&leaf_traits::ASPEN, architectures::aspen(), 3.6),
    )
}

pub(super) fn ivy() -> LeafPlan {
    leaf(
        &leaf_traits::IVY,
        2,
        specimens::entire(contours::ivy()),
        dense(&leaf_traits::IVY, architectures::ivy(), 3.5),
    )
}

pub(super) fn white_oak() -> LeafPlan {
    leaf(
        &leaf_traits::WHITE_OAK,
        1,
        specimens::entire(contours::white_oak()),
        dense(&leaf_traits::WHITE_OAK, architectures::white_oak(), 3.4),
    )
}

pub(super) fn red_oak() -> LeafPlan {
    leaf(
        &leaf_traits::RED_OAK,
        4,
        specimens::red_oak(contours::red_oak()),
        dense(&leaf_traits::RED_OAK, architectures::red_oak(), 3.4),
    )
}

pub(super) fn birch() -> LeafPlan {
    leaf(
        &leaf_traits::BIRCH,
        4,
        specimens::birch(contours::birch()),
        dense(&leaf_traits::BIRCH, architectures::birch(), 4.5),
    )
}

pub(super) fn willow() -> LeafPlan {
    leaf(
        &leaf_traits::WILLOW,
        1,
        specimens::willow(contours::willow()),
        dense(&leaf_traits::WILLOW, architectures::willow(), 4.2),
    )
}

pub(super) fn magnolia() -> LeafPlan {
    let venation = AuxinPlan {
        free_endings: Some(FreeEndings {
            birth_distance: 1.6,
            kill_distance: 0.8,
            darts_per_area: 0.03,
        }),
        ..dense(&leaf_traits::MAGNOLIA, architectures::magnolia(), 3.2)
    };
    leaf(
        &leaf_traits::MAGNOLIA,
        2,
        specimens::entire(contours::magnolia()),
        venation,
    )
}

/// A green croton; its patterns are added by the coloured presets.
pub(super) fn croton() -> LeafPlan {
    leaf(
        &leaf_traits::CROTON,
        1,
        specimens::entire(contours::croton()),
        dense(&leaf_traits::CROTON, architectures::croton(), 3.5),
    )
}
