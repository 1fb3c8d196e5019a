//! Boughs and shoots: axes with nodes, and the place of each leaf, bud, branch and flower; pots, and
//! walls to climb on.
//!
//! An axis grows node by node. Each node bears one leaf or several, turned against those of the
//! node before (phyllotaxis). In its axil there may be a bud, in its place a branch, or a short shoot
//! with a cluster of leaves. A petiole, which is part of the leaf, twists and bends until the blade
//! faces the light, as far as it may. Where blades would cut each other or an axis, they turn out of
//! the way.
//!
//! - **In**: a plan ([`PlantPlan`]), how each leaf is held ([`Foot`]), and the [`Wall`] on which
//!   the plant climbs.
//! - **Out**: the axes as closed tubes, a transform for each leaf, the bodies of a flower, a pot with
//!   soil and crumbs ([`Plant`]).
//! - **Always true**: the foot of each petiole lies within its axis; neighbours on an axis are
//!   different individuals; axes that climb lie on the wall; same plan and seed, same plant, bit for
//!   bit.
//! - **Left out**: relief of bark is in nobody's way, nor is a wall in its; compound leaves, petioles and what the weather did to a blade are in nobody's way;
//!   leaves that find no free place cut others; wood does not bend under the weight of leaves.
//!
//! The plant's frame: the foot of its main axis is the origin, z is up. Lengths are millimetres.

mod apart;
mod axis;
mod bark;
mod bearing;
mod check;
mod climbing;
mod flower;
mod foot;
mod posture;
mod pot;
pub mod presets;
mod stems;
#[cfg(test)]
mod tests;
mod turned;

use glam::{DAffine3, DVec3};
use thiserror::Error;

pub use self::bark::BarkRelief;
use self::check::{phyllotaxis, rising, towards_light};
pub use self::climbing::{Climbing, Wall};
pub use self::flower::FlowerPlan;
pub use self::foot::{Foot, NotBorne};
pub use self::pot::{Crumb, PotPlan};
use crate::blade::stalk::{StalkError, StalkMesh};
use crate::document::declared::Declared;
use crate::document::ranges::RangeError;

/// Most leaves of a plant.
pub const MOST_LEAVES: usize = 100_000;
/// Most vertices of its axes and buds.
pub const MOST_VERTICES: usize = 1 << 23;

/// The numbers of a plant. Angles are radians.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct PlantPlan {
    /// Same plan and seed, same plant.
    #[key("seed")]
    pub seed: u64,
    /// Different leaves of each kind that are grown; neighbours differ from 2 on.
    #[key("individuals", 1..=1000)]
    pub individuals: u32,
    /// The main axis.
    #[key(flat)]
    pub axis: AxisPlan,
    /// Branches in the axils of leaves.
    #[key("branches", block, default = Branching::USUAL)]
    pub branching: Option<Branching>,
    /// How leaves stand on their axis.
    #[key("posture", block)]
    pub posture: Posture,
    /// Other turns about its foot that a leaf tries whose blade would cut another one or an axis; it
    /// takes the first that cuts nothing, or the one that cuts least. Compound leaves and plants
    /// that climb try none.
    #[key("evasions", 0..=1000)]
    pub evasions: u32,
    /// Buds in the axils of leaves and at the tips.
    #[key("buds", block, default = Buds { length_mm: 4.0, radius_mm: 1.2 })]
    pub buds: Option<Buds>,
    /// The stems that rise from its foot.
    #[key("stems", block)]
    pub stems: Stems,
    /// Whether its axes are green and soft instead of bark.
    #[key("green")]
    pub is_green: bool,
    /// The relief of its axes; left out, they are smooth.
    #[key("relief", block, default = BarkRelief::USUAL)]
    pub relief: Option<BarkRelief>,
    /// A flower at the tip of each stem.
    #[key("flower", block, default = FlowerPlan::USUAL)]
    pub flower: Option<FlowerPlan>,
    /// How it climbs on a wall; left out, its axes stand free.
    #[key("climbing", block, default = Climbing::USUAL)]
    pub climbing: Option<Climbing>,
    /// A pot with soil, in which it stands.
    #[key("pot", block, default = PotPlan::USUAL)]
    pub pot: Option<PotPlan>,
}

/// The stems that rise from the foot of a plant. The first is the main axis, the others are
/// shorter.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Stems {
    /// How many; the first is the main axis, the others are shorter.
    #[key("count", 1..=100)]
    pub count: u32,
    /// Radius of the disc within which they rise; along a wall, half the width.
    #[key("spread_mm", 0.0..=1e4)]
    pub spread_mm: f64,
    /// Angle by which the outermost lean outwards.
    ///
    /// Radians.
    #[key("fan_deg", degrees(0.0..=80.0))]
    pub fan: f64,
}

