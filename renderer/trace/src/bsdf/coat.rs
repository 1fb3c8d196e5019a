//! The rough dielectric coat of a leaf's face.

use glam::Vec3;

use crate::bsdf::directional_albedo::DirectionalAlbedo;
use crate::bsdf::fresnel;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::leaf_shape::Passed;

/// The rough dielectric coat of one face, with its tables.
#[derive(Clone, Debug)]
pub struct Coat {
    pub(super) ggx: Ggx,
    eta: f32,
    pub(super) albedo: DirectionalAlbedo,
}

impl Coat {
    /// A coat of refractive index `eta` and GGX roughness across and along the main vein.
    pub fn new(eta: f32, alpha_across: f32, alpha_along: f32) -> Self {
        let ggx = Ggx {
            alpha_x: alpha_across,
            alpha_y: alpha_along,
        };
        let albedo = DirectionalAlbedo::new(ggx, eta);
        Self { ggx, eta, albedo }
    }

    /// No coat.
    pub fn none() -> Self {
        Self::new(1.0, 1.0, 1.0)
    }

    /// Whether the coat reflects anything.
    #[inline]
    pub fn shines(&self) -> bool {
        self.eta != 1.0
    }

    /// `E(w)`.
    #[inline]
    pub(super) fn reflected(&self, w: Vec3) -> f32 {
        if self.shines() {
            self.albedo.at(w)
        } else {
            0.0
        }
    }

    /// Its refractive index and its roughness across and along.
    pub fn numbers(&self) -> (f32, [f32; 2]) {
        (self.eta, [self.ggx.alpha_x, self.ggx.alpha_y])
    }

    /// The directional albedo of the coat's lobe.
    pub fn albedo(&self) -> &DirectionalAlbedo {
        &self.albedo
    }

    /// The lobe's value and its sampling density from `wo`, whose Λ is `lambda`; for two directions
    /// on the side +z.
    #[inline]
    pub(super) fn lobe(&self, wo: Vec3, lambda: f32, wi: Vec3) -> (f32, f32) {
        coat_lobe(self.ggx, self.eta, wo, lambda, wi)
    }

    /// What passes of light that is alike from all directions.
    #[inline]
    pub(super) fn passed(&self) -> Passed {
        self.albedo.passed()
    }

    /// `1 − Ē`.
    pub(super) fn passed_mean(&self) -> f32 {
        1.0 - self.albedo.mean()
    }
}

/// The lobe of a coat of refractive index `eta`: its value and its sampling density from `wo`, whose
/// Λ is `lambda`; for two directions on the side +z.
#[inline]
pub(super) fn coat_lobe(ggx: Ggx, eta: f32, wo: Vec3, lambda: f32, wi: Vec3) -> (f32, f32) {
    facets(ggx, wo, lambda, wi).map_or((0.0, 0.0), |met| {
        let fresnel = fresnel::dielectric(met.cosine, eta);
        (met.shape * fresnel / wi.z, met.pdf)
    })
}

/// The microfacets that reflect light from one direction into another.
pub(super) struct Facets {
    /// Cosine of the angle of incidence on them.
    pub(super) cosine: f32,
    /// `D G₂ / (4 cos θₒ)`; times Fresnel over `cos θᵢ` it is the lobe's value.
    pub(super) shape: f32,
    /// Density with which a direction is sampled by the facets that `wo` sees.
    pub(super) pdf: f32,
}

/// The facets between `wo`, whose Λ is `lambda`, and `wi`, for two directions on the side +z.
#[inline]
pub(super) fn facets(ggx: Ggx, wo: Vec3, lambda: f32, wi: Vec3) -> Option<Facets> {
    let h = (wo + wi).try_normalize()?;
    let shared = ggx.d(h) / (4.0 * wo.z);
    let shadowed = 1.0 / (1.0 + lambda + ggx.lambda(wi));
    Some(Facets {
        cosine: wo.dot(h),
        shape: shared * shadowed,
        pdf: shared / (1.0 + lambda),
    })
}
