//! How much of each constituent veins hold, over what the lamina between them does.

use std::ops::{Deref, DerefMut};

use super::constituent::Constituent;
use super::per_constituent::PerConstituent;

/// Factors on contents over the middle of a fully developed vein, each ≥ 0; 1 changes nothing.
///
/// Below 1 for chlorophyll makes veins bright in transmitted light, above 1 dark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinFactors(pub PerConstituent<f64>);

impl VeinFactors {
    /// The most that a factor may be.
    pub const MOST: f64 = 100.0;

    /// These factors; those of all others are 1.
    pub const fn of(factors: &[(Constituent, f64)]) -> Self {
        Self(PerConstituent::splat(1.0).with(factors))
    }
}

/// Veins of a leaf of which nothing is said: pale, watery, dense (our choice within the ranges that
/// `docs/src/format/leaf.md` names).
impl Default for VeinFactors {
    fn default() -> Self {
        const USUAL: VeinFactors = VeinFactors::of(&[
            (Constituent::Structure, 1.3),
            (Constituent::Chlorophyll, 0.1),
            (Constituent::Carotenoids, 0.12),
            (Constituent::Water, 2.0),
            (Constituent::DryMatter, 2.5),
            (Constituent::Proteins, 2.5),
            (Constituent::CarbonBased, 2.5),
        ]);
        USUAL
    }
}

impl Deref for VeinFactors {
    type Target = PerConstituent<f64>;

    fn deref(&self) -> &PerConstituent<f64> {
        &self.0
    }
}

impl DerefMut for VeinFactors {
    fn deref_mut(&mut self) -> &mut PerConstituent<f64> {
        &mut self.0
    }
}
