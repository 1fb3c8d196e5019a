//! Surfaces that emit on the side of their normal.

use glam::{Vec2, Vec3};

use crate::light::patch::{self, Patch};
use crate::light::tree::Emitter;
use crate::light::{LightSample, Receiver};
use crate::spectrum::{Curve, Lanes, Spectrum, WavelengthGrid, Wavelengths};

/// Patches in world space with a common radiance. A patch is a triangle, or a rectangle of two
/// triangles.
#[derive(Clone, Debug)]
pub struct AreaLight {
    radiance: Spectrum,
    patches: Box<[Patch]>,
    /// The patch that each triangle belongs to; `None` if it has no area in world space.
    patch_of: Box<[Option<u32>]>,
}

impl AreaLight {
    /// A light from world-space triangles, counter-clockwise seen from the bright side.
    pub fn new(triangles: &[[Vec3; 3]], radiance: Curve) -> Self {
        let (patches, patch_of) = patch::patches(triangles);
        Self {
            radiance: radiance.into(),
            patches: patches.into(),
            patch_of: patch_of.into(),
        }
    }

    /// Radiance curve, W m⁻² sr⁻¹ nm⁻¹.
    pub fn radiance(&self) -> &Curve {
        self.radiance.curve()
    }

    /// Evaluates its radiance at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.radiance.tabulate(grid);
    }

    /// The emitting patches.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// Number of the patch that a triangle belongs to.
    pub fn patch_of(&self, triangle: u32) -> Option<usize> {
        self.patch_of[triangle as usize].map(|patch| patch as usize)
    }

    /// Each patch as an emitter for the light tree; `mean_radiance` is that of the film's
    /// wavelengths, W m⁻² sr⁻¹ nm⁻¹.
    pub fn emitters(&self, mean_radiance: f32) -> impl Iterator<Item = Emitter> + '_ {
        self.patches
            .iter()
            .map(move |patch| patch.emitter(mean_radiance))
    }

    /// Samples a point of one patch, seen from `receiver`.
    pub fn sample<const N: usize>(
        &self,
        patch: usize,
        receiver: &Receiver,
        wavelengths: &Wavelengths<N>,
        u: Vec2,
    ) -> Option<LightSample<N>> {
        let sample = self.patches[patch].sample(receiver, u)?;
        Some(LightSample {
            wi: sample.wi,
            point: Some(sample.point),
            radiance: self.radiance.lanes(wavelengths),
            pdf: sample.pdf,
            is_point: false,
        })
    }

    /// Density over solid angle with which [`AreaLight::sample`] draws a point of that patch, seen
    /// from `receiver`.
    pub fn pdf(&self, patch: usize, receiver: &Receiver, point: Vec3) -> f32 {
        self.patches[patch].pdf(receiver, point)
    }

    /// Radiance towards `-wi` from a point of the surface with the given normal; `None` on the dark
    /// side.
    pub fn emitted<const N: usize>(
        &self,
        wi: Vec3,
        normal: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> Option<Lanes<N>> {
        (wi.dot(normal) < 0.0).then(|| self.radiance.lanes(wavelengths))
    }
}
