//! Ways of paths through media and through boundaries that let light pass straight.
//!
//! Only scenes with media come here.

use glam::Vec3;

use super::drops::Drops;
use super::{FirstHit, Leg, PathResult, Paths};
use crate::geometry::{Hit, Ray};
use crate::medium::{Inside, Phase};
use crate::sampling::dimensions::picture as sets;
use crate::sampling::stream::Stream;
use crate::scene::world::World;
use crate::spectrum::{Lanes, Wavelengths};

/// Where a path is.
#[derive(Clone, Copy, Default)]
pub(in crate::integrator) struct Passage {
    /// The bodies around.
    pub(in crate::integrator) inside: Inside,
    /// Number of flights so far, each with random numbers of its own.
    pub(in crate::integrator) flights: u32,
    /// The drops around.
    pub(in crate::integrator) drops: Drops,
}

/// What a ray comes to.
pub(super) enum Met {
    /// A surface.
    Surface(Hit),
    /// An event of scattering in a medium.
    Medium(Collision),
    /// Nothing.
    Nothing,
}

/// An event of scattering in a medium.
pub(super) struct Collision {
    pub(super) position: Vec3,
    pub(super) phase: Phase,
    /// Whether light reaches the place straight, through boundaries with one index on both sides;
    /// through others only bounces find it.
    pub(super) is_lit: bool,
}

impl Passage {
    /// Where the camera stands.
    pub(super) fn of_camera(world: &World) -> Self {
        Self {
            inside: world.media.around_camera,
            flights: 0,
            drops: Drops::default(),
        }
    }
}

impl<const N: usize> Paths<'_, N> {
    /// Goes on along a leg until it comes to a surface that scatters, is scattered by a medium, or
    /// leaves the scene; its throughput is then what is left. The camera's ray notes the first surface.
    #[inline(never)]
    pub(super) fn advance(
        &self,
        leg: &mut Leg<N>,
        passage: &mut Passage,
        is_camera_ray: bool,
        stream: &mut Stream,
        result: &mut PathResult<N>,
    ) -> Met {
        let world = self.world;
        // From where on the ray is in what is around it now.
        let mut from = 0.0;
        // The ray begins behind each hit, so it passes no triangle twice.
        loop {
            let around = passage.inside.innermost();
            let medium = around.and_then(|(place, body)| {
                let medium = &world.media.media[body.medium? as usize];
                // Nothing happens to light that there is none of.
                let medium = (!leg.throughput.is_zero()).then(|| medium.at(self.wavelengths));
                medium.map(|medium| (medium, place, body.is_matched))
            });
            leg.ray = leg.ray.up_to(f32::INFINITY);
            result.rays += 1;
            // Within a closed body there is something ahead. Where a ray passes an edge, rounding may
            // turn the order of two boundaries round, so that it takes itself for inside: then it is
            // in the open here, and does not walk on for ever.
            let Some(hit) = world.geometry.intersect(&leg.ray) else {
                return Met::Nothing;
            };
            let mut end = f32::INFINITY;
            if let Some((medium, ..)) = &medium {
                stream.seek(sets::FLIGHT.of(passage.flights));
                passage.flights += 1;
                let [choice, distance, ..] = stream.next4();
                end = from + medium.reach(&leg.throughput, [choice, distance]);
            }
            if let Some((medium, place, is_lit)) = &medium
                && end < hit.t
            {
                leg.ray = leg.ray.up_to(end);
                leg.throughput *= medium.scattered(&leg.throughput, end - from);
                let position = leg.ray.origin() + leg.ray.direction() * end;
                if is_camera_ray && result.first.is_none() {
                    result.first = Some(FirstHit {
                        position,
                        normal: -leg.ray.direction(),
                        albedo: medium.albedo(),
                        object: world.objects.object_of(*place) as u32,
                    });
                }
                return Met::Medium(Collision {
                    position,
                    phase: medium.phase,
                    is_lit: *is_lit,
                });
            }
            if let Some((medium, ..)) = &medium {
                leg.throughput *= medium.passed(&leg.throughput, hit.t - from);
            }
            let object = world.objects[hit.instance as usize];
            let Some(body) = object.body.filter(|body| body.is_matched) else {
                return Met::Surface(hit);
            };
            let surface = world.geometry.surface(&leg.ray, &hit);
            let direction = leg.ray.direction();
            if is_camera_ray && result.first.is_none() {
                let against = direction.dot(surface.shading_normal) < 0.0;
                result.first = Some(FirstHit {
                    position: surface.position,
                    normal: surface.shading_normal * if against { 1.0 } else { -1.0 },
                    albedo: Lanes::ONE,
                    object: object.object as u32,
                });
            }
            let place = world.objects.body_place(hit.instance);
            let normal = surface.geometric_normal;
            passage
                .inside
                .leave_boundary(place, body, normal, direction);
            // The same ray goes on: behind the hit, which depends on ray and triangle alone.
            from = hit.t;
            leg.ray = leg.ray.starting_at(from.next_up());
        }
    }
}

/// Share of light that comes straight along a ray, to a point at its end or from infinity, through
/// media and boundaries with one index on both sides; and the number of rays traced for it.
#[inline(never)]
pub(super) fn transmittance<const N: usize>(
    world: &World,
    mut ray: Ray,
    target: Option<Vec3>,
    mut inside: Inside,
    wavelengths: &Wavelengths<N>,
) -> (Lanes<N>, u32) {
    let mut left = Lanes::ONE;
    let mut from = 0.0;
    let mut rays = 0;
    loop {
        rays += 1;
        let hit = world.geometry.intersect(&ray);
        if let Some(number) = inside.medium() {
            // The direction to a point is as long as the way to it.
            let whole = if target.is_some() { 1.0 } else { f32::INFINITY };
            let end = hit.map_or(whole, |hit| hit.t);
            let length = (end - from) * ray.direction().length();
            let medium = world.media.media[number as usize].at(wavelengths);
            left *= medium.transmittance(length);
        }
        let Some(hit) = hit else {
            return (left, rays);
        };
        let body = world.objects[hit.instance as usize].body;
        let Some(body) = body.filter(|body| body.is_matched && !left.is_zero()) else {
            return (Lanes::ZERO, rays);
        };
        let surface = world.geometry.surface(&ray, &hit);
        let place = world.objects.body_place(hit.instance);
        let normal = surface.geometric_normal;
        inside.leave_boundary(place, body, normal, ray.direction());
        from = hit.t;
        ray = ray.starting_at(from.next_up());
    }
}
