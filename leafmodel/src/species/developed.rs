//! Presets of leaves that develop from their margin, with finer veins grown around their main
//! veins.
//!
//! Numbers of the development are fitted by eye to the usual leaf of each species, starting from
//! what the literature says of it: where convergence points appear, in which sequence, and how much
//! growth is held back between them. What the leaf holds is that of the species where it is known,
//! else of a usual green leaf.

#[cfg(test)]
mod tests;

use super::green_leaf;
use super::trees::{self, net};
use crate::development::{DevelopmentPlan, Primordium, Sequence, Wave};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::venation::plan::AuxinPlan;

/// Teeth or small lobes between what is there, when the leaf is some times as long as its
/// primordium.
fn teeth(spacing: f64, hold: f64) -> Wave {
    Wave {
        from: 6.0,
        until: 9.0,
        spacing,
        sequence: Sequence::Intercalary,
        hold,
        blunt: 1.0,
        lean: 0.4,
        zone: [0.12, 0.96],
        ..Wave::default()
    }
}

/// Veins from the base, for lobes of palmate leaves.
fn palmate(spacing: f64, hold: f64) -> Wave {
    Wave {
        until: 1.5,
        spacing,
        transport: 1.0,
        hold,
        sinus: 1.1,
        blunt: 1.2,
        bow: 0.02,
        ..Wave::default()
    }
}

fn primordium([width, widest_at, taper_base, taper_tip]: [f64; 4]) -> Primordium {
    Primordium {
        width,
        widest_at,
        taper_base,
        taper_tip,
    }
}

fn plan(form: [f64; 4], irregularity: f64, waves: Vec<Wave>) -> DevelopmentPlan {
    DevelopmentPlan {
        primordium: primordium(form),
        irregularity,
        waves,
        ..DevelopmentPlan::default()
    }
}

/// A leaf of a species that is known otherwise, with an outline and main veins that develop.
fn as_if(mut leaf: LeafPlan, seed: u64, plan: DevelopmentPlan) -> LeafPlan {
    leaf.outline = Contour::Development(plan).into();
    leaf.seed = seed;
    if let VenationPlan::Auxin(veins) = &mut leaf.venation {
        // The main veins come from the development; the net is the species'.
        veins.architecture = None;
    }
    leaf
}

/// A green leaf with a net of so many segments along it.
fn green(length_mm: f64, segments: f64, seed: u64, plan: DevelopmentPlan) -> LeafPlan {
    let venation = AuxinPlan {
        // The finest veins are a fifth of a segment across.
        veinlet_radius_mm: 0.09 * length_mm / segments,
        ..net(0.15 * segments, segments, 4.0)
    };
    let outline = Contour::Development(plan).into();
    green_leaf(length_mm, seed, outline, venation)
}

pub(super) fn maple() -> LeafPlan {
    let lobes = Wave {
        rates: [0.97, 1.02],
        splay: 0.06,
        zone: [0.25, 0.72],
        sinus: 1.0,
        ..palmate(0.46, 0.3)
    };
    let points = Wave {
        from: 3.0,
        until: 6.0,
        transport: 0.6,
        bow: 0.02,
        lean: 0.0,
        zone: [0.15, 0.93],
        ..teeth(0.75, 0.3)
    };
    let form = [1.15, 0.42, 0.45, 0.85];
    as_if(trees::maple(), 1, plan(form, 0.35, vec![lobes, points]))
}

pub(super) fn white_oak() -> LeafPlan {
    let lobes = Wave {
        until: 1.2,
        spacing: 0.24,
        hold: 0.36,
        hold_base: 0.35,
        terminal: 0.65,
        sinus: 0.9,
        blunt: 2.3,
        rates: [0.97, 1.0],
        transport: 0.55,
        zone: [0.2, 0.74],
        bow: 0.015,
        ..Wave::default()
    };
    let form = [0.66, 0.58, 0.75, 0.6];
    as_if(trees::white_oak(), 1, plan(form, 0.5, vec![lobes]))
}

