//! What the legs of a path share, and what a leg remembers.

use crate::integrator::effort::Effort;
use crate::light::Receiver;
use crate::light::selection::LightSelection;
use crate::material::Material;
use crate::material::leaf::LeafMaterial;
use crate::spectrum::{Lanes, Wavelengths};
use crate::walk;
use crate::world::World;

/// Data that all legs of a path share.
pub(in crate::integrator) struct Paths<'a, const N: usize> {
    pub(in crate::integrator) world: &'a World,
    pub(in crate::integrator) effort: Effort,
    pub(in crate::integrator) wavelengths: &'a Wavelengths<N>,
    /// Whether the path excites fluorescence; then its wavelengths are not of the film.
    pub(in crate::integrator) excites: bool,
}

/// A ray of a path and its origin.
pub(in crate::integrator) type Leg<const N: usize> = walk::Leg<N, Bounce>;

/// The bounce from which a ray originates.
#[derive(Clone, Copy)]
pub(in crate::integrator) struct Bounce {
    /// Density of its direction; infinite if no light sample could have chosen the same direction.
    pub(super) pdf: f32,
    /// The point where it started; used only if the density is finite.
    pub(super) from: Receiver,
    /// Number of lights chosen there.
    pub(super) light_samples: u32,
}

impl<const N: usize> Paths<'_, N> {
    /// The lights that are sampled.
    pub(super) fn selection(&self) -> &LightSelection {
        self.world.selections.of(self.effort.sample_skies)
    }

    /// How much of a throughput counts: as the film sees it, or of light that excites, the brightest
    /// lane.
    pub(super) fn brightness(&self, throughput: &Lanes<N>) -> f32 {
        if self.excites {
            throughput.max_lane()
        } else {
            let sampler = &self.world.wavelengths;
            sampler.brightness(self.wavelengths, throughput)
        }
    }

    /// Number of lights that are chosen and sampled at a vertex.
    pub(super) fn light_samples(&self, depth: u32) -> u32 {
        if depth == 0 {
            self.effort.light_samples
        } else {
            1
        }
    }

    /// The leaf that a material is, if that fluoresces on this path.
    pub(super) fn fluorescing<'m>(&self, material: &'m Material) -> Option<&'m LeafMaterial> {
        let may = self.world.fluoresces && !self.excites;
        may.then(|| material.fluorescing()).flatten()
    }
}
