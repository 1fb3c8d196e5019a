//! A face of a leaf whose inside is followed: the boundary between air and tissue.
//!
//! Light is followed as flux, so nothing is compressed by the refractive index on its way in and
//! out. `docs/src/theory/leaf-layers.md` describes it under "In pictures".

use glam::{Vec2, Vec3};

use crate::bsdf::dielectric::Dielectric;
use crate::bsdf::fresnel;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::sample::{BsdfSample, Scattered};
use crate::spectrum::Lanes;

/// Facets that light meets before it is let go whatever their shadows say.
const MOST_FACETS: usize = 16;

/// How likely light of each wavelength goes one way, of which chance follows a single one.
///
/// The way is drawn by the chances of one wavelength, and counts for each as much as it would have
/// been drawn for it, over the mean of all (the balance heuristic). So no way is missed that any of
/// them may go.
///
/// # Source
///
/// \[wilkie2014\].
#[derive(Clone, Copy, Debug)]
pub struct Likelihood<const N: usize> {
    /// Relative to the mean of all wavelengths.
    of: Lanes<N>,
    /// The wavelength by whose chances the way is drawn.
    drawn: usize,
}

impl<const N: usize> Likelihood<N> {
    /// A way of which nothing is decided yet; `number` in [0, 1) draws the wavelength.
    pub fn new(number: f32) -> Self {
        Self {
            of: Lanes::ONE,
            drawn: ((number * N as f32) as usize).min(N - 1),
        }
    }

    /// The wavelength by whose chances the way is drawn.
    #[inline]
    pub fn drawn(&self) -> usize {
        self.drawn
    }

    /// What the way counts for each wavelength.
    #[inline]
    pub fn weight(&self) -> Lanes<N> {
        self.of
    }

    /// Goes on by what has this chance for each wavelength, whatever its measure; it is more than 0
    /// for the one that is drawn.
    #[inline]
    pub fn happens(&mut self, chance: Lanes<N>) {
        let of = self.of * chance;
        let mean = of.mean();
        // Beyond the range of numbers the way counts as before.
        if mean > 0.0 && mean.is_finite() {
            self.of = of * (1.0 / mean);
        }
    }
}

/// A boundary; tissue lies on the side −z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafFace<const N: usize> {
    eta: Lanes<N>,
    alpha: f32,
}

/// What becomes of light at a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossed<const N: usize> {
    /// Direction in which light of each wavelength goes on, unit.
    pub towards: [Vec3; N],
    /// Whether it is on the other side of the face.
    pub through: bool,
    /// Density of the direction over solid angle if a sampled light could have chosen it too: one
    /// facet of a rough face sent the light into air.
    pub pdf: Option<f32>,
}

impl<const N: usize> LeafFace<N> {
    /// A face of tissue of these refractive indices; a GGX roughness of 0 is smooth.
    pub fn new(eta: Lanes<N>, alpha: f32) -> Self {
        Self { eta, alpha }
    }

    /// Whether light samples contribute nothing.
    pub fn is_smooth(&self) -> bool {
        self.alpha == 0.0
    }

    fn ggx(&self) -> Ggx {
        Ggx {
            alpha_x: self.alpha,
            alpha_y: self.alpha,
        }
    }

    /// Indices on the far side over those on the side of air (`above`) or of tissue.
    #[inline]
    fn relative(&self, above: bool) -> Lanes<N> {
        if above {
            self.eta
        } else {
            Lanes::ONE / self.eta
        }
    }

    /// Directions in which a facet of normal `h` sends light that comes `from` above, with the chance
    /// of each that it meets such a facet and is refracted or not.
    #[inline]
    fn by_facet(
        &self,
        from: &[Vec3; N],
        h: Vec3,
        relative: Lanes<N>,
        refracts: bool,
    ) -> ([Vec3; N], Lanes<N>) {
        let mut to = *from;
        let mut chance = Lanes::ZERO;
        for lane in 0..N {
            let (from, relative) = (from[lane], relative.0[lane]);
            let cosine = from.dot(h);
            let reflected = fresnel::dielectric(cosine, relative);
            chance.0[lane] = if refracts { 1.0 - reflected } else { reflected };
            to[lane] = match fresnel::refracted_cosine(cosine, relative).filter(|_| refracts) {
                Some(refracted) => h * (cosine / relative - refracted) - from / relative,
                None => 2.0 * cosine * h - from,
            };
            if !self.is_smooth() {
                chance.0[lane] *= self.ggx().g1(from) * cosine.max(0.0) / from.z;
            }
        }
        (to, chance)
    }