pub(super) fn red_oak() -> LeafPlan {
    let lobes = Wave {
        until: 1.2,
        spacing: 0.28,
        hold: 0.34,
        hold_base: 0.3,
        terminal: 0.85,
        sinus: 1.5,
        blunt: 1.2,
        rates: [0.97, 1.02],
        zone: [0.22, 0.85],
        bow: 0.02,
        ..Wave::default()
    };
    let points = Wave {
        from: 5.0,
        until: 8.0,
        bow: 0.0,
        lean: 0.0,
        zone: [0.25, 0.97],
        ..teeth(0.55, 0.35)
    };
    let form = [0.82, 0.55, 0.7, 1.0];
    as_if(trees::red_oak(), 1, plan(form, 0.4, vec![lobes, points]))
}

pub(super) fn cottonwood() -> LeafPlan {
    let secondaries = Wave {
        until: 1.2,
        spacing: 0.2,
        transport: 0.7,
        zone: [0.3, 0.9],
        ..Wave::default()
    };
    let blunt = Wave {
        blunt: 1.6,
        sinus: 1.2,
        lean: 0.3,
        zone: [0.15, 0.9],
        ..teeth(0.55, 0.06)
    };
    let mut plan = plan([0.95, 0.22, 0.45, 0.9], 0.25, vec![secondaries, blunt]);
    plan.basal_growth = 0.05;
    as_if(trees::cottonwood(), 1, plan)
}

pub(super) fn birch() -> LeafPlan {
    let large = Wave {
        until: 1.2,
        spacing: 0.15,
        hold: 0.02,
        blunt: 1.0,
        lean: 0.4,
        zone: [0.2, 0.95],
        ..Wave::default()
    };
    let form = [0.8, 0.3, 0.55, 0.95];
    as_if(
        trees::birch(),
        1,
        plan(form, 0.3, vec![large, teeth(0.28, 0.06)]),
    )
}

pub(super) fn willow() -> LeafPlan {
    let secondaries = Wave {
        until: 1.6,
        spacing: 0.1,
        transport: 0.6,
        bow: 0.1,
        zone: [0.08, 0.9],
        ..Wave::default()
    };
    let fine = Wave {
        from: 8.0,
        until: 12.0,
        lean: 0.5,
        transport: 0.6,
        zone: [0.05, 0.97],
        ..teeth(0.2, 0.1)
    };
    let form = [0.17, 0.38, 0.8, 0.9];
    as_if(
        trees::willow(),
        1,
        plan(form, 0.25, vec![secondaries, fine]),
    )
}

pub(super) fn ivy() -> LeafPlan {
    let lobes = Wave {
        until: 1.4,
        rates: [0.97, 1.0],
        splay: 0.1,
        zone: [0.25, 0.62],
        blunt: 1.3,
        ..palmate(0.6, 0.13)
    };
    let form = [1.2, 0.33, 0.4, 0.85];
    as_if(trees::ivy(), 1, plan(form, 0.35, vec![lobes]))
}

pub(super) fn magnolia() -> LeafPlan {
    let secondaries = Wave {
        until: 1.3,
        spacing: 0.12,
        transport: 0.45,
        bow: 0.08,
        zone: [0.08, 0.95],
        ..Wave::default()
    };
    let form = [0.46, 0.52, 0.7, 0.65];
    as_if(trees::magnolia(), 1, plan(form, 0.2, vec![secondaries]))
}

pub(super) fn linden() -> LeafPlan {
    let secondaries = Wave {
        until: 1.2,
        spacing: 0.2,
        transport: 0.7,
        zone: [0.2, 0.93],
        splay: 0.04,
        ..Wave::default()
    };
    let sharp = Wave {
        sinus: 1.2,
        zone: [0.1, 0.95],
        ..teeth(0.45, 0.06)
    };
    let form = [0.95, 0.35, 0.42, 0.9];
    green(70.0, 480.0, 1, plan(form, 0.25, vec![secondaries, sharp]))
}

