//! Chance as a function of seed, generation and number.

use std::f64::consts::TAU;

use crate::shape::chance::{bits, share};

/// Purposes of random numbers of this room; the numbers separate them and must never change.
#[derive(Clone, Copy, Debug)]
pub(super) enum Purpose {
    /// The seed of a simulation.
    Seed = 0x00f1_7000,
    /// Both coordinates of normal numbers.
    Normal = 0x00f1_7001,
    /// Which member of a weighted sample is taken.
    Member = 0x00f1_7002,
    /// A place in the prior.
    Prior = 0x00f1_7003,
}

fn counter(generation: u32, number: u32, dimension: u32) -> u64 {
    (u64::from(generation) << 48) | (u64::from(dimension) << 32) | u64::from(number)
}

/// The seed of a simulation. It is below 2⁵³, so that every program reads it from JSON as it is.
pub(super) fn seed_of(seed: u64, generation: u32, number: u32) -> u64 {
    bits(seed, Purpose::Seed as u64, counter(generation, number, 0)) >> 11
}

/// A uniform number in [0, 1).
pub(super) fn uniform(
    seed: u64,
    purpose: Purpose,
    generation: u32,
    number: u32,
    dimension: u32,
) -> f64 {
    let at = counter(generation, number, dimension);
    share(bits(seed, purpose as u64, at))
}

/// Standard normal numbers, as many as `dimensions` (Box and Muller 1958).
pub(super) fn normal(seed: u64, generation: u32, number: u32, dimensions: usize) -> Vec<f64> {
    let one = |dimension: u32| {
        let number = |part| {
            uniform(
                seed,
                Purpose::Normal,
                generation,
                number,
                2 * dimension + part,
            )
        };
        // 1 − u lies in (0, 1].
        (-2.0 * libm::log(1.0 - number(0))).sqrt() * libm::cos(TAU * number(1))
    };
    (0..dimensions as u32).map(one).collect()
}

/// The member of a weighted sample at a share, 0 to 1, of the sum of weights.
pub(super) fn member(sums: &[f64], share: f64) -> usize {
    sums.partition_point(|sum| *sum <= share)
        .min(sums.len() - 1)
}
