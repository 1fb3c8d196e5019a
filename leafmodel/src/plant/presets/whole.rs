//! Plants as a whole: in a pot, on a wall, in flower.

use glam::DVec3;

use super::shoots::{croton, ivy};
use crate::plant::{
    AxisPlan, Branching, Climbing, FlowerPlan, Phyllotaxis, PlantPlan, Posture, PotPlan, Stems,
};

/// Leaf sizes of floras ask for a shoot of some 40 cm, the height of one from a nursery.
pub(super) fn croton_in_pot() -> PlantPlan {
    let shoot = croton();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 280.0,
            nodes: 27,
            bare: 0.22,
            shortening: 0.94,
            radius_mm: [5.0, 1.8],
            stray: 0.03,
            ..shoot.axis
        },
        posture: Posture {
            angle: [1.3, 0.16],
            size: [0.95, 1.0, 0.42],
            to_light: 0.12,
            stray: 0.14,
            ..shoot.posture
        },
        stems: Stems {
            count: 3,
            spread_mm: 24.0,
            fan: 0.22,
        },
        pot: Some(PotPlan::USUAL),
        ..shoot
    }
}

pub(super) fn ivy_on_wall() -> PlantPlan {
    let shoot = ivy();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 700.0,
            nodes: 22,
            bare: 0.04,
            shortening: 0.97,
            radius_mm: [2.6, 0.8],
            swelling: 0.2,
            zigzag: 0.12,
            inclination: 0.0,
            upward: 0.5,
            stray: 0.09,
            ..shoot.axis
        },
        branching: Some(Branching {
            between: [0.08, 0.6],
            length: [0.55, 0.3],
            angle: 0.75,
            share: 0.4,
            ..Branching::USUAL
        }),
        posture: Posture {
            angle: [1.25, 0.8],
            size: [1.0, 0.9, 0.3],
            to_light: 0.9,
            light: DVec3::new(0.85, 0.0, 0.527).normalize(),
            stray: 0.12,
            ..shoot.posture
        },
        stems: Stems {
            count: 5,
            spread_mm: 260.0,
            fan: 0.3,
        },
        climbing: Some(Climbing::USUAL),
        ..shoot
    }
}

/// Stem 2–4 dm, leaves in one whorl below the flower (\[gleason1991\]).
pub(super) fn trillium() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 3,
        axis: AxisPlan {
            length_mm: 210.0,
            nodes: 1,
            bare: 0.5,
            radius_mm: [2.6, 2.1],
            swelling: 0.15,
            phyllotaxis: Phyllotaxis::WHORLED,
            stray: 0.02,
            inclination: 0.06,
            ..usual.axis
        },
        posture: Posture {
            angle: [1.42, 1.42],
            size: [1.0; 3],
            to_light: 0.45,
            stray: 0.06,
            ..usual.posture
        },
        is_green: true,
        flower: Some(FlowerPlan::USUAL),
        ..usual
    }
}
