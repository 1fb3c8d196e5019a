//! The edges that meet at a node, and the directions of veins.

use glam::DVec2;

use crate::venation::network::VeinEdge;
use crate::venation::planar::PlaneGraph;
use crate::venation::topology::Topology;

/// Length over which directions at a junction are taken, in segments of the network, at most up to the
/// next junction. It is a length, so that nothing depends on how finely a vein is digitised.
const LOOK_SEGMENTS: f64 = 4.0;

/// A plane graph with its edges sorted by the nodes at their ends.
pub(super) struct Skeleton<'a> {
    graph: &'a PlaneGraph,
    pub(super) topology: Topology<'a>,
    /// Length over which directions are taken, mm.
    look: f64,
}

impl<'a> Skeleton<'a> {
    /// Sorts `edges`, which are the ends of the graph's; `segment_mm` is that of the network.
    pub(super) fn new(graph: &'a PlaneGraph, edges: &'a [[u32; 2]], segment_mm: f64) -> Self {
        Self {
            graph,
            topology: Topology::new(graph.nodes().len(), edges),
            look: LOOK_SEGMENTS * segment_mm,
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

    /// Direction in which an edge leads away from its node, over a short length.
    pub(super) fn departure(&self, edge: u32) -> DVec2 {
        let [from, ahead] = self.topology.edge(edge);
        self.ahead(from, ahead, |node| match self.topology.leaving(node) {
            &[next] => Some(self.topology.edge(next)[1]),
            _ => None,
        })
    }

    /// Direction in which an edge comes to its node, over a short length.
    pub(super) fn arrival(&self, edge: u32) -> DVec2 {
        let [back, to] = self.topology.edge(edge);
        -self.ahead(to, back, |node| match self.topology.entering(node) {
            &[before] => Some(self.topology.edge(before)[0]),
            _ => None,
        })
    }

    /// From a node by its neighbour and `next` along a vein to the length over which directions are
    /// taken, or to the next junction.
    fn ahead(&self, from: u32, neighbour: u32, next: impl Fn(u32) -> Option<u32>) -> DVec2 {
        let start = self.place(from);
        let (mut at, mut ahead, mut left) = (from, neighbour, self.look);
        loop {
            let step = self.place(ahead) - self.place(at);
            let length = step.length();
            if length >= left {
                return self.place(at) + step * (left / length) - start;
            }
            left -= length;
            match next(ahead).filter(|_| self.degree(ahead) == 2) {
                // A ring of two ends where it began.
                Some(other) if other != from => (at, ahead) = (ahead, other),
                _ => return self.place(ahead) - start,
            }
        }
    }
}

/// Angle between two directions, 0° to 180°.
pub(super) fn angle_deg(a: DVec2, b: DVec2) -> f64 {
    libm::atan2(a.perp_dot(b).abs(), a.dot(b)).to_degrees()
}
