//! A point where a path is scattered, and the ways on from there.

use glam::{Vec2, Vec3};

use super::drops::{Cap, Passage};
use super::paths::{Bounce, Leg, Paths};
use crate::bsdf::View;
use crate::light::Receiver;
use crate::medium::Inside;
use crate::spectrum::Lanes;
use crate::walk::cone::Cone;
use crate::walk::encounter::Encounter;
use crate::walk::{Boundary, Scatterer, roulette};

/// A point where a path is scattered.
pub(in crate::integrator) struct Vertex<'a, const N: usize> {
    pub(in crate::integrator) paths: &'a Paths<'a, N>,
    pub(in crate::integrator) scatterer: Scatterer<'a, N>,
    pub(in crate::integrator) receiver: Receiver,
    /// Whether lamps are sampled.
    pub(in crate::integrator) is_lit: bool,
    /// Number of lights that are chosen and sampled.
    pub(in crate::integrator) light_samples: u32,
    /// Factor on radiance from here, up to the camera.
    pub(in crate::integrator) throughput: Lanes<N>,
    /// Width of the ray that found it, m.
    pub(in crate::integrator) width: f32,
    /// Radiance that the path has found so far.
    pub(in crate::integrator) gathered: Lanes<N>,
    /// The bodies from whose inside the ray came.
    pub(in crate::integrator) inside: &'a Inside,
    /// The boundary of a body on which the point lies, in scenes with media.
    pub(in crate::integrator) boundary: Option<Boundary>,
    /// The drop on whose surface the point lies.
    pub(in crate::integrator) cap: Option<Cap>,
}

impl<const N: usize> Vertex<'_, N> {
    /// Turns a leg into that which leaves by a random bounce with a share of the throughput. If it
    /// returns false, Russian roulette, below a threshold, ends the path.
    ///
    /// The leg is written where it stays: a copy would wait until all of it is in memory.
    pub(in crate::integrator) fn bounce(
        &self,
        numbers: [f32; 4],
        share: f32,
        roulette_below: f32,
        leg: &mut Leg<N>,
    ) -> bool {
        let [lobe, x, y, chance] = numbers;
        let Some(sample) = self.scatterer.sample(lobe, Vec2::new(x, y)) else {
            return false;
        };
        let mut throughput = self.throughput * sample.weight * share;
        let brightness = self.paths.brightness(&throughput);
        if brightness <= 0.0 {
            return false;
        }
        let Some(factor) = roulette(brightness, roulette_below, || chance) else {
            return false;
        };
        throughput *= factor;
        leg.throughput = throughput;
        leg.ray = match (&self.scatterer, self.boundary) {
            (Scatterer::Surface { facet, .. }, Some(_)) => facet.spawn_whole(sample.wi_world),
            (scatterer, _) => scatterer.spawn(sample.wi_world),
        };
        leg.cone = Cone::scattered(self.width);
        leg.origin = Bounce {
            // Where lamps were not sampled, what the bounce finds has no other weight.
            pdf: if self.is_lit {
                sample.pdf
            } else {
                f32::INFINITY
            },
            from: self.receiver,
            light_samples: self.light_samples,
        };
        true
    }

    /// The bodies around a ray that leaves in a direction.
    pub(in crate::integrator) fn inside_towards(&self, direction: Vec3) -> Inside {
        let mut inside = *self.inside;
        if let Some(boundary) = &self.boundary {
            boundary.leave(&mut inside, direction);
        }
        inside
    }

    /// Where a ray is that leaves in a direction, of a path that came by this passage; `None` if it
    /// is where it was.
    #[inline]
    pub(in crate::integrator) fn passage_towards(
        &self,
        passage: &Passage,
        direction: Vec3,
    ) -> Option<Passage> {
        if self.boundary.is_none() && self.cap.is_none() {
            return None;
        }
        let mut beyond = *passage;
        beyond.around.inside = self.inside_towards(direction);
        if let Some(cap) = &self.cap {
            beyond.drops = cap.drops_towards(beyond.drops, direction);
        }
        Some(beyond)
    }
}

impl<const N: usize> Paths<'_, N> {
    /// The vertex where a leg has met a surface.
    #[inline(always)]
    pub(in crate::integrator) fn on_surface<'v>(
        &'v self,
        (encounter, view): (&'v Encounter<'_, N>, &'v View<'v, N>),
        leg: &Leg<N>,
        passage: &'v Passage,
        depth: u32,
        gathered: Lanes<N>,
    ) -> Vertex<'v, N> {
        let objects = &self.world.objects;
        let surface = &encounter.surface;
        Vertex {
            paths: self,
            scatterer: Scatterer::Surface {
                facet: encounter.facet(&self.world.geometry),
                frame: &encounter.frame,
                view,
            },
            receiver: Receiver {
                position: surface.position,
                normal: surface.shading_normal,
            },
            is_lit: !encounter.bsdf.is_specular(),
            light_samples: self.light_samples(depth),
            throughput: leg.throughput,
            width: encounter.width,
            gathered,
            inside: &passage.around.inside,
            boundary: Boundary::at(objects, surface),
            cap: if objects.have_drops() {
                self.cap_at(surface, leg.ray.direction())
            } else {
                None
            },
        }
    }
}
