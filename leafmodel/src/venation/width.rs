//! Widths of veins by Murray's law, from the tips to the base (sections 3.5 and 4).
//!
//! In units of a veinlet's `rⁿ`, a vein's `rⁿ` is a *flow* that adds up towards the base:
//! `r_parentⁿ = Σ r_childⁿ`. A tip carries 1. Where several veins enter a junction, the flow beyond
//! it is divided among them equally ("all child veins entering a vein node contribute equally to
//! the width of the parent nodes"). No vein is finer than a veinlet, since the calculation "begins
//! with the veinlets, assumed to have the minimum width": a share below 1 counts as 1. So a loop of
//! wide veins neither creates nor destroys flow, while each vein that closes a loop of veinlets adds
//! 1: the 181 tips and 88 such loops of `runions-9e` give 269 at its root.
//!
//! The exponent may rise in the finest veins ([`WidthLaw`]).
//!
//! The paper walks from the veinlets to the base; with loops that is well defined since edges run
//! from older to younger tissue: every node is processed after all nodes to which it leads.

use rayon::prelude::*;

use super::topology::Topology;

/// Flows in units of a veinlet's `rⁿ`, all ≥ 1.
pub(crate) struct Flows {
    /// Flow into each node.
    pub(crate) nodes: Vec<f64>,
    /// Flow that each edge carries to the node at its end.
    pub(crate) edges: Vec<f64>,
}

/// Adds up flows over the whole network, given its nodes from base to tip. `unseen` is the
/// additional flow of a node ("we additionally increase the width of primary and secondary veins at
/// each node", section 3.5).
pub(crate) fn flows(
    topology: &Topology,
    base_to_tip: &[u32],
    unseen: impl Fn(u32) -> f64,
) -> Flows {
    let mut nodes = vec![0.0; topology.nodes()];
    let mut edges = vec![1.0; topology.edge_count()];
    for &node in base_to_tip.iter().rev() {
        let beyond: f64 = topology
            .leaving(node)
            .iter()
            .map(|&edge| edges[edge as usize])
            .sum();
        nodes[node as usize] = beyond.max(1.0) + unseen(node);
        let entering = topology.entering(node);
        let share = (nodes[node as usize] / entering.len() as f64).max(1.0);
        for &edge in entering {
            edges[edge as usize] = share;
        }
    }
    Flows { nodes, edges }
}

/// Radii over that of a veinlet at which a law that rises lies halfway between its exponents.
const HALFWAY: f64 = 4.0;

/// How wide a vein is for what it carries.
///
/// Murray's exponent is near 2 where veins are wide and rises towards 3 in the finest orders
/// (\[price2013\]). With `x` for a radius over a veinlet's, what adds up at a junction is
/// `xᶠ ((1 + c) / (x + c))^(f − n)`: its exponent is `f` where `x` is far below `c`, and `n` far
/// above. With `f = n` it is `xⁿ`, Murray's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WidthLaw {
    /// Exponent of wide veins, `n`.
    pub(crate) coarse: f64,
    /// Exponent of the finest veins, `f`.
    pub(crate) finest: f64,
}

impl WidthLaw {
    /// What a vein carries, in units of a veinlet's, for its radius over a veinlet's.
    pub(crate) fn flow(self, radius: f64) -> f64 {
        let rise = (1.0 + HALFWAY) / (radius + HALFWAY);
        libm::pow(radius, self.finest) * libm::pow(rise, self.finest - self.coarse)
    }

    /// The radius over a veinlet's of a vein that carries `flow`, at least 1.
    pub(crate) fn radius(self, flow: f64) -> f64 {
        if self.finest == self.coarse {
            return libm::pow(flow, 1.0 / self.coarse);
        }
        // Newton's method on logarithms, in which the law is nearly straight.
        let wanted = libm::log(flow);
        let mut x = wanted / self.coarse;
        for _ in 0..30 {
            let radius = libm::exp(x);
            let over = libm::log(self.flow(radius)) - wanted;
            let slope = self.finest - (self.finest - self.coarse) * radius / (radius + HALFWAY);
            x -= over / slope;
            if over.abs() < 1e-14 * wanted.abs().max(1.0) {
                break;
            }
        }
        libm::exp(x)
    }
}

