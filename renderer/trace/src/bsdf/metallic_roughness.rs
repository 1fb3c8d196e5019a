//! A surface between paint and metal, as glTF 2.0 means it: a diffuse body below a rough clear coat,
//! mixed with a metal that is as rough.
//!
//! `docs/src/theory/leaf-bsdf.md` describes it under "Between paint and metal". Both sides are alike. As
//! on a [relief](super::relief), the mesh's shading normal alone decides on which side a direction lies.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::coat::facets;
use super::coat_table::LocalCoat;
use super::fresnel;
use super::relief::{Tilt, given_back, lowered, normal_of};
use super::sample::{BsdfSample, Scattered};
use crate::sampling::warp;
use crate::spectrum::Lanes;

/// The surface at one point.
#[derive(Clone, Debug)]
pub struct MetallicRoughness<'a, const N: usize> {
    /// Reflectance of the body below its coat, and of the metal at normal incidence.
    pub colour: Lanes<N>,
    /// Fraction of metal.
    pub metallic: f32,
    /// The coat of the body.
    pub coat: LocalCoat<'a>,
    /// A coat of the same roughness that reflects all light.
    pub mirror: LocalCoat<'a>,
    /// ∂z/∂x and ∂z/∂y of its relief, z along the shading normal.
    pub slope: Vec2,
}

/// The same, seen from one direction.
#[derive(Clone, Debug)]
pub struct MetallicView<'a, const N: usize> {
    surface: MetallicRoughness<'a, N>,
    wo: Vec3,
    /// `wo` in the frame of the relief, mirrored to +z.
    outward: Vec3,
    /// Frame of the relief in the mesh's shading frame.
    frame: Tilt,
    lambda: f32,
    /// `f` of the body, and of light that leaves the metal after several reflections, without the
    /// factors for `wi`.
    body: Lanes<N>,
    again: Lanes<N>,
    /// Probability that a microfacet sends the light on at once.
    shining: f32,
}

/// Reflectance of a metal at a cosine, by its reflectance at normal incidence (Schlick).
#[inline]
fn metal<const N: usize>(colour: Lanes<N>, cosine: f32) -> Lanes<N> {
    let rest = 1.0 - cosine;
    let squared = rest * rest;
    colour + (Lanes::ONE - colour) * (squared * squared * rest)
}

/// Mean of [`metal`] over diffuse light.
fn metal_mean<const N: usize>(colour: Lanes<N>) -> Lanes<N> {
    colour + (Lanes::ONE - colour) * (1.0 / 21.0)
}

/// Fraction of the light that does not leave facets of a metal at once which does so later, if all
/// of it does where nothing is absorbed.
fn leaving_later<const N: usize>(colour: Lanes<N>, mirror: &LocalCoat<'_>) -> Lanes<N> {
    let mean = metal_mean(colour);
    let held = mirror.passed().mean;
    mean * mean * (1.0 - held) / (Lanes::ONE - mean * held)
}

impl<'a, const N: usize> MetallicRoughness<'a, N> {
    fn tilt(&self, wo: Vec3) -> Tilt {
        Tilt::to(normal_of(lowered(self.slope, wo)))
    }

    /// The normal of its relief, on the side that `wo` sees.
    pub fn normal(&self, wo: Vec3) -> Vec3 {
        self.tilt(wo).normal * 1.0_f32.copysign(wo.z)
    }

    /// Fraction of diffuse light that it reflects.
    pub fn albedo(&self) -> Lanes<N> {
        let [passed, held] = [&self.coat, &self.mirror].map(|coat| coat.passed().mean);
        let body = self.colour * passed + Lanes::splat(1.0 - passed);
        let at_once = metal_mean(self.colour) * (1.0 - held);
        let metal = at_once + leaving_later(self.colour, &self.mirror) * held;
        body * (1.0 - self.metallic) + metal * self.metallic
    }

