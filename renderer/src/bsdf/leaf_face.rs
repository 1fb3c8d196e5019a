//! A face of a leaf whose inside is followed: the boundary between air and tissue.
//!
//! Light is followed as flux, so nothing is compressed by the refractive index on its way in and
//! out. `docs/src/theory/leaf-layers.md` describes it under "In pictures".

use glam::{Vec2, Vec3};

use crate::bsdf::dielectric::Dielectric;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::{BsdfSample, Scattered, fresnel};
use crate::spectrum::Lanes;

/// Facets that light meets before it is let go whatever their shadows say.
const MOST_FACETS: usize = 16;

/// A boundary; tissue lies on the side −z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafFace {
    boundary: Dielectric,
}

/// What becomes of light at a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossed {
    /// Direction in which it goes on, unit.
    pub towards: Vec3,
    /// Whether it is on the other side of the face.
    pub through: bool,
    /// Density of the direction over solid angle if a sampled light could have chosen it too: one
    /// facet of a rough face sent the light into air.
    pub pdf: Option<f32>,
}

impl LeafFace {
    /// A face of tissue of this refractive index; a GGX roughness of 0 is smooth.
    pub fn new(eta: f32, alpha: f32) -> Self {
        Self {
            boundary: Dielectric { eta, alpha },
        }
    }

    /// Whether light samples contribute nothing.
    pub fn is_smooth(&self) -> bool {
        self.boundary.is_smooth()
    }

    /// Flux scattered by one facet from `wo` to `wi` per solid angle, which is also the density with
    /// which [`LeafFace::cross`] draws such a direction: what a facet shadows goes on to the next.
    fn once(self, wo: Vec3, wi: Vec3) -> f32 {
        let f = self.boundary.eval(wo, wi);
        f * wi.z.abs() * self.boundary.flux_over_radiance(wo, wi)
    }

    /// What becomes of light that comes from `wo`, away from the face; `number` gives random
    /// numbers in [0, 1).
    ///
    /// A facet, drawn from those that are visible, reflects or refracts it by Fresnel's formulae.
    /// With Smith's chance it leaves; else it meets another facet, as if it came from its mirrored
    /// direction. So nothing is lost however rough the face.
    pub fn cross(&self, wo: Vec3, mut number: impl FnMut() -> f32) -> Crossed {
        let Dielectric { eta, alpha } = self.boundary;
        let ggx = Ggx {
            alpha_x: alpha,
            alpha_y: alpha,
        };
        // All in a frame in which the light comes from above.
        let mut side = 1.0_f32.copysign(wo.z);
        let mut from = Vec3::new(wo.x, wo.y, wo.z.abs().max(1e-6));
        for facet in 0..MOST_FACETS {
            let relative = if side > 0.0 { eta } else { 1.0 / eta };
            let h = if self.is_smooth() {
                Vec3::Z
            } else {
                ggx.sample_visible(from, Vec2::new(number(), number()))
            };
            let cosine = from.dot(h);
            let refracted = fresnel::refracted_cosine(cosine, relative)
                .filter(|_| number() >= fresnel::dielectric(cosine, relative));
            let to = match refracted {
                None => 2.0 * cosine * h - from,
                Some(refracted) => h * (cosine / relative - refracted) - from / relative,
            };
            let wants = if refracted.is_some() { -1.0 } else { 1.0 };
            // Seen from the side on which it is now.
            let outward = to.z * wants;
            let lengths = Vec3::new(to.x, to.y, outward.abs()).normalize();
            let leaves = self.is_smooth()
                || facet + 1 == MOST_FACETS
                || (outward > 0.0 && number() < ggx.g1(lengths));
            if leaves {
                let now = side * wants;
                let towards = Vec3::new(lengths.x, lengths.y, now * lengths.z.max(1e-6));
                let through = now * wo.z < 0.0;
                let single = facet == 0 && outward > 0.0 && towards.z > 0.0 && !self.is_smooth();
                return Crossed {
                    towards,
                    through,
                    pdf: single.then(|| self.once(wo, towards)),
                };
            }
            side *= wants;
            from = Vec3::new(-lengths.x, -lengths.y, lengths.z.max(1e-6));
        }
        unreachable!("the last facet lets light go")
    }

    /// The face seen by light from `wo`, as a sampled light sees it.
    pub fn seen_from(&self, wo: Vec3) -> FaceView {
        FaceView { face: *self, wo }
    }
}

