//! The main veins as a network like that of any other leaf.

use super::skeleton::NO_NODE;
use super::steps::Developing;
use crate::document::Declared;
use crate::venation::network::{VeinEdge, VeinNode, VenationNetwork};
use crate::venation::topology::Topology;
use crate::venation::width;

/// How main veins are drawn.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct MainVeinStyle {
    /// Radius of the midrib at the base.
    #[key("base_radius_mm", 1e-4..=100.0)]
    pub base_radius_mm: f64,
    /// n of Murray's law: rⁿ adds up from the tips to the base.
    #[key("murray_exponent", 0.5..=10.0)]
    pub murray_exponent: f64,
}

impl Default for MainVeinStyle {
    fn default() -> Self {
        Self {
            base_radius_mm: 0.6,
            murray_exponent: 2.0,
        }
    }
}

/// Finer veins of the blade that a main vein bears for each such part of the leaf's length.
const BEARS_PER_LENGTH: f64 = 120.0;

impl Developing {
    /// The main veins; each bears unseen finer ones along its length, so that it tapers.
    pub(super) fn network(&self, length_mm: f64, style: MainVeinStyle) -> VenationNetwork {
        let scale = length_mm / self.skeleton.length();
        let skeleton = &self.skeleton;
        let nodes: Vec<VeinNode> = skeleton
            .nodes
            .iter()
            .map(|node| VeinNode {
                position: node.place * scale,
                born: skeleton.veins[node.vein as usize].born,
            })
            .collect();
        let pairs: Vec<[u32; 2]> = (0..)
            .zip(&skeleton.nodes)
            .filter(|(_, node)| node.before != NO_NODE)
            .map(|(number, node)| [node.before, number])
            .collect();
        let topology = Topology::new(nodes.len(), &pairs);
        let base_to_tip: Vec<u32> = (0..nodes.len() as u32).collect();
        let place = |node: u32| nodes[node as usize].position;
        let flows = width::flows(&topology, &base_to_tip, |node| {
            let before = skeleton.nodes[node as usize].before;
            if before == NO_NODE {
                0.0
            } else {
                (place(node) - place(before)).length() / length_mm * BEARS_PER_LENGTH
            }
        });
        let widest = flows.nodes[0];
        let radius =
            |flow: f64| width::radius(flow / widest, style.base_radius_mm, style.murray_exponent);
        let edges = pairs.iter().zip(&flows.edges).map(|(&[from, to], &flow)| {
            let vein = skeleton.nodes[to as usize].vein;
            let goes_on = skeleton.nodes[from as usize].vein == vein;
            let radius_to = radius(flow);
            VeinEdge {
                from,
                to,
                radius_from: if goes_on {
                    radius(flows.nodes[from as usize]).max(radius_to)
                } else {
                    radius_to
                },
                radius_to,
                order: skeleton.veins[vein as usize].order,
            }
        });
        let longest = pairs.iter().map(|&[a, b]| (place(b) - place(a)).length());
        let segment_mm = longest.fold(0.0, f64::max);
        VenationNetwork::from_parts(nodes.clone(), edges.collect(), segment_mm)
            .expect("a tree whose flows fall from base to tip is a network")
    }
}
