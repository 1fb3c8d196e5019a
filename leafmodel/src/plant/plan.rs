//! The plan of a plant: its axes, and how they bear leaves.

use glam::DVec3;

use super::bark::BarkRelief;
use super::climbing::Climbing;
use super::flower::FlowerPlan;
use super::pot::PotPlan;
use crate::document::{Declared, Degrees, Integer, Keys, Limits, Word};

/// The keys of a phyllotaxis, and what it is by its name.
fn phyllotaxis(axis: &mut AxisPlan, keys: &mut Keys<'_>) {
    let known = [
        ("distichous", Phyllotaxis::DISTICHOUS),
        ("decussate", Phyllotaxis::DECUSSATE),
        ("spiral", Phyllotaxis::SPIRAL),
        ("whorled", Phyllotaxis::WHORLED),
    ];
    // A file says so much of what no word stands for.
    let own = keys.reader().is_none() && known.iter().all(|(_, one)| *one != axis.phyllotaxis);
    let about = "How leaves follow one another: in two rows, in pairs at right angles, one by one \
        by the golden angle, or in whorls of three.";
    if !own {
        keys.key("phyllotaxis", &mut axis.phyllotaxis, Word(&known), about);
    }
    let about = "Leaves of a node, instead of what `phyllotaxis` says.";
    let mut per_node = own.then_some(axis.phyllotaxis.per_node);
    keys.optional("per_node", &mut per_node, Integer::within(1, 12), about);
    let about = "Angle about the axis from node to node, instead of what `phyllotaxis` says.";
    let mut divergence = own.then_some(axis.phyllotaxis.divergence);
    let limits = Degrees(Limits::closed(-180.0, 180.0));
    keys.optional("divergence_deg", &mut divergence, limits, about);
    axis.phyllotaxis = Phyllotaxis {
        per_node: per_node.unwrap_or(axis.phyllotaxis.per_node),
        divergence: divergence.unwrap_or(axis.phyllotaxis.divergence),
    };
}

/// Reports branches that begin behind their end.
fn rising(branches: &Branching, keys: &Keys<'_>) {
    let [from, to] = branches.between;
    if from > to {
        let problem = format!("there is nothing from {from} up to {to}");
        keys.refuse(&["between"], problem, "write the smaller share first");
    }
}

/// Gives the direction of the light the length 1.
fn towards_light(posture: &mut Posture, keys: &Keys<'_>) {
    match posture.light.try_normalize() {
        Some(light) => posture.light = light,
        None => keys.refuse(
            &["light"],
            "a direction of length 0 is none".to_owned(),
            "write where the light comes from, such as `[0, 0, 1]`",
        ),
    }
}

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
