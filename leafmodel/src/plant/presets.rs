//! Boughs of well-known trees and shrubs.
//!
//! Phyllotaxis is that of floras (in two rows: birch, elm; in pairs: maples; by the golden angle:
//! poplar, cherry, oak; on short shoots: ginkgo). Lengths and angles are by eye.

mod whole;

use glam::DVec3;

use super::{AxisPlan, Branching, Buds, Phyllotaxis, PlantPlan, Posture, Stems};

/// A bough by name.
#[derive(Clone, Copy, Debug)]
pub struct PlantPreset {
    /// Its name in scene files.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    plan: fn() -> PlantPlan,
}

impl PlantPreset {
    /// Its numbers.
    pub fn plan(&self) -> PlantPlan {
        (self.plan)()
    }
}

/// All presets, by name.
pub const PRESETS: &[PlantPreset] = &[
    PlantPreset {
        name: "birch-twig",
        about: "A drooping twig of birch: leaves in two rows on a fine zigzag axis, side twigs.",
        plan: birch,
    },
    PlantPreset {
        name: "cherry-bough",
        about: "A bough of Nankin cherry: leaves by the golden angle, side branches.",
        plan: cherry,
    },
    PlantPreset {
        name: "croton-in-pot",
        about: "A croton of three stems in a clay pot with a dish: leaves by the golden angle.",
        plan: whole::croton_in_pot,
    },
    PlantPreset {
        name: "croton-shoot",
        about: "A shoot of croton: leathery leaves by the golden angle, close together.",
        plan: croton,
    },
    PlantPreset {
        name: "ginkgo-shoot",
        about: "A long shoot of ginkgo: clusters of leaves on short shoots.",
        plan: ginkgo,
    },
    PlantPreset {
        name: "grass-tuft",
        about: "A tuft of grass: upright blades from one foot, the outer ones leaning out.",
        plan: grass,
    },
    PlantPreset {
        name: "ivy-on-wall",
        about: "Stems of ivy that climb a wall (its normal is +x): leaves in two rows, off the wall.",
        plan: whole::ivy_on_wall,
    },
    PlantPreset {
        name: "ivy-shoot",
        about: "A climbing shoot of ivy: leaves in two rows, turned to the light beside the wall (+x).",
        plan: ivy,
    },
    PlantPreset {
        name: "maple-bough",
        about: "A bough of maple: pairs of leaves at right angles, side branches in pairs.",
        plan: maple,
    },
    PlantPreset {
        name: "oak-twig",
        about: "A twig of oak: leaves by the golden angle, crowded towards the tips.",
        plan: oak,
    },
    PlantPreset {
        name: "poplar-branch",
        about: "A branch of poplar: long petioles by the golden angle, side branches.",
        plan: poplar,
    },
    PlantPreset {
        name: "trillium",
        about: "White trillium in flower: a whorl of three leaves, three sepals, three petals.",
        plan: whole::trillium,
    },
];

/// A preset by its name.
pub fn find(name: &str) -> Option<&'static PlantPreset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

impl PlantPlan {
    /// A shoot of a dozen leaves in two rows: the numbers that a file leaves out.
    pub fn usual() -> Self {
        Self {
            seed: 0,
            individuals: 6,
            axis: AxisPlan {
                length_mm: 300.0,
                nodes: 12,
                bare: 0.08,
                shortening: 0.97,
                radius_mm: [2.0, 0.8],
                swelling: 0.15,
                phyllotaxis: Phyllotaxis::DISTICHOUS,
                zigzag: 0.0,
                inclination: 0.0,
                upward: 0.0,
                stray: 2.0_f64.to_radians(),
            },
            branching: None,
            posture: Posture {
                angle: [60.0_f64.to_radians(), 35.0_f64.to_radians()],
                size: [0.8, 1.0, 0.6],
                to_light: 0.6,
                light: DVec3::Z,
                stray: 6.0_f64.to_radians(),
                cluster: 1,
                spur_mm: 5.0,
            },
            evasions: 24,
            buds: None,
            stems: Stems::ONE,
            is_green: false,
            flower: None,
            climbing: None,
            pot: None,
        }
    }
}

impl Branching {
    /// One order of side branches half-way up.
    pub const USUAL: Self = Self {
        order: 1,
        between: [0.05, 0.6],
        length: [0.6, 0.3],
        angle: 50.0 * std::f64::consts::PI / 180.0,
        thickness: 0.6,
        share: 1.0,
    };
}

fn birch() -> PlantPlan {
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

fn cherry() -> PlantPlan {
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

fn croton() -> PlantPlan {
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

fn ginkgo() -> PlantPlan {
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

fn grass() -> PlantPlan {
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
        ..usual
    }
}

fn ivy() -> PlantPlan {
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

fn maple() -> PlantPlan {
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

fn oak() -> PlantPlan {
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

fn poplar() -> PlantPlan {
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
