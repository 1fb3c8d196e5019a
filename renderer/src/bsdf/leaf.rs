//! The leaf: two faces with rough coats over a tissue with two reflectances and one transmittance.
//!
//! `docs/src/theory/leaf-bsdf.md` has the model; the letters here are its letters.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use crate::bsdf::BsdfSample;
use crate::bsdf::directional_albedo::DirectionalAlbedo;
use crate::bsdf::fresnel;
use crate::bsdf::ggx::Ggx;
use crate::sampling::warp;
use crate::spectrum::Lanes;

/// The rough dielectric coat of one face, with what is tabulated about it.
#[derive(Clone, Debug)]
pub struct Coat {
    ggx: Ggx,
    eta: f32,
    albedo: DirectionalAlbedo,
}

impl Coat {
    /// A coat of refractive index `eta` and GGX roughness across and along the main vein.
    pub fn new(eta: f32, alpha_across: f32, alpha_along: f32) -> Self {
        let ggx = Ggx {
            alpha_x: alpha_across,
            alpha_y: alpha_along,
        };
        Self {
            ggx,
            eta,
            albedo: DirectionalAlbedo::new(ggx, eta),
        }
    }

    /// What the coat's lobe reflects, by direction.
    pub fn albedo(&self) -> &DirectionalAlbedo {
        &self.albedo
    }

    /// The lobe, for two directions on the side +z.
    fn eval(&self, wo: Vec3, wi: Vec3) -> f32 {
        let Some(h) = (wo + wi).try_normalize() else {
            return 0.0;
        };
        let fresnel = fresnel::dielectric(wo.dot(h), self.eta);
        self.ggx.d(h) * self.ggx.g2(wo, wi) * fresnel / (4.0 * wo.z * wi.z)
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        (wo + wi)
            .try_normalize()
            .filter(|h| wo.dot(*h) > 0.0)
            .map_or(0.0, |h| self.ggx.visible_density(wo, h) / (4.0 * wo.dot(h)))
    }
}

/// What the tissue does with light that has passed the coats.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tissue<const N: usize> {
    /// `r` of the adaxial and the abaxial face.
    reflectance: [Lanes<N>; 2],
    /// `t` of light that enters by the adaxial and by the abaxial face.
    transmittance: [Lanes<N>; 2],
}

/// A leaf at one point.
#[derive(Clone, Debug)]
pub struct LeafBsdf<'a, const N: usize> {
    /// Adaxial and abaxial.
    coats: &'a [Coat; 2],
    tissue: Tissue<N>,
    /// `c(A, A)` and `c(B, B)`.
    reflecting: [Lanes<N>; 2],
    /// `c(A, B)`.
    through: Lanes<N>,
}

/// Number of the face that `w` lies on: 0 adaxial, 1 abaxial.
fn face(w: Vec3) -> usize {
    usize::from(w.z < 0.0)
}

fn above(w: Vec3) -> Vec3 {
    Vec3::new(w.x, w.y, w.z.abs())
}

impl<'a, const N: usize> LeafBsdf<'a, N> {
    /// From the leaf's reflectance `R` and transmittance `T` at normal incidence on the adaxial face, and the
    /// abaxial over adaxial reflectance `ratio`.
    pub fn new(
        coats: &'a [Coat; 2],
        reflectance: Lanes<N>,
        transmittance: Lanes<N>,
        ratio: Lanes<N>,
    ) -> Self {
        let normal = coats.each_ref().map(|coat| coat.albedo.normal());
        let passed_mean = coats.each_ref().map(|coat| 1.0 - coat.albedo.mean());
        let most = (passed_mean[1] / passed_mean[0]).min(1.0);
        let mut tissue = Tissue {
            reflectance: [Lanes::ZERO; 2],
            transmittance: [Lanes::ZERO; 2],
        };
        let mut through = Lanes::ZERO;
        for lane in 0..N {
            let (r, t) = (reflectance.0[lane], transmittance.0[lane]);
            let t_ab = (t / (1.0 - normal[0])).min(most);
            let r_a = ((r - normal[0]) / (1.0 - normal[0])).clamp(0.0, 1.0 - t_ab);
            let c = t_ab / passed_mean[1];
            let t_ba = (c * passed_mean[0]).min(1.0);
            let absorbed = (1.0 - ratio.0[lane] * r - t).max(0.0) / (1.0 - normal[1]);
            let r_b = (1.0 - t_ba - absorbed).clamp(0.0, 1.0 - t_ba);
            tissue.reflectance[0].0[lane] = r_a;
            tissue.reflectance[1].0[lane] = r_b;
            tissue.transmittance[0].0[lane] = t_ab;
            tissue.transmittance[1].0[lane] = t_ba;
            through.0[lane] = c;
        }
        let reflecting = [
            tissue.reflectance[0] / passed_mean[0],
            tissue.reflectance[1] / passed_mean[1],
        ];
        Self {
            coats,
            tissue,
            reflecting,
            through,
        }
    }

