//! How light is scattered at a point of a surface.
//!
//! - **In**: directions `wo`, `wi` in the local frame, unit, away from the surface, +z the shading normal on the
//!   adaxial (outer) side, +y along ∂p/∂v.
//! - **Out**: `f` without the cosine, sr⁻¹, a value a lane; densities over solid angle.
//! - **Always true**: energy is not created; all but the dielectric are reciprocal; a density never depends
//!   on wavelength.

use glam::{Vec2, Vec3};

use crate::spectrum::Lanes;

pub mod dielectric;
pub mod directional_albedo;
pub mod fresnel;
pub mod ggx;
pub mod leaf;

use crate::sampling::warp;
use dielectric::Dielectric;
use leaf::LeafBsdf;

/// A direction that was drawn, and what light from it is multiplied by.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample<const N: usize> {
    /// Direction of the light, local.
    pub wi: Vec3,
    /// `f · |cos| / pdf`.
    pub weight: Lanes<N>,
    /// Density over solid angle; meaningless for a mirror direction.
    pub pdf: f32,
    /// Whether the direction is one of finitely many (no light sample can match it).
    pub specular: bool,
}

/// The ways of scattering, with parameters taken from the material at a hit.
#[derive(Clone, Debug)]
pub enum Bsdf<'a, const N: usize> {
    /// Lambertian reflection on both sides.
    Diffuse(Lanes<N>),
    /// The boundary of a transparent medium.
    Dielectric(Dielectric),
    /// A leaf.
    Leaf(LeafBsdf<'a, N>),
}

impl<const N: usize> Bsdf<'_, N> {
    /// `f(wo, wi)`, sr⁻¹, without the cosine; zero for specular parts.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Lanes<N> {
        match self {
            Self::Diffuse(reflectance) => {
                if wo.z * wi.z > 0.0 {
                    *reflectance * std::f32::consts::FRAC_1_PI
                } else {
                    Lanes::ZERO
                }
            }
            Self::Dielectric(dielectric) => Lanes::splat(dielectric.eval(wo, wi)),
            Self::Leaf(leaf) => leaf.eval(wo, wi),
        }
    }

    /// Density with which [`Bsdf::sample`] draws `wi`, sr⁻¹; zero for specular parts.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        match self {
            Self::Diffuse(_) => {
                if wo.z * wi.z > 0.0 {
                    wi.z.abs() * std::f32::consts::FRAC_1_PI
                } else {
                    0.0
                }
            }
            Self::Dielectric(dielectric) => dielectric.pdf(wo, wi),
            Self::Leaf(leaf) => leaf.pdf(wo, wi),
        }
    }

    /// Draws a direction; `lobe` chooses the lobe, `u` the direction in it.
    pub fn sample(&self, wo: Vec3, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        match self {
            Self::Diffuse(reflectance) => {
                let up = warp::cosine_hemisphere(u);
                let wi = Vec3::new(up.x, up.y, up.z.copysign(wo.z));
                (up.z > 0.0 && wo.z != 0.0).then_some(BsdfSample {
                    wi,
                    weight: *reflectance,
                    pdf: up.z * std::f32::consts::FRAC_1_PI,
                    specular: false,
                })
            }
            Self::Dielectric(dielectric) => {
                dielectric.sample(wo, lobe, u).map(|sample| BsdfSample {
                    wi: sample.wi,
                    weight: Lanes::splat(sample.weight),
                    pdf: sample.pdf,
                    specular: sample.specular,
                })
            }
            Self::Leaf(leaf) => leaf.sample(wo, lobe, u),
        }
    }

    /// Whether light samples are wasted on it.
    pub fn is_specular(&self) -> bool {
        match self {
            Self::Diffuse(_) | Self::Leaf(_) => false,
            Self::Dielectric(dielectric) => dielectric.is_smooth(),
        }
    }

    /// Share of light that the surface scatters, whatever the direction: in [0, 1], free of the view.
    pub fn albedo(&self) -> Lanes<N> {
        match self {
            Self::Diffuse(reflectance) => *reflectance,
            Self::Dielectric(_) => Lanes::ONE,
            Self::Leaf(leaf) => leaf.albedo(),
        }
    }
}
