//! Shoots of what is no tree.

use glam::DVec3;

use crate::plant::{AxisPlan, Branching, Phyllotaxis, PlantPlan, Posture};

pub(super) fn croton() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 6,
        axis: AxisPlan {
            length_mm: 320.0,
            nodes: 26,
            bare: 0.35,
            shortening: 0.95,
            radius_mm: [5.0, 2.5],
            swelling: 0.1,
            phyllotaxis: Phyllotaxis::SPIRAL,
            stray: 0.03,
            ..usual.axis
        },
        posture: Posture {
            angle: [1.35, 0.6],
            size: [0.9, 1.0, 0.5],
            to_light: 0.35,
            stray: 0.12,
            ..usual.posture
        },
        buds: None,
        ..usual
    }
}

pub(super) fn grass() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 60.0,
            nodes: 26,
            bare: 0.02,
            shortening: 1.0,
            radius_mm: [2.2, 1.5],
            swelling: 0.0,
            phyllotaxis: Phyllotaxis::SPIRAL,
            stray: 0.0,
            ..usual.axis
        },
        posture: Posture {
            angle: [0.7, 0.08],
            size: [0.6, 0.9, 1.0],
            to_light: 0.0,
            stray: 0.15,
            ..usual.posture
        },
        buds: None,
        // Blades of a tuft sheathe one another: turned, half still cut, and the inner ones lie down.
        evasions: 0,
        ..usual
    }
}

pub(super) fn ivy() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 480.0,
            nodes: 15,
            bare: 0.04,
            shortening: 0.96,
            radius_mm: [2.2, 0.9],
            swelling: 0.2,
            zigzag: 0.15,
            inclination: 0.5,
            upward: 0.4,
            stray: 0.08,
            ..usual.axis
        },
        branching: Some(Branching {
            between: [0.1, 0.5],
            length: [0.5, 0.35],
            angle: 0.8,
            share: 0.35,
            ..Branching::USUAL
        }),
        posture: Posture {
            angle: [1.2, 0.8],
            size: [1.0, 0.9, 0.4],
            to_light: 0.9,
            light: DVec3::new(0.8, 0.0, 0.6),
            stray: 0.12,
            ..usual.posture
        },
        buds: None,
        ..usual
    }
}