impl Stems {
    /// One.
    pub const ONE: Self = Self {
        count: 1,
        spread_mm: 0.0,
        fan: 0.0,
    };
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
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct AxisPlan {
    /// Length of the main axis.
    #[key("length_mm", 1.0..=1e5)]
    pub length_mm: f64,
    /// Nodes of the main axis, the last one at its tip.
    #[key("nodes", 1..=1000)]
    pub nodes: u32,
    /// Share of an axis below its first node.
    #[key("bare", 0.0..=0.99)]
    pub bare: f64,
    /// Length of each internode over that of the one before.
    #[key("shortening", 0.5..=1.5)]
    pub shortening: f64,
    /// Radius at the foot and at the tip.
    #[key("radius_mm", 0.05..=1000.0)]
    pub radius_mm: [f64; 2],
    /// How much thicker nodes are, over the radius.
    #[key("swelling", 0.0..=1.0)]
    pub swelling: f64,
    /// How leaves follow one another.
    #[key(with = phyllotaxis)]
    pub phyllotaxis: Phyllotaxis,
    /// Angle by which the axis bends away from the leaf at each node of one leaf.
    ///
    /// Radians.
    #[key("zigzag_deg", degrees(0.0..=34.0))]
    pub zigzag: f64,
    /// Angle of its foot from upright, towards +y.
    ///
    /// Radians.
    #[key("inclination_deg", degrees(0.0..=180.0))]
    pub inclination: f64,
    /// Angle by which a level axis would turn upwards from foot to tip; below 0 it droops.
    ///
    /// Radians.
    #[key("upward_deg", degrees(-170.0..=170.0))]
    pub upward: f64,
    /// Standard deviation of the bend of each internode.
    ///
    /// Radians.
    #[key("stray_deg", degrees(0.0..=28.0))]
    pub stray: f64,
}

/// Branches in the axils of leaves.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = rising)]
pub struct Branching {
    /// 1: the main axis has branches; 2: these have branches too; and so on.
    #[key("order", 1..=4)]
    pub order: u32,
    /// The nodes with branches: from and up to these shares of their axis.
    #[key("between", 0.0..=1.0)]
    pub between: [f64; 2],
    /// Their lengths at both ends of that, over that of the axis that bears them.
    #[key("length", 0.02..=1.0)]
    pub length: [f64; 2],
    /// Angle from the axis that bears them.
    ///
    /// Radians.
    #[key("angle_deg", degrees(6.0..=114.0))]
    pub angle: f64,
    /// Radius of a branch's foot over that of its axis there.
    #[key("thickness", 0.1..=1.0)]
    pub thickness: f64,
    /// Share of the axils there that have one; the others bear leaves.
    #[key("share", 0.0..=1.0)]
    pub share: f64,
}

/// How leaves stand on their axis.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = towards_light)]
pub struct Posture {
    /// Angle of the petiole's foot from the axis, at the axis' foot and at its tip.
    ///
    /// Radians.
    #[key("angle_deg", degrees(3.0..=170.0))]
    pub angle: [f64; 2],
    /// Factor on the leaves at the axis' foot, in its middle and at its tip.
    #[key("size", 0.02..=2.0)]
    pub size: [f64; 3],
    /// Share of the turn to the light that petioles make.
    #[key("to_light", 0.0..=1.0)]
    pub to_light: f64,
    /// Where the light comes from, in the plant's frame; any length but 0.
    #[key("light", -1e6..=1e6)]
    pub light: DVec3,
    /// Standard deviation of the turns of each leaf.
    ///
    /// Radians.
    #[key("stray_deg", degrees(0.0..=40.0))]
    pub stray: f64,
    /// Leaves of each short shoot; with 1 there are no short shoots.
    #[key("cluster", 1..=12)]
    pub cluster: u32,
    /// Length of a short shoot.
    #[key("spur_mm", 0.5..=200.0)]
    pub spur_mm: f64,
}

/// The buds in the axils of leaves and at the tips.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Buds {
    /// Length.
    #[key("length_mm", 0.2..=50.0)]
    pub length_mm: f64,
    /// Greatest radius.
    #[key("radius_mm", 0.1..=20.0)]
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

/// What a body of a plant is, which decides what it is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Organ {
    /// The peduncle of a flower.
    Peduncle,
    /// Filaments of stamens.
    Filaments,
    /// Anthers.
    Anthers,
    /// Ovary and stigmas.
    Pistil,
    /// A pot and its dish.
    Pot,
    /// The surface of the soil in the pot.
    Soil,
}

/// A grown plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// Axes, short shoots, buds and rootlets.
    pub axes: StalkMesh,
    /// The leaves. With a flower, its sepals and petals are the last two kinds.
    pub leaves: Vec<BorneLeaf>,
    /// Bodies besides the axes.
    pub organs: Vec<(Organ, StalkMesh)>,
    /// Crumbs on the soil of its pot.
    pub crumbs: Vec<Crumb>,
    /// How many leaves cut another one or an axis after all; `None` where not all were looked at:
    /// of plants that climb, of very many leaves, and without `evasions`.
    pub crossing: Option<usize>,
}

/// Why a plant cannot be grown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlantError {
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] RangeError),
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
    /// No leaf is given, or with a flower no sepal or no petal.
    #[error("a plant bears one leaf at least, and with a flower a sepal and a petal")]
    NoLeaf,
    /// A pot has no inside.
    #[error("the walls of the pot leave no room for soil")]
    NoPot,
    /// A leaf cannot be borne.
    #[error(transparent)]
    NotBorne(#[from] NotBorne),
}

impl Plant {
    /// Grows a plant; `feet` says how each individual of each kind of leaf is held. With a flower
    /// the last two kinds are its sepals and petals. What climbs does so on the wall, or on an
    /// even one if none is given.
    ///
    /// # Errors
    ///
    /// [`PlantError`].
    pub fn grow(
        plan: &PlantPlan,
        feet: &[Vec<Foot>],
        wall: Option<&Wall>,
    ) -> Result<Self, PlantError> {
        plan.validate()?;
        let least = if plan.flower.is_some() { 3 } else { 1 };
        if feet.len() < least || feet.iter().any(Vec::is_empty) {
            return Err(PlantError::NoLeaf);
        }
        let even = plan.climbing.map(|climbing| Wall::flat(climbing.away));
        let wall = wall.filter(|_| even.is_some()).or(even.as_ref());
        bearing::grow(plan, feet, wall)
    }
}
