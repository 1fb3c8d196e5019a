//! Boughs and shoots: axes with nodes, and the place of each leaf, bud and branch.
//!
//! An axis grows node by node. Each node bears one leaf or several, turned against those of the
//! node before (phyllotaxis). In its axil there may be a bud, in its place a branch, or a short shoot
//! with a cluster of leaves. A petiole, which is part of the leaf, twists and bends until the blade
//! faces the light, as far as it may.
//!
//! - **In**: a plan ([`PlantPlan`]) and how each leaf is held ([`Foot`]).
//! - **Out**: the axes as closed tubes, and a transform for each leaf ([`Plant`]).
//! - **Always true**: the foot of each petiole lies within its axis; neighbours on an axis are
//!   different individuals; same plan and seed, same plant, bit for bit.
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

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use thiserror::Error;

pub use self::foot::{Foot, NotBorne};
use crate::blade::stalk::{StalkError, StalkMesh};

/// Most leaves of a plant.
pub const MOST_LEAVES: usize = 100_000;
/// Most vertices of its axes and buds.
pub const MOST_VERTICES: usize = 1 << 23;

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
    /// The buds; none if none are seen.
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
    /// The place within the axis where its petiole stands.
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
    /// There is too much of it.
    #[error(
        "the plant has more than {MOST_LEAVES} leaves, or {MOST_VERTICES} vertices of axes and buds"
    )]
    TooLarge,
    /// An axis bends so sharply that it is no tube.
    #[error("an axis cannot be built: {0}")]
    Bent(#[from] StalkError),
    /// No leaf is given.
    #[error("a plant bears one leaf at least")]
    NoLeaf,
    /// A leaf cannot be borne.
    #[error(transparent)]
    NotBorne(#[from] NotBorne),
}

impl PlantPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`PlantError::OutOfRange`] for the first field out of range, [`PlantError::NoRoom`].
    pub fn validate(&self) -> Result<(), PlantError> {
        let (axis, posture) = (&self.axis, &self.posture);
        let within = |field, value: f64, [least, most]: [f64; 2], range| {
            let is_good = (least..=most).contains(&value);
            is_good.then_some(()).ok_or(PlantError::OutOfRange {
                field,
                value,
                range,
            })
        };
        let each = |field, values: &[f64], limits, range| {
            values
                .iter()
                .try_for_each(|&value| within(field, value, limits, range))
        };
        let many = f64::from(self.individuals);
        within("individuals", many, [1.0, 1000.0], "1 to 1000")?;
        within("length_mm", axis.length_mm, [1.0, 1e5], "1 to 100000")?;
        within("nodes", f64::from(axis.nodes), [1.0, 1000.0], "1 to 1000")?;
        within("bare", axis.bare, [0.0, 0.99], "0 to 0.99")?;
        within("shortening", axis.shortening, [0.5, 1.5], "0.5 to 1.5")?;
        each("radius_mm", &axis.radius_mm, [0.05, 1000.0], "0.05 to 1000")?;
        within("swelling", axis.swelling, [0.0, 1.0], "0 to 1")?;
        let leaves = axis.phyllotaxis;
        within(
            "per_node",
            f64::from(leaves.per_node),
            [1.0, 12.0],
            "1 to 12",
        )?;
        within(
            "divergence_deg",
            leaves.divergence,
            [-PI, PI],
            "-180° to 180°",
        )?;
        within("zigzag_deg", axis.zigzag, [0.0, 0.6], "0 to 34°")?;
        within("inclination_deg", axis.inclination, [0.0, PI], "0 to 180°")?;
        within("upward_deg", axis.upward, [-3.0, 3.0], "-171° to 171°")?;
        within("stray_deg", axis.stray, [0.0, 0.5], "0 to 28°")?;
        each(
            "posture.angle_deg",
            &posture.angle,
            [0.05, 3.0],
            "3° to 171°",
        )?;
        each("posture.size", &posture.size, [0.02, 2.0], "0.02 to 2")?;
        within("posture.to_light", posture.to_light, [0.0, 1.0], "0 to 1")?;
        let length = posture.light.length();
        within("posture.light", length, [0.999, 1.001], "a unit vector")?;
        within("posture.stray_deg", posture.stray, [0.0, 0.7], "0 to 40°")?;
        let cluster = f64::from(posture.cluster);
        within("posture.cluster", cluster, [1.0, 12.0], "1 to 12")?;
        within(
            "posture.spur_mm",
            posture.spur_mm,
            [0.5, 200.0],
            "0.5 to 200",
        )?;
        if let Some(branches) = &self.branching {
            let order = f64::from(branches.order);
            within("branches.order", order, [1.0, 4.0], "1 to 4")?;
            each("branches.between", &branches.between, [0.0, 1.0], "0 to 1")?;
            each(
                "branches.length",
                &branches.length,
                [0.02, 1.0],
                "0.02 to 1",
            )?;
            within(
                "branches.angle_deg",
                branches.angle,
                [0.1, 2.0],
                "6° to 114°",
            )?;
            let thickness = branches.thickness;
            within("branches.thickness", thickness, [0.1, 1.0], "0.1 to 1")?;
            within("branches.share", branches.share, [0.0, 1.0], "0 to 1")?;
        }
        if let Some(buds) = &self.buds {
            within("buds.length_mm", buds.length_mm, [0.2, 50.0], "0.2 to 50")?;
            within("buds.radius_mm", buds.radius_mm, [0.1, 20.0], "0.1 to 20")?;
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
        if feet.is_empty() || feet.iter().any(Vec::is_empty) {
            return Err(PlantError::NoLeaf);
        }
        bearing::grow(plan, feet)
    }
}