    /// The surface seen from `wo`; `None` from within its plane.
    pub fn seen_from(&self, wo: Vec3) -> Option<MetallicView<'a, N>> {
        if wo.z == 0.0 {
            return None;
        }
        let frame = self.tilt(wo);
        let outward = frame.to_local(wo);
        let outward = Vec3::new(outward.x, outward.y, outward.z.abs());
        let Self {
            colour, metallic, ..
        } = *self;
        let [coat, mirror] = [&self.coat, &self.mirror].map(|coat| coat.reflected(outward.z));
        let body = colour * ((1.0 - metallic) * (1.0 - coat));
        let again = leaving_later(colour, &self.mirror) * (metallic * (1.0 - mirror));
        let shining =
            (1.0 - metallic) * coat + metallic * mirror * metal(colour, outward.z.min(1.0)).mean();
        let total = shining + (body + again).mean();
        let factor = given_back(frame.normal.z) * FRAC_1_PI;
        Some(MetallicView {
            lambda: self.coat.ggx.lambda(outward),
            body: body * (factor / self.coat.passed().mean),
            again: again * (factor / self.mirror.passed().mean),
            shining: if total > 0.0 { shining / total } else { 0.0 },
            surface: self.clone(),
            wo,
            outward,
            frame,
        })
    }
}

