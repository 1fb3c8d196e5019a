//! What a simulation has grown, and the network that it becomes: widths, orders, millimetres.

use glam::DVec2;
use rayon::prelude::*;

use super::conformal_map::ConformalMap;
use super::network::{Ending, VeinEdge, VeinNode, VenationNetwork};
use super::plan::AuxinPlan;
use super::topology::Topology;
use super::width::RadiusTable;
use super::{order, tension, width};

/// A simulation's state, in segments of its step, base at the origin, without widths.
#[derive(Debug, PartialEq)]
pub(crate) struct Grown {
    pub(super) positions: Vec<DVec2>,
    pub(super) births: Vec<u32>,
    /// The order as which each node was laid out, 0 for none; empty without an architecture.
    pub(super) laid_orders: Vec<u8>,
    /// Whether tension leaves a node in its place: it was laid out or given.
    pub(super) is_held: Vec<bool>,
    pub(super) edges: Vec<[u32; 2]>,
    pub(super) origins: u32,
    pub(super) steps: u32,
    pub(super) sources: u32,
    /// Places of the sources that are there, in the order of their birth.
    pub(super) live_sources: Vec<DVec2>,
    pub(super) ending: Ending,
    pub(super) margin: Vec<DVec2>,
    pub(super) apex: DVec2,
    /// Apex of the leaf to which the conformal map belongs: only isogonic growth scales the map.
    pub(super) map_apex: DVec2,
}

impl Grown {
    /// Adds straight veins from the base to all origins. The base becomes node 0; the numbers of
    /// all other nodes rise by one.
    fn joined(mut self) -> Self {
        self.positions.insert(0, DVec2::ZERO);
        self.births.insert(0, 0);
        if !self.laid_orders.is_empty() {
            self.laid_orders.insert(0, 0);
        }
        self.is_held.insert(0, true);
        let grown = self.edges.iter().map(|&[from, to]| [from + 1, to + 1]);
        let joints = (1..=self.origins).map(|origin| [0, origin]);
        self.edges = joints.chain(grown).collect();
        self.origins = 1;
        self
    }

    /// Adds widths and orders and converts to millimetres.
    pub(super) fn into_network(
        self,
        plan: &AuxinPlan,
        segment_mm: f64,
        base: DVec2,
    ) -> VenationNetwork {
        let grown = if plan.joined_origins {
            self.joined()
        } else {
            self
        };
        grown.widened(plan, segment_mm, base)
    }

    fn widened(self, plan: &AuxinPlan, segment_mm: f64, base: DVec2) -> VenationNetwork {
        let apex = self.map_apex * segment_mm;
        let curvature = plan.gaussian_curvature / apex.length_squared();
        let map = ConformalMap::new(curvature, base + apex * 0.5);
        let place = |node: u32| base + self.positions[node as usize] * segment_mm;
        let topology = Topology::new(self.positions.len(), &self.edges);
        let base_to_tip = topology
            .base_to_tip()
            .expect("children and junctions are younger than what leads to them, so no edges run in a circle");
        let law = plan.width_law();
        let mut flows = width::flows(&topology, &base_to_tip, |_| 0.0);
        let mut table = RadiusTable::new(law, &flows);
        let radius = |table: &RadiusTable, flow| plan.veinlet_radius_mm * table.radius(flow);
        let of_edges = |table: &RadiusTable, flows: &width::Flows| -> Vec<f64> {
            let flows = flows.edges.par_iter();
            flows.map(|&flow| radius(table, flow)).collect()
        };
        let mut radii = of_edges(&table, &flows);
        let orders = order::orders(
            &topology,
            &self.positions,
            &radii,
            &base_to_tip,
            &self.laid_orders,
            order::Look::Segments,
        );
        if plan.unseen_veinlets > 0.0 {
            let major = |edge: u32| orders.edges[edge as usize] <= 2;
            flows = width::flows(&topology, &base_to_tip, |node| {
                let bears = topology.entering(node).iter().any(|&edge| major(edge));
                if bears { plan.unseen_veinlets } else { 0.0 }
            });
            table = RadiusTable::new(law, &flows);
            radii = of_edges(&table, &flows);
        }
        let edges: Vec<VeinEdge> = self
            .edges
            .par_iter()
            .enumerate()
            .map(|(i, &[from, to])| {
                // A lateral starts with its own radius; only a vein that continues tapers between
                // its nodes.
                let continues = orders.continuations[from as usize] == Some(i as u32);
                let start = if continues {
                    radius(&table, flows.nodes[from as usize])
                } else {
                    radii[i]
                };
                VeinEdge {
                    from,
                    to,
                    radius_from: start.max(radii[i]) * map.enlargement(place(from)),
                    radius_to: radii[i] * map.enlargement(place(to)),
                    order: orders.edges[i],
                }
            })
            .collect();
        let positions = if plan.tension_rounds == 0 {
            self.positions
        } else {
            let is_free = |node: usize| !self.is_held[node];
            tension::relaxed(&self.positions, &edges, is_free, plan.tension_rounds)
        };
        let nodes = positions
            .iter()
            .zip(&self.births)
            .map(|(&position, &born)| VeinNode {
                position: base + position * segment_mm,
                born,
            })
            .collect();
        VenationNetwork {
            nodes,
            edges,
            map,
            origins: self.origins,
            steps: self.steps,
            sources: self.sources,
            segment_mm,
            ending: self.ending,
        }
    }
}
