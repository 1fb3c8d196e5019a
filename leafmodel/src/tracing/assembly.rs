//! Lines in pixels become a network in millimetres: ways from the base, orders.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::traced::Frame;
use crate::buckets::Buckets;
use crate::plane::polyline;
use crate::venation::network::{self, NetworkError, VeinEdge, VeinNode, VenationNetwork};
use crate::venation::order::{Look, orders};
use crate::venation::topology::Topology;

/// A vein from node to node, its points and radii in pixels.
#[derive(Clone, Debug)]
pub(super) struct Vein {
    pub(super) ends: [u32; 2],
    /// At least three if both ends are the same node or another vein has the same ends.
    pub(super) points: Vec<DVec2>,
    pub(super) radii: Vec<f64>,
}

/// The veins of a picture before they have directions.
#[derive(Clone, Debug, Default)]
pub(super) struct Veins {
    /// Places of the nodes, pixels.
    pub(super) nodes: Vec<DVec2>,
    pub(super) list: Vec<Vein>,
}

/// The part to which each node belongs, and the veins' length of each part.
pub(super) fn parts(veins: &Veins) -> (Vec<u32>, Vec<f64>) {
    let mut part = vec![u32::MAX; veins.nodes.len()];
    let at = chains_at(veins);
    let mut lengths = Vec::new();
    for first in 0..veins.nodes.len() {
        if part[first] != u32::MAX {
            continue;
        }
        let number = lengths.len() as u32;
        part[first] = number;
        let (mut open, mut doubled) = (vec![first as u32], 0.0);
        while let Some(node) = open.pop() {
            for &vein in at.list(node as usize) {
                let vein = &veins.list[vein as usize];
                let length = polyline::length(&vein.points);
                doubled += length;
                for end in vein.ends {
                    if part[end as usize] == u32::MAX {
                        part[end as usize] = number;
                        open.push(end);
                    }
                }
            }
        }
        lengths.push(0.5 * doubled);
    }
    (part, lengths)
}

fn chains_at(veins: &Veins) -> Buckets {
    Buckets::around(veins.nodes.len(), veins.list.iter().map(|vein| vein.ends))
}

/// The resistance of the way from the nearest root to each node by Poiseuille's law, up to a
/// factor: the sum of length over the fourth power of the radius along the easiest way. So a vein
/// counts as led to by wide veins.
fn resistances(veins: &Veins, roots: &[u32]) -> Vec<f64> {
    let of_vein: Vec<f64> = veins
        .list
        .iter()
        .map(|vein| {
            let pieces = vein.points.windows(2).zip(vein.radii.windows(2));
            pieces
                .map(|(p, r)| {
                    let square = 0.25 * (r[0] + r[1]) * (r[0] + r[1]);
                    p[0].distance(p[1]) / (square * square)
                })
                .sum()
        })
        .collect();
    let at = chains_at(veins);
    let mut least = vec![f64::INFINITY; veins.nodes.len()];
    let mut open = BinaryHeap::new();
    for &root in roots {
        least[root as usize] = 0.0;
        open.push(Reverse((0_u64, root)));
    }
    while let Some(Reverse((bits, node))) = open.pop() {
        if f64::from_bits(bits) > least[node as usize] {
            continue;
        }
        for &vein in at.list(node as usize) {
            let [a, b] = veins.list[vein as usize].ends;
            let other = if a == node { b } else { a };
            let there = least[node as usize] + of_vein[vein as usize];
            if there < least[other as usize] {
                least[other as usize] = there;
                // Resistances are not negative, so their bits are in the order of their values.
                open.push(Reverse((there.to_bits(), other)));
            }
        }
    }
    least
}