    /// `f(wo, wi)`, sr⁻¹.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Lanes<N> {
        if wo.z == 0.0 || wi.z == 0.0 {
            return Lanes::ZERO;
        }
        let (o, i) = (face(wo), face(wi));
        let passed =
            (1.0 - self.coats[o].albedo.at(wo)) * (1.0 - self.coats[i].albedo.at(wi)) * FRAC_1_PI;
        if o == i {
            let lobe = self.coats[o].eval(above(wo), above(wi));
            self.reflecting[o] * passed + Lanes::splat(lobe)
        } else {
            self.through * passed
        }
    }

    /// Probabilities of the coat, of tissue reflection and of transmission, as seen from `wo`.
    fn lobes(&self, wo: Vec3) -> [f32; 3] {
        let side = face(wo);
        let coat = self.coats[side].albedo.at(wo);
        let reflected = (1.0 - coat) * self.tissue.reflectance[side].mean();
        let transmitted = (1.0 - coat) * self.tissue.transmittance[side].mean();
        let total = coat + reflected + transmitted;
        if total > 0.0 {
            [coat / total, reflected / total, transmitted / total]
        } else {
            [0.0; 3]
        }
    }

    /// Density of [`LeafBsdf::sample`], sr⁻¹.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if wo.z == 0.0 || wi.z == 0.0 {
            return 0.0;
        }
        let [coat, reflected, transmitted] = self.lobes(wo);
        let cosine = wi.z.abs() * FRAC_1_PI;
        if face(wo) == face(wi) {
            coat * self.coats[face(wo)].pdf(above(wo), above(wi)) + reflected * cosine
        } else {
            transmitted * cosine
        }
    }

    /// Draws a direction in proportion to what each lobe scatters.
    pub fn sample(&self, wo: Vec3, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        if wo.z == 0.0 {
            return None;
        }
        let [coat, reflected, transmitted] = self.lobes(wo);
        let up = if lobe < coat {
            let outward = above(wo);
            let h = self.coats[face(wo)].ggx.sample_visible(outward, u);
            2.0 * outward.dot(h) * h - outward
        } else {
            warp::cosine_hemisphere(u)
        };
        if up.z <= 0.0 || reflected + transmitted + coat == 0.0 {
            return None;
        }
        let through = lobe >= coat + reflected;
        let side = 1.0_f32.copysign(wo.z);
        let wi = Vec3::new(up.x, up.y, if through { -side * up.z } else { side * up.z });
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BsdfSample {
            wi,
            weight: self.eval(wo, wi) * (wi.z.abs() / pdf),
            pdf,
            specular: false,
        })
    }

    /// Share of diffuse light that the leaf scatters, mean of the two faces.
    pub fn albedo(&self) -> Lanes<N> {
        let of_face = |side: usize| {
            let coat = self.coats[side].albedo.mean();
            (self.tissue.reflectance[side] + self.tissue.transmittance[side]) * (1.0 - coat)
                + Lanes::splat(coat)
        };
        (of_face(0) + of_face(1)) * 0.5
    }
}
