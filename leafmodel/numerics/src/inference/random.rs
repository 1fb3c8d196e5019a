//! Chance as a function of seed, generation and number.

use crate::random::{self, Use};

fn counter(generation: u32, number: u32, dimension: u32) -> u64 {
    (u64::from(generation) << 48) | (u64::from(dimension) << 32) | u64::from(number)
}

/// The seed of a simulation. It is below 2⁵³, so that every program reads it from JSON as it is.
pub(super) fn seed_of(seed: u64, generation: u32, number: u32) -> u64 {
    random::bits(seed, Use::Simulation, counter(generation, number, 0)) >> 11
}

/// A uniform number in [0, 1).
pub(super) fn uniform(
    seed: u64,
    purpose: Use,
    generation: u32,
    number: u32,
    dimension: u32,
) -> f64 {
    random::uniform(seed, purpose, counter(generation, number, dimension))
}

/// Standard normal numbers, as many as `dimensions`.
pub(super) fn normal(seed: u64, generation: u32, number: u32, dimensions: usize) -> Vec<f64> {
    let part = |dimension| uniform(seed, Use::Normal, generation, number, dimension);
    (0..dimensions as u32)
        .map(|dimension| random::normal([0, 1].map(|k| part(2 * dimension + k))))
        .collect()
}

/// The member of a weighted sample at a share, 0 to 1, of the sum of weights.
pub(super) fn member(sums: &[f64], share: f64) -> usize {
    sums.partition_point(|sum| *sum <= share)
        .min(sums.len() - 1)
}
