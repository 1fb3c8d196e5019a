//! Veinlets that end freely: trees that hang from the loops of a net.

use super::{Areoles, OUTSIDE};

/// A vein that ends freely, with all its branches, from the loop on which it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Veinlet {
    /// Number of its free ends: one more than its branches.
    pub(crate) free_ends: usize,
    /// Number of the areole in which it lies, if any.
    pub(crate) areole: Option<usize>,
}

impl Areoles {
    /// All veinlets, by the chain with which they start. What hangs together with an origin, such
    /// as the petiole's end of the midrib, is none.
    pub(crate) fn veinlets(&self) -> Vec<Veinlet> {
        let chains = &self.chains;
        let joints = chains.joints.len();
        // An origin has one edge, which leads away from it.
        let is_tip = |joint: usize| {
            let &[half] = chains.leaving(joint as u32) else {
                return false;
            };
            let edges = chains.edges(half / 2);
            let edge = if half % 2 == 0 {
                edges[0]
            } else {
                edges[edges.len() - 1]
            };
            self.graph.edges()[edge as usize].to == chains.joints[joint]
        };
        let mut degrees: Vec<usize> = (0..joints as u32)
            .map(|joint| chains.leaving(joint).len())
            .collect();
        let mut free_ends = vec![0; joints];
        let mut is_cut = vec![false; chains.len()];
        let mut is_gone = vec![false; joints];
        let mut open: Vec<usize> = (0..joints).filter(|&joint| is_tip(joint)).collect();
        for &joint in &open {
            free_ends[joint] = 1;
        }
        // Each end takes away the chain that leads to it, and what is an end then follows.
        let mut stems: Vec<(u32, usize, usize)> = Vec::new();
        while let Some(joint) = open.pop() {
            let left = chains.leaving(joint as u32).iter();
            let Some(&half) = left.clone().find(|&&half| !is_cut[(half / 2) as usize]) else {
                continue;
            };
            let inner = chains.start(half ^ 1) as usize;
            is_cut[(half / 2) as usize] = true;
            is_gone[joint] = true;
            free_ends[inner] += free_ends[joint];
            degrees[inner] -= 1;
            stems.push((half / 2, inner, free_ends[joint]));
            if degrees[inner] == 1 && chains.leaving(inner as u32).len() > 1 {
                open.push(inner);
            }
        }
        stems.sort_unstable();
        let on_loop = stems.into_iter().filter(|&(_, inner, _)| !is_gone[inner]);
        on_loop
            .map(|(chain, _, free_ends)| {
                let areole = self.on_left[2 * chain as usize];
                Veinlet {
                    free_ends,
                    areole: (areole != OUTSIDE).then_some(areole as usize),
                }
            })
            .collect()
    }

    /// Junctions of areole `number` at which its boundary turns by `least` radians or more; on
    /// either side of a junction over a third of what lies between it and the next.
    pub(crate) fn corners(&self, number: usize, least: f64) -> usize {
        let (start, end) = (
            self.starts[number] as usize,
            self.starts[number + 1] as usize,
        );
        let halves = &self.halves[start..end];
        let before = |i: usize| halves[(i + halves.len() - 1) % halves.len()];
        let turns = |i: usize| {
            let departure = self.chains.stretch(halves[i]);
            let arrival = -self.chains.stretch(before(i) ^ 1);
            arrival.angle_to(departure).abs() >= least
        };
        (0..halves.len()).filter(|&i| turns(i)).count()
    }
}
