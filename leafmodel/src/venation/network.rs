//! The graph of veins that every venation model produces.
//!
//! - **In**: positions of nodes and the edges between them, from older to younger tissue.
//! - **Out**: nodes, edges with radius and order, segments in millimetres, counts.
//! - **Always true**: see [`VenationNetwork::validate`].
//!
//! Nodes and edges are numbered in order of birth, and numbers never change while a network grows.
//! So the network of an earlier step consists of the first nodes of a later one, though edges may
//! have been subdivided since.

use glam::DVec2;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::conformal_map::ConformalMap;
use crate::numeric::Sets;

/// Greatest x and y of a node of an external network, mm: one kilometre.
pub(crate) const FARTHEST_MM: f64 = 1e6;

/// A piece of vein between two neighbouring nodes, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinSegment {
    /// End nearer to the petiole.
    pub from: DVec2,
    /// End farther from the petiole.
    pub to: DVec2,
    /// Radius of the vein at `from`, > 0.
    pub radius_from: f64,
    /// Radius of the vein at `to`, > 0, at most `radius_from`.
    pub radius_to: f64,
    /// Vein order: 1 for the midrib and other primaries, then upwards.
    pub order: u8,
}

/// A point of a vein.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct VeinNode {
    /// Its place, mm, in the frame of the outline.
    pub position: DVec2,
    /// Step of the simulation that added it.
    pub born: u32,
}

/// A piece of vein between two nodes, given by their numbers.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct VeinEdge {
    /// Node nearer to the petiole: the older tissue.
    pub from: u32,
    /// Node farther from the petiole.
    pub to: u32,
    /// Radius at `from`, mm, > 0.
    pub radius_from: f64,
    /// Radius at `to`, mm, > 0, at most `radius_from`.
    pub radius_to: f64,
    /// Vein order: 1 for the midrib and other primaries, then upwards.
    pub order: u8,
}

/// How a simulation ended.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
pub enum Ending {
    /// No source was left that could still draw a vein.
    Settled,
    /// It had not ended: the network is a stage of a leaf, or its growth was stopped.
    Growing,
    /// The pattern had not settled after far more steps than veins need to cross the leaf.
    StepLimit,
}

/// The veins of one leaf.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct VenationNetwork {
    pub(crate) nodes: Vec<VeinNode>,
    pub(crate) edges: Vec<VeinEdge>,
    pub(crate) map: ConformalMap,
    pub(crate) origins: u32,
    pub(crate) steps: u32,
    pub(crate) sources: u32,
    pub(crate) segment_mm: f64,
    pub(crate) ending: Ending,
}

/// Why a network is not valid. Networks from [`super::grow`] are always valid.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NetworkError {
    /// An edge refers to a node that does not exist, or to one node twice (number of the edge).
    #[error("edge {0} does not join two nodes of the network")]
    BadEdge(usize),
    /// A position or radius is not finite, or a radius is not above 0 or grows away from the
    /// petiole (number of the edge).
    #[error("edge {0} has a bad position or radius")]
    BadNumber(usize),
    /// A node lies more than 10⁶ mm from the origin in x or y, or its position is not finite
    /// (number of the node).
    #[error("node {0} is not within 10⁶ mm of the origin")]
    FarNode(usize),
    /// The length of a segment is not finite and above 0 (the length given).
    #[error("a vein segment is {0} mm long; it must be finite and above 0")]
    BadSegment(f64),
    /// An edge has no length (number of the edge).
    #[error("edge {0} has no length")]
    NoLength(usize),
    /// The same two nodes are joined twice (number of the second edge).
    #[error("edge {0} joins two nodes that are joined already")]
    Twice(usize),
    /// The directed edges contain a cycle (number of a node on or beyond the cycle).
    #[error("the edges about node {0} run in a circle")]
    Circle(usize),
    /// An edge has order 0 (number of the edge).
    #[error("edge {0} has order 0; orders start at 1")]
    NoOrder(usize),
}

/// The nodes at both ends of each edge.
pub(crate) fn ends(edges: &[VeinEdge]) -> Vec<[u32; 2]> {
    edges.iter().map(|edge| [edge.from, edge.to]).collect()
}

