//! Random numbers as a function of seed, use and counter.
//!
//! There is no generator state, so results cannot depend on the order of work.

use std::f64::consts::TAU;

/// What a random number is used for. The discriminants separate the uses and must never change.
#[derive(Clone, Copy, Debug)]
pub enum Use {
    /// Where a dart lands, across the leaf.
    DartX = 1,
    /// Where a dart lands, along the leaf.
    DartY = 2,
    /// Which of several equally near nodes a source drives.
    Tie = 3,
    /// Where a dart for a veinlet that ends freely lands, across the leaf.
    FreeDartX = 4,
    /// The same, along the leaf.
    FreeDartY = 5,
    /// Whether a dart on a curved blade is kept.
    DartKept = 6,
    /// Where along the margin a secondary vein ends.
    Arch = 7,
    /// The light on a patch of a transport leaf.
    Light = 8,
    /// The seed of a leaflet of a compound leaf.
    Leaflet = 9,
    /// The place of a cell of a mosaic, and that of a child beside its parent.
    MosaicPlace = 11,
    /// The type of a cell of a mosaic.
    MosaicKind = 12,
    /// When a cell of a mosaic divides.
    MosaicDivision = 13,
    /// The images that control a mosaic.
    MosaicImage = 14,
    /// Gradients of noise patterns.
    NoiseGradient = 15,
    /// The places at which the pattern of a mosaic is sampled.
    PatternProbe = 17,
    /// The seed of the patches in which a leaf begins to age or dies.
    Ageing = 18,
    /// The seed of the noise in a layer of contents.
    Layer = 19,
    /// How far the veins of an architecture stray.
    Architecture = 20,
    /// How unevenly a leaf dries, and how its margin grows.
    Stance = 21,
    /// Where convergence points appear, and how unlike their veins are.
    Development = 31,
    /// Along which line a source draws two veins.
    Axis = 32,
    /// How dead tissue weathers.
    Weathering = 41,
    /// Spots on dead tissue.
    WeatheringSpot = 42,
    /// Where hairs stand, and their shapes.
    Hair = 43,
    /// How a petiole strays from its course.
    Petiole = 51,
    /// Where the distance to the nearest vein is measured, across the leaf.
    ProbeX = 101,
    /// Where the distance to the nearest vein is measured, along the leaf.
    ProbeY = 102,
    /// Which areole is drawn for a confidence interval.
    Bootstrap = 103,
    /// Which leaves change groups.
    Permutation = 104,
    /// Lengths of teeth along the margin.
    ToothSpacing = 0x5eee,
    /// Heights of teeth.
    ToothHeight = 0x5eef,
    /// The difference of the sides' widths.
    Width = 0x5ef0,
    /// The side to which a blade leans, and how far.
    Bow = 0x5ef1,
    /// Direction, length and phase of the waves by which places of the margin wander.
    Wander = 0x5ef2,
    /// The seed of a leaf of a plant.
    Individual = 0x5ef3,
    /// How a leaf of a plant differs from the others.
    IndividualTrait = 0x5ef4,
    /// Places of damage.
    Damage = 0x5ef5,
    /// Sizes of damage.
    DamageSize = 0x5ef6,
    /// How the axes of a plant stray.
    Plant = 0x5ef7,
    /// Which axils of a plant bear branches.
    Branch = 0x5ef8,
    /// How each leaf of a plant is turned.
    BorneLeaf = 0x5ef9,
    /// How the stems of a plant differ.
    Stem = 0x5efa,
    /// How the parts of a flower stray.
    Flower = 0x5efb,
    /// Waves and crumbs of soil.
    Soil = 0x5efc,
    /// Adventitious roots.
    Rootlet = 0x5efd,
    /// Turns that a leaf of a plant tries which would cut another.
    Evasion = 0x5efe,
    /// Ridges and lenticels of bark.
    Bark = 0x5eff,
    /// The patches in which a margin dies back.
    Dieback = 0xd1eb,
    /// The seed of a simulation of an inference.
    Simulation = 0x00f1_7000,
    /// Both uniform numbers of a normal one.
    Normal = 0x00f1_7001,
    /// Which member of a weighted sample is taken.
    Member = 0x00f1_7002,
    /// A place in a prior.
    Prior = 0x00f1_7003,
    /// The ways of photons.
    Photon = 0x00f2_0000,
}

