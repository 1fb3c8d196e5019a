//! How light is scattered at a point of a surface.
//!
//! - **In**: directions `wo`, `wi` in the local frame, unit, away from the surface, +z the shading
//!   normal on the adaxial (outer) side, +y along ∂p/∂v.
//! - **Out**: `f` without the cosine, sr⁻¹, one value per lane; densities over solid angle.
//! - **Always true**: energy is not created; all BSDFs except the dielectric are reciprocal; a
//!   density never depends on wavelength.
//!
//! ```
//! use glam::{Vec2, Vec3};
//! use trace::bsdf::Bsdf;
//! use trace::spectrum::Lanes;
//!
//! // Grey paper at four wavelengths, seen from 60° off its normal.
//! let paper: Bsdf<'_, 4> = Bsdf::Diffuse(Lanes::splat(0.6));
//! let wo = Vec3::new(0.75_f32.sqrt(), 0.0, 0.5);
//! let sample = paper.sample(wo, 0.5, Vec2::new(0.3, 0.8)).expect("it is seen from above");
//! assert!((paper.pdf(wo, sample.wi) - sample.pdf).abs() < 1e-6);
//! // f · |cos| / pdf is what the path goes on with.
//! let weight = paper.eval(wo, sample.wi) * (sample.wi.z / sample.pdf);
//! assert!((weight.mean() - 0.6).abs() < 1e-5);
//! ```

use glam::{Vec2, Vec3};

use crate::spectrum::Lanes;

pub mod coat;
pub mod coat_table;
pub mod dielectric;
pub mod diffuse;
pub mod directional_albedo;
pub mod dust;
pub mod fluorescence;
pub mod fresnel;
pub mod ggx;
pub mod hapke;
mod known;
pub mod leaf;
pub mod leaf_face;
pub mod leaf_shape;
pub mod leaf_tissue;
pub mod metallic_roughness;
pub mod relief;
pub mod sample;

use self::dielectric::Dielectric;
use self::diffuse::DiffuseView;
use self::fluorescence::FluorescenceView;
use self::hapke::{HapkeBsdf, HapkeView};
use self::leaf::{LeafBsdf, LeafView};
use self::leaf_face::FaceView;
use self::metallic_roughness::{MetallicRoughness, MetallicView};
use self::relief::{ReliefBsdf, ReliefFace, ReliefView};
pub use self::sample::{BsdfSample, Scattered};

