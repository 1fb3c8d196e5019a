//! Lambertian reflection.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::sample::{BsdfSample, Scattered};
use crate::sampling::warp;
use crate::spectrum::Lanes;

/// Lambertian reflection on both sides, seen from one direction.
#[derive(Clone, Debug)]
pub struct DiffuseView<const N: usize> {
    pub(super) reflectance: Lanes<N>,
    /// The outgoing direction, local.
    pub(super) wo: Vec3,
}

impl<const N: usize> DiffuseView<N> {
    /// The BSDF's value for light from `wi`, and the density with which `wi` is sampled.
    #[inline]
    pub fn scatter(&self, wi: Vec3) -> Scattered<N> {
        if self.wo.z * wi.z > 0.0 {
            Scattered {
                f: self.reflectance * FRAC_1_PI,
                pdf: wi.z.abs() * FRAC_1_PI,
            }
        } else {
            Scattered::NOTHING
        }
    }

    /// Draws a direction.
    #[inline]
    pub fn sample(&self, u: Vec2) -> Option<BsdfSample<N>> {
        let up = warp::cosine_hemisphere(u);
        (up.z > 0.0).then_some(BsdfSample {
            wi: Vec3::new(up.x, up.y, up.z.copysign(self.wo.z)),
            weight: self.reflectance,
            pdf: up.z * FRAC_1_PI,
            specular: false,
        })
    }
}
