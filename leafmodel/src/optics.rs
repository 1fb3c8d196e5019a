//! Leaf optics: from what a leaf contains to what it reflects and transmits.

/// What a leaf holds per leaf area, and its structure: PROSPECT-D's inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contents {
    /// `N`, number of plates, real, ≥ 1.
    pub structure: f64,
    /// Chlorophyll a + b, µg cm⁻², ≥ 0.
    pub chlorophyll: f64,
    /// Carotenoids, µg cm⁻², ≥ 0.
    pub carotenoids: f64,
    /// Anthocyanins, µg cm⁻², ≥ 0.
    pub anthocyanins: f64,
    /// Brown pigments, PROSPECT's arbitrary unit, ≥ 0.
    pub brown: f64,
    /// Water, cm (= g cm⁻²), ≥ 0.
    pub water: f64,
    /// Dry matter, g cm⁻², ≥ 0.
    pub dry_matter: f64,
}