/// Radii over a veinlet's of all flows in a net. A net has a hundred times fewer different flows
/// than veins, and a radius is found by iteration.
#[derive(Debug)]
pub(crate) struct RadiusTable {
    /// Ascending, each once.
    flows: Vec<f64>,
    radii: Vec<f64>,
}

impl RadiusTable {
    pub(crate) fn new(law: WidthLaw, flows: &Flows) -> Self {
        let mut flows: Vec<f64> = flows.nodes.iter().chain(&flows.edges).copied().collect();
        flows.par_sort_unstable_by(f64::total_cmp);
        flows.dedup();
        let radii = flows.par_iter().map(|&flow| law.radius(flow)).collect();
        Self { flows, radii }
    }

    /// The radius of a flow of the net.
    pub(crate) fn radius(&self, flow: f64) -> f64 {
        let place = self.flows.binary_search_by(|other| other.total_cmp(&flow));
        self.radii[place.expect("every flow of the net is in the table")]
    }
}

/// Radius of a vein that carries `flow`: `r = r_0 flow^{1/n}`, in the unit of the veinlet's radius
/// `r_0`.
pub(crate) fn radius(flow: f64, veinlet_radius: f64, exponent: f64) -> f64 {
    veinlet_radius * libm::pow(flow, 1.0 / exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flows_of(count: usize, edges: &[[u32; 2]]) -> Flows {
        let topology = Topology::new(count, edges);
        let order = topology.base_to_tip().expect("no circle");
        flows(&topology, &order, |_| 0.0)
    }

    #[test]
    fn a_binary_tree_carries_its_number_of_tips_at_every_node() {
        let edges: Vec<[u32; 2]> = (1..31).map(|i| [(i - 1) / 2, i]).collect();
        let flows = flows_of(31, &edges);
        for (depth, expected) in [(0, 16.0), (1, 8.0), (2, 4.0), (3, 2.0), (4, 1.0)] {
            for node in (1 << depth) - 1..(1 << (depth + 1)) - 1 {
                assert_eq!(flows.nodes[node], expected, "node {node}");
            }
        }
        assert!((radius(16.0, 0.01, 2.0) - 0.04).abs() < 1e-15);
        assert!((radius(8.0, 0.01, 3.0) - 0.02).abs() < 1e-15);
    }

    #[test]
    fn a_loop_divides_what_lies_beyond_it_equally() {
        // Node 0 forks to 1 and 2, which meet in 3; beyond lie six tips.
        let mut edges = vec![[0, 1], [0, 2], [1, 3], [2, 3]];
        edges.extend((4..10).map(|tip| [3, tip]));
        let flows = flows_of(10, &edges);
        assert_eq!(flows.nodes[..4], [6.0, 3.0, 3.0, 6.0]);
    }

    #[test]
    fn veins_that_merely_meet_are_no_finer_than_veinlets() {
        let flows = flows_of(4, &[[0, 1], [0, 2], [1, 3], [2, 3]]);
        assert_eq!(flows.edges, [1.0; 4]);
        assert_eq!(flows.nodes, [2.0, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn the_exponent_rises_from_coarse_veins_to_fine_ones() {
        let law = WidthLaw {
            coarse: 2.0,
            finest: 3.0,
        };
        assert!(
            (law.radius(1.0) - 1.0).abs() < 1e-12,
            "the finest carries 1"
        );
        for flow in [1.5, 4.0, 50.0, 1e4, 1e7] {
            assert!((law.flow(law.radius(flow)) / flow - 1.0).abs() < 1e-10);
        }
        // The exponent with which two equal veins join: 2 = (r / r_child)ⁿ.
        let exponent = |flow: f64| {
            let ratio = law.radius(2.0 * flow) / law.radius(flow);
            libm::log(2.0) / libm::log(ratio)
        };
        assert!((2.7..3.0).contains(&exponent(1.0)), "{}", exponent(1.0));
        assert!((2.0..2.05).contains(&exponent(1e6)), "{}", exponent(1e6));
        let same = WidthLaw {
            coarse: 2.5,
            finest: 2.5,
        };
        assert_eq!(same.radius(7.0), libm::pow(7.0, 1.0 / 2.5));
    }
}
