//! Random numbers that make a specimen unlike its plan, as a function of seed, use and
//! counter.

/// What a random number is used for. The discriminants separate the uses and must never change.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Use {
    /// Lengths of teeth along the margin.
    ToothSpacing = 1,
    /// Heights of teeth.
    ToothHeight = 2,
    /// The difference of the sides' widths.
    Width = 3,
    /// The side to which a blade leans, and how far.
    Bow = 4,
    /// Direction, length and phase of the waves by which places of the margin wander.
    Wander = 5,
    /// The seed of a leaf of a plant.
    Individual = 6,
    /// How a leaf of a plant differs from the others.
    IndividualTrait = 7,
    /// Places of damage.
    Damage = 8,
    /// Sizes of damage.
    DamageSize = 9,
    /// How the axes of a plant stray.
    Plant = 10,
    /// Which axils of a plant bear branches.
    Branch = 11,
    /// How each leaf of a plant is turned.
    BorneLeaf = 12,
    /// How the stems of a plant differ.
    Stem = 13,
    /// How the parts of a flower stray.
    Flower = 14,
    /// Waves and crumbs of soil.
    Soil = 15,
    /// Adventitious roots.
    Rootlet = 16,
    /// Turns that a leaf of a plant tries which would cut another.
    Evasion = 17,
    /// Ridges and lenticels of bark.
    Bark = 18,
}

/// A uniform random number in [0, 1), a multiple of 2⁻⁵³.
pub(crate) fn uniform(seed: u64, purpose: Use, counter: u64) -> f64 {
    share(bits(seed, purpose as u64 + 0x5eed, counter))
}

/// 64 random bits for the use with this number, number `counter` of their kind.
///
/// Two rounds of the output function of `SplitMix64` (\[steele2014\]), the second keyed by the
/// first. The counter's increment is that of the generator.
pub(crate) fn bits(seed: u64, purpose: u64, counter: u64) -> u64 {
    let key = scramble(seed ^ purpose.wrapping_mul(0xd1b5_4a32_d192_ed03));
    scramble(key.wrapping_add(counter.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
}

/// A number in [0, 1) from random bits, a multiple of 2⁻⁵³.
pub(crate) fn share(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// A random number of mean 0 and standard deviation 1, within ±√3: uniform.
pub(crate) fn even(seed: u64, purpose: Use, counter: u64) -> f64 {
    3.0_f64.sqrt() * (2.0 * uniform(seed, purpose, counter) - 1.0)
}

/// A random number of mean 0 and standard deviation 1, within ±√12: nearly normal, the sum of four
/// uniform ones.
pub(crate) fn bell(seed: u64, purpose: Use, counter: u64) -> f64 {
    let sum: f64 = (0..4)
        .map(|i| uniform(seed, purpose, 4 * counter + i))
        .sum();
    3.0_f64.sqrt() * (sum - 2.0)
}

fn scramble(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_kinds_of_numbers_have_mean_0_and_deviation_1() {
        let n = 20_000_u64;
        for number in [even, bell] {
            let all: Vec<f64> = (0..n).map(|i| number(7, Use::Width, i)).collect();
            let mean = all.iter().sum::<f64>() / n as f64;
            let square = all.iter().map(|x| x * x).sum::<f64>() / n as f64;
            // Standard error of the mean: 1/√n = 0.007.
            assert!(mean.abs() < 0.03, "{mean}");
            assert!((square - 1.0).abs() < 0.04, "{square}");
        }
        assert_ne!(even(7, Use::Width, 3), even(7, Use::Bow, 3));
        assert_ne!(even(7, Use::Width, 3), even(8, Use::Width, 3));
    }
}
