//! What a path gives to the film.

use glam::Vec3;

use crate::spectrum::Lanes;
use crate::walk::encounter::Encounter;
use crate::world::World;

/// The result of one path.
#[derive(Clone, Copy, Debug)]
pub struct PathResult<const N: usize> {
    /// Radiance along the camera ray, W m⁻² sr⁻¹ nm⁻¹.
    pub radiance: Lanes<N>,
    /// The first hit of the camera ray.
    pub first: Option<FirstHit<N>>,
    /// Number of rays traced, shadow rays included.
    pub rays: u32,
    /// Number of times that a limit cut the path.
    pub cuts: u32,
    /// Throughput of what was cut: factor on the radiance that might have been found there.
    pub cut: Lanes<N>,
}

impl<const N: usize> PathResult<N> {
    /// No light, of a path that has not begun.
    pub const NOTHING: Self = Self {
        radiance: Lanes::ZERO,
        first: None,
        rays: 0,
        cuts: 0,
        cut: Lanes::ZERO,
    };

    /// Adds what another path found, which goes on from this one with a throughput.
    pub(super) fn take(&mut self, throughput: Lanes<N>, found: &Self) {
        self.radiance += throughput * found.radiance;
        self.rays += found.rays;
        self.cuts += found.cuts;
        self.cut += throughput * found.cut;
    }

    /// Notes that a limit cuts a path of this throughput, if any light is left.
    #[cold]
    pub(super) fn end_early(&mut self, throughput: Lanes<N>) {
        if !throughput.is_zero() {
            self.cuts += 1;
            self.cut += throughput;
        }
    }
}

/// The first hit of the camera ray.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit<const N: usize> {
    /// Point, world, m.
    pub position: Vec3,
    /// Shading normal on the side of the camera, world.
    pub normal: Vec3,
    /// Share of light that the surface scatters.
    pub albedo: Lanes<N>,
    /// Number of the object in the scene.
    pub object: u32,
}

impl<const N: usize> FirstHit<N> {
    pub(super) fn new(world: &World, encounter: &Encounter<'_, N>) -> Self {
        let (surface, bsdf, wo) = (&encounter.surface, &encounter.bsdf, encounter.wo);
        let normal = if encounter.has_relief {
            encounter.frame.to_world(bsdf.normal(wo))
        } else if wo.z < 0.0 {
            -surface.shading_normal
        } else {
            surface.shading_normal
        };
        Self {
            position: surface.position,
            normal,
            albedo: bsdf.albedo(wo),
            object: world.objects[surface.instance as usize].object as u32,
        }
    }
}
