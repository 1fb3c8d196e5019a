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
    /// `κ`: how much less light of grazing directions goes through the leaf than passes the coat.
    slope: f32,
    /// `P`, the mean of what goes on through the leaf of light that is alike from all directions.
    through_mean: f32,
}

impl Coat {
    /// A coat of refractive index `eta` and GGX roughness across and along the main vein.
    pub fn new(eta: f32, alpha_across: f32, alpha_along: f32) -> Self {
        let ggx = Ggx {
            alpha_x: alpha_across,
            alpha_y: alpha_along,
        };
        let albedo = DirectionalAlbedo::new(ggx, eta);
        Self {
            ggx,
            eta,
            slope: 0.0,
            through_mean: 1.0 - albedo.mean(),
            albedo,
        }
    }

    /// The coats of a measured leaf, through which as much light goes either way at normal incidence.
    ///
    /// What goes through is reciprocal only if light from above is to light from below as `(1 − E⊥) /
    /// P` of the upper coat is to that of the lower. The coat of which this is less lets less light of
    /// grazing directions through, and sends that back.
    pub fn pair(mut coats: [Self; 2]) -> [Self; 2] {
        let upright = coats.each_ref().map(|coat| 1.0 - coat.albedo.normal());
        let ratio = [0, 1].map(|side| upright[side] / coats[side].passed_mean());
        if ratio[0] == ratio[1] {
            return coats;
        }
        let side = usize::from(ratio[1] < ratio[0]);
        let coat = &mut coats[side];
        let passed = coat.passed_mean();
        let most = passed - coat.albedo.passed_steeply();
        coat.slope = ((passed - upright[side] / ratio[1 - side]) / most).clamp(0.0, 1.0);
        coat.through_mean = passed - coat.slope * most;
        coats
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

    /// Fraction of light of this cosine that the tissue would let through and sends back, `κ (1 − µ)`.
    #[inline]
    pub(super) fn turned(&self, mu: f32) -> f32 {
        self.slope * (1.0 - mu)
    }

    /// `P`.
    pub(super) fn through_mean(&self) -> f32 {
        self.through_mean
    }

    /// One over the mean of what is turned back, 0 if nothing is.
    pub(super) fn over_turned_mean(&self) -> f32 {
        let mean = self.passed_mean() - self.through_mean;
        if mean > 0.0 { 1.0 / mean } else { 0.0 }
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
