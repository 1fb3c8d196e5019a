//! Boughs of well-known trees and shrubs.
//!
//! Phyllotaxis is that of floras (in two rows: birch, elm; in pairs: maples; by the golden angle:
//! poplar, cherry, oak; on short shoots: ginkgo). Lengths and angles are by eye.

mod boughs;
mod shoots;
mod whole;

use glam::DVec3;

use super::plan::{AxisPlan, Branching, Phyllotaxis, PlantPlan, Posture, Stems};

/// A bough by name.
#[derive(Clone, Copy, Debug)]
pub struct PlantPreset {
    /// Its name in scene files.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// The preset of its leaves, if it needs nothing else.
    pub leaf: Option<&'static str>,
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
        leaf: Some("birch"),
        plan: boughs::birch,
    },
    PlantPreset {
        name: "cherry-bough",
        about: "A bough of Nankin cherry: leaves by the golden angle, side branches.",
        leaf: Some("cherry-leaf"),
        plan: boughs::cherry,
    },
    PlantPreset {
        name: "croton-in-pot",
        about: "A croton of three stems in a clay pot with a dish: leaves by the golden angle.",
        leaf: None,
        plan: whole::croton_in_pot,
    },
    PlantPreset {
        name: "croton-shoot",
        about: "A shoot of croton: leathery leaves by the golden angle, close together.",
        leaf: Some("croton"),
        plan: shoots::croton,
    },
    PlantPreset {
        name: "ginkgo-shoot",
        about: "A long shoot of ginkgo: clusters of leaves on short shoots.",
        leaf: Some("ginkgo"),
        plan: boughs::ginkgo,
    },
    PlantPreset {
        name: "grass-tuft",
        about: "A tuft of grass: upright blades from one foot, the outer ones leaning out.",
        leaf: Some("grass"),
        plan: shoots::grass,
    },
    PlantPreset {
        name: "ivy-on-wall",
        about: "Stems of ivy that climb a wall (its normal is +x): leaves in two rows, off the wall.",
        leaf: None,
        plan: whole::ivy_on_wall,
    },
    PlantPreset {
        name: "ivy-shoot",
        about: "A climbing shoot of ivy: leaves in two rows, turned to the light beside the wall (+x).",
        leaf: Some("ivy"),
        plan: shoots::ivy,
    },
    PlantPreset {
        name: "maple-bough",
        about: "A bough of maple: pairs of leaves at right angles, side branches in pairs.",
        leaf: Some("maple"),
        plan: boughs::maple,
    },
    PlantPreset {
        name: "oak-twig",
        about: "A twig of oak: leaves by the golden angle, crowded towards the tips.",
        leaf: Some("white-oak"),
        plan: boughs::oak,
    },
    PlantPreset {
        name: "poplar-branch",
        about: "A branch of poplar: long petioles by the golden angle, side branches.",
        leaf: Some("poplar"),
        plan: boughs::poplar,
    },
    PlantPreset {
        name: "trillium",
        about: "White trillium in flower: a whorl of three leaves, three sepals, three petals.",
        leaf: None,
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
            relief: None,
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
