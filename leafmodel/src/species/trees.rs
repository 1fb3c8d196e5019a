//! Presets of trees and shrubs: outline, veins, contents and blade form of a mature leaf in summer.
//!
//! Nothing here is measured on one specimen. Lengths and kinds of venation are what floras give for the species; contents lie in
//! the range of the leaves that PROSPECT was made with; outlines, plans of veins and forms are fitted by eye.

use super::{green_leaf, trees_contours as contours};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::venation::plan::{AuxinPlan, FreeEndings, Growth, MarginClearance};

/// A closed net on isogonic growth; the young leaf is `initial_length` segments long, the grown one `final_length`.
fn net(initial_length: f64, final_length: f64, birth_distance: f64) -> AuxinPlan {
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

/// What distinguishes a species besides outline and veins.
struct Look {
    /// Structure of the mesophyll, `N`.
    structure: f64,
    /// Chlorophyll and carotenoids, µg/cm².
    pigments: [f64; 2],
    /// Water, cm, and dry matter, g/cm².
    mass: [f64; 2],
    /// Fold and curl, degrees; ruffle, share of the length.
    bend: [f64; 3],
}

fn leaf(
    length_mm: f64,
    seed: u64,
    outline: OutlinePlan,
    venation: AuxinPlan,
    look: &Look,
) -> LeafPlan {
    // The finest veins are a fifth of a segment across.
    let venation = AuxinPlan {
        veinlet_radius_mm: 0.09 * length_mm / venation.final_length,
        ..venation
    };
    let mut leaf = green_leaf(length_mm, seed, outline, venation);
    let lamina = &mut leaf.tissue.lamina;
    lamina.structure = look.structure;
    [lamina.chlorophyll, lamina.carotenoids] = look.pigments;
    [lamina.water, lamina.dry_matter] = look.mass;
    leaf.form.fold = look.bend[0].to_radians();
    leaf.form.curl = look.bend[1].to_radians();
    leaf.form.ruffle = look.bend[2];
    leaf
}

pub(super) fn maple() -> LeafPlan {
    let look = Look {
        structure: 1.4,
        pigments: [42.0, 9.0],
        mass: [0.008, 0.0045],
        bend: [6.0, 18.0, 0.02],
    };
    leaf(110.0, 3, contours::maple(), net(80.0, 620.0, 4.0), &look)
}

pub(super) fn ivy() -> LeafPlan {
    let look = Look {
        structure: 1.9,
        pigments: [62.0, 12.0],
        mass: [0.019, 0.009],
        bend: [4.0, 12.0, 0.01],
    };
    leaf(60.0, 2, contours::ivy(), net(70.0, 420.0, 4.0), &look)
}

pub(super) fn white_oak() -> LeafPlan {
    let look = Look {
        structure: 1.6,
        pigments: [48.0, 11.0],
        mass: [0.011, 0.008],
        bend: [10.0, 25.0, 0.015],
    };
    leaf(
        130.0,
        1,
        contours::white_oak(),
        net(80.0, 620.0, 4.0),
        &look,
    )
}

pub(super) fn red_oak() -> LeafPlan {
    let look = Look {
        structure: 1.6,
        pigments: [50.0, 11.0],
        mass: [0.010, 0.008],
        bend: [8.0, 22.0, 0.012],
    };
    leaf(150.0, 1, contours::red_oak(), net(80.0, 620.0, 4.0), &look)
}

pub(super) fn birch() -> LeafPlan {
    let look = Look {
        structure: 1.45,
        pigments: [38.0, 9.0],
        mass: [0.009, 0.006],
        bend: [9.0, 20.0, 0.01],
    };
    leaf(55.0, 4, contours::birch(), net(60.0, 480.0, 3.5), &look)
}

pub(super) fn willow() -> LeafPlan {
    let look = Look {
        structure: 1.7,
        pigments: [45.0, 10.0],
        mass: [0.012, 0.0075],
        bend: [14.0, 40.0, 0.004],
    };
    leaf(90.0, 1, contours::willow(), net(140.0, 900.0, 3.5), &look)
}

pub(super) fn magnolia() -> LeafPlan {
    let look = Look {
        structure: 2.0,
        pigments: [65.0, 13.0],
        mass: [0.020, 0.012],
        bend: [10.0, 25.0, 0.008],
    };
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
    leaf(160.0, 2, contours::magnolia(), venation, &look)
}

/// The green parts of a croton; its patterns are a matter of colour, not of veins.
pub(super) fn croton() -> LeafPlan {
    let look = Look {
        structure: 1.9,
        pigments: [45.0, 16.0],
        mass: [0.018, 0.008],
        bend: [8.0, 30.0, 0.012],
    };
    leaf(150.0, 1, contours::croton(), net(110.0, 620.0, 4.0), &look)
}
