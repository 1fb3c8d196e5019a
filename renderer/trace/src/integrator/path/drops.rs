//! Drops on leaves: what passes between their water and the tissue on which they stand.
//!
//! The BSDF of a leaf is that of a leaf in air: what the boundary of its tissue sends back inwards is in
//! it. Taken as it is under water, a leaf would send out 1/η² of its light, and a drop on it be half
//! as bright as the leaf. So between them lies a *film* of air, thinner than a wave: it refracts as
//! air does and sends nothing back but what it reflects totally.
//!
//! - **Always true**: no energy comes or goes; in even light all around, a leaf that absorbs nothing
//!   looks the same with and without drops.
//!
//! Only scenes with drops come here.

use glam::Vec3;

use super::paths::{Leg, Paths};
use crate::bsdf::fresnel::refracted_cosine;
use crate::geometry::frame::Frame;
use crate::geometry::surface::SurfacePoint;
use crate::geometry::{Geometry, Hit};
use crate::walk;
use crate::walk::encounter::Encounter;
use crate::walk::facet::Facet;
use crate::world::World;

/// The drops in whose water a path is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::integrator) struct Drops {
    /// How many that run into each other.
    count: u8,
    /// Refractive index of the last one's water over that outside.
    eta: f32,
}

/// The surface of a drop where a path meets it.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct Cap {
    /// Refractive index of the water over that outside.
    pub(in crate::integrator) eta: f32,
    /// Its shading normal, to the outside.
    pub(in crate::integrator) normal: Vec3,
    /// Whether the ray that met it came from the water.
    pub(in crate::integrator) came_out: bool,
}

impl Cap {
    /// Whether a ray meets it from below that has not come through it: from a leaf that it met from its
    /// other side, or under the rim. Nobody knew that there is water, so the ray goes straight on as if
    /// there were none.
    pub(super) fn is_unknown(&self, drops: Drops) -> bool {
        drops.count == 0 && self.came_out
    }

    /// The drops around a ray that leaves in a direction.
    pub(super) fn drops_towards(&self, mut drops: Drops, direction: Vec3) -> Drops {
        match (self.came_out, direction.dot(self.normal) > 0.0) {
            (false, false) => {
                drops = Drops {
                    count: drops.count.saturating_add(1),
                    eta: self.eta,
                }
            }
            (true, true) => drops.count = drops.count.saturating_sub(1),
            (false, true) | (true, false) => {}
        }
        drops
    }
}

impl Drops {
    /// The film over tissue that a path meets in a drop; `None` in the open.
    pub(in crate::integrator) fn film(self) -> Option<Film> {
        (self.count > 0).then_some(Film { eta: self.eta })
    }
}

/// The film of air between water and tissue.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct Film {
    /// Refractive index of the water over that of the air.
    eta: f32,
}

impl Film {
    /// The direction in the film of light that goes to `wo` in the water, local; `None` if the film
    /// reflects it totally.
    fn into_air(self, wo: Vec3) -> Option<Vec3> {
        bent(wo, self.eta)
    }

    /// The direction in the water of light from `wi` in the film, local.
    fn into_water(self, wi: Vec3) -> Option<Vec3> {
        bent(wi, 1.0 / self.eta)
    }

