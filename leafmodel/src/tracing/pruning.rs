//! Spurs cut off, nodes on a line dissolved, ends put where a round end has its centre.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::graph::{Chain, Graph};
use super::radii::HALF_PIXEL;

/// Least radius of what counts as a vein's mouth, pixels: stairs of pixels are as wide.
const STAIR: f64 = 1.5;

/// A graph while chains are taken out of it.
pub(super) struct Pruning {
    graph: Graph,
    /// The chains at each node; a chain from a node to itself stands there twice.
    at: Vec<Vec<u32>>,
    is_gone: Vec<bool>,
    /// How often each chain has changed.
    version: Vec<u32>,
}

impl Pruning {
    pub(super) fn new(graph: Graph) -> Self {
        let mut at = vec![Vec::new(); graph.nodes.len()];
        for (number, chain) in (0..).zip(&graph.chains) {
            for end in chain.ends {
                at[end as usize].push(number);
            }
        }
        let count = graph.chains.len();
        Self {
            graph,
            at,
            is_gone: vec![false; count],
            version: vec![0; count],
        }
    }

    /// By how much of its own radius a chain with one free end juts out of the vein on which it
    /// stands; `None` for other chains.
    ///
    /// The disc of the node covers the chain up to its mouth. What juts out is the way from the
    /// node to the end and the end's own reach, less the reach of the node.
    fn prominence(&self, number: u32) -> Option<f64> {
        let chain = &self.graph.chains[number as usize];
        let degree = |node: u32| self.at[node as usize].len();
        let [start, end] = chain.ends;
        let node = match (degree(start), degree(end)) {
            (1, 3..) => end,
            (3.., 1) => start,
            _ => return None,
        };
        let last = if node == start {
            chain.points.len() - 1
        } else {
            0
        };
        let mouth = self.mouth(number, node);
        let node = self.graph.nodes[node as usize];
        // Straight, since steps from pixel to pixel would make a spur on a wide vein longer.
        let way = chain.points[last].distance(node.place);
        let juts = way + chain.reaches[last] - node.reach;
        Some(juts / mouth)
    }

    /// The radius of a chain where it leaves the disc of a node at one of its ends, or at its other
    /// end if it does not; at least what stairs of pixels make.
    fn mouth(&self, number: u32, node: u32) -> f64 {
        let chain = &self.graph.chains[number as usize];
        let last = chain.points.len() - 1;
        let from_node = |i: usize| if chain.ends[0] == node { i } else { last - i };
        let node = self.graph.nodes[node as usize];
        let is_out = |i: &usize| chain.points[*i].distance(node.place) >= node.reach;
        let mouth = (0..=last).map(from_node).find(is_out);
        (chain.reaches[mouth.unwrap_or(from_node(last))] - HALF_PIXEL).max(STAIR)
    }

    /// The radius of the finest vein at a node but for one.
    fn finest_but(&self, node: u32, number: u32) -> f64 {
        let others = self.at[node as usize]
            .iter()
            .filter(|&&other| other != number);
        others.fold(f64::INFINITY, |least, &other| {
            least.min(self.mouth(other, node))
        })
    }

    /// Takes out spurs that jut out by less than `radii` of their own radius, the least prominent
    /// first; the number of them.
    pub(super) fn cut_spurs(&mut self, radii: f64) -> usize {
        let mut count = 0;
        let mut open = BinaryHeap::new();
        let key = |prominence: f64| (prominence.max(0.0) * 4096.0) as u64;
        for number in 0..self.graph.chains.len() as u32 {
            if let Some(prominence) = self.prominence(number) {
                open.push(Reverse((key(prominence), number, 0)));
            }
        }
        while let Some(Reverse((at, number, version))) = open.pop() {
            let is_old = version != self.version[number as usize];
            if self.is_gone[number as usize] || is_old {
                continue;
            }
            let Some(prominence) = self.prominence(number) else {
                continue;
            };
            if key(prominence) > at {
                open.push(Reverse((key(prominence), number, version)));
                continue;
            }
            if prominence >= radii {
                break;
            }
            count += 1;
            let ends = self.graph.chains[number as usize].ends;
            self.take_out(number);
            for node in ends {
                if let Some(joined) = self.dissolve(node)
                    && let Some(prominence) = self.prominence(joined)
                {
                    let version = self.version[joined as usize];
                    open.push(Reverse((key(prominence), joined, version)));
                }
            }
        }
        count + self.take_out_blobs(radii)
    }

    /// Takes out what is no line: single chains shorter than `radii` of their own radius, which
    /// stand for a disc or a spot.
    fn take_out_blobs(&mut self, radii: f64) -> usize {
        let mut count = 0;
        for number in 0..self.graph.chains.len() as u32 {
            let chain = &self.graph.chains[number as usize];
            let is_free = chain
                .ends
                .iter()
                .all(|&end| self.at[end as usize].len() == 1);
            let widest = chain.reaches.iter().copied().fold(0.0, f64::max);
            if !self.is_gone[number as usize] && is_free && chain.length() < radii * widest {
                self.take_out(number);
                count += 1;
            }
        }
        count
    }

    fn take_out(&mut self, number: u32) {
        self.is_gone[number as usize] = true;
        for end in self.graph.chains[number as usize].ends {
            self.at[end as usize].retain(|&other| other != number);
        }
    }

