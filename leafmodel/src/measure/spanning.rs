//! The shortest part of the veins that connects the whole network.

use crate::numeric::Sets;
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