impl VenationNetwork {
    /// A network from another program or a drawing. Edges lead away from the petiole.
    ///
    /// `segment_mm` is the resolution of the veins, which [`VenationNetwork::segment_mm`] returns.
    /// The number of steps is that of the last node; the number of sources is 0.
    ///
    /// # Errors
    ///
    /// [`NetworkError`]: for whatever [`VenationNetwork::validate`] refuses, for a node farther
    /// than 10⁶ mm from the origin in x or y, and for a `segment_mm` that is not finite and
    /// above 0.
    pub fn from_parts(
        nodes: Vec<VeinNode>,
        edges: Vec<VeinEdge>,
        segment_mm: f64,
    ) -> Result<Self, NetworkError> {
        let near = |node: &VeinNode| node.position.abs().max_element() <= FARTHEST_MM;
        if let Some(node) = nodes
            .iter()
            .position(|node| !near(node) || node.position.is_nan())
        {
            return Err(NetworkError::FarNode(node));
        }
        if !(segment_mm.is_finite() && segment_mm > 0.0) {
            return Err(NetworkError::BadSegment(segment_mm));
        }
        let steps = nodes.iter().map(|node| node.born).max().unwrap_or(0);
        // The origins: the first nodes up to the first one that an edge leads to.
        let mut led_to = vec![false; nodes.len()];
        for edge in &edges {
            if let Some(node) = led_to.get_mut(edge.to as usize) {
                *node = true;
            }
        }
        let origins = led_to.iter().take_while(|led_to| !**led_to).count() as u32;
        let network = Self {
            nodes,
            edges,
            map: ConformalMap::FLAT,
            origins,
            steps,
            sources: 0,
            segment_mm,
            ending: Ending::Settled,
        };
        network.validate()?;
        Ok(network)
    }

    /// The nodes, by number; the origins come first.
    pub fn nodes(&self) -> &[VeinNode] {
        &self.nodes
    }

    /// The edges, in the order of the nodes to which they lead.
    pub fn edges(&self) -> &[VeinEdge] {
        &self.edges
    }

