//! A surface of grains, as bare soil is: the reflectance of Hapke, without its roughness on a large scale.
//!
//! `f = w / 4π / (µ₀ + µ) · ((1 + B(g)) P(g) + H(µ₀) H(µ) − 1)`, with the single-scattering albedo w, the
//! phase angle g between both directions, the phase function P of two Henyey-Greenstein lobes, the opposition effect
//! `B = B₀ / (1 + tan(g/2) / h)`, and Hapke's approximation of Chandrasekhar's H. Both sides are alike.
//!
//! # Source
//!
//! \[hapke2002\] for the formula and H, \[hapke2012\] for P; `docs/src/theory/soil.md`.

use std::f32::consts::{FRAC_1_PI, PI, TAU};

use glam::{Vec2, Vec3};

use super::sample::{BsdfSample, Scattered};
use crate::sampling::warp;
use crate::spectrum::Lanes;

/// How grains scatter, the same at all wavelengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grains {
    /// Asymmetry b of both lobes, in [0, 1).
    pub asymmetry: f32,
    /// Weight c of the backward lobe: 1 is all of it, −1 is none, 0 is half.
    pub backward: f32,
    /// Height B₀ of the opposition effect.
    pub opposition: f32,
    /// Its width h, > 0.
    pub width: f32,
}

/// The surface at one point.
#[derive(Clone, Copy, Debug)]
pub struct HapkeBsdf<const N: usize> {
    /// Single-scattering albedo of grains, in [0, 1].
    pub albedo: Lanes<N>,
    /// How grains scatter.
    pub grains: Grains,
}

/// The same, seen from one direction.
#[derive(Clone, Debug)]
pub struct HapkeView<const N: usize> {
    surface: HapkeBsdf<N>,
    wo: Vec3,
    /// H of `wo`.
    outward: Lanes<N>,
}

impl Grains {
    /// `(1 + B) P` at the cosine of a phase angle.
    fn once(&self, cosine: f32) -> f32 {
        let cosine = cosine.clamp(-1.0, 1.0);
        let lobe = |asymmetry: f32| {
            let square = asymmetry * asymmetry;
            let base = 1.0 + square - 2.0 * asymmetry * cosine;
            (1.0 - square) / (base * base.sqrt())
        };
        let [back, forth] = [self.asymmetry, -self.asymmetry].map(lobe);
        let phase = 0.5 * ((1.0 + self.backward) * back + (1.0 - self.backward) * forth);
        // tan(g/2).
        let half = ((1.0 - cosine) / (1.0 + cosine).max(1e-12)).sqrt();
        (1.0 + self.opposition / (1.0 + half / self.width)) * phase
    }
}

/// `H` at a cosine.
fn multiple<const N: usize>(albedo: Lanes<N>, cosine: f32) -> Lanes<N> {
    // x ln((1 + x) / x) goes to 0 with x.
    let cosine = cosine.max(1e-6);
    let log = libm::logf((1.0 + cosine) / cosine);
    Lanes::from_fn(|lane| {
        let albedo = albedo.0[lane];
        let gamma = (1.0 - albedo).max(0.0).sqrt();
        let mean = (1.0 - gamma) / (1.0 + gamma);
        let inner = mean + (0.5 - mean * cosine) * log;
        1.0 / (1.0 - albedo * cosine * inner)
    })
}

impl<const N: usize> HapkeBsdf<N> {
    /// Seen from a direction.
    pub fn view(&self, wo: Vec3) -> HapkeView<N> {
        HapkeView {
            surface: *self,
            wo,
            outward: multiple(self.albedo, wo.z.abs()),
        }
    }

    /// The share of light from a direction that isotropic grains of this albedo reflect: 1 − γ H.
    pub fn reflected(&self, wo: Vec3) -> Lanes<N> {
        let outward = multiple(self.albedo, wo.z.abs());
        Lanes::from_fn(|lane| {
            let gamma = (1.0 - self.albedo.0[lane]).max(0.0).sqrt();
            (1.0 - gamma * outward.0[lane]).clamp(0.0, 1.0)
        })
    }
}

