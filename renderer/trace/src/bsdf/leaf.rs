//! The leaf: two faces with rough coats over a tissue with two reflectances and one transmittance.
//!
//! `docs/src/theory/leaf-bsdf.md` describes the model; the symbols are the same.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

pub use crate::bsdf::coat::Coat;
pub use crate::bsdf::leaf_shape::LeafShape;
use crate::bsdf::leaf_shape::slant;
use crate::bsdf::leaf_tissue::TissueView;
pub use crate::bsdf::leaf_tissue::{Tissue, usual_abaxial_ratio};
use crate::bsdf::sample::{BsdfSample, Scattered};
use crate::sampling::warp;
use crate::spectrum::Lanes;

/// A leaf at one point.
#[derive(Clone, Debug)]
pub struct LeafBsdf<'a, const N: usize> {
    /// Adaxial and abaxial.
    coats: &'a [Coat; 2],
    shape: &'a LeafShape,
    tissue: Tissue<N>,
}

/// A leaf at one point, seen from one direction, with everything that does not depend on the
/// direction of the light.
#[derive(Clone, Debug)]
pub struct LeafView<'a, const N: usize> {
    /// Coats of the side of the view, and of the other.
    coats: [&'a Coat; 2],
    wo: Vec3,
    /// Λ of the coat for the view.
    lambda: f32,
    /// Without the factor for the coat on the side of `wi`.
    tissue: TissueView<N>,
    /// Probabilities of the coat, of tissue reflection and of transmission.
    lobes: [f32; 3],
}

fn above(w: Vec3) -> Vec3 {
    Vec3::new(w.x, w.y, w.z.abs())
}

impl<'a, const N: usize> LeafBsdf<'a, N> {
    /// Tissue under the adaxial and the abaxial coat for which it was made.
    #[inline]
    pub fn new(coats: &'a [Coat; 2], shape: &'a LeafShape, tissue: Tissue<N>) -> Self {
        Self {
            coats,
            shape,
            tissue,
        }
    }

    /// How what it scatters depends on angle.
    pub(super) fn shape(&self) -> &'a LeafShape {
        self.shape
    }

    /// Its tissue.
    pub(super) fn tissue(&self) -> &Tissue<N> {
        &self.tissue
    }

    /// The leaf seen from `wo`; `None` from within its plane.
    #[inline]
    pub fn seen_from(&self, wo: Vec3) -> Option<LeafView<'a, N>> {
        (wo.z != 0.0).then(|| self.view(wo))
    }

    /// The leaf seen from `wo`, which does not lie in its plane.
    #[inline]
    pub(super) fn view(&self, wo: Vec3) -> LeafView<'a, N> {
        let side = usize::from(wo.z < 0.0);
        let coats = [&self.coats[side], &self.coats[1 - side]];
        let [coat, _] = coats;
        let albedo = coat.reflected(wo);
        let passed = 1.0 - albedo;
        let means = coats.map(Coat::passed);
        let x = slant(wo.z.abs());
        let tissue = self.tissue.seen(self.shape, side, means.each_ref(), x, 1.0);
        let [reflected, transmitted] = tissue.shares.map(|share| passed * share.mean());
        let total = albedo + reflected + transmitted;
        let share = if total > 0.0 { 1.0 / total } else { 0.0 };
        let factor = Lanes::splat(passed * FRAC_1_PI);
        LeafView {
            coats,
            wo,
            lambda: if coat.shines() {
                coat.ggx.lambda(above(wo))
            } else {
                0.0
            },
            tissue: tissue.scaled(factor, factor),
            lobes: [albedo, reflected, transmitted].map(|lobe| lobe * share),
        }
    }

    /// `f(wo, wi)`, sr⁻¹.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Lanes<N> {
        let view = self.seen_from(wo);
        view.map_or(Lanes::ZERO, |view| view.scatter(wi).f)
    }

    /// Density of [`LeafBsdf::sample`], sr⁻¹.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.seen_from(wo).map_or(0.0, |view| view.scatter(wi).pdf)
    }

    /// The adaxial and the abaxial coat.
    pub fn coats(&self) -> &'a [Coat; 2] {
        self.coats
    }

    /// Fractions of light along the normal of a face (0 adaxial, 1 abaxial) that the tissue sends
    /// back and lets through, once it has passed the coat.
    pub fn below_coat(&self, face: usize) -> [Lanes<N>; 2] {
        let coats = [&self.coats[face], &self.coats[1 - face]].map(Coat::passed);
        let x = slant(1.0);
        let seen = self.tissue.seen(self.shape, face, coats.each_ref(), x, 1.0);
        seen.shares
    }

    /// Fractions of light along the normal of a face that the leaf, its coats included, sends back and lets
    /// through.
    pub fn along_normal(&self, face: usize) -> [Lanes<N>; 2] {
        let coat = self.coats[face].albedo.normal();
        let [back, through] = self.below_coat(face).map(|part| part * (1.0 - coat));
        [back + Lanes::splat(coat), through]
    }

    /// Samples a direction; lobes are chosen in proportion to the light that they scatter.
    pub fn sample(&self, wo: Vec3, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        self.seen_from(wo)?.sample(lobe, u)
    }

    /// Share of the diffuse light on the face that `wo` sees which the leaf scatters, to either
    /// side.
    pub fn albedo(&self, wo: Vec3) -> Lanes<N> {
        let side = usize::from(wo.z < 0.0);
        let coat = &self.coats[side];
        let passed = coat.passed();
        self.tissue.diffuse(self.shape, side, &passed) * passed.mean
            + Lanes::splat(coat.albedo.mean())
    }
}

impl<const N: usize> LeafView<'_, N> {
    /// The BSDF's value for light from `wi`, and the density with which `wi` is sampled.
    #[inline]
    pub fn scatter(&self, wi: Vec3) -> Scattered<N> {
        if wi.z == 0.0 {
            return Scattered::NOTHING;
        }
        let [coat, other] = self.coats;
        let [shining, reflected, transmitted] = self.lobes;
        let mu = wi.z.abs();
        let cosine = mu * FRAC_1_PI;
        let (x, across) = (slant(mu), -self.wo.truncate().dot(wi.truncate()));
        if self.wo.z * wi.z < 0.0 {
            return Scattered {
                f: self.tissue.let_through(x, across) * (1.0 - other.reflected(wi)),
                pdf: transmitted * cosine,
            };
        }
        let diffuse = Scattered {
            f: self.tissue.sent_back(x, across) * (1.0 - coat.reflected(wi)),
            pdf: reflected * cosine,
        };
        if !coat.shines() {
            return diffuse;
        }
        let (lobe, pdf) = coat.lobe(above(self.wo), self.lambda, above(wi));
        Scattered {
            f: diffuse.f + Lanes::splat(lobe),
            pdf: diffuse.pdf + shining * pdf,
        }
    }

    /// Samples a direction; lobes are chosen in proportion to the light that they scatter.
    #[inline]
    pub fn sample(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        let [coat, reflected, transmitted] = self.lobes;
        let up = if lobe < coat {
            let outward = above(self.wo);
            let h = self.coats[0].ggx.sample_visible(outward, u);
            2.0 * outward.dot(h) * h - outward
        } else {
            warp::cosine_hemisphere(u)
        };
        if up.z <= 0.0 || reflected + transmitted + coat == 0.0 {
            return None;
        }
        let through = lobe >= coat + reflected;
        let side = 1.0_f32.copysign(self.wo.z);
        let wi = Vec3::new(up.x, up.y, if through { -side * up.z } else { side * up.z });
        self.scatter(wi).drawn(wi)
    }
}