    /// Takes a path that has come to tissue through the water into the film: changes its direction
    /// `wo`, local, and weight. If the film reflects it totally, the leg is the one that goes on.
    ///
    /// # Errors
    ///
    /// `()` if the film reflects it totally.
    pub(super) fn enter<const N: usize>(
        self,
        (facet, frame): (Facet<'_, Geometry>, &Frame),
        wo: &mut Vec3,
        leg: &mut Leg<N>,
    ) -> Result<(), ()> {
        if let Some(refracted) = self.into_air(*wo) {
            *wo = refracted;
            // Radiance is not compressed in air.
            leg.throughput *= self.eta * self.eta;
            return Ok(());
        }
        let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
        leg.ray = facet.spawn(facet.leaving(frame.to_world(mirrored)));
        leg.origin.pdf = f32::INFINITY;
        Err(())
    }

    /// Takes the leg that leaves the tissue on from the film, if it goes back to the side of `wo`: into
    /// the water. Gives the drops around it.
    pub(in crate::integrator) fn leave<const N: usize>(
        self,
        drops: Drops,
        (facet, frame, wo): (Facet<'_, Geometry>, &Frame, Vec3),
        leg: &mut Leg<N>,
    ) -> Drops {
        let wi = frame.to_local(leg.ray.direction());
        if wi.z * wo.z <= 0.0 {
            return Drops::default();
        }
        if let Some(wi) = self.into_water(wi) {
            leg.ray = facet.spawn(facet.leaving(frame.to_world(wi)));
        }
        leg.throughput *= 1.0 / (self.eta * self.eta);
        leg.origin.pdf = f32::INFINITY;
        drops
    }
}

impl<const N: usize> Paths<'_, N> {
    /// The drop on whose surface a point lies that a ray met on its way.
    pub(super) fn cap_at(&self, surface: &SurfacePoint, way: Vec3) -> Option<Cap> {
        let eta = self.world.objects[surface.instance as usize].drop?;
        Some(Cap {
            eta,
            normal: surface.shading_normal,
            came_out: way.dot(surface.geometric_normal) > 0.0,
        })
    }

    /// The film through which a leg has come to what it has met, if it comes from the water of a drop.
    ///
    /// # Errors
    ///
    /// `()` if a drop has changed the leg, which goes on by itself.
    #[inline(always)]
    pub(super) fn film_over(
        &self,
        leg: &mut Leg<N>,
        drops: Drops,
        encounter: &mut Encounter<'_, N>,
        hit: &Hit,
    ) -> Result<Option<Film>, ()> {
        if self.world.objects.have_drops() {
            self.in_drops(leg, drops, encounter, hit)
        } else {
            Ok(None)
        }
    }

    /// [`Self::film_over`] in scenes with drops.
    #[inline(never)]
    fn in_drops(
        &self,
        leg: &mut Leg<N>,
        drops: Drops,
        encounter: &mut Encounter<'_, N>,
        hit: &Hit,
    ) -> Result<Option<Film>, ()> {
        if let Some(cap) = self.cap_at(&encounter.surface, leg.ray.direction()) {
            if cap.is_unknown(drops) {
                // The same ray goes on behind the hit.
                leg.ray = leg.ray.starting_at(hit.t.next_up());
                leg.ray = leg.ray.up_to(f32::INFINITY);
                leg.origin.pdf = f32::INFINITY;
                return Err(());
            }
            return Ok(None);
        }
        let film = drops.film();
        let is_tissue = self.world.material_of(hit.instance).tissue().is_some();
        let Some(film) = film.filter(|_| is_tissue) else {
            return Ok(None);
        };
        let facet = Facet {
            around: &self.world.geometry,
            surface: &encounter.surface,
        };
        film.enter((facet, &encounter.frame), &mut encounter.wo, leg)?;
        Ok(Some(film))
    }
}

/// A direction on the far side of a boundary that it passes, whose transverse part is `factor` times as
/// long there; `None` if there is none.
fn bent(w: Vec3, factor: f32) -> Option<Vec3> {
    let cosine = refracted_cosine(w.z, 1.0 / factor)?;
    let across = w.truncate() * factor;
    Some(across.extend(cosine.copysign(w.z)))
}

/// Where a path is.
#[derive(Clone, Copy, Default)]
pub(in crate::integrator) struct Passage {
    /// The bodies around, in scenes with media.
    pub(in crate::integrator) around: walk::Passage,
    /// The drops around.
    pub(in crate::integrator) drops: Drops,
}

impl Passage {
    /// Where the camera stands.
    pub(super) fn of_camera(world: &World) -> Self {
        Self {
            around: walk::Passage {
                inside: world.media.around_camera,
                flights: 0,
            },
            drops: Drops::default(),
        }
    }
}

impl AsMut<walk::Passage> for Passage {
    fn as_mut(&mut self) -> &mut walk::Passage {
        &mut self.around
    }
}
