//! Edges strung together to veins.

use crate::venation::network::{self, VenationNetwork};
use crate::venation::topology::Topology;

/// Edges that follow each other from a junction or origin to the next junction or tip, all of one
/// order.
#[derive(Clone, Debug)]
pub struct Runs {
    starts: Vec<u32>,
    edges: Vec<u32>,
}

impl Runs {
    /// Strings the edges of a network together. Every edge is in one run.
    pub fn new(network: &VenationNetwork) -> Self {
        let ends = network::ends(network.edges());
        let topology = Topology::new(network.nodes().len(), &ends);
        let order = |edge: u32| network.edges()[edge as usize].order;
        // The edge in which another goes on, or from which it comes, at a node where nothing else
        // is.
        let passing = |node: u32| match (topology.entering(node), topology.leaving(node)) {
            (&[before], &[after]) if order(before) == order(after) => Some((before, after)),
            _ => None,
        };
        let mut runs = Self {
            starts: vec![0],
            edges: Vec::with_capacity(ends.len()),
        };
        for (first, [from, _]) in (0..).zip(&ends) {
            if passing(*from).is_some() {
                continue;
            }
            // Edges run in no circle, so this ends, and every edge is behind a first one.
            let mut edge = first;
            loop {
                runs.edges.push(edge);
                match passing(ends[edge as usize][1]) {
                    Some((_, after)) => edge = after,
                    None => break,
                }
            }
            runs.starts.push(runs.edges.len() as u32);
        }
        runs
    }

    /// The numbers of the edges of each run, from the petiole outwards.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.starts
            .windows(2)
            .map(|pair| &self.edges[pair[0] as usize..pair[1] as usize])
    }
}
