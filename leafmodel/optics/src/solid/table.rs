//! Reflectance of one solid by albedo, tabulated for inner loops.

use super::half_space::HalfSpace;

/// Intervals of `√(1 − a)`.
const INTERVALS: usize = 256;

/// Reflectance at normal incidence of a half-space of one refractive index and skin, by albedo.
///
/// Reflectance is smooth in `s = √(1 − a)`, as it is not in `a`; between knots of `s` a cubic goes
/// through four of them. Off by less than 1e-7 (a test measures it).
#[derive(Clone, Debug)]
pub struct ReflectanceTable {
    knots: Vec<f64>,
}

impl ReflectanceTable {
    /// For a refractive index of 1 to 2 and a skin of optical depth ≥ 0.
    pub fn new(eta: f64, skin: f64) -> Self {
        let space = HalfSpace::new(eta);
        let knots = (0..=INTERVALS)
            .map(|i| {
                let s = i as f64 / INTERVALS as f64;
                space.reflected(1.0 - s * s, skin).normal
            })
            .collect();
        Self { knots }
    }

    /// Reflectance, in [0, 1], for an albedo (clamped to [0, 1]).
    pub fn at(&self, albedo: f64) -> f64 {
        let place = (1.0 - albedo).clamp(0.0, 1.0).sqrt() * INTERVALS as f64;
        let first = (place as usize).saturating_sub(1).min(INTERVALS - 3);
        let x = place - first as f64;
        let [a, b, c, d] = std::array::from_fn(|i| self.knots[first + i]);
        // Lagrange's polynomial through 0, 1, 2, 3.
        let value = -a * (x - 1.0) * (x - 2.0) * (x - 3.0) / 6.0
            + b * x * (x - 2.0) * (x - 3.0) / 2.0
            - c * x * (x - 1.0) * (x - 3.0) / 2.0
            + d * x * (x - 1.0) * (x - 2.0) / 6.0;
        value.clamp(0.0, 1.0)
    }
}
