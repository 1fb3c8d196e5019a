//! The flat map in which the veins of a curved blade are computed.
//!
//! A blade of constant Gaussian curvature `K` has a map that preserves angles. A length at distance
//! `r` from the map's centre appears enlarged by `1 + K r²/4` in every direction. The map is the
//! stereographic projection of a sphere if `K > 0`, the Poincaré disc if `K < 0`.

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// The conformal map of a blade of constant Gaussian curvature; flat if that is 0.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct ConformalMap {
    /// `K`, one over the square of the unit of length.
    curvature: f64,
    /// The point at which the map has scale 1.
    centre: DVec2,
}

impl ConformalMap {
    /// The map of a flat blade: the blade itself.
    pub const FLAT: Self = Self {
        curvature: 0.0,
        centre: DVec2::ZERO,
    };

    /// The map of a blade with curvature `K`, in one over the square of the unit of length, about
    /// `centre`.
    pub fn new(curvature: f64, centre: DVec2) -> Self {
        Self { curvature, centre }
    }

    /// Whether the blade is flat.
    pub fn is_flat(&self) -> bool {
        self.curvature == 0.0
    }

    /// Lengths in the map over true lengths at `p`; 1 on a flat blade, > 0 where the map exists.
    pub fn enlargement(&self, p: DVec2) -> f64 {
        1.0 + 0.25 * self.curvature * (p - self.centre).length_squared()
    }

    /// The point of the blade at `p`, raised by `height` towards the adaxial side; the map's centre
    /// is at the origin, where the blade is horizontal. For `K > 0` the surface is a sphere that
    /// bends up towards the adaxial side (a cup), and all lengths are exact. No complete surface
    /// with constant `K < 0` has a simple form, so a saddle is used: it has the curvature `K` at
    /// the centre, and its lengths are exact to second order in the distance from there.
    pub(crate) fn in_space(&self, p: DVec2, height: f64) -> DVec3 {
        let q = p - self.centre;
        if self.curvature > 0.0 {
            let radius = 1.0 / self.curvature.sqrt();
            let rise = 0.25 * self.curvature * q.length_squared();
            let flat = q / (1.0 + rise);
            let at = DVec3::new(flat.x, flat.y, 2.0 * radius * rise / (1.0 + rise));
            at + (DVec3::new(0.0, 0.0, radius) - at) * (height / radius)
        } else {
            let bend = (-self.curvature).sqrt();
            let at = DVec3::new(q.x, q.y, 0.5 * bend * (q.x * q.x - q.y * q.y));
            at + DVec3::new(-bend * q.x, bend * q.y, 1.0).normalize() * height
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_on_the_sphere_are_those_of_the_map_over_its_enlargement() {
        let map = ConformalMap::new(0.04, DVec2::new(1.0, -2.0));
        for i in 0..40 {
            let p = DVec2::new(0.3 * f64::from(i) - 5.0, 0.2 * f64::from(i % 7));
            for way in [DVec2::X, DVec2::Y, DVec2::new(0.6, -0.8)] {
                let step = 1e-5;
                let there = map.in_space(p + way * step, 0.0) - map.in_space(p - way * step, 0.0);
                let length = there.length() / (2.0 * step);
                assert!(
                    (length * map.enlargement(p) - 1.0).abs() < 1e-9,
                    "{p} {length}"
                );
            }
            // On the sphere of radius 5 about (0, 0, 5), and nearer to its centre when raised.
            let from_centre =
                |height| (map.in_space(p, height) - DVec3::new(0.0, 0.0, 5.0)).length();
            assert!((from_centre(0.0) - 5.0).abs() < 1e-12);
            assert!((from_centre(0.25) - 4.75).abs() < 1e-12);
        }
    }

    #[test]
    fn the_saddle_is_true_to_second_order_and_the_flat_map_altogether() {
        let map = ConformalMap::new(-0.04, DVec2::ZERO);
        for r in [0.1, 0.2, 0.4] {
            let p = DVec2::new(r, 0.0);
            let step = 1e-6;
            let there = map.in_space(p + DVec2::X * step, 0.0) - map.in_space(p, 0.0);
            let error = there.length() / step * map.enlargement(p) - 1.0;
            assert!(error.abs() < 0.04 * r * r, "{error} at {r}");
        }
        let flat = ConformalMap::FLAT.in_space(DVec2::new(3.0, 4.0), 0.5);
        assert_eq!(flat, DVec3::new(3.0, 4.0, 0.5));
    }
}
