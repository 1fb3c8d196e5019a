//! Contents to absorption per plate.

use super::constituent::Constituent;
use super::contents::Contents;
use super::prospect_d::Coefficients;

impl Coefficients {
    /// Absorption of the whole leaf, `Σᵢ Cᵢ Kᵢ(λ)`, dimensionless, ≥ 0.
    pub fn absorption_of_leaf(&self, contents: &Contents) -> f64 {
        let absorbed = |constituent| contents[constituent] * self.absorption[constituent];
        Constituent::ABSORBING.map(absorbed).into_iter().sum()
    }

    /// Absorption coefficient of one plate, `K(λ) = Σᵢ Cᵢ Kᵢ(λ) / N`, dimensionless, ≥ 0.
    ///
    /// # Source
    ///
    /// \[feret2017\]; `docs/src/theory/leaf-optics.md`.
    pub(crate) fn absorption_per_plate(&self, contents: &Contents) -> f64 {
        self.absorption_of_leaf(contents) / contents[Constituent::Structure]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::ProspectD;
    use properties::fixed;

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn doubling_the_plates_halves_the_absorption(content in 0.0..100.0, n in 1.0..4.0) {
            let one = Contents::prospect_d([n, content, 8.0, 1.0, 0.2, 0.01, 0.005])
                .with(&[(Constituent::Betacyanins, 2.0), (Constituent::Betaxanthins, 3.0)]);
            let two = one.with(&[(Constituent::Structure, 2.0 * n)]);
            for nm in [450.0, 675.3, 1400.0] {
                let at = ProspectD::coefficients(nm).expect("in range");
                let (one, two) = (at.absorption_per_plate(&one), at.absorption_per_plate(&two));
                prop_assert!((one - 2.0 * two).abs() <= 1e-12 * one, "{one} is not twice {two}");
            }
        }
    }
}
