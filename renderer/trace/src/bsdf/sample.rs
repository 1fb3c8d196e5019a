//! What all BSDFs give: the value for a direction, and a direction that is drawn.

use glam::Vec3;

use crate::spectrum::Lanes;

/// A sampled direction, with the weight of light from it.
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

/// The value of a BSDF for a pair of directions, with its sampling density.
#[derive(Clone, Copy, Debug)]
pub struct Scattered<const N: usize> {
    /// `f(wo, wi)`, sr⁻¹, without the cosine; zero for specular parts.
    pub f: Lanes<N>,
    /// Density with which [`View::sample`](super::View::sample) draws the direction, sr⁻¹; zero for specular parts.
    pub pdf: f32,
}

impl<const N: usize> Scattered<N> {
    /// No scattering, and density 0.
    pub const NOTHING: Self = Self {
        f: Lanes::ZERO,
        pdf: 0.0,
    };

    /// The sample of a direction that was drawn with this density; `None` if that is 0.
    #[inline(always)]
    pub(super) fn drawn(self, wi: Vec3) -> Option<BsdfSample<N>> {
        let Self { f, pdf } = self;
        (pdf > 0.0).then(|| BsdfSample {
            wi,
            weight: f * (wi.z.abs() / pdf),
            pdf,
            specular: false,
        })
    }
}