pub(super) fn hawthorn() -> LeafPlan {
    let lobes = Wave {
        until: 1.3,
        spacing: 0.32,
        hold: 0.36,
        hold_base: 0.3,
        terminal: 0.8,
        blunt: 1.6,
        sinus: 1.2,
        transport: 0.45,
        zone: [0.3, 0.72],
        bow: 0.02,
        ..Wave::default()
    };
    let points = Wave {
        lean: 0.3,
        zone: [0.4, 0.97],
        sequence: Sequence::Acropetal,
        ..teeth(0.6, 0.12)
    };
    let form = [0.85, 0.5, 0.6, 0.9];
    green(45.0, 420.0, 1, plan(form, 0.4, vec![lobes, points]))
}

pub(super) fn arabidopsis() -> LeafPlan {
    let serrations = Wave {
        until: 2.5,
        spacing: 0.24,
        hold: 0.05,
        hold_base: 1.0,
        blunt: 1.0,
        lean: 0.35,
        zone: [0.25, 0.72],
        ..Wave::default()
    };
    let form = [0.5, 0.6, 0.8, 0.6];
    green(30.0, 260.0, 1, plan(form, 0.3, vec![serrations]))
}

/// Leaflets as lobes down to the rachis.
fn leaflets(spacing: f64) -> Wave {
    Wave {
        until: 3.0,
        spacing,
        transport: 0.25,
        hold: 1.0,
        hold_base: 1.0,
        blunt: 3.0,
        sinus: 1.2,
        terminal: 0.8,
        zone: [0.2, 0.55],
        bow: 0.01,
        rates: [0.96, 1.0],
        ..Wave::default()
    }
}

pub(super) fn cardamine() -> LeafPlan {
    let mut plan = plan([0.85, 0.58, 0.6, 0.7], 0.3, vec![leaflets(0.26)]);
    plan.growth = 24.0;
    green(60.0, 340.0, 1, plan)
}

pub(super) fn tomato() -> LeafPlan {
    let leaflets = Wave {
        until: 1.2,
        transport: 0.35,
        terminal: 0.78,
        zone: [0.25, 0.66],
        bow: 0.0,
        rates: [1.0, 1.0],
        ..leaflets(0.32)
    };
    let lobes = Wave {
        from: 8.0,
        until: 12.0,
        transport: 0.4,
        blunt: 1.2,
        sinus: 1.3,
        lean: 0.0,
        zone: [0.1, 0.97],
        ..teeth(1.2, 0.3)
    };
    let mut plan = plan([0.9, 0.5, 0.5, 0.7], 0.3, vec![leaflets, lobes]);
    plan.growth = 30.0;
    green(150.0, 520.0, 1, plan)
}

pub(super) fn horse_chestnut() -> LeafPlan {
    let leaflets = Wave {
        until: 1.3,
        rates: [0.9, 1.0],
        splay: 0.1,
        zone: [0.2, 0.8],
        blunt: 2.5,
        sinus: 1.0,
        bow: 0.0,
        ..palmate(0.3, 0.9)
    };
    let sharp = Wave {
        from: 5.0,
        lean: 0.3,
        sinus: 1.3,
        zone: [0.1, 0.97],
        ..teeth(0.6, 0.06)
    };
    let form = [1.0, 0.3, 0.4, 0.6];
    let mut plan = plan(form, 0.3, vec![leaflets, sharp]);
    plan.growth = 25.0;
    green(160.0, 560.0, 1, plan)
}

pub(super) fn plantain() -> LeafPlan {
    let parallel = Wave {
        until: 1.02,
        spacing: 0.16,
        sequence: Sequence::Acropetal,
        transport: 1.0,
        zone: [0.35, 0.92],
        bow: 0.05,
        ..Wave::default()
    };
    let form = [0.3, 0.42, 0.9, 0.85];
    green(110.0, 520.0, 1, plan(form, 0.15, vec![parallel]))
}
