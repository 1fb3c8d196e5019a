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
mod plan;
mod posture;
mod pot;
pub mod presets;
mod stems;

#[cfg(test)]
mod tests;
mod turned;

use glam::{DAffine3, DVec3};

pub use self::bark::BarkRelief;
pub use self::climbing::{Climbing, Wall};
pub use self::flower::FlowerPlan;
use self::foot::ANOTHER;
pub use self::foot::Foot;
pub use self::plan::{AxisPlan, Branching, Buds, Phyllotaxis, PlantPlan, Posture, Stems};
pub use self::pot::{Crumb, PotPlan};
use crate::blade::stalk::StalkMesh;
use crate::not_grown::NotGrown;

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

impl Plant {
    /// Grows a plant; `feet` says how each individual of each kind of leaf is held. With a flower
    /// the last two kinds are its sepals and petals. What climbs does so on the wall, or on an
    /// even one if none is given.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub fn grow(
        plan: &PlantPlan,
        feet: &[Vec<Foot>],
        wall: Option<&Wall>,
    ) -> Result<Self, NotGrown> {
        plan.validate()?;
        let least = if plan.flower.is_some() { 3 } else { 1 };
        if feet.len() < least || feet.iter().any(Vec::is_empty) {
            let problem = "a plant bears one leaf at least, and with a flower a sepal and a petal";
            return Err(NotGrown::because(problem).mend("leaf", ANOTHER));
        }
        let even = plan.climbing.map(|climbing| Wall::flat(climbing.away));
        let wall = wall.filter(|_| even.is_some()).or(even.as_ref());
        bearing::grow(plan, feet, wall)
    }
}