/// The ways of scattering, with parameters taken from the material at a hit.
#[derive(Clone, Debug)]
pub enum Bsdf<'a, const N: usize> {
    /// Lambertian reflection on both sides.
    Diffuse(Lanes<N>),
    /// The boundary of a transparent medium.
    Dielectric(Dielectric),
    /// A leaf.
    Leaf(LeafBsdf<'a, N>),
    /// A leaf with a relief.
    Relief(ReliefBsdf<'a, N>),
    /// A surface between paint and metal.
    Metallic(MetallicRoughness<'a, N>),
    /// A surface of grains.
    Hapke(HapkeBsdf<N>),
}

/// A [`Bsdf`] for one direction `wo`: everything that depends on `wo` alone is computed once.
#[derive(Clone, Debug)]
pub enum View<'a, const N: usize> {
    /// Lambertian reflection on both sides.
    Diffuse(DiffuseView<N>),
    /// The boundary of a transparent medium.
    Dielectric {
        /// The outgoing direction, local.
        wo: Vec3,
        /// The boundary.
        dielectric: Dielectric,
    },
    /// A leaf.
    Leaf(LeafView<'a, N>),
    /// A leaf with a relief.
    Relief(ReliefView<'a, N>),
    /// A surface between paint and metal.
    Metallic(MetallicView<'a, N>),
    /// A surface of grains.
    Hapke(HapkeView<N>),
    /// A leaf that emits what light of other wavelengths excites.
    Fluorescence(FluorescenceView<'a>),
    /// A face of a leaf whose inside is followed.
    Face(&'a FaceView<N>),
}

impl<const N: usize> View<'_, N> {
    /// The BSDF's value for light from `wi`, and the density with which `wi` is sampled.
    #[inline]
    pub fn scatter(&self, wi: Vec3) -> Scattered<N> {
        match self {
            Self::Diffuse(surface) => surface.scatter(wi),
            Self::Dielectric { wo, dielectric } => {
                let (f, pdf) = dielectric.scatter(*wo, wi);
                let f = Lanes::splat(f);
                Scattered { f, pdf }
            }
            Self::Leaf(leaf) => leaf.scatter(wi),
            Self::Relief(relief) => relief.scatter(wi),
            Self::Metallic(surface) => surface.scatter(wi),
            Self::Hapke(surface) => surface.scatter(wi),
            Self::Fluorescence(leaf) => leaf.scatter(wi),
            Self::Face(face) => face.scatter(wi),
        }
    }

    /// Draws a direction; `lobe` chooses the lobe, `u` the direction in it.
    #[inline]
    pub fn sample(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        match self {
            Self::Diffuse(surface) => surface.sample(u),
            Self::Dielectric { wo, dielectric } => dielectric.sample(*wo, lobe, u),
            Self::Leaf(leaf) => leaf.sample(lobe, u),
            Self::Relief(relief) => relief.sample(lobe, u),
            Self::Metallic(surface) => surface.sample(lobe, u),
            Self::Hapke(surface) => surface.sample(lobe, u),
            Self::Fluorescence(leaf) => leaf.sample(u),
            Self::Face(face) => face.sample(lobe, u),
        }
    }
}

impl<'a, const N: usize> Bsdf<'a, N> {
    /// The surface seen from `wo`; `None` if `wo` lies in its plane.
    #[inline]
    pub fn seen_from(&self, wo: Vec3) -> Option<View<'a, N>> {
        match self {
            _ if wo.z == 0.0 => None,
            Self::Diffuse(reflectance) => Some(View::Diffuse(DiffuseView {
                reflectance: *reflectance,
                wo,
            })),
            Self::Dielectric(dielectric) => Some(View::Dielectric {
                wo,
                dielectric: *dielectric,
            }),
            Self::Leaf(leaf) => Some(View::Leaf(leaf.view(wo))),
            Self::Relief(relief) => relief.seen_from(wo).map(View::Relief),
            Self::Metallic(surface) => surface.seen_from(wo).map(View::Metallic),
            Self::Hapke(surface) => Some(View::Hapke(surface.view(wo))),
        }
    }

    /// The same surface with the relief of its faces, on which grains of dust have these albedos; a
    /// surface that is no leaf has none.
    pub fn with_relief(self, faces: [ReliefFace<'a>; 2], grains: Lanes<N>) -> Self {
        match self {
            Self::Leaf(leaf) => Self::Relief(ReliefBsdf {
                leaf,
                faces,
                grains,
            }),
            Self::Diffuse(_)
            | Self::Dielectric(_)
            | Self::Relief(_)
            | Self::Metallic(_)
            | Self::Hapke(_) => self,
        }
    }

    /// `f(wo, wi)`, sr⁻¹, without the cosine; zero for specular parts.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Lanes<N> {
        let view = self.seen_from(wo);
        view.map_or(Lanes::ZERO, |view| view.scatter(wi).f)
    }

    /// Density with which [`Bsdf::sample`] draws `wi`, sr⁻¹; zero for specular parts.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.seen_from(wo).map_or(0.0, |view| view.scatter(wi).pdf)
    }

    /// Draws a direction; `lobe` chooses the lobe, `u` the direction in it.
    pub fn sample(&self, wo: Vec3, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        self.seen_from(wo)?.sample(lobe, u)
    }

    /// Factor on the weight of a sample where flux is followed from `wo` to `wi` instead of radiance
    /// from `wi` to `wo`; 1 but for light that enters or leaves a transparent medium.
    pub fn flux_over_radiance(&self, wo: Vec3, wi: Vec3) -> f32 {
        match self {
            Self::Diffuse(_)
            | Self::Leaf(_)
            | Self::Relief(_)
            | Self::Metallic(_)
            | Self::Hapke(_) => 1.0,
            Self::Dielectric(dielectric) => dielectric.flux_over_radiance(wo, wi),
        }
    }

    /// Whether the BSDF is specular only, so that light samples contribute nothing.
    pub fn is_specular(&self) -> bool {
        match self {
            Self::Diffuse(_)
            | Self::Leaf(_)
            | Self::Relief(_)
            | Self::Metallic(_)
            | Self::Hapke(_) => false,
            Self::Dielectric(dielectric) => dielectric.is_smooth(),
        }
    }

    /// Share of diffuse light on the face that `wo` sees which the surface scatters, to either
    /// side: in [0, 1].
    pub fn albedo(&self, wo: Vec3) -> Lanes<N> {
        match self {
            Self::Diffuse(reflectance) => *reflectance,
            Self::Dielectric(_) => Lanes::ONE,
            Self::Leaf(leaf) => leaf.albedo(wo),
            Self::Relief(relief) => relief.albedo(wo),
            Self::Metallic(surface) => surface.albedo(),
            Self::Hapke(surface) => surface.reflected(wo),
        }
    }

    /// The normal of the face that `wo` sees, on its side.
    pub fn normal(&self, wo: Vec3) -> Vec3 {
        match self {
            Self::Diffuse(_) | Self::Dielectric(_) | Self::Leaf(_) | Self::Hapke(_) => {
                Vec3::new(0.0, 0.0, 1.0_f32.copysign(wo.z))
            }
            Self::Relief(relief) => relief.normal(wo),
            Self::Metallic(surface) => surface.normal(wo),
        }
    }
}
