//! The species of Table 1 of Runions et al. 2005 as they grow: their veins by architecture.
//!
//! The rows of the table keep every node under their own names; `ginkgo` is Fig. 10, `ginkgo-leaf`
//! the plant.

use super::architectures;
use super::contours;
use super::leaf_traits;
use super::specimens;
use super::trees::{dense, leaf};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::leaf::venation_plan::VenationPlan;
use crate::optics::Constituent::{
    Anthocyanins, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
};
use crate::venation::architecture::Architecture;
use crate::venation::plan::{AuxinPlan, Growth};

/// No source appears: only what is laid out.
const NO_DARTS: f64 = 1e-12;

/// Veins of an architecture alone, without a net between them.
fn bare(final_length: f64, architecture: Architecture) -> AuxinPlan {
    AuxinPlan {
        final_length,
        darts_per_area: NO_DARTS,
        growth: Growth::Isogonic {
            initial_length: 0.98 * final_length,
            length_step: 0.02 * final_length,
        },
        murray_exponent: 2.0,
        architecture: Some(architecture),
        ..AuxinPlan::default()
    }
}

pub(super) fn ginkgo() -> LeafPlan {
    let traits = &leaf_traits::GINKGO;
    let mut plan = leaf(
        traits,
        1,
        specimens::entire(contours::notched_fan()),
        bare(1100.0, architectures::ginkgo()),
    );
    widen(&mut plan, 0.03);
    plan
}

pub(super) fn alchemilla() -> LeafPlan {
    let traits = &leaf_traits::ALCHEMILLA;
    let venation = dense(traits, architectures::alchemilla(), 4.0);
    leaf(
        traits,
        1,
        specimens::serrate(contours::lobed_round()),
        venation,
    )
}

pub(super) fn sweetgum() -> LeafPlan {
    let traits = &leaf_traits::SWEETGUM;
    let venation = dense(traits, architectures::sweetgum(), 3.6);
    leaf(
        traits,
        1,
        specimens::serrate(contours::sweetgum()),
        venation,
    )
}

pub(super) fn cherry() -> LeafPlan {
    let traits = &leaf_traits::CHERRY;
    let venation = dense(traits, architectures::cherry(), 4.2);
    leaf(traits, 2, specimens::cherry(contours::obovate()), venation)
}

pub(super) fn orchid() -> LeafPlan {
    let traits = &leaf_traits::ORCHID;
    let venation = dense(traits, architectures::orchid(), 3.4);
    leaf(traits, 1, specimens::entire(contours::elliptic()), venation)
}

/// A whole blade, where the row is a piece of one.
pub(super) fn grass() -> LeafPlan {
    let traits = &leaf_traits::GRASS;
    let outline: OutlinePlan = contours::linear();
    let mut plan = leaf(traits, 1, outline, bare(1600.0, architectures::grass()));
    plan.length_mm = 240.0;
    widen(&mut plan, 0.012);
    plan
}

pub(super) fn trillium() -> LeafPlan {
    let traits = &leaf_traits::TRILLIUM;
    let venation = AuxinPlan {
        final_length: 400.0,
        ..dense(traits, architectures::trillium(), 1.2)
    };
    leaf(traits, 1, specimens::entire(contours::petal()), venation)
}

/// A green organ of trillium: primaries that part from the midrib at these angles, degrees, and
/// arch to the tip; its length, mm; its thickness, mm, and contents, by eye.
fn green_trillium(
    outline: OutlinePlan,
    lateral_angles_deg: &[f64],
    length_mm: f64,
    thickness_mm: f64,
) -> LeafPlan {
    let mut plan = trillium();
    plan.outline = specimens::entire(outline);
    if let VenationPlan::Auxin(auxin) = &mut plan.venation {
        auxin.architecture = Some(architectures::trillium_green(lateral_angles_deg));
    }
    plan.length_mm = length_mm;
    plan.form.thickness_mm = thickness_mm;
    plan.form.max_edge_mm = length_mm / 80.0;
    let lamina = &mut plan.tissue.lamina;
    lamina[Structure] = 1.6;
    lamina[Chlorophyll] = 34.0;
    lamina[Carotenoids] = 8.0;
    lamina[Anthocyanins] = 0.3;
    lamina[Water] = 0.016;
    lamina[DryMatter] = 0.003;
    let veins = &mut plan.tissue.vein_factors;
    veins[Chlorophyll] = 0.35;
    veins[Carotenoids] = 0.42;
    plan
}

/// One of the three leaves of the whorl, which floras call bracts.
pub(super) fn trillium_bract() -> LeafPlan {
    let mut plan = green_trillium(contours::bract(), &[22.0, 46.0], 110.0, 0.3);
    plan.form.fold = 10.0_f64.to_radians();
    plan.form.curl = 24.0_f64.to_radians();
    plan.form.ruffle = 0.02;
    plan
}

pub(super) fn trillium_sepal() -> LeafPlan {
    let mut plan = green_trillium(contours::sepal(), &[20.0], 40.0, 0.3);
    plan.tissue.lamina[Chlorophyll] = 26.0;
    plan.tissue.lamina[Carotenoids] = 6.5;
    plan.form.fold = 18.0_f64.to_radians();
    plan.form.curl = 25.0_f64.to_radians();
    plan.form.ruffle = 0.01;
    plan
}

/// Finest veins of this radius, mm: a segment says nothing of it where there is no net.
fn widen(plan: &mut LeafPlan, radius_mm: f64) {
    if let VenationPlan::Auxin(auxin) = &mut plan.venation {
        auxin.veinlet_radius_mm = radius_mm;
    }
}
