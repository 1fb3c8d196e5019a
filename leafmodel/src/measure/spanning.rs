//! The shortest part of the veins that connects the whole network.

use crate::venation::areole::Chains;

/// Length of the minimum spanning forest of the veins, taken from junction to junction, over the
/// length of all veins (Kruskal's algorithm). `None` without veins.
pub(super) fn ratio(chains: &Chains) -> Option<f64> {
    let total: f64 = chains.lengths.iter().sum();
    let mut order: Vec<(u64, u32)> = chains
        .lengths
        .iter()
        .zip(0..)
        // Lengths are above 0, so their bits are in the order of their values.
        .map(|(length, chain)| (length.to_bits(), chain))
        .collect();
    order.sort_unstable();
    let mut trees = Sets::new(chains.joints.len());
    let kept: f64 = order
        .into_iter()
        .filter(|&(_, chain)| {
            let [a, b] = chains.ends[chain as usize];
            trees.join(a, b).is_some()
        })
        .map(|(_, chain)| chains.lengths[chain as usize])
        .sum();
    (total > 0.0).then(|| kept / total)
}

/// Disjoint sets of numbers from 0.
pub(super) struct Sets(Vec<u32>);

impl Sets {
    pub(super) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The number that represents the set of another.
    pub(super) fn leader(&mut self, mut of: u32) -> u32 {
        while self.0[of as usize] != of {
            self.0[of as usize] = self.0[self.0[of as usize] as usize];
            of = self.0[of as usize];
        }
        of
    }

    /// Joins two sets; returns the leader that remains and the one that does not, or `None` if they
    /// were the same set.
    pub(super) fn join(&mut self, a: u32, b: u32) -> Option<(u32, u32)> {
        let (a, b) = (self.leader(a), self.leader(b));
        let (stays, goes) = (a.min(b), a.max(b));
        self.0[goes as usize] = stays;
        (stays != goes).then_some((stays, goes))
    }
}