    /// Chance that light which a facet has sent on leaves the face.
    #[inline]
    fn leaving(&self, outward: f32, lengths: Vec3) -> f32 {
        if self.is_smooth() {
            1.0
        } else if outward > 0.0 {
            self.ggx().g1(lengths)
        } else {
            0.0
        }
    }

    /// What becomes of light that comes from `wo`, away from the face, on the same side for each
    /// wavelength; `number` gives random numbers in [0, 1).
    ///
    /// A facet, drawn from those that are visible, reflects or refracts it by Fresnel's formulae.
    /// With Smith's chance it leaves; else it meets another facet, as if it came from its mirrored
    /// direction. So nothing is lost however rough the face. Into air all wavelengths go in the
    /// direction of the one that is drawn.
    pub fn cross(
        &self,
        wo: &[Vec3; N],
        likelihood: &mut Likelihood<N>,
        mut number: impl FnMut() -> f32,
    ) -> Crossed<N> {
        let (before, drawn) = (*likelihood, likelihood.drawn);
        // All in a frame in which the light comes from above.
        let start = wo[drawn].z;
        let mut side = 1.0_f32.copysign(start);
        let mut from = wo.map(steep);
        for facet in 0..MOST_FACETS {
            let relative = self.relative(side > 0.0);
            let h = if self.is_smooth() {
                Vec3::Z
            } else {
                let point = Vec2::new(number(), number());
                self.ggx().sample_visible(from[drawn], point)
            };
            let (cosine, own) = (from[drawn].dot(h), relative.0[drawn]);
            let refracts = fresnel::refracted_cosine(cosine, own).is_some()
                && number() >= fresnel::dielectric(cosine, own);
            let (to, mut chance) = self.by_facet(&from, h, relative, refracts);
            let wants = if refracts { -1.0 } else { 1.0 };
            // Seen from the side on which it is now.
            let lengths = to.map(|to| Vec3::new(to.x, to.y, to.z.abs()).normalize());
            let is_last = self.is_smooth() || facet + 1 == MOST_FACETS;
            let leaving = |lane: usize| self.leaving(to[lane].z * wants, lengths[lane]);
            let leaves = is_last || number() < leaving(drawn);
            if !is_last {
                let part = Lanes::from_fn(leaving);
                chance *= if leaves { part } else { Lanes::ONE - part };
            }
            likelihood.happens(chance);
            if leaves {
                let now = side * wants;
                let on = lengths.map(|to| Vec3::new(to.x, to.y, now * to.z.max(1e-6)));
                let single = facet == 0 && to[drawn].z * wants > 0.0 && now > 0.0;
                let density = || {
                    let flux = self.seen_from(*wo, before).flux(on[drawn]);
                    flux.map_or(0.0, |(_, pdf)| pdf)
                };
                return Crossed {
                    towards: if now > 0.0 { [on[drawn]; N] } else { on },
                    through: now * start < 0.0,
                    pdf: (single && !self.is_smooth()).then(density),
                };
            }
            side *= wants;
            from = lengths.map(|to| Vec3::new(-to.x, -to.y, to.z.max(1e-6)));
        }
        unreachable!("the last facet lets light go")
    }

    /// The face seen by light that comes from `wo`, as a sampled light sees it.
    pub fn seen_from(&self, wo: [Vec3; N], likelihood: Likelihood<N>) -> FaceView<N> {
        FaceView {
            face: *self,
            wo,
            likelihood,
        }
    }
}

/// A direction mirrored to +z, not within the plane.
fn steep(w: Vec3) -> Vec3 {
    Vec3::new(w.x, w.y, w.z.abs().max(1e-6))
}

/// A face for one direction; light of one facet alone, to the side of air.
#[derive(Clone, Debug)]
pub struct FaceView<const N: usize> {
    face: LeafFace<N>,
    wo: [Vec3; N],
    likelihood: Likelihood<N>,
}

