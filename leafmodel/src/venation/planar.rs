//! The veins as a plane graph: edges meet at nodes only.
//!
//! In a grown network veins cross in rare cases; in networks of other programs they may cross
//! anywhere. Faces can be followed only if every crossing is a node, so edges are cut at crossings
//! first.
//!
//! - **In**: a [`VenationNetwork`].
//! - **Out**: nodes and edges without crossings, ordered by place (rows of a grid) so that
//!   neighbours on the leaf are neighbours in memory; and a grid that finds edges near a point.
//! - **Always true**: up to rounding, two edges share at most a node at their ends; no two edges
//!   join the same two nodes.
//! - **Left out**: crossings that arise when rounding displaces a cut edge.

mod contacts;
mod grid;
#[cfg(test)]
mod tests;

use glam::DVec2;

pub(crate) use self::grid::EdgeGrid;
use self::grid::cells_around;
use super::network::{VeinEdge, VenationNetwork};
use crate::buckets::Buckets;

/// A network whose edges meet at nodes only.
#[derive(Clone, Debug)]
pub struct PlaneGraph {
    nodes: Vec<DVec2>,
    edges: Vec<VeinEdge>,
    grid: EdgeGrid,
    crossings: Vec<DVec2>,
    touches: Vec<DVec2>,
}

impl PlaneGraph {
    /// Cuts the edges of a network wherever they cross or touch. The time is proportional to the
    /// number of edges if they have similar lengths.
    pub fn new(network: &VenationNetwork) -> Self {
        let (mut nodes, mut edges) = in_rows(network);
        let length = |e: &VeinEdge| (nodes[e.to as usize] - nodes[e.from as usize]).length();
        let mean_length = edges.iter().map(length).sum::<f64>() / (edges.len() as f64).max(1.0);
        let mut grid = EdgeGrid::new(&nodes, &edges, mean_length);
        let found = contacts::find(&nodes, &edges, &grid, mean_length);
        let (crossings, touches) = (found.crossings(&nodes, &edges), found.touches(&nodes));
        if !found.are_none() {
            contacts::cut(&mut nodes, &mut edges, found);
            grid = EdgeGrid::new(&nodes, &edges, mean_length);
        }
        Self {
            nodes,
            edges,
            grid,
            crossings,
            touches,
        }
    }

    /// Places of the nodes, mm. Nodes that a cut left without an edge stay in the list.
    pub fn nodes(&self) -> &[DVec2] {
        &self.nodes
    }

    /// The edges; their node numbers refer to [`PlaneGraph::nodes`]. The pieces of a cut edge have
    /// its order, and radii between its own.
    pub fn edges(&self) -> &[VeinEdge] {
        &self.edges
    }

    /// Number of pairs of edges that crossed. Each crossing adds one loop to those of the network,
    /// unless it joins two components.
    pub fn crossings(&self) -> usize {
        self.crossings.len()
    }

    /// Where pairs of edges crossed, mm.
    pub(crate) fn crossing_places(&self) -> &[DVec2] {
        &self.crossings
    }

    /// Where nodes lay on edges that did not end there, or on other nodes, mm.
    pub(crate) fn touch_places(&self) -> &[DVec2] {
        &self.touches
    }

    pub(crate) fn grid(&self) -> &EdgeGrid {
        &self.grid
    }

    /// Distance from `p` to the midline of the nearest vein, mm; `None` without veins.
    pub fn distance_to_vein(&self, p: DVec2) -> Option<f64> {
        self.grid.distance(&self.nodes, &self.edges, p)
    }
}

/// The network's nodes and edges, renumbered by the place of the nodes.
fn in_rows(network: &VenationNetwork) -> (Vec<DVec2>, Vec<VeinEdge>) {
    let count = network.nodes().len();
    let lattice = cells_around(network.nodes().iter().map(|n| n.position), count, 0.0);
    let places = network.nodes().iter().map(|node| node.position);
    let cells = places.map(|place| lattice.cell(place));
    let order = Buckets::new(lattice.cells(), cells.zip(0_u32..)).into_members();
    let mut ranks = vec![0_u32; count];
    let mut nodes = Vec::with_capacity(count);
    for (rank, &node) in (0..).zip(&order) {
        ranks[node as usize] = rank;
        nodes.push(network.nodes()[node as usize].position);
    }
    let edges = network.edges().iter().map(|edge| VeinEdge {
        from: ranks[edge.from as usize],
        to: ranks[edge.to as usize],
        ..*edge
    });
    let by_start = Buckets::new(count, edges.map(|edge| (edge.from as usize, edge)));
    (nodes, by_start.into_members())
}
