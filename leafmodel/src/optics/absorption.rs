//! Contents to absorption per plate.

use super::constituents::{Coefficients, SpecificAbsorption};
use super::contents::Contents;

impl SpecificAbsorption {
    /// Absorption of the whole leaf, `Σᵢ Cᵢ Kᵢ(λ)`, dimensionless, ≥ 0.
    pub fn of_leaf(&self, contents: &Contents) -> f64 {
        contents.chlorophyll * self.chlorophyll
            + contents.carotenoids * self.carotenoids
            + contents.anthocyanins * self.anthocyanins
            + contents.betacyanins * self.betacyanins
            + contents.betaxanthins * self.betaxanthins
            + contents.brown * self.brown
            + contents.water * self.water
            + contents.dry_matter * self.dry_matter
    }
}

impl Coefficients {
    /// Absorption coefficient of one plate, `K(λ) = Σᵢ Cᵢ Kᵢ(λ) / N`, dimensionless, ≥ 0.
    ///
    /// # Source
    ///
    /// \[feret2017\]; `docs/src/theory/leaf-optics.md`.
    pub fn absorption_per_plate(&self, contents: &Contents) -> f64 {
        self.absorption.of_leaf(contents) / contents.structure
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::optics::ProspectD;

    proptest! {
        #[test]
        fn doubling_the_plates_halves_the_absorption(content in 0.0..100.0, n in 1.0..4.0) {
            let one = Contents::from_array([n, content, 8.0, 1.0, 2.0, 3.0, 0.2, 0.01, 0.005]);
            let two = Contents { structure: 2.0 * n, ..one };
            for nm in [450.0, 675.3, 1400.0] {
                let at = ProspectD::coefficients(nm).expect("in range");
                let (one, two) = (at.absorption_per_plate(&one), at.absorption_per_plate(&two));
                prop_assert!((one - 2.0 * two).abs() <= 1e-12 * one, "{one} is not twice {two}");
            }
        }
    }
}
