//! The boundary of a transparent medium, smooth or rough.

use glam::{Vec2, Vec3};

use crate::bsdf::fresnel;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::sample::BsdfSample;
use crate::spectrum::Lanes;

/// Reflection and refraction at a boundary; the medium lies on the side −z.
///
/// Rough boundaries follow Walter et al. 2007 with the GGX distribution and their separable Smith
/// shadowing (masking on one side says little about shadowing on the other side of the surface).
/// Radiance that enters the medium is compressed by the solid angle, so `f` is not reciprocal:
/// `f(wo, wi) η_i² = f(wi, wo) η_o²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Refractive index of the medium over that outside.
    pub eta: f32,
    /// GGX roughness; 0 is smooth.
    pub alpha: f32,
}

impl Dielectric {
    /// Whether the boundary reflects and refracts into single directions.
    pub fn is_smooth(self) -> bool {
        self.alpha == 0.0
    }

    fn ggx(self) -> Ggx {
        Ggx {
            alpha_x: self.alpha,
            alpha_y: self.alpha,
        }
    }

    /// Factor from the weight of radiance, which a denser medium compresses, to that of the flux
    /// which goes from the side of `wo` to that of `wi`: η² across the boundary, else 1.
    pub(super) fn flux_over_radiance(self, wo: Vec3, wi: Vec3) -> f32 {
        if wo.z * wi.z < 0.0 {
            let eta = self.relative_eta(wo);
            eta * eta
        } else {
            1.0
        }
    }

    /// Index on the far side over that on the side of `wo`.
    fn relative_eta(self, wo: Vec3) -> f32 {
        if wo.z > 0.0 { self.eta } else { 1.0 / self.eta }
    }

    /// Microfacet normal on the side of +z that sends `wi` to `wo`; both are flipped so that `wo`
    /// is above.
    fn half_vector(wo: Vec3, wi: Vec3, eta: f32) -> Option<Vec3> {
        let sum = if wi.z > 0.0 { wo + wi } else { wo + wi * eta };
        let h = sum.try_normalize()?;
        let h = if h.z < 0.0 { -h } else { h };
        // A facet seen from behind scatters nothing.
        (wo.dot(h) > 0.0 && wi.dot(h) * wi.z > 0.0).then_some(h)
    }

    /// `f(wo, wi)`, sr⁻¹, and the density of [`Dielectric::sample`], sr⁻¹; zero for a smooth boundary.
    #[inline]
    pub fn scatter(self, wo: Vec3, wi: Vec3) -> (f32, f32) {
        if self.is_smooth() || wo.z == 0.0 || wi.z == 0.0 {
            return (0.0, 0.0);
        }
        let eta = self.relative_eta(wo);
        let (wo, wi) = flip(wo, wi);
        let Some(h) = Self::half_vector(wo, wi, eta) else {
            return (0.0, 0.0);
        };
        let ggx = self.ggx();
        let reflected = fresnel::dielectric(wo.dot(h), eta);
        let visible = ggx.visible_density(wo, h);
        if wi.z > 0.0 {
            let f = ggx.d(h) * ggx.g1(wo) * ggx.g1(wi) * reflected / (4.0 * wo.z * wi.z);
            return (f, reflected * visible / (4.0 * wo.dot(h)));
        }
        let denominator = wo.dot(h) + eta * wi.dot(h);
        let jacobian =
            wo.dot(h) * wi.dot(h).abs() / (wo.z * wi.z.abs() * denominator * denominator);
        // η² of the density of normals and 1/η² of the radiance's compression cancel.
        let f = (1.0 - reflected) * ggx.d(h) * ggx.g1(wo) * ggx.g1(-wi) * jacobian;
        let pdf =
            (1.0 - reflected) * visible * eta * eta * wi.dot(h).abs() / (denominator * denominator);
        (f, pdf)
    }

    /// Samples reflection or refraction in proportion to their Fresnel shares.
    pub fn sample<const N: usize>(self, wo: Vec3, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        if wo.z == 0.0 {
            return None;
        }
        let eta = self.relative_eta(wo);
        let side = 1.0_f32.copysign(wo.z);
        let above = Vec3::new(wo.x, wo.y, wo.z.abs());
        let h = if self.is_smooth() {
            Vec3::Z
        } else {
            self.ggx().sample_visible(above, u)
        };
        let cos = above.dot(h);
        let reflected = fresnel::dielectric(cos, eta);
        let (wi, smooth_weight) = if lobe < reflected {
            let wi = 2.0 * cos * h - above;
            if wi.z <= 0.0 {
                return None;
            }
            (wi, 1.0)
        } else {
            let cos_t = fresnel::refracted_cosine(cos, eta)?;
            let wi = -above / eta + (cos / eta - cos_t) * h;
            if wi.z >= 0.0 {
                return None;
            }
            (wi, 1.0 / (eta * eta))
        };
        let wi = Vec3::new(wi.x, wi.y, wi.z * side);
        if self.is_smooth() {
            return Some(BsdfSample {
                wi,
                weight: Lanes::splat(smooth_weight),
                pdf: 1.0,
                specular: true,
            });
        }
        let wi = wi.normalize();
        let (f, pdf) = self.scatter(wo, wi);
        (pdf > 0.0).then(|| BsdfSample {
            wi,
            weight: Lanes::splat(f * wi.z.abs() / pdf),
            pdf,
            specular: false,
        })
    }
}

/// Mirrors both directions so that `wo` is above.
fn flip(wo: Vec3, wi: Vec3) -> (Vec3, Vec3) {
    if wo.z > 0.0 {
        (wo, wi)
    } else {
        (Vec3::new(wo.x, wo.y, -wo.z), Vec3::new(wi.x, wi.y, -wi.z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flux_through_a_smooth_boundary_is_neither_compressed_nor_lost() {
        let glass = Dielectric {
            eta: 1.5,
            alpha: 0.0,
        };
        for wo in [
            Vec3::new(0.6, 0.0, 0.8),
            Vec3::new(0.3, 0.1, -0.9).normalize(),
        ] {
            let sample = glass.sample::<1>(wo, 0.99, Vec2::splat(0.5));
            let sample = sample.expect("it is refracted");
            assert!(wo.z * sample.wi.z < 0.0);
            let flux = sample.weight.0[0] * glass.flux_over_radiance(wo, sample.wi);
            assert!((flux - 1.0).abs() < 1e-6, "{flux}");
            assert_eq!(glass.flux_over_radiance(wo, wo), 1.0);
        }
    }
}
