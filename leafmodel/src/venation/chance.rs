//! Random numbers as a function of seed, use and counter.
//!
//! There is no generator state, so results cannot depend on the order of work.

use crate::shape::chance;

/// What a random number is used for. The discriminants separate the uses and must never change.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Use {
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
    /// The shuffling of types of cells for a null model.
    Shuffle = 16,
    /// The places at which the pattern of a mosaic is sampled.
    PatternProbe = 17,
    /// The seed of the patches in which a leaf begins to age or dies.
    Ageing = 18,
    /// Where convergence points appear, and how unlike their veins are.
    Development = 31,
    /// The seed of the noise in a layer of contents.
    Layer = 19,
    /// How far the veins of an architecture stray.
    Architecture = 20,
    /// Along which line a source draws two veins.
    Axis = 32,
    /// How dead tissue weathers.
    Weathering = 41,
    /// Spots on dead tissue.
    WeatheringSpot = 42,
    /// How unevenly a leaf dries, and how its margin grows.
    Stance = 21,
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
}

/// 64 random bits for one use, number `counter` of its kind.
pub(crate) fn bits(seed: u64, purpose: Use, counter: u64) -> u64 {
    chance::bits(seed, purpose as u64, counter)
}

/// A uniform random number in [0, 1), a multiple of 2⁻⁵³.
pub(crate) fn uniform(seed: u64, purpose: Use, counter: u64) -> f64 {
    chance::share(bits(seed, purpose, counter))
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
}