impl<const N: usize> FaceView<N> {
    /// The face for the wavelength that is drawn.
    fn boundary(&self) -> Dielectric {
        Dielectric {
            eta: self.face.eta.0[self.likelihood.drawn],
            alpha: self.face.alpha,
        }
    }

    /// Flux of each wavelength that one facet scatters to `wi` in air per solid angle, and the
    /// density with which [`LeafFace::cross`] draws such a direction: what a facet shadows goes on to
    /// the next.
    fn flux(&self, wi: Vec3) -> Option<(Lanes<N>, f32)> {
        let (boundary, drawn) = (self.boundary(), self.likelihood.drawn);
        let wo = self.wo[drawn];
        let own = boundary.scatter(wo, wi).0 * wi.z.abs() * boundary.flux_over_radiance(wo, wi);
        if own <= 0.0 {
            return None;
        }
        // All meet the same facet; in a frame in which the light comes from above.
        let above = wo.z > 0.0;
        let relative = self.face.relative(above);
        let (wants, scale) = if above {
            (1.0, 1.0)
        } else {
            (-1.0, relative.0[drawn])
        };
        let sum = steep(wo) + Vec3::new(wi.x, wi.y, wants * wi.z) * scale;
        let h = sum.try_normalize()?;
        let h = if h.z < 0.0 { -h } else { h };
        let from = self.wo.map(steep);
        let (to, chance) = self.face.by_facet(&from, h, relative, !above);
        let chance = Lanes::from_fn(|lane| {
            let lengths = Vec3::new(to[lane].x, to[lane].y, to[lane].z.abs()).normalize();
            chance.0[lane] * self.face.leaving(to[lane].z * wants, lengths)
        });
        if chance.0[drawn] <= 0.0 {
            return None;
        }
        let flux = chance * (own / chance.0[drawn]);
        Some((flux, (flux * self.likelihood.of).mean()))
    }

    /// What one facet scatters to `wi` in air, per projected solid angle, with its density.
    #[inline]
    pub(super) fn scatter(&self, wi: Vec3) -> Scattered<N> {
        if wi.z <= 0.0 {
            return Scattered::NOTHING;
        }
        self.flux(wi)
            .map_or(Scattered::NOTHING, |(flux, pdf)| Scattered {
                f: flux * (1.0 / wi.z),
                pdf,
            })
    }

    /// A direction by one facet, into air alone.
    pub(super) fn sample(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        let wo = self.wo[self.likelihood.drawn];
        let sample = self.boundary().sample::<N>(wo, lobe, u)?;
        let Scattered { f, .. } = self.scatter(sample.wi);
        (sample.wi.z > 0.0).then(|| BsdfSample {
            wi: sample.wi,
            weight: f * (sample.wi.z / sample.pdf),
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
        let face = LeafFace::new(Lanes([1.45]), 0.0);
        let wo = Vec3::new(0.6, 0.0, 0.8);
        let mut number = numbers(3);
        let count = 100_000;
        let mut reflected = 0;
        for _ in 0..count {
            let crossed = face.cross(&[wo], &mut Likelihood::new(0.0), &mut number);
            assert_eq!(crossed.pdf, None);
            let [towards] = crossed.towards;
            if crossed.through {
                let sine = towards.x;
                assert!((sine + 0.6 / 1.45).abs() < 1e-6, "{sine}");
            } else {
                reflected += 1;
                assert!((towards - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-6);
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
        let face = LeafFace::new(Lanes([1.45]), 0.4);
        for (wo, middle) in [
            (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.5, 0.2, 0.8)),
            (Vec3::new(0.3, 0.1, -0.9), Vec3::new(-0.4, 0.1, 0.8)),
        ] {
            let (wo, middle) = (wo.normalize(), middle.normalize());
            let view = face.seen_from([wo], Likelihood::new(0.0));
            let mut number = numbers(7);
            let count = 400_000;
            let (mut inside, mut mean) = (0, 0.0);
            for _ in 0..count {
                let crossed = face.cross(&[wo], &mut Likelihood::new(0.0), &mut number);
                let [towards] = crossed.towards;
                if let Some(pdf) = crossed.pdf
                    && towards.z > 0.0
                {
                    let scattered: Scattered<1> = view.scatter(towards);
                    assert!((scattered.pdf / pdf - 1.0).abs() < 1e-3);
                    inside += u32::from(towards.dot(middle) > 0.95);
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
