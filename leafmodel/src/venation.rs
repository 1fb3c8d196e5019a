//! Veins: networks drawn towards auxin, and their widths.
//!
//! Auxin sources appear in the lamina away from veins; veins grow towards the sources; sources that
//! veins have reached are used up; and the lamina grows meanwhile, which makes room for more. [`grow`] runs
//! that loop, gives each vein its width and its order, and returns the network.
//!
//! - **In**: an [`Outline`], a [`VenationPlan`], a seed.
//! - **Out**: a [`VenationNetwork`] in millimetres, in the frame of the outline.
//! - **Always true**: every node lies inside the outline; the network is connected and passes its own
//!   [`VenationNetwork::validate`]; the same input gives the same bits on every machine.
//! - **Left out** so far: non-uniform growth, several seed nodes, the Urquhart approximation.
//!
//! # Source
//!
//! \[runions2005\]; `docs/src/theory/venation.md` tells what it leaves open and how that is settled.

#[cfg(test)]
mod agreement;
#[cfg(test)]
mod all_pairs;
mod auxin;
mod chance;
mod closed;
mod fresh_nodes;
mod horizon;
mod influence;
mod lamina_clock;
mod length_queue;
pub mod network;
mod open;
mod order;
pub mod plan;
mod point_tree;
mod probe;
mod relative_neighbourhood;
mod simulation;
mod topology;
mod veins;
mod width;

use glam::DVec2;
use thiserror::Error;

use self::auxin::waiting_darts;
use self::closed::RelativeNeighbours;
use self::influence::Influence;
use self::lamina_clock::LaminaClock;
use self::network::{Ending, VeinEdge, VeinNode, VenationNetwork};
use self::open::NearestNode;
use self::plan::{Growth, Pattern, PlanError, VenationPlan};
use self::simulation::Simulation;
use self::topology::Topology;
use crate::shape::outline::Outline;

/// Why no veins grow.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum VenationError {
    /// The plan cannot be carried out.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// Grows the veins of a leaf.
///
/// A vein segment is the midrib's length over `plan.final_length`. Veins start from one node at the base.
///
/// # Errors
///
/// [`VenationError`] if the plan cannot be carried out on this outline.
///
/// # Source
///
/// \[runions2005\], sections 3 and 4.
pub fn grow(
    outline: &Outline,
    plan: &VenationPlan,
    seed: u64,
) -> Result<VenationNetwork, VenationError> {
    plan.validate()?;
    let segment_mm = outline.length() / plan.final_length;
    let blade = outline.moved_and_scaled(outline.base(), 1.0 / segment_mm);
    let clock = LaminaClock::new(plan).map_err(PlanError::from)?;
    check_darts(plan, &blade, &clock)?;
    let grown = match plan.pattern {
        Pattern::Open => simulate::<NearestNode>(plan, &blade, clock, seed),
        Pattern::Closed(_) => simulate::<RelativeNeighbours>(plan, &blade, clock, seed),
    };
    let place = |p: DVec2| outline.base() + p * segment_mm;
    Ok(grown.into_network(plan, segment_mm, place))
}

/// Refuses plans whose darts would take forever.
fn check_darts(plan: &VenationPlan, blade: &Outline, clock: &LaminaClock) -> Result<(), PlanError> {
    let (low, high) = blade.bounds();
    let size = high - low;
    VenationPlan::validate_darts(match plan.growth {
        Growth::None | Growth::Isogonic { .. } | Growth::Anisotropic { .. } => {
            plan.darts_per_area * size.x * size.y
        }
        Growth::Marginal { .. } => waiting_darts(plan, size, clock.last_growth_step()),
    })
}

/// A finished simulation: positions in segments, no widths yet.
#[derive(Debug, PartialEq)]
pub(crate) struct Grown {
    positions: Vec<DVec2>,
    births: Vec<u32>,
    edges: Vec<[u32; 2]>,
    steps: u32,
    sources: u32,
    ending: Ending,
}

fn simulate<I: Influence>(
    plan: &VenationPlan,
    blade: &Outline,
    clock: LaminaClock,
    seed: u64,
) -> Grown {
    let mut simulation = Simulation::<I>::new(plan, blade, clock, seed);
    let ending = simulation.run();
    let mut edges = simulation.veins.edges;
    edges.sort_unstable_by_key(|&[from, to]| (to, from));
    Grown {
        positions: simulation.veins.positions,
        births: simulation.veins.births,
        edges,
        steps: simulation.step,
        sources: simulation.sources_born,
        ending,
    }
}

impl Grown {
    /// Widths, orders, and millimetres.
    fn into_network(
        self,
        plan: &VenationPlan,
        segment_mm: f64,
        place: impl Fn(DVec2) -> DVec2,
    ) -> VenationNetwork {
        let topology = Topology::new(self.positions.len(), &self.edges);
        let base_to_tip = topology
            .base_to_tip()
            .expect("children and junctions are younger than what leads to them, so no edges run in a circle");
        let flows = width::flows(&topology, &base_to_tip);
        let radius = |flow: f64| width::radius(flow, plan.veinlet_radius_mm, plan.murray_exponent);
        let radii: Vec<f64> = flows.edges.iter().map(|&flow| radius(flow)).collect();
        let orders = order::orders(&topology, &self.positions, &radii, &base_to_tip);
        let edges = self
            .edges
            .iter()
            .enumerate()
            .map(|(i, &[from, to])| {
                // A lateral starts as wide as it goes on; only the vein itself tapers where it gives one off.
                let continues = orders.continuations[from as usize] == Some(i as u32);
                let start = if continues {
                    radius(flows.nodes[from as usize])
                } else {
                    radii[i]
                };
                VeinEdge {
                    from,
                    to,
                    radius_from: start.max(radii[i]),
                    radius_to: radii[i],
                    order: orders.edges[i],
                }
            })
            .collect();
        let nodes = self
            .positions
            .iter()
            .zip(&self.births)
            .map(|(&position, &born)| VeinNode {
                position: place(position),
                born,
            })
            .collect();
        VenationNetwork {
            nodes,
            edges,
            steps: self.steps,
            sources: self.sources,
            segment_mm,
            ending: self.ending,
        }
    }
}
