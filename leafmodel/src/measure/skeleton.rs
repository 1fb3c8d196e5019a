//! The edges that meet at a node, and the directions of veins.

use glam::DVec2;

use crate::venation::network::VeinEdge;
use crate::venation::planar::PlaneGraph;
use crate::venation::topology::Topology;

/// Number of edges over which directions at a junction are taken, at most up to the next junction.
const LOOK: usize = 4;

/// A plane graph with its edges sorted by the nodes at their ends.
pub(super) struct Skeleton<'a> {
    graph: &'a PlaneGraph,
    pub(super) topology: Topology<'a>,
}

impl<'a> Skeleton<'a> {
    /// Sorts `edges`, which are the ends of the graph's.
    pub(super) fn new(graph: &'a PlaneGraph, edges: &'a [[u32; 2]]) -> Self {
        Self {
            graph,
            topology: Topology::new(graph.nodes().len(), edges),
        }
    }

    pub(super) fn nodes(&self) -> std::ops::Range<u32> {
        0..self.graph.nodes().len() as u32
    }

    pub(super) fn place(&self, node: u32) -> DVec2 {
        self.graph.nodes()[node as usize]
    }

    pub(super) fn edge(&self, edge: u32) -> &VeinEdge {
        &self.graph.edges()[edge as usize]
    }

    /// Length of the veins of each order, mm, from order 1 to the finest.
    pub(super) fn lengths_by_order(&self) -> Vec<f64> {
        let mut lengths = vec![0.0; usize::from(u8::MAX)];
        for edge in self.graph.edges() {
            let length = (self.place(edge.to) - self.place(edge.from)).length();
            lengths[usize::from(edge.order) - 1] += length;
        }
        let last = lengths.iter().rposition(|&length| length > 0.0);
        lengths.truncate(last.map_or(0, |last| last + 1));
        lengths
    }

    /// Edges at a node.
    pub(super) fn degree(&self, node: u32) -> usize {
        self.topology.entering(node).len() + self.topology.leaving(node).len()
    }

    /// Direction in which an edge leads away from its node, over a few edges.
    pub(super) fn departure(&self, edge: u32) -> DVec2 {
        let [from, mut ahead] = self.topology.edge(edge);
        for _ in 1..LOOK {
            match (self.degree(ahead), self.topology.leaving(ahead)) {
                (2, &[next]) => ahead = self.topology.edge(next)[1],
                _ => break,
            }
        }
        self.place(ahead) - self.place(from)
    }

    /// Direction in which an edge comes to its node, over a few edges.
    pub(super) fn arrival(&self, edge: u32) -> DVec2 {
        let [mut back, to] = self.topology.edge(edge);
        for _ in 1..LOOK {
            match (self.degree(back), self.topology.entering(back)) {
                (2, &[before]) => back = self.topology.edge(before)[0],
                _ => break,
            }
        }
        self.place(to) - self.place(back)
    }
}

/// Angle between two directions, 0° to 180°.
pub(super) fn angle_deg(a: DVec2, b: DVec2) -> f64 {
    libm::atan2(a.perp_dot(b).abs(), a.dot(b)).to_degrees()
}