/// 64 random bits for one use, number `counter` of its kind.
#[inline]
pub fn bits(seed: u64, purpose: Use, counter: u64) -> u64 {
    bits_of(seed, purpose as u64, counter)
}

/// As [`bits`], for the use with this number.
///
/// Two rounds of the output function of `SplitMix64` (\[steele2014\]), the second keyed by the
/// first. The counter's increment is that of the generator.
#[inline]
pub fn bits_of(seed: u64, purpose: u64, counter: u64) -> u64 {
    let key = scramble(seed ^ purpose.wrapping_mul(0xd1b5_4a32_d192_ed03));
    scramble(key.wrapping_add(counter.wrapping_mul(INCREMENT)))
}

/// The state of a hash after one number more: one round of `SplitMix64`, cheap enough for the corners
/// of a lattice.
#[inline]
pub fn hashed(state: u64, number: u64) -> u64 {
    scramble((state ^ number).wrapping_add(INCREMENT))
}

/// A number in [0, 1) from random bits, a multiple of 2⁻⁵³.
#[inline]
pub fn share(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// A whole number below `count` from random bits.
#[inline]
pub fn below(bits: u64, count: usize) -> usize {
    ((u128::from(bits) * count as u128) >> 64) as usize
}

/// A uniform random number in [0, 1), a multiple of 2⁻⁵³.
#[inline]
pub fn uniform(seed: u64, purpose: Use, counter: u64) -> f64 {
    share(bits(seed, purpose, counter))
}

/// A random number of mean 0 and standard deviation 1, within ±√3: uniform.
#[inline]
pub fn even(seed: u64, purpose: Use, counter: u64) -> f64 {
    3.0_f64.sqrt() * (2.0 * uniform(seed, purpose, counter) - 1.0)
}

/// A random number of mean 0 and standard deviation 1, within ±√12: nearly normal, the sum of four
/// uniform ones.
#[inline]
pub fn bell(seed: u64, purpose: Use, counter: u64) -> f64 {
    let sum: f64 = (0..4)
        .map(|i| uniform(seed, purpose, 4 * counter + i))
        .sum();
    3.0_f64.sqrt() * (sum - 2.0)
}

/// A standard normal number from two uniform ones in [0, 1) (Box and Muller 1958).
#[inline]
pub fn normal([radius, angle]: [f64; 2]) -> f64 {
    // 1 − u lies in (0, 1].
    (-2.0 * libm::log(1.0 - radius)).sqrt() * libm::cos(TAU * angle)
}

/// The increment of `SplitMix64`: 2⁶⁴ over the golden ratio.
const INCREMENT: u64 = 0x9e37_79b9_7f4a_7c15;

/// The output function of `SplitMix64`.
fn scramble(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uses_and_seeds_give_unrelated_uniform_numbers() {
        let n = 20_000;
        for (seed, purpose) in [(0, Use::DartX), (1, Use::DartX), (0, Use::DartY)] {
            let mean = (0..n).map(|i| uniform(seed, purpose, i)).sum::<f64>() / n as f64;
            // Standard error of the mean of n uniform numbers: 1/√(12 n) = 0.002.
            assert!((mean - 0.5).abs() < 0.008, "mean {mean}");
        }
        let covariance = (0..n)
            .map(|i| (uniform(7, Use::DartX, i) - 0.5) * (uniform(7, Use::DartY, i) - 0.5))
            .sum::<f64>()
            / n as f64;
        // Standard error 1/(12 √n) = 0.0006.
        assert!(covariance.abs() < 0.0024, "covariance {covariance}");
    }

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
