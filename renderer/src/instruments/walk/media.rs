//! Flux on its way through media and through boundaries that let it pass straight.

use glam::{Vec2, Vec3};

use super::super::LANES;
use super::super::stage::Stage;
use super::{Ahead, Course, Event, Leg, ROULETTE_BELOW, Walk, Witness};
use crate::geometry::Ray;
use crate::integrator::facet::{Facet, Surroundings};
use crate::medium::{BodyPlace, Coefficients, Inside};
use crate::sampling::dimensions::instrument as sets;
use crate::sampling::stream::Stream;
use crate::spectrum::Lanes;

/// Where light is.
#[derive(Clone, Copy)]
pub(in crate::instruments) struct Passage {
    /// The bodies around.
    inside: Inside,
    /// Number of flights so far.
    flights: u32,
    /// Whether no medium has scattered it.
    pub(super) is_straight: bool,
}

impl Passage {
    /// In the open, where instruments have their lamps.
    pub(super) fn in_the_open() -> Self {
        Self {
            inside: Inside::default(),
            flights: 0,
            is_straight: true,
        }
    }

    /// Light leaves the surface that it has met, in a direction.
    pub(super) fn leave(
        &mut self,
        stage: &Stage<'_>,
        facet: Facet<'_, impl Surroundings>,
        ray: &mut Ray,
    ) {
        let surface = facet.surface;
        if let Some(body) = stage.objects[surface.instance as usize].body {
            let place = stage.objects.body_place(surface.instance);
            let direction = ray.direction();
            self.inside
                .leave_boundary(place, body, surface.shading_normal, direction);
            *ray = facet.spawn_whole(direction);
        }
    }
}

/// An event at which light of an object goes straight on; its weights before and after.
fn passing(
    object: usize,
    (position, uv): (Vec3, Vec2),
    [before, after]: [Lanes<LANES>; 2],
) -> Event {
    Event {
        object,
        instance: None,
        position,
        uv,
        before,
        after,
        is_first: false,
        is_scattered: false,
    }
}

impl<'m, C: Course> Walk<'m, C> {
    /// Follows light until it meets a surface that scatters, as [`Course::next`] does; its weight is
    /// then what is left of it, and 0 if none is. Every event in a medium is told.
    pub(super) fn fly(
        &self,
        leg: &mut Leg,
        stream: &mut Stream,
        witness: &mut impl Witness<'m>,
    ) -> (Ahead, f32) {
        let stage = self.stage;
        // How far the ray was moved, and from where on it is in what is around it now.
        let (mut moved, mut from) = (0.0, 0.0);
        while leg.passage.flights < stage.world.integrator.max_events {
            let around = self.around(&leg.passage);
            stream.seek(sets::FLIGHT.of(leg.passage.flights));
            leg.passage.flights += 1;
            let [choice, distance, x, y] = stream.next4();
            let reach = around.map_or(f32::INFINITY, |(_, medium)| {
                medium.reach(&leg.weight, [choice, distance])
            });
            leg.ray = leg.ray.up_to(from + reach);
            let (ahead, gone) = self.course.next(stage, &mut leg.ray);
            moved += gone;
            let before = leg.weight;
            let hit = match ahead {
                Ahead::Hit(hit) => Some(hit),
                Ahead::Nothing => None,
                Ahead::Unknown => break,
            };
            let Some(hit) = hit else {
                let Some((body, medium)) = around else {
                    return (Ahead::Nothing, moved);
                };
                if leg.ray.t_max().is_infinite() {
                    // No closed body is left without passing its boundary, but by rounding.
                    leg.weight *= medium.passed(&before, f32::INFINITY);
                    witness.event(&passing(
                        stage.objects.object_of(body),
                        (leg.ray.origin(), Vec2::ZERO),
                        [before, leg.weight],
                    ));
                    return (Ahead::Nothing, moved);
                }
                leg.passage.is_straight = false;
                let position = leg.ray.origin() + leg.ray.direction() * leg.ray.t_max();
                leg.weight *= medium.scattered(&before, reach);
                self.play(&mut leg.weight, stream);
                witness.event(&Event {
                    object: stage.objects.object_of(body),
                    instance: None,
                    position,
                    uv: Vec2::ZERO,
                    before,
                    after: leg.weight,
                    is_first: false,
                    is_scattered: true,
                });
                if leg.weight.is_zero() {
                    return (Ahead::Nothing, moved);
                }
                leg.is_specular = false;
                let scattering = medium.phase.sample(leg.ray.direction(), Vec2::new(x, y));
                leg.cone = leg.cone.from(moved + leg.ray.t_max());
                leg.ray = Ray::new(position, scattering.direction);
                (moved, from) = (0.0, 0.0);
                continue;
            };
            let surface = stage.geometry.surface(&leg.ray, &hit);
            if let Some((_, medium)) = around {
                leg.weight *= medium.passed(&before, gone + hit.t - from);
            }
            let object = &stage.objects[hit.instance as usize];
            let passed = object.body.filter(|body| body.is_matched);
            if around.is_some() || passed.is_some() {
                let owner = around.map_or(object.object, |(body, _)| stage.objects.object_of(body));
                witness.event(&passing(
                    owner,
                    (surface.position, surface.uv),
                    [before, leg.weight],
                ));
            }
            let Some(body) = passed.filter(|_| !leg.weight.is_zero()) else {
                return (Ahead::Hit(hit), moved);
            };
            let direction = leg.ray.direction();
            leg.passage.inside.leave_boundary(
                stage.objects.body_place(hit.instance),
                body,
                surface.geometric_normal,
                direction,
            );
            // The same ray goes on: behind the hit, which depends on ray and triangle alone.
            from = hit.t;
            leg.ray = leg.ray.starting_at(from.next_up());
        }
        // What light that is caught still carries counts as absorbed where it is, if anything is there.
        if let Some((body, _)) = leg.passage.inside.innermost() {
            witness.event(&passing(
                stage.objects.object_of(body),
                (leg.ray.origin(), Vec2::ZERO),
                [leg.weight, Lanes::ZERO],
            ));
        }
        (Ahead::Unknown, 0.0)
    }

    /// The body around light and the medium in it, if there is one.
    fn around(&self, passage: &Passage) -> Option<(BodyPlace, Coefficients<LANES>)> {
        let (place, body) = passage.inside.innermost()?;
        let medium = &self.stage.world.media.media[body.medium? as usize];
        Some((place, medium.at(self.wavelengths)))
    }

    /// Russian roulette for a faint weight.
    fn play(&self, weight: &mut Lanes<LANES>, stream: &mut Stream) {
        let greatest = weight.max_lane();
        let below = ROULETTE_BELOW / self.ways as f32;
        if !greatest.is_finite() {
            *weight = Lanes::ZERO;
        } else if greatest < below {
            let survival = greatest / below;
            *weight = if stream.next4()[0] < survival {
                *weight * (1.0 / survival)
            } else {
                Lanes::ZERO
            };
        }
    }
}