    /// Makes one chain of two that meet at a node where nothing else is; its number.
    fn dissolve(&mut self, node: u32) -> Option<u32> {
        let &[first, second] = self.at[node as usize].as_slice() else {
            return None;
        };
        if first == second {
            return None; // A circle on which this is the only node.
        }
        let [kept, gone] = [first.min(second), first.max(second)];
        let take = |chain: &mut Chain| {
            let empty = Chain {
                ends: chain.ends,
                points: Vec::new(),
                reaches: Vec::new(),
            };
            std::mem::replace(chain, empty)
        };
        let before = take(&mut self.graph.chains[kept as usize]);
        let before = before.from(node).reversed();
        let after = take(&mut self.graph.chains[gone as usize]).from(node);
        let far = after.ends[1];
        let mut points = before.points;
        let mut reaches = before.reaches;
        // The node lay between the lines; now it is a point of one, which goes straight past.
        if points.len() > 1 && after.points.len() > 1 {
            points.pop();
            reaches.pop();
        }
        points.extend(&after.points[1..]);
        reaches.extend(&after.reaches[1..]);
        self.graph.chains[kept as usize] = Chain {
            ends: [before.ends[0], far],
            points,
            reaches,
        };
        self.at[node as usize].clear();
        self.is_gone[gone as usize] = true;
        self.version[kept as usize] += 1;
        for other in &mut self.at[far as usize] {
            if *other == gone {
                *other = kept;
            }
        }
        Some(kept)
    }

    /// Ends each free end where its disc just reaches the end of the vein: the centre of a round
    /// end. Beyond, discs lie within those before.
    pub(super) fn trim_ends(&mut self) {
        for number in 0..self.graph.chains.len() {
            if self.is_gone[number] {
                continue;
            }
            for end in self.graph.chains[number].ends {
                if self.at[end as usize].len() != 1 {
                    continue;
                }
                let chain = &mut self.graph.chains[number];
                let is_last = chain.ends[1] == end;
                if !is_last {
                    chain.points.reverse();
                    chain.reaches.reverse();
                }
                let kept = covered_from(chain);
                chain.points.truncate(kept);
                chain.reaches.truncate(kept);
                let node = &mut self.graph.nodes[end as usize];
                node.place = chain.points[kept - 1];
                node.reach = chain.reaches[kept - 1];
                if !is_last {
                    chain.points.reverse();
                    chain.reaches.reverse();
                }
            }
        }
    }

    /// Joins nodes if the chain between them is shorter than `share` of the sum of the radii of the
    /// finest veins at both: veins that cross have a stretch of their middle lines in common. Two
    /// chains between the same nodes are a loop and stay.
    pub(super) fn join_near_nodes(&mut self, share: f64) -> usize {
        let mut count = 0;
        for number in 0..self.graph.chains.len() as u32 {
            let chain = &self.graph.chains[number as usize];
            let [a, b] = chain.ends;
            let degree = |node: u32| self.at[node as usize].len();
            if self.is_gone[number as usize] || a == b || degree(a) < 3 || degree(b) < 3 {
                continue;
            }
            let [near, far] = [a, b].map(|node| self.graph.nodes[node as usize]);
            let between = |other: &u32| {
                let ends = self.graph.chains[*other as usize].ends;
                ends.contains(&a) && ends.contains(&b)
            };
            let joined_twice = self.at[a as usize].iter().filter(|&o| between(o)).count() > 1;
            let finest = self.finest_but(a, number) + self.finest_but(b, number);
            if joined_twice || chain.length() >= share * finest {
                continue;
            }
            self.take_out(number);
            count += 1;
            let node = &mut self.graph.nodes[a as usize];
            node.place = 0.5 * (near.place + far.place);
            node.reach = near.reach.max(far.reach);
            let place = node.place;
            let moved = std::mem::take(&mut self.at[b as usize]);
            for &other in &moved {
                let chain = &mut self.graph.chains[other as usize];
                for end in &mut chain.ends {
                    if *end == b {
                        *end = a;
                    }
                }
            }
            self.at[a as usize].extend(moved);
            let touching = self.at[a as usize].clone();
            for other in touching {
                let chain = &mut self.graph.chains[other as usize];
                let last = chain.points.len() - 1;
                for (end, point) in chain.ends.into_iter().zip([0, last]) {
                    if end == a {
                        chain.points[point] = place;
                    }
                }
            }
        }
        count
    }

    /// What is left, numbered anew.
    pub(super) fn finished(self) -> Graph {
        let mut number = vec![u32::MAX; self.graph.nodes.len()];
        let mut graph = Graph::default();
        for (mut chain, is_gone) in self.graph.chains.into_iter().zip(self.is_gone) {
            if is_gone {
                continue;
            }
            for end in &mut chain.ends {
                let at = *end as usize;
                if number[at] == u32::MAX {
                    number[at] = graph.nodes.len() as u32;
                    graph.nodes.push(self.graph.nodes[at]);
                }
                *end = number[at];
            }
            graph.chains.push(chain);
        }
        graph
    }
}

/// How many points of a chain stay, so that the disc of its last point reaches as far as those of
/// the points after; at least two.
fn covered_from(chain: &Chain) -> usize {
    let (points, reaches) = (&chain.points, &chain.reaches);
    let mut kept = points.len();
    while kept > 2 {
        let (tip, before) = (kept - 1, kept - 2);
        let covers = points[tip].distance(points[before]) + reaches[tip] <= reaches[before] + 0.5;
        // Pixels make distances jump: a few points farther back may cover it as well.
        let back = before.saturating_sub(3);
        let far = points[tip].distance(points[back]) + reaches[tip] <= reaches[back] + 0.5;
        if !(covers || far) {
            break;
        }
        kept -= 1;
    }
    kept
}
