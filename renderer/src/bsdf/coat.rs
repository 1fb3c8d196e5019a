//! The rough dielectric coat of a leaf's face.

use glam::Vec3;

use crate::bsdf::directional_albedo::DirectionalAlbedo;
use crate::bsdf::fresnel;
use crate::bsdf::ggx::Ggx;

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
        Self {
            ggx,
            eta,
            albedo: DirectionalAlbedo::new(ggx, eta),
        }
    }

    /// No coat.
    pub fn none() -> Self {
        Self::new(1.0, 1.0, 1.0)
    }

    /// Whether the coat reflects anything.
    #[inline]
    pub(super) fn shines(&self) -> bool {
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

    /// `1 − Ē`.
    pub(super) fn passed_mean(&self) -> f32 {
        1.0 - self.albedo.mean()
    }
}

/// The lobe of a coat of refractive index `eta`: its value and its sampling density from `wo`, whose
/// Λ is `lambda`; for two directions on the side +z.
#[inline]
pub(super) fn coat_lobe(ggx: Ggx, eta: f32, wo: Vec3, lambda: f32, wi: Vec3) -> (f32, f32) {
    let Some(h) = (wo + wi).try_normalize() else {
        return (0.0, 0.0);
    };
    let fresnel = fresnel::dielectric(wo.dot(h), eta);
    let shared = ggx.d(h) / (4.0 * wo.z);
    let shadowed = 1.0 / (1.0 + lambda + ggx.lambda(wi));
    (shared * shadowed * fresnel / wi.z, shared / (1.0 + lambda))
}