/// A face for one direction; light of one facet alone, to the side of air.
#[derive(Clone, Copy, Debug)]
pub struct FaceView {
    face: LeafFace,
    wo: Vec3,
}

impl FaceView {
    /// What one facet scatters to `wi` in air, per projected solid angle, with its density.
    #[inline]
    pub(super) fn scatter<const N: usize>(&self, wi: Vec3) -> Scattered<N> {
        if wi.z <= 0.0 {
            return Scattered::NOTHING;
        }
        let flux = self.face.once(self.wo, wi);
        Scattered {
            f: Lanes::splat(flux / wi.z),
            pdf: flux,
        }
    }

    /// A direction by one facet, into air alone.
    pub(super) fn sample<const N: usize>(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        let sample = self.face.boundary.sample(self.wo, lobe, u)?;
        let flux = self.face.boundary.flux_over_radiance(self.wo, sample.wi);
        (sample.wi.z > 0.0).then(|| BsdfSample {
            wi: sample.wi,
            weight: Lanes::splat(sample.weight * flux),
            pdf: sample.pdf,
            specular: sample.specular,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random numbers of a plain generator.
    fn numbers(mut state: u64) -> impl FnMut() -> f32 {
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let x = (state ^ (state >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            (x >> 40) as f32 / 16_777_216.0
        }
    }

    #[test]
    fn a_smooth_face_reflects_fresnels_share_and_refracts_the_rest() {
        let face = LeafFace::new(1.45, 0.0);
        let wo = Vec3::new(0.6, 0.0, 0.8);
        let mut number = numbers(3);
        let count = 100_000;
        let mut reflected = 0;
        for _ in 0..count {
            let crossed = face.cross(wo, &mut number);
            assert_eq!(crossed.pdf, None);
            if crossed.through {
                let sine = crossed.towards.x;
                assert!((sine + 0.6 / 1.45).abs() < 1e-6, "{sine}");
            } else {
                reflected += 1;
                assert!((crossed.towards - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-6);
            }
        }
        let share = f64::from(reflected) / f64::from(count);
        let expected = f64::from(fresnel::dielectric(0.8, 1.45));
        let error = (expected * (1.0 - expected) / f64::from(count)).sqrt();
        assert!((share - expected).abs() < 4.0 * error, "{share} {expected}");
    }

    #[test]
    fn directions_by_one_facet_come_with_the_density_that_lights_are_weighted_by() {
        // Shares of light that goes to a cone around a direction, by chance and by the density.
        let face = LeafFace::new(1.45, 0.4);
        for (wo, middle) in [
            (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.5, 0.2, 0.8)),
            (Vec3::new(0.3, 0.1, -0.9), Vec3::new(-0.4, 0.1, 0.8)),
        ] {
            let (wo, middle) = (wo.normalize(), middle.normalize());
            let view = face.seen_from(wo);
            let mut number = numbers(7);
            let count = 400_000;
            let (mut inside, mut mean) = (0, 0.0);
            for _ in 0..count {
                let crossed = face.cross(wo, &mut number);
                if let Some(pdf) = crossed.pdf
                    && crossed.towards.z > 0.0
                {
                    let scattered: Scattered<1> = view.scatter(crossed.towards);
                    assert!((scattered.pdf / pdf - 1.0).abs() < 1e-3);
                    inside += u32::from(crossed.towards.dot(middle) > 0.95);
                }
                // Even directions in the cone.
                let z = 0.95 + 0.05 * number();
                let angle = std::f32::consts::TAU * number();
                let radius = (1.0 - z * z).sqrt();
                let (across, along) = middle.any_orthonormal_pair();
                let w = across * (radius * libm::cosf(angle))
                    + along * (radius * libm::sinf(angle))
                    + middle * z;
                let scattered: Scattered<1> = view.scatter(w);
                mean += f64::from(scattered.pdf);
            }
            let cone = 2.0 * std::f64::consts::PI * 0.05;
            let (share, expected) = (
                f64::from(inside) / f64::from(count),
                cone * mean / f64::from(count),
            );
            assert!(expected > 0.001, "{expected}");
            let error = 1.5 * (expected / f64::from(count)).sqrt();
            assert!((share - expected).abs() < 4.0 * error, "{share} {expected}");
        }
    }
}
