//! Where the petiole is, and which way edges lead from it.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use glam::DVec2;

use super::draft::{Draft, DraftEdge};
use super::error::ImportError;
use super::faults::{Fault, FaultKind};
use crate::buckets::Buckets;
use crate::venation::network::{self, VeinNode, VenationNetwork};
use crate::venation::topology::Topology;

/// Ends of veins at least this wide, as a share of the widest vein, may be the petiole.
const WIDE: f64 = 0.5;

/// The network with all edges turned away from the root, nodes numbered by their distance from it
/// along veins. Parts apart come behind, each from its own root.
pub(super) fn turned(
    draft: &Draft,
    base: Option<DVec2>,
    segment_mm: f64,
    faults: &mut Vec<Fault>,
) -> Result<VenationNetwork, ImportError> {
    let veins = Veins::new(draft);
    let root = if let Some(base) = base {
        veins.nearest(base)
    } else {
        let root = veins.widest_end(&veins.nodes().collect::<Vec<u32>>());
        let mut none = Fault::new(FaultKind::NoRoot);
        none.at(draft.places[root as usize]);
        faults.push(none);
        root
    };
    let order = veins.by_distance(root);
    let mut rank = vec![0_u32; order.len()];
    for (new, &old) in (0..).zip(&order) {
        rank[old as usize] = new;
    }
    let mut turned = draft.clone();
    let (mut turns, mut widening) = (0, Fault::new(FaultKind::Widening));
    for edge in &mut turned.edges {
        let place = draft.places[edge.ends[1] as usize];
        edge.ends = edge.ends.map(|end| rank[end as usize]);
        if edge.ends[0] > edge.ends[1] {
            edge.ends.swap(0, 1);
            edge.radii.swap(0, 1);
            turns += 1;
        }
        if let [Some(start), Some(end)] = edge.radii
            && start < end
        {
            edge.radii = [Some(0.5 * (start + end)); 2];
            widening.at(place);
        }
    }
    // Edges in the order of the nodes to which they lead.
    turned
        .edges
        .sort_by_key(|edge| (edge.ends[1], edge.ends[0]));
    if draft.is_directed && turns > 0 {
        let mut fault = Fault::new(FaultKind::Turned);
        fault.count = turns;
        faults.push(fault);
    }
    faults.extend((widening.count > 0).then_some(widening));
    let nodes = order.iter().map(|&old| VeinNode {
        position: draft.places[old as usize],
        born: draft.born.get(old as usize).copied().unwrap_or(0),
    });
    let edges = turned.vein_edges(segment_mm);
    VenationNetwork::from_parts(nodes.collect(), edges, segment_mm)
        .map_err(|error| ImportError::malformed("network", error.to_string()))
}

/// A node of each part of a network in which there is no origin.
pub(super) fn parts_without_petiole(network: &VenationNetwork) -> Vec<DVec2> {
    let ends = network::ends(network.edges());
    let topology = Topology::new(network.nodes().len(), &ends);
    let mut seen = vec![false; network.nodes().len()];
    let mut parts = Vec::new();
    for start in 0..network.nodes().len() as u32 {
        if seen[start as usize] {
            continue;
        }
        if start as usize >= network.origins() {
            parts.push(network.nodes()[start as usize].position);
        }
        let mut open = vec![start];
        seen[start as usize] = true;
        while let Some(node) = open.pop() {
            let out = topology
                .leaving(node)
                .iter()
                .map(|&edge| ends[edge as usize][1]);
            let back = topology
                .entering(node)
                .iter()
                .map(|&edge| ends[edge as usize][0]);
            for other in out.chain(back) {
                if !std::mem::replace(&mut seen[other as usize], true) {
                    open.push(other);
                }
            }
        }
    }
    parts
}

/// The veins of a draft as a graph without directions.
struct Veins<'a> {
    draft: &'a Draft,
    around: Buckets,
}

impl<'a> Veins<'a> {
    fn new(draft: &'a Draft) -> Self {
        let ends = draft.edges.iter().map(|edge| edge.ends);
        Self {
            draft,
            around: Buckets::around(draft.places.len(), ends),
        }
    }

    fn edges(&self, node: u32) -> impl Iterator<Item = &DraftEdge> {
        let list = self.around.list(node as usize);
        list.iter().map(|&edge| &self.draft.edges[edge as usize])
    }

    fn place(&self, node: u32) -> DVec2 {
        self.draft.places[node as usize]
    }

    fn nodes(&self) -> std::ops::Range<u32> {
        0..self.draft.places.len() as u32
    }

    fn nearest(&self, to: DVec2) -> u32 {
        let away = |node: &u32| (self.place(*node) - to).length_squared();
        let nearest = self.nodes().min_by(|a, b| away(a).total_cmp(&away(b)));
        nearest.unwrap_or(0)
    }

    /// Of the ends of wide veins among some nodes the lowest; without any, the lowest node.
    fn widest_end(&self, among: &[u32]) -> u32 {
        let width = |edge: &DraftEdge| {
            edge.radii
                .iter()
                .flatten()
                .fold(0.0, |width, r| f64::max(width, *r))
        };
        let of_node = |node: u32| self.edges(node).map(width).fold(0.0, f64::max);
        let widest = among.iter().map(|&node| of_node(node)).fold(0.0, f64::max);
        let is_end = |node: &u32| self.edges(*node).count() == 1 && of_node(*node) >= WIDE * widest;
        let height = |a: &u32, b: &u32| self.place(*a).y.total_cmp(&self.place(*b).y);
        let ends = among.iter().copied().filter(is_end);
        let lowest = ends.min_by(height);
        lowest
            .or_else(|| among.iter().copied().min_by(height))
            .unwrap_or(0)
    }

    /// All nodes by their distance along veins from the root, then those of each other part from a
    /// root of its own (Dijkstra's algorithm; equally far ones by number).
    fn by_distance(&self, root: u32) -> Vec<u32> {
        let mut order = Vec::with_capacity(self.draft.places.len());
        let mut is_done = vec![false; self.draft.places.len()];
        self.reach(root, &mut is_done, &mut order);
        for start in self.nodes() {
            if !is_done[start as usize] {
                let root = self.widest_end(&self.part(start));
                self.reach(root, &mut is_done, &mut order);
            }
        }
        order
    }

    /// The nodes that hang together with one.
    fn part(&self, start: u32) -> Vec<u32> {
        let mut seen = BTreeSet::from([start]);
        let mut open = vec![start];
        while let Some(node) = open.pop() {
            for edge in self.edges(node) {
                let other = edge.ends[usize::from(edge.ends[0] == node)];
                if seen.insert(other) {
                    open.push(other);
                }
            }
        }
        seen.into_iter().collect()
    }

    fn reach(&self, root: u32, is_done: &mut [bool], order: &mut Vec<u32>) {
        let mut open = BinaryHeap::new();
        // Distances are at least 0, so their bits are in the order of their values.
        open.push(Reverse((0.0_f64.to_bits(), root)));
        while let Some(Reverse((bits, node))) = open.pop() {
            if std::mem::replace(&mut is_done[node as usize], true) {
                continue;
            }
            order.push(node);
            for edge in self.edges(node) {
                let other = edge.ends[usize::from(edge.ends[0] == node)];
                if !is_done[other as usize] {
                    let step = (self.place(other) - self.place(node)).length();
                    open.push(Reverse(((f64::from_bits(bits) + step).to_bits(), other)));
                }
            }
        }
    }
}
