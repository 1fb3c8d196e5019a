//! A virtual integrating sphere: how much a surface scatters into each half space.

use glam::{Vec2, Vec3};
use renderer::sampling::stream::Stream;

/// Shares of the light from one direction that leave on its own side and on the far side.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scattered {
    /// Directional–hemispherical reflectance.
    pub reflected: f64,
    /// Directional–hemispherical transmittance.
    pub transmitted: f64,
}

impl Scattered {
    /// Both together.
    pub fn total(self) -> f64 {
        self.reflected + self.transmitted
    }
}

/// Integrates `f |cos|` over all directions with low-discrepancy points.
///
/// `scatter(lobe, u)` draws a direction and gives it with `f |cos| / pdf`.
pub fn integrate(
    wo: Vec3,
    points: u32,
    mut scatter: impl FnMut(f32, Vec2) -> Option<(Vec3, f64)>,
) -> Scattered {
    let mut sum = Scattered::default();
    for point in 0..points {
        let [lobe, x, y, _] = Stream::new(17, 0, 0, point).next4();
        if let Some((wi, weight)) = scatter(lobe, Vec2::new(x, y)) {
            if wi.z * wo.z > 0.0 {
                sum.reflected += weight / f64::from(points);
            } else {
                sum.transmitted += weight / f64::from(points);
            }
        }
    }
    sum
}

/// Unit vectors from nearly normal to grazing incidence, on both sides.
pub fn directions() -> Vec<Vec3> {
    let mut directions = Vec::new();
    for (i, mu) in [1.0_f32, 0.95, 0.8, 0.6, 0.4, 0.25, 0.12, 0.05, 0.02]
        .into_iter()
        .enumerate()
    {
        let sin = (1.0 - mu * mu).sqrt();
        let phi = 0.3 + 1.1 * i as f32;
        for side in [1.0, -1.0] {
            directions.push(Vec3::new(sin * phi.cos(), sin * phi.sin(), side * mu));
        }
    }
    directions
}
