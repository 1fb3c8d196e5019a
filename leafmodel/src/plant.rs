//! Boughs and shoots: axes with nodes, and the place of each leaf, bud and branch.
//!
//! An axis grows node by node. Each node bears one leaf or several, turned against those of the
//! node before (phyllotaxis); leaves of a node in the order of growth and their petioles come with
//! the leaf. In the axil of a leaf there is a bud, a branch, or a short shoot with a cluster of
//! leaves. A petiole twists and bends until its blade faces the light, as far as it may.
//!
//! - **In**: a plan ([`PlantPlan`]) and how each leaf is held ([`Foot`]).
//! - **Out**: the axes as closed tubes, and a transform for each leaf ([`Plant`]).
//! - **Always true**: the foot of each petiole lies within its axis; neighbours are different
//!   individuals; same plan and seed, same plant, bit for bit.
//! - **Left out**: leaves may touch one another; wood does not bend under the weight of leaves.
//!
//! The plant's frame: the foot of its main axis is the origin, z is up. Lengths are millimetres.

mod axis;
mod bearing;
mod foot;
mod posture;
pub mod presets;
#[cfg(test)]
mod tests;

use glam::{DAffine3, DVec3};
use thiserror::Error;

pub use self::foot::{Foot, NotBorne};
use crate::blade::stalk::StalkMesh;

/// Most leaves of a plant.
pub const MOST_LEAVES: usize = 100_000;

/// The numbers of a plant. Angles are radians.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantPlan {
    /// Same plan and seed, same plant.
    pub seed: u64,
    /// Number of different leaves of each kind, 1 to 1000; neighbours differ from 2 on.
    pub individuals: u32,
    /// The main axis.
    pub axis: AxisPlan,
    /// Its branches; none if every leaf's axil holds a bud.
    pub branching: Option<Branching>,
    /// How leaves stand.
    pub posture: Posture,
    /// The buds; none if there are none to be seen.
    pub buds: Option<Buds>,
}

/// How the leaves of one node stand to those of the node before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phyllotaxis {
    /// Leaves of a node, 1 to 12, evenly around the axis.
    pub per_node: u32,
    /// Angle about the axis from each node to the next, −π to π.
    pub divergence: f64,
}

impl Phyllotaxis {
    /// Two rows: elm, birch, lime, grasses.
    pub const DISTICHOUS: Self = Self {
        per_node: 1,
        divergence: std::f64::consts::PI,
    };
    /// Pairs at right angles: maple, ash.
    pub const DECUSSATE: Self = Self {
        per_node: 2,
        divergence: std::f64::consts::FRAC_PI_2,
    };
    /// One leaf a node by the golden angle, 2π / (φ + 1): poplar, cherry, oak.
    pub const SPIRAL: Self = Self {
        per_node: 1,
        divergence: 2.399_963_229_728_653,
    };
    /// Whorls of three, each in the gaps of the one before: trillium, oleander.
    pub const WHORLED: Self = Self {
        per_node: 3,
        divergence: std::f64::consts::PI / 3.0,
    };
}

/// An axis with its nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisPlan {
    /// Length, mm, 1 to 100000.
    pub length_mm: f64,
    /// Nodes, 1 to 1000; the last is at the tip.
    pub nodes: u32,
    /// Share of the length below the first node, 0 to 0.99.
    pub bare: f64,
    /// Length of each internode over that of the one before, 0.5 to 1.5.
    pub shortening: f64,
    /// Radius at the foot and at the tip, mm, 0.05 to 1000.
    pub radius_mm: [f64; 2],
    /// How much thicker nodes are, over the radius, 0 to 1.
    pub swelling: f64,
    /// How leaves follow one another.
    pub phyllotaxis: Phyllotaxis,
    /// Angle by which the axis bends away from the leaf at each node of one leaf, 0 to 0.6.
    pub zigzag: f64,
    /// Angle of its foot from upright, towards +y, 0 to π.
    pub inclination: f64,
    /// Angle by which it would turn upwards from foot to tip if it were level all the way, −3 to 3;
    /// below 0 it droops.
    pub upward: f64,
    /// Standard deviation of the bend of each internode, 0 to 0.5.
    pub stray: f64,
}

/// Branches in the axils of leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branching {
    /// 1: the main axis has branches; 2: these have too; up to 4.
    pub order: u32,
    /// The nodes with branches: from and up to these shares of the axis, 0 to 1.
    pub between: [f64; 2],
    /// Length over that of the parent at either end of that range, 0.02 to 1.
    pub length: [f64; 2],
    /// Angle from the parent, 0.1 to 2.
    pub angle: f64,
    /// Radius of its foot over that of the parent there, 0.1 to 1.
    pub thickness: f64,
    /// Share of the axils there that have one, 0 to 1.
    pub share: f64,
}

