//! Boughs and shoots of trees.

use crate::plant::{AxisPlan, Branching, Buds, Phyllotaxis, PlantPlan, Posture};

pub(super) fn birch() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 420.0,
            nodes: 16,
            bare: 0.1,
            shortening: 0.97,
            radius_mm: [1.7, 0.5],
            swelling: 0.25,
            zigzag: 0.2,
            inclination: 1.2,
            upward: -0.9,
            stray: 0.05,
            ..usual.axis
        },
        branching: Some(Branching {
            between: [0.1, 0.6],
            length: [0.5, 0.25],
            angle: 0.8,
            share: 0.6,
            ..Branching::USUAL
        }),
        posture: Posture {
            angle: [1.0, 0.7],
            size: [0.85, 1.0, 0.6],
            to_light: 0.6,
            stray: 0.16,
            ..usual.posture
        },
        buds: Some(Buds {
            length_mm: 4.5,
            radius_mm: 1.0,
        }),
        ..usual
    }
}

pub(super) fn cherry() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 300.0,
            nodes: 22,
            bare: 0.12,
            shortening: 0.96,
            radius_mm: [2.2, 0.8],
            swelling: 0.2,
            phyllotaxis: Phyllotaxis::SPIRAL,
            inclination: 1.2,
            upward: 0.5,
            stray: 0.05,
            ..usual.axis
        },
        branching: Some(Branching {
            between: [0.1, 0.5],
            length: [0.45, 0.3],
            angle: 0.85,
            share: 0.45,
            ..Branching::USUAL
        }),
        posture: Posture {
            angle: [1.2, 0.7],
            size: [0.8, 1.0, 0.55],
            to_light: 0.55,
            stray: 0.16,
            ..usual.posture
        },
        buds: Some(Buds {
            length_mm: 3.0,
            radius_mm: 0.9,
        }),
        ..usual
    }
}

pub(super) fn ginkgo() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 450.0,
            nodes: 11,
            bare: 0.1,
            shortening: 0.97,
            radius_mm: [4.0, 2.2],
            swelling: 0.05,
            phyllotaxis: Phyllotaxis::SPIRAL,
            inclination: 1.0,
            upward: 0.4,
            stray: 0.03,
            ..usual.axis
        },
        posture: Posture {
            angle: [1.2, 0.9],
            size: [0.9, 1.0, 0.8],
            to_light: 0.35,
            stray: 0.2,
            cluster: 5,
            spur_mm: 10.0,
            ..usual.posture
        },
        buds: Some(Buds {
            length_mm: 4.0,
            radius_mm: 2.0,
        }),
        ..usual
    }
}

pub(super) fn maple() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 10,
        axis: AxisPlan {
            length_mm: 700.0,
            nodes: 9,
            bare: 0.1,
            shortening: 0.93,
            radius_mm: [4.5, 1.6],
            swelling: 0.25,
            phyllotaxis: Phyllotaxis::DECUSSATE,
            inclination: 1.3,
            upward: 0.35,
            stray: 0.05,
            ..usual.axis
        },
        branching: Some(Branching {
            order: 2,
            between: [0.05, 0.65],
            length: [0.6, 0.35],
            angle: 0.8,
            share: 0.75,
            ..Branching::USUAL
        }),
        posture: Posture {
            angle: [1.1, 0.7],
            size: [0.9, 1.0, 0.6],
            to_light: 0.75,
            stray: 0.14,
            ..usual.posture
        },
        buds: Some(Buds {
            length_mm: 5.0,
            radius_mm: 1.6,
        }),
        ..usual
    }
}

pub(super) fn oak() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 320.0,
            nodes: 14,
            bare: 0.2,
            shortening: 0.86,
            radius_mm: [3.4, 1.6],
            swelling: 0.2,
            phyllotaxis: Phyllotaxis::SPIRAL,
            inclination: 0.9,
            upward: 0.4,
            stray: 0.06,
            ..usual.axis
        },
        branching: Some(Branching {
            between: [0.15, 0.6],
            length: [0.55, 0.4],
            angle: 0.8,
            share: 0.4,
            ..Branching::USUAL
        }),
        posture: Posture {
            angle: [1.2, 0.7],
            size: [0.7, 0.9, 1.0],
            to_light: 0.55,
            stray: 0.18,
            ..usual.posture
        },
        buds: Some(Buds {
            length_mm: 5.0,
            radius_mm: 2.0,
        }),
        ..usual
    }
}

pub(super) fn poplar() -> PlantPlan {
    let usual = PlantPlan::usual();
    PlantPlan {
        individuals: 8,
        axis: AxisPlan {
            length_mm: 500.0,
            nodes: 20,
            bare: 0.1,
            shortening: 0.95,
            radius_mm: [4.0, 1.4],
            swelling: 0.2,
            phyllotaxis: Phyllotaxis::SPIRAL,
            inclination: 0.9,
            upward: 0.5,
            stray: 0.04,
            ..usual.axis
        },
        branching: Some(Branching {
            between: [0.1, 0.5],
            length: [0.5, 0.35],
            angle: 0.75,
            share: 0.4,
            ..Branching::USUAL
        }),
        posture: Posture {
            angle: [1.15, 0.65],
            size: [0.8, 1.0, 0.5],
            to_light: 0.4,
            stray: 0.2,
            ..usual.posture
        },
        buds: Some(Buds {
            length_mm: 8.0,
            radius_mm: 1.8,
        }),
        ..usual
    }
}