impl<const N: usize> MetallicView<'_, N> {
    /// The value for light from `wi`, cosine to the mesh's normal left out, and the density with
    /// which `wi` is sampled.
    pub fn scatter(&self, wi: Vec3) -> Scattered<N> {
        let local = self.frame.to_local(wi);
        // The other side, or in the relief's own shadow.
        if self.wo.z * wi.z <= 0.0 || local.z * wi.z <= 0.0 {
            return Scattered::NOTHING;
        }
        let MetallicRoughness {
            colour,
            metallic,
            coat,
            mirror,
            ..
        } = &self.surface;
        let mu = local.z.abs();
        let tilted = mu / wi.z.abs();
        let rest =
            self.body * (1.0 - coat.reflected(mu)) + self.again * (1.0 - mirror.reflected(mu));
        let diffuse = Scattered {
            f: rest * tilted,
            pdf: (1.0 - self.shining) * mu * FRAC_1_PI,
        };
        let inward = Vec3::new(local.x, local.y, mu);
        let Some(met) = facets(coat.ggx, self.outward, self.lambda, inward) else {
            return diffuse;
        };
        let reflected = Lanes::splat((1.0 - metallic) * fresnel::dielectric(met.cosine, coat.eta))
            + metal(*colour, met.cosine) * *metallic;
        Scattered {
            f: diffuse.f + reflected * (met.shape / mu * tilted),
            pdf: diffuse.pdf + self.shining * met.pdf,
        }
    }

    /// Samples a direction; `None` too where the direction would leave by the other side.
    pub fn sample(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        let up = if lobe < self.shining {
            let h = self.surface.coat.ggx.sample_visible(self.outward, u);
            2.0 * self.outward.dot(h) * h - self.outward
        } else {
            warp::cosine_hemisphere(u)
        };
        if up.z <= 0.0 {
            return None;
        }
        let wi = self
            .frame
            .to_mesh(Vec3::new(up.x, up.y, up.z.copysign(self.wo.z)));
        self.scatter(wi).drawn(wi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::coat_table::{Bloom, CoatTable};
    use std::sync::Arc;

    struct Made {
        tables: [Arc<CoatTable>; 2],
        bare: [Bloom; 2],
    }

    fn made() -> Made {
        let tables = [1.5, f32::INFINITY].map(CoatTable::of);
        let bare = tables.each_ref().map(|table| Bloom::new(0.0, table));
        Made { tables, bare }
    }

    impl Made {
        fn surface(&self, colour: f32, metallic: f32, alpha: f32) -> MetallicRoughness<'_, 1> {
            let [coat, mirror] = [1.5, f32::INFINITY];
            let of = |i: usize, eta| self.tables[i].coat(eta, [alpha; 2], &self.bare[i]);
            MetallicRoughness {
                colour: Lanes::splat(colour),
                metallic,
                coat: of(0, coat),
                mirror: of(1, mirror),
                slope: Vec2::ZERO,
            }
        }
    }

    fn direction(cosine: f32, azimuth: f32) -> Vec3 {
        let sin = (1.0 - cosine * cosine).sqrt();
        Vec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cosine)
    }

    /// Fraction of light that is reflected: the mean of the weights of samples over a lattice.
    fn reflected(surface: &MetallicRoughness<'_, 1>, wo: Vec3) -> f32 {
        let view = surface.seen_from(wo).expect("it is not in the plane");
        let count = 1 << 16;
        let mut sum = 0.0_f64;
        for i in 0..count {
            let along = |step: f64| ((f64::from(i) + 0.5) * step).fract() as f32;
            let (lobe, u) = (
                along(0.819_172_5),
                Vec2::new(along(0.671_043_6), along(0.549_700_5)),
            );
            sum += view
                .sample(lobe, u)
                .map_or(0.0, |sample| f64::from(sample.weight.0[0]));
        }
        (sum / f64::from(count)) as f32
    }

    #[test]
    fn white_paint_and_white_metal_send_back_all_light() {
        let made = made();
        for metallic in [0.0, 0.4, 1.0] {
            for alpha in [0.05, 0.3, 1.0] {
                for cosine in [1.0, 0.6, 0.2, -0.5] {
                    let surface = made.surface(1.0, metallic, alpha);
                    let found = reflected(&surface, direction(cosine, 0.7));
                    // The table of the coats is linear between its nodes.
                    assert!(
                        (found - 1.0).abs() < 0.01,
                        "{found}: metal {metallic}, roughness {alpha}, cosine {cosine}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_smooth_metal_reflects_its_colour_and_a_smooth_coat_four_percent() {
        let made = made();
        for (colour, metallic, expected) in [
            (0.6, 1.0, 0.6),
            (0.0, 0.0, 0.04),
            (0.6, 0.25, 0.25 * 0.6 + 0.75 * (0.04 + 0.96 * 0.6)),
        ] {
            let found = reflected(&made.surface(colour, metallic, 0.02), Vec3::Z);
            assert!((found - expected).abs() < 2e-3, "{found}, not {expected}");
        }
    }

    #[test]
    fn it_is_reciprocal_and_keeps_to_the_side_of_the_view() {
        let made = made();
        for metallic in [0.0, 0.5, 1.0] {
            let surface = made.surface(0.7, metallic, 0.4);
            let (a, b) = (direction(0.8, 0.3), direction(0.25, 2.0));
            let f = |wo: Vec3, wi| surface.seen_from(wo).expect("out of plane").scatter(wi).f.0[0];
            assert!((f(a, b) - f(b, a)).abs() < 1e-5 * f(a, b), "{metallic}");
            assert!((f(-a, -b) - f(a, b)).abs() < 1e-5 * f(a, b), "{metallic}");
            assert_eq!(f(a, -b), 0.0);
        }
    }

    #[test]
    fn a_tilted_surface_sends_back_less_than_comes_in_and_shines_about_its_own_normal() {
        let made = made();
        for metallic in [0.0, 1.0] {
            for cosine in [1.0, 0.5, 0.1] {
                let mut surface = made.surface(1.0, metallic, 0.3);
                surface.slope = Vec2::new(0.8, -0.3);
                let found = reflected(&surface, direction(cosine, 2.9));
                assert!(found < 1.005 && found > 0.6, "{found}: {metallic} {cosine}");
            }
        }
        let mut surface = made.surface(1.0, 1.0, 0.05);
        surface.slope = Vec2::new(-0.2, 0.0);
        // The mirror image of the view at the normal (0.2, 0, 1).
        let normal = Vec3::new(0.2, 0.0, 1.0).normalize();
        let wi = 2.0 * normal.z * normal - Vec3::Z;
        let view = surface.seen_from(Vec3::Z).expect("from above");
        let [there, beside] = [wi, direction(wi.z, 1.0)].map(|wi| view.scatter(wi).f.0[0]);
        assert!(there > 50.0 * beside, "{there} {beside}");
    }
}