/// How leaves stand on their axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Posture {
    /// Angle of the petiole's foot from the axis at its foot and at its tip, 0.05 to 3.
    pub angle: [f64; 2],
    /// Factor on the leaves' size at the axis' foot, in its middle and at its tip, 0.02 to 2.
    pub size: [f64; 3],
    /// Share of the turn to the light that petioles make, 0 to 1.
    pub to_light: f64,
    /// Unit vector towards the light.
    pub light: DVec3,
    /// Standard deviation of the turns of each leaf, 0 to 0.7.
    pub stray: f64,
    /// Leaves of each short shoot, 1 to 12; with 1 there are none.
    pub cluster: u32,
    /// Length of a short shoot, mm, 0.5 to 200.
    pub spur_mm: f64,
}

/// The buds in the axils of leaves and at the tips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Buds {
    /// Length, mm, 0.2 to 50.
    pub length_mm: f64,
    /// Greatest radius, mm, 0.1 to 20.
    pub radius_mm: f64,
}

/// A leaf in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BorneLeaf {
    /// Which kind it is, of those from the foot of its axis to its tip.
    pub kind: usize,
    /// Which individual of the kind.
    pub individual: u32,
    /// From the leaf's frame to the plant's.
    pub to_plant: DAffine3,
    /// The place on the surface of the axis where its petiole stands.
    pub node: DVec3,
}

/// A grown plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// Axes, short shoots and buds.
    pub axes: StalkMesh,
    /// The leaves.
    pub leaves: Vec<BorneLeaf>,
}

/// Why a plant cannot be grown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlantError {
    /// A number is out of its range.
    #[error("{field} is {value}, it must be {range}")]
    OutOfRange {
        /// Which, by its key.
        field: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Nodes have no room.
    #[error(
        "an internode of an axis of {length:.3} mm with {nodes} nodes is {internode:.3} mm long, \
         less than the radius there, {radius:.3} mm"
    )]
    NoRoom {
        /// Length of the axis, mm.
        length: f64,
        /// Its nodes.
        nodes: u32,
        /// The first internode that is too short, mm.
        internode: f64,
        /// The axis' radius there, mm.
        radius: f64,
    },
    /// There are too many leaves.
    #[error("the plant has more than {MOST_LEAVES} leaves")]
    TooManyLeaves,
    /// A leaf cannot be borne.
    #[error(transparent)]
    NotBorne(#[from] NotBorne),
}

impl PlantPlan {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`PlantError::OutOfRange`] for the first field out of range, [`PlantError::NoRoom`].
    pub fn validate(&self) -> Result<(), PlantError> {
        let (axis, posture) = (&self.axis, &self.posture);
        let [foot, tip] = axis.radius_mm;
        let mut fields = vec![
            (
                "individuals",
                f64::from(self.individuals),
                1.0,
                1000.0,
                "1 to 1000",
            ),
            ("length_mm", axis.length_mm, 1.0, 1e5, "1 to 100000"),
            ("nodes", f64::from(axis.nodes), 1.0, 1000.0, "1 to 1000"),
            ("bare", axis.bare, 0.0, 0.99, "0 to 0.99"),
            ("shortening", axis.shortening, 0.5, 1.5, "0.5 to 1.5"),
            ("radius_mm", foot, 0.05, 1000.0, "0.05 to 1000"),
            ("radius_mm", tip, 0.05, 1000.0, "0.05 to 1000"),
            ("swelling", axis.swelling, 0.0, 1.0, "0 to 1"),
            (
                "per_node",
                f64::from(axis.phyllotaxis.per_node),
                1.0,
                12.0,
                "1 to 12",
            ),
            ("zigzag_deg", axis.zigzag, 0.0, 0.6, "0 to 34°"),
            ("stray_deg", axis.stray, 0.0, 0.5, "0 to 28°"),
            ("leaves.to_light", posture.to_light, 0.0, 1.0, "0 to 1"),
            (
                "leaves.cluster",
                f64::from(posture.cluster),
                1.0,
                12.0,
                "1 to 12",
            ),
            ("leaves.spur_mm", posture.spur_mm, 0.5, 200.0, "0.5 to 200"),
        ];
        fields.extend(
            posture
                .size
                .map(|size| ("leaves.size", size, 0.02, 2.0, "0.02 to 2")),
        );
        if let Some(branches) = &self.branching {
            fields.push((
                "branches.order",
                f64::from(branches.order),
                1.0,
                4.0,
                "1 to 4",
            ));
            fields.extend(
                (branches.length).map(|one| ("branches.length", one, 0.02, 1.0, "0.02 to 1")),
            );
        }
        for (field, value, least, most, range) in fields {
            if !(least..=most).contains(&value) {
                return Err(PlantError::OutOfRange {
                    field,
                    value,
                    range,
                });
            }
        }
        axis.has_room()
    }
}

impl Plant {
    /// Grows a plant; `feet` tells how each individual of each kind of leaf is held.
    ///
    /// # Errors
    ///
    /// [`PlantError`].
    pub fn grow(plan: &PlantPlan, feet: &[Vec<Foot>]) -> Result<Self, PlantError> {
        plan.validate()?;
        bearing::grow(plan, feet)
    }
}
