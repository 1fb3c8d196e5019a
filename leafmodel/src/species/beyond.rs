//! Presets for extensions that section 7 of Runions et al. 2005 names.

use super::{contours, green_leaf};
use crate::leaf::LeafPlan;
use crate::venation::plan::{AuxinPlan, FreeEndings, Growth, MarginClearance};

/// A closed net under isogonic growth. The young leaf is long enough for its secondaries to form
/// together.
fn net(final_length: f64, initial_length: f64, veinlet_mm: f64) -> AuxinPlan {
    AuxinPlan {
        final_length,
        source_birth_distance: 3.5,
        vein_birth_distance: 3.5,
        darts_per_area: 0.01,
        growth: Growth::Isogonic {
            initial_length,
            length_step: 2.0,
        },
        murray_exponent: 2.3,
        veinlet_radius_mm: veinlet_mm,
        ..AuxinPlan::default()
    }
}

pub(super) fn brochidodromous() -> LeafPlan {
    let venation = AuxinPlan {
        source_birth_distance: 4.0,
        vein_birth_distance: 4.0,
        murray_exponent: 3.2,
        margin_clearance: Some(MarginClearance {
            distance: 0.075,
            until: 0.4,
            arches: 9,
        }),
        ..net(500.0, 100.0, 0.025)
    };
    green_leaf(80.0, 2, contours::broad_elliptic(), venation)
}

pub(super) fn free_endings() -> LeafPlan {
    let venation = AuxinPlan {
        source_birth_distance: 5.0,
        vein_birth_distance: 5.0,
        free_endings: Some(FreeEndings {
            birth_distance: 1.8,
            kill_distance: 0.8,
            darts_per_area: 0.03,
        }),
        ..net(260.0, 60.0, 0.006)
    };
    green_leaf(25.0, 1, contours::ovate(), venation)
}

pub(super) fn cupped() -> LeafPlan {
    let venation = AuxinPlan {
        gaussian_curvature: 6.0,
        ..net(300.0, 60.0, 0.012)
    };
    let mut leaf = green_leaf(60.0, 1, contours::orbicular(), venation);
    // Its Gaussian curvature bends it already.
    leaf.form.fold = 0.0;
    leaf.form.curl = 0.0;
    leaf
}
