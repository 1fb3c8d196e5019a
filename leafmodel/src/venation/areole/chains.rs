//! Chains: pieces of veins from junction to junction.

use glam::DVec2;

use crate::buckets::Buckets;
use crate::venation::planar::PlaneGraph;

/// Pieces of veins between junctions and tips, called chains; nodes in between have two edges.
///
/// A *half* is a chain with a direction: `2 c` is chain `c` from its first to its second end,
/// `2 c + 1` is the reverse.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chains {
    /// The junctions or tips at both ends of each chain. On a ring without junctions one node is
    /// made a junction.
    pub(crate) ends: Vec<[u32; 2]>,
    /// Chain `c` runs through `points[starts[c]..starts[c + 1]]`.
    starts: Vec<u32>,
    points: Vec<DVec2>,
    /// Edges of the plane graph that make up chain `c`:
    /// `edges[starts[c] − c..starts[c + 1] − c − 1]`.
    edges: Vec<u32>,
    /// Length of each chain, mm.
    pub(crate) lengths: Vec<f64>,
    /// Mean radius along each chain, mm.
    pub(crate) radii: Vec<f64>,
    /// Nodes of the plane graph that are junctions or tips.
    pub(crate) joints: Vec<u32>,
    /// Halves that leave each joint, counter-clockwise.
    leaving: Buckets,
}

impl Chains {
    pub(crate) fn new(graph: &PlaneGraph) -> Self {
        let ends = graph.edges().iter().map(|edge| [edge.from, edge.to]);
        let around = Buckets::around(graph.nodes().len(), ends);
        let nodes = graph.nodes().len() as u32;
        let mut chains = Self {
            starts: vec![0],
            points: Vec::with_capacity(graph.edges().len() + graph.edges().len() / 2),
            edges: Vec::with_capacity(graph.edges().len()),
            ..Self::default()
        };
        let mut joint_of = vec![u32::MAX; nodes as usize];
        for node in (0..nodes).filter(|&node| ![0, 2].contains(&around.list(node as usize).len())) {
            joint_of[node as usize] = chains.joints.len() as u32;
            chains.joints.push(node);
        }
        let mut done = vec![false; graph.edges().len()];
        for joint in 0..chains.joints.len() {
            let node = chains.joints[joint];
            for &edge in around.list(node as usize) {
                chains.follow(graph, &around, &joint_of, &mut done, node, edge);
            }
        }
        // The remaining edges form rings.
        for first in 0..graph.edges().len() {
            if !done[first] {
                let node = graph.edges()[first].from;
                joint_of[node as usize] = chains.joints.len() as u32;
                chains.joints.push(node);
                chains.follow(graph, &around, &joint_of, &mut done, node, first as u32);
            }
        }
        chains.turn_around_joints();
        chains
    }

    /// Adds the chain that starts at the joint `node` with `edge`, unless it has been added.
    fn follow(
        &mut self,
        graph: &PlaneGraph,
        around: &Buckets,
        joint_of: &[u32],
        done: &mut [bool],
        node: u32,
        edge: u32,
    ) {
        if done[edge as usize] {
            return;
        }
        let place = |node: u32| graph.nodes()[node as usize];
        let (mut at, mut edge) = (node, edge);
        let (mut length, mut area) = (0.0, 0.0);
        self.points.push(place(at));
        loop {
            done[edge as usize] = true;
            self.edges.push(edge);
            let e = &graph.edges()[edge as usize];
            let next = if e.from == at { e.to } else { e.from };
            let step = (place(next) - place(at)).length();
            length += step;
            area += step * (e.radius_from + e.radius_to);
            self.points.push(place(next));
            at = next;
            if joint_of[at as usize] != u32::MAX {
                break;
            }
            let pair = around.list(at as usize);
            edge = if pair[0] == edge { pair[1] } else { pair[0] };
        }
        self.starts.push(self.points.len() as u32);
        self.ends
            .push([joint_of[node as usize], joint_of[at as usize]]);
        self.lengths.push(length);
        self.radii.push(0.5 * area / length);
    }

    /// Sorts the halves that leave each joint by direction.
    fn turn_around_joints(&mut self) {
        let starts = self.ends.iter().flatten().map(|&joint| joint as usize);
        let mut leaving = Buckets::new(self.joints.len(), starts.zip(0..));
        leaving.sort_each(|list| {
            list.sort_by(|&a, &b| turn(self.departure(a)).total_cmp(&turn(self.departure(b))));
        });
        self.leaving = leaving;
    }

    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The joint from which a half leaves.
    pub(crate) fn start(&self, half: u32) -> u32 {
        self.ends[(half / 2) as usize][(half % 2) as usize]
    }

    /// All points of a chain, from its first to its second end.
    pub(crate) fn points(&self, chain: u32) -> &[DVec2] {
        let chain = chain as usize;
        &self.points[self.starts[chain] as usize..self.starts[chain + 1] as usize]
    }

    /// Edges of the plane graph along a chain.
    pub(crate) fn edges(&self, chain: u32) -> &[u32] {
        let chain = chain as usize;
        let (start, end) = (self.starts[chain] as usize, self.starts[chain + 1] as usize);
        &self.edges[start - chain..end - chain - 1]
    }

    /// All points along a half except the last.
    pub(crate) fn corners(&self, half: u32) -> impl Iterator<Item = DVec2> + '_ {
        let points = self.points(half / 2);
        let last = points.len() - 1;
        let back = half % 2 == 1;
        (0..last).map(move |i| if back { points[last - i] } else { points[i] })
    }

    /// Halves that leave a joint, counter-clockwise.
    pub(crate) fn leaving(&self, joint: u32) -> &[u32] {
        self.leaving.list(joint as usize)
    }

    /// Direction and length of the first edge of a half.
    fn departure(&self, half: u32) -> DVec2 {
        let points = self.points(half / 2);
        if half.is_multiple_of(2) {
            points[1] - points[0]
        } else {
            points[points.len() - 2] - points[points.len() - 1]
        }
    }

    /// Way from the start of a half to the place a third of its length away.
    pub(crate) fn stretch(&self, half: u32) -> DVec2 {
        let mut left = self.lengths[(half / 2) as usize] / 3.0;
        let points = self.points(half / 2);
        let last = points.len() - 1;
        let at = |i: usize| {
            if half.is_multiple_of(2) {
                points[i]
            } else {
                points[last - i]
            }
        };
        for i in 0..last {
            let (from, to) = (at(i), at(i + 1));
            let step = (to - from).length();
            if step >= left && step > 0.0 {
                return from.lerp(to, left / step) - at(0);
            }
            left -= step;
        }
        at(last) - at(0)
    }

    /// For each half the next one along the face on its left.
    pub(crate) fn nexts(&self) -> Vec<u32> {
        let mut nexts = vec![0; 2 * self.len()];
        for joint in 0..self.joints.len() as u32 {
            let list = self.leaving(joint);
            for (i, &half) in list.iter().enumerate() {
                // After arriving along `half`, the next half clockwise has the same face on its
                // left.
                let before = list[(i + list.len() - 1) % list.len()];
                nexts[(half ^ 1) as usize] = before;
            }
        }
        nexts
    }
}

/// A number in [0, 4) that grows with the angle of a direction from +x, counter-clockwise.
fn turn(d: DVec2) -> f64 {
    let x = d.x / (d.x.abs() + d.y.abs());
    if d.y >= 0.0 { 1.0 - x } else { 3.0 + x }
}