    /// All pieces of vein, in the order of the edges.
    pub fn segments(&self) -> impl Iterator<Item = VeinSegment> + '_ {
        self.edges.iter().map(|edge| VeinSegment {
            from: self.nodes[edge.from as usize].position,
            to: self.nodes[edge.to as usize].position,
            radius_from: edge.radius_from,
            radius_to: edge.radius_to,
            order: edge.order,
        })
    }

    /// The map of the blade in which positions, lengths and radii are given; flat except for curved
    /// blades.
    pub fn map(&self) -> ConformalMap {
        self.map
    }

    /// Number of origins, from which veins started, ≥ 1; they are the first nodes.
    pub fn origins(&self) -> usize {
        self.origins as usize
    }

    /// Number of steps of the simulation.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// Number of auxin sources that appeared.
    pub fn sources(&self) -> u32 {
        self.sources
    }

    /// Length `D` of a vein segment at the end of growth, mm.
    pub fn segment_mm(&self) -> f64 {
        self.segment_mm
    }

    /// How the simulation ended.
    pub fn ending(&self) -> Ending {
        self.ending
    }

    /// The same veins farther apart by `factor`, about `centre`; their widths stay.
    pub(crate) fn enlarged(self, centre: DVec2, factor: f64) -> Self {
        self.moved(|p| centre + (p - centre) * factor)
    }

    /// The same network with every node elsewhere.
    pub(crate) fn moved(mut self, place: impl Fn(DVec2) -> DVec2) -> Self {
        for node in &mut self.nodes {
            node.position = place(node.position);
        }
        self
    }

    /// Number of connected components, ≥ 1.
    pub fn components(&self) -> usize {
        let mut sets = Sets::new(self.nodes.len());
        let joints = self.edges.iter();
        let joints = joints.filter(|edge| sets.join(edge.from, edge.to).is_some());
        self.nodes.len() - joints.count()
    }

    /// Number of independent loops: edges − nodes + components. If veins do not cross, it is the
    /// number of areoles.
    pub fn loops(&self) -> usize {
        self.edges.len() + self.components() - self.nodes.len()
    }

    /// Length of all veins, mm.
    pub fn vein_length_mm(&self) -> f64 {
        self.segments().map(|s| (s.to - s.from).length()).sum()
    }

    /// Checks what every network must satisfy: edges join two different nodes, no two edges join
    /// the same two nodes, and there is no directed cycle; every edge has a length above 0, an
    /// order of at least 1, and radii that are finite, above 0 and do not grow away from the
    /// petiole.
    ///
    /// # Errors
    ///
    /// The first [`NetworkError`] found.
    pub fn validate(&self) -> Result<(), NetworkError> {
        let count = self.nodes.len();
        for (edge, e) in self.edges.iter().enumerate() {
            if e.from == e.to || e.from.max(e.to) as usize >= count {
                return Err(NetworkError::BadEdge(edge));
            }
            let (from, to) = (self.nodes[e.from as usize], self.nodes[e.to as usize]);
            // Radii are compared on the blade, not in its map; equal ones may differ by rounding.
            let on_blade =
                |radius: f64, node: &VeinNode| radius / self.map.enlargement(node.position);
            let (start, end) = (on_blade(e.radius_from, &from), on_blade(e.radius_to, &to));
            let slack = if self.map.is_flat() { 1.0 } else { 1.0 + 1e-12 };
            let radii = start.is_finite() && end > 0.0 && start * slack >= end;
            if !(radii && from.position.is_finite() && to.position.is_finite()) {
                return Err(NetworkError::BadNumber(edge));
            }
            if from.position == to.position {
                return Err(NetworkError::NoLength(edge));
            }
            if e.order == 0 {
                return Err(NetworkError::NoOrder(edge));
            }
        }
        let mut pairs: Vec<(u32, u32, usize)> = self
            .edges
            .iter()
            .enumerate()
            .map(|(edge, e)| (e.from.min(e.to), e.from.max(e.to), edge))
            .collect();
        pairs.sort_unstable();
        if let Some(pair) = pairs
            .windows(2)
            .find(|p| (p[0].0, p[0].1) == (p[1].0, p[1].1))
        {
            return Err(NetworkError::Twice(pair[1].2));
        }
        let edges = ends(&self.edges);
        match super::topology::Topology::new(count, &edges).base_to_tip() {
            Ok(_) => Ok(()),
            Err(node) => Err(NetworkError::Circle(node)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(
        positions: &[(f64, f64)],
        edges: &[(u32, u32, f64, f64)],
    ) -> Result<VenationNetwork, NetworkError> {
        let nodes = positions.iter().zip(3..).map(|(&p, born)| VeinNode {
            position: p.into(),
            born,
        });
        let edges = edges
            .iter()
            .map(|&(from, to, radius_from, radius_to)| VeinEdge {
                from,
                to,
                radius_from,
                radius_to,
                order: 1,
            });
        VenationNetwork::from_parts(nodes.collect(), edges.collect(), 0.5)
    }

    #[test]
    fn a_network_from_elsewhere_keeps_its_parts() {
        let network = parts(
            &[(0.0, 0.0), (0.0, 1.0), (1.0, 2.0)],
            &[(0, 1, 0.2, 0.1), (1, 2, 0.1, 0.1)],
        );
        let network = network.expect("nothing is wrong with it");
        assert_eq!(
            (network.steps(), network.sources(), network.segment_mm()),
            (5, 0, 0.5)
        );
        assert_eq!((network.components(), network.loops()), (1, 0));
        assert_eq!(network.vein_length_mm(), 1.0 + 2.0_f64.sqrt());
    }

    #[test]
    fn each_fault_of_a_network_from_elsewhere_has_its_error() {
        let two = [(0.0, 0.0), (0.0, 1.0)];
        let far = NetworkError::FarNode(1);
        for place in [(f64::NAN, 0.0), (0.0, f64::INFINITY), (0.0, -2e6)] {
            assert_eq!(parts(&[(0.0, 0.0), place], &[]), Err(far.clone()));
        }
        assert_eq!(
            parts(&two, &[(0, 2, 1.0, 1.0)]),
            Err(NetworkError::BadEdge(0))
        );
        assert_eq!(
            parts(&two, &[(1, 1, 1.0, 1.0)]),
            Err(NetworkError::BadEdge(0))
        );
        for (from, to) in [
            (1.0, 2.0),
            (1.0, 0.0),
            (f64::NAN, 1.0),
            (f64::INFINITY, 1.0),
            (1.0, f64::NAN),
        ] {
            assert_eq!(
                parts(&two, &[(0, 1, from, to)]),
                Err(NetworkError::BadNumber(0))
            );
        }
        let same = parts(&[(1.0, 1.0), (1.0, 1.0)], &[(0, 1, 1.0, 1.0)]);
        assert_eq!(same, Err(NetworkError::NoLength(0)));
        let twice = parts(&two, &[(0, 1, 1.0, 1.0), (1, 0, 1.0, 1.0)]);
        assert_eq!(twice, Err(NetworkError::Twice(1)));
        let ring = [(0, 1, 1.0, 1.0), (1, 2, 1.0, 1.0), (2, 0, 1.0, 1.0)];
        let ring = parts(&[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)], &ring);
        assert_eq!(ring, Err(NetworkError::Circle(0)));
        for value in [0.0, -1.0, f64::INFINITY] {
            let bad = VenationNetwork::from_parts(Vec::new(), Vec::new(), value);
            assert_eq!(bad, Err(NetworkError::BadSegment(value)));
        }
        assert!(VenationNetwork::from_parts(Vec::new(), Vec::new(), f64::NAN).is_err());
    }
}