impl<const N: usize> HapkeView<N> {
    /// The value for light from `wi`, and the density with which `wi` is sampled.
    #[inline]
    pub fn scatter(&self, wi: Vec3) -> Scattered<N> {
        if self.wo.z * wi.z <= 0.0 {
            return Scattered::NOTHING;
        }
        let [outward, inward] = [self.wo.z.abs(), wi.z.abs()];
        let HapkeBsdf { albedo, grains } = &self.surface;
        let once = grains.once(self.wo.dot(wi)) - 1.0;
        let again = self.outward * multiple(*albedo, inward);
        let factor = 1.0 / (4.0 * PI * (outward + inward));
        Scattered {
            f: *albedo * (again + Lanes::splat(once)) * factor,
            pdf: density(inward),
        }
    }

    /// Draws a direction: half of them evenly over the hemisphere, so that no weight grows without bounds near
    /// the horizon.
    #[inline]
    pub fn sample(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        let up = if lobe < 0.5 {
            warp::cosine_hemisphere(u)
        } else {
            warp::cone(u, 1.0)
        };
        if up.z <= 0.0 {
            return None;
        }
        let wi = Vec3::new(up.x, up.y, up.z.copysign(self.wo.z));
        let Scattered { f, pdf } = self.scatter(wi);
        Some(BsdfSample {
            wi,
            weight: f * (up.z / pdf),
            pdf,
            specular: false,
        })
    }
}

/// The density of directions with a cosine.
fn density(cosine: f32) -> f32 {
    0.5 * (cosine * FRAC_1_PI + 1.0 / TAU)
}

/// Rings and spokes by which reflected light is summed.
const RINGS: u32 = 96;