/// The network of some veins. `roots` are the nodes from which they start, one of each part, the
/// base first.
pub(super) fn network(
    veins: &Veins,
    roots: &[u32],
    frame: &Frame,
    segment_mm: f64,
) -> Result<VenationNetwork, NetworkError> {
    let resistance = resistances(veins, roots);
    let mut nodes: Vec<VeinNode> = Vec::new();
    let mut number = vec![u32::MAX; veins.nodes.len()];
    let add = |place: DVec2, nodes: &mut Vec<VeinNode>| {
        nodes.push(VeinNode {
            position: frame.to_mm(place),
            born: 0,
        });
        nodes.len() as u32 - 1
    };
    let mut is_root = vec![false; veins.nodes.len()];
    for &root in roots {
        is_root[root as usize] = true;
    }
    let others = (0..veins.nodes.len() as u32).filter(|node| !is_root[*node as usize]);
    // The base alone is an origin of the network: water comes in by no other root. An origin is one
    // of the first nodes, so the roots of parts apart are the last.
    let (base, apart) = roots.split_at(roots.len().min(1));
    let in_order = base
        .iter()
        .copied()
        .chain(others)
        .chain(apart.iter().copied());
    for node in in_order {
        number[node as usize] = add(veins.nodes[node as usize], &mut nodes);
    }
    let mut edges: Vec<VeinEdge> = Vec::new();
    for vein in &veins.list {
        let rank = |end: usize| (resistance[vein.ends[end] as usize], vein.ends[end]);
        let forwards = rank(0) <= rank(1);
        let last = vein.points.len() - 1;
        let index = |i: usize| if forwards { i } else { last - i };
        let end = |i: usize| number[vein.ends[usize::from(index(i) > 0)] as usize];
        let inner: Vec<u32> = (1..last)
            .map(|i| add(vein.points[index(i)], &mut nodes))
            .collect();
        let node = |i: usize| match i {
            0 => end(0),
            i if i == last => end(last),
            i => inner[i - 1],
        };
        // A vein that comes back to its start leads from there both ways to its middle.
        let turn = if vein.ends[0] == vein.ends[1] {
            last.div_ceil(2)
        } else {
            last
        };
        for i in 0..last {
            let (near, far) = if i < turn { (i, i + 1) } else { (i + 1, i) };
            let (start, end) = (vein.radii[index(near)], vein.radii[index(far)]);
            // Radii do not grow away from the petiole: what seems to is as wide as its middle.
            let (start, end) = if start >= end {
                (start, end)
            } else {
                (0.5 * (start + end), 0.5 * (start + end))
            };
            edges.push(VeinEdge {
                from: node(near),
                to: node(far),
                radius_from: start * frame.mm_per_pixel,
                radius_to: end * frame.mm_per_pixel,
                order: 1,
            });
        }
    }
    give_orders(&nodes, &mut edges, roots.len(), segment_mm);
    VenationNetwork::from_parts(nodes, edges, segment_mm)
}

/// Gives edges their orders: those that hang together with the base by width and branching, as in
/// networks that are grown; those that do not have the order whose mean radius is the nearest.
fn give_orders(nodes: &[VeinNode], edges: &mut [VeinEdge], roots: usize, segment_mm: f64) {
    let pairs = network::ends(edges);
    let topology = Topology::new(nodes.len(), &pairs);
    let Ok(base_to_tip) = topology.base_to_tip() else {
        return; // The network refuses a circle, with its place.
    };
    let positions: Vec<DVec2> = nodes.iter().map(|node| node.position).collect();
    let radii: Vec<f64> = edges
        .iter()
        .map(|e| 0.5 * (e.radius_from + e.radius_to))
        .collect();
    let found = orders(
        &topology,
        &positions,
        &radii,
        &base_to_tip,
        &[],
        Look::Length { segment_mm },
    );
    for (edge, order) in edges.iter_mut().zip(&found.edges) {
        edge.order = (*order).max(1);
    }
    if roots < 2 {
        return;
    }
    let mut of_base = vec![false; nodes.len()];
    of_base[0] = true;
    for &node in &base_to_tip {
        if topology
            .entering(node)
            .iter()
            .any(|&e| of_base[pairs[e as usize][0] as usize])
        {
            of_base[node as usize] = true;
        }
    }
    let is_joined = |edge: &VeinEdge| of_base[edge.from as usize];
    let mut sums = [(0.0, 0.0); 256];
    for (edge, radius) in edges.iter().zip(&radii).filter(|(edge, _)| is_joined(edge)) {
        let length = positions[edge.from as usize].distance(positions[edge.to as usize]);
        let (sum, weight) = &mut sums[usize::from(edge.order)];
        (*sum, *weight) = (*sum + length * libm::log(*radius), *weight + length);
    }
    let means: Vec<(u8, f64)> = (0..=u8::MAX)
        .zip(sums)
        .filter(|(_, (_, weight))| *weight > 0.0)
        .map(|(order, (sum, weight))| (order, sum / weight))
        .collect();
    for (edge, radius) in edges.iter_mut().zip(&radii) {
        if !of_base[edge.from as usize] {
            let off = |mean: f64| (mean - libm::log(*radius)).abs();
            let nearest = means.iter().min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
            edge.order = nearest.map_or(1, |(order, _)| *order);
        }
    }
}