/// The greatest share of parallel light that such a surface reflects, and the angle of incidence at which
/// it does, rad. Models of grains are approximations: with bright ones this may be more than 1.
pub fn greatest_reflectance(albedo: f32, grains: Grains) -> (f32, f32) {
    let surface = HapkeBsdf {
        albedo: Lanes([albedo]),
        grains,
    };
    let along = |step: u32| (step as f32 + 0.5) / RINGS as f32;
    let reflected = |cosine: f32| {
        let wo = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let view = surface.view(wo);
        let mut sum = 0.0;
        for ring in 0..RINGS {
            let z = along(ring);
            let sin = (1.0 - z * z).sqrt();
            for spoke in 0..RINGS {
                let (sin_phi, cos_phi) = libm::sincosf(PI * along(spoke));
                let wi = Vec3::new(sin * cos_phi, sin * sin_phi, z);
                sum += f64::from(view.scatter(wi).f.0[0] * z);
            }
        }
        (sum * f64::from(TAU) / f64::from(RINGS * RINGS)) as f32
    };
    let angles = (0..18).map(|step| 5.0 * step as f32).chain([88.0, 89.9]);
    let found = angles.map(|degrees: f32| {
        let angle = degrees.to_radians();
        (reflected(libm::cosf(angle)), angle)
    });
    found.fold(
        (0.0, 0.0),
        |most, own| if own.0 > most.0 { own } else { most },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const ISOTROPIC: Grains = Grains {
        asymmetry: 0.0,
        backward: 0.0,
        opposition: 0.0,
        width: 1.0,
    };

    /// Chandrasekhar's H, by iteration of 1/H = √(1−w) + w/2 ∫ x H(x) / (µ + x) dx at midpoints.
    fn exact(albedo: f64, at: f64) -> f64 {
        let count = 400;
        // Denser towards 0, where H is steep.
        let nodes: Vec<(f64, f64)> = (0..count)
            .map(|i| (f64::from(i) + 0.5) / f64::from(count))
            .map(|s| (s * s, 2.0 * s / f64::from(count)))
            .collect();
        let gamma = (1.0 - albedo).sqrt();
        let next = |h: &[f64], mu: f64| {
            let terms = nodes.iter().zip(h);
            let sum: f64 = terms.map(|((x, dx), h)| x * h / (mu + x) * dx).sum();
            1.0 / (gamma + 0.5 * albedo * sum)
        };
        let mut h = vec![1.0; nodes.len()];
        for _ in 0..200 {
            h = nodes
                .iter()
                .map(|(mu, _)| 0.5 * (next(&h, *mu)))
                .zip(&h)
                .map(|(new, old)| new + 0.5 * old)
                .collect();
        }
        next(&h, at)
    }

    #[test]
    fn isotropic_grains_reflect_what_chandrasekhar_says() {
        for albedo in [0.2_f32, 0.6, 0.9, 0.99] {
            for cosine in [1.0_f32, 0.8, 0.5, 0.2] {
                let wo = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
                let albedo_of = Lanes([albedo]);
                let surface = HapkeBsdf {
                    albedo: albedo_of,
                    grains: ISOTROPIC,
                };
                let h = exact(albedo.into(), cosine.into());
                let found = f64::from(surface.view(wo).outward.0[0]);
                // Hapke's approximation is within 1 %.
                assert!(
                    (found / h - 1.0).abs() < 0.01,
                    "{albedo} {cosine}: {found} {h}"
                );
                let plane = 1.0 - (1.0 - f64::from(albedo)).sqrt() * h;
                let count = 1 << 16;
                let weights = (0..count).filter_map(|i| {
                    let [lobe, x, y, _] = crate::sampling::stream::Stream::new(3, 0, 0, i).next4();
                    surface.view(wo).sample(lobe, Vec2::new(x, y))
                });
                let sum: f64 = weights.map(|sample| f64::from(sample.weight.0[0])).sum();
                let reflected = sum / f64::from(count);
                // Two factors H, each within 1 %; the draws add a part in 500.
                assert!(
                    (reflected / plane - 1.0).abs() < 0.022,
                    "{albedo} {cosine}: {reflected} {plane}"
                );
                let told = f64::from(surface.reflected(wo).0[0]);
                assert!((told - plane).abs() < 0.01, "{told} {plane}");
            }
        }
    }

    #[test]
    fn phase_functions_are_normalised_and_the_opposition_doubles_what_comes_straight_back() {
        let grains = Grains {
            asymmetry: 0.4,
            backward: 0.3,
            ..ISOTROPIC
        };
        let steps = 20_000;
        let mean: f64 = (0..steps)
            .map(|i| grains.once(2.0 * (i as f32 + 0.5) / steps as f32 - 1.0))
            .map(f64::from)
            .sum::<f64>()
            / f64::from(steps);
        assert!((mean - 1.0).abs() < 1e-4, "{mean}");
        // A whole lobe has (1 + b) / (1 − b)² straight back.
        let lobe = Grains {
            backward: 1.0,
            ..grains
        };
        assert!((lobe.once(1.0) - 1.4 / 0.36).abs() < 1e-4);
        let shining = Grains {
            opposition: 1.0,
            width: 0.1,
            ..grains
        };
        assert!((shining.once(1.0) / grains.once(1.0) - 2.0).abs() < 1e-5);
        // Half of the effect where tan(g/2) = h.
        let cosine = libm::cosf(2.0 * libm::atanf(0.1));
        assert!((shining.once(cosine) / grains.once(cosine) - 1.5).abs() < 1e-3);
    }

    #[test]
    fn the_greatest_reflectance_of_isotropic_grains_is_near_the_horizon() {
        let (most, angle) = greatest_reflectance(0.5, ISOTROPIC);
        assert!(angle > 1.5, "{angle}");
        let cosine = f64::from(libm::cosf(angle));
        let plane = 1.0 - 0.5_f64.sqrt() * exact(0.5, cosine);
        assert!((f64::from(most) - plane).abs() < 0.02, "{most} {plane}");
    }
}
