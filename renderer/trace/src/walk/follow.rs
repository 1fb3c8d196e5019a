//! A walk: leg after leg, from one event to the next.

use glam::Vec2;

use super::cone::Cone;
use super::encounter::Encounter;
use super::flight::{Ahead, Collision, Passage};
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::geometry::{Geometry, Hit};
use crate::material::Material;
use crate::medium::BodyPlace;
use crate::sampling::dimensions::Sets;
use crate::sampling::stream::Stream;
use crate::spectrum::{Lanes, Wavelengths};
use crate::world::{World, WorldObjects};

/// A ray of a walk and what it carries.
#[derive(Clone, Copy, Debug)]
pub struct Leg<const N: usize, O> {
    /// The ray.
    pub ray: Ray,
    /// Its width.
    pub cone: Cone,
    /// Factor on radiance along the ray up to the camera, or weight of the flux along it.
    pub throughput: Lanes<N>,
    /// What is remembered of where it starts.
    pub origin: O,
}

/// Light that comes to a surface through a medium, or to a boundary that lets it pass straight.
#[derive(Debug)]
pub struct Arrival<'a, const N: usize> {
    /// The ray.
    pub ray: &'a Ray,
    /// The body through whose medium it comes.
    pub around: Option<BodyPlace>,
    /// Where it is.
    pub surface: &'a SurfacePoint,
    /// What it carried before the flight.
    pub before: Lanes<N>,
    /// What it carries.
    pub after: Lanes<N>,
}

/// What light comes to.
pub enum Met<const N: usize> {
    Surface(Hit),
    Medium(Collision<N>),
    Nothing,
    Unknown,
}

/// How light is followed, and what is made of what it meets: `F` is what is found on the way, `'w`
/// the life of the world.
///
/// A walk has legs between *events*. At each event it calls one of the methods that say so, which
/// turn the leg into the next one, or return false if the walk ends. Everything is dispatched
/// statically.
pub trait Walk<'w, const N: usize, F> {
    /// What a leg remembers of its start.
    type Origin;
    /// Where light is.
    type Passage: AsMut<Passage>;

    /// The sets of random numbers of flights.
    const FLIGHTS: Sets;
    /// Whether each flight counts, is limited in number and is reported, through what it may lead;
    /// what scatters light in a medium is no event then. If not, it is an event.
    const COUNTS_FLIGHTS: bool;

    /// The world.
    fn world(&self) -> &'w World;
    /// The surfaces in it that light may meet, and their objects.
    fn scenery(&self) -> (&Geometry, &WorldObjects);
    /// The wavelengths that light has.
    fn wavelengths(&self) -> &Wavelengths<N>;

    /// What is ahead of a ray, and the distance by which it was moved on its way to it. The span is
    /// where on the ray its flight starts, and how far that goes, m.
    fn next(&self, ray: &mut Ray, span: [f32; 2], event: u32, found: &mut F) -> (Ahead, f32);
    /// Light arrives through a medium, if flights are counted, or at a boundary that lets it pass.
    /// Whether it continues there.
    fn arrives(&self, arrival: &Arrival<'_, N>, event: u32, found: &mut F) -> bool;
    /// A medium scatters light.
    fn collides(
        &self,
        leg: &mut Leg<N, Self::Origin>,
        passage: &mut Self::Passage,
        collision: &Collision<N>,
        event: u32,
        stream: &mut Stream,
        found: &mut F,
    ) -> bool;
    /// Light meets a surface of a material.
    fn meets(
        &self,
        leg: &mut Leg<N, Self::Origin>,
        passage: &mut Self::Passage,
        met: (&'w Material, &mut Encounter<'w, N>, &Hit),
        event: u32,
        stream: &mut Stream,
        found: &mut F,
    ) -> bool;
    /// Light leaves the scene.
    fn leaves(&self, leg: &mut Leg<N, Self::Origin>, passage: &mut Self::Passage, found: &mut F);
    /// A limit ends the walk, in the midst of a flight or after the last event.
    fn cut(&self, leg: &mut Leg<N, Self::Origin>, passage: &mut Self::Passage, found: &mut F);

    /// Follows light from a leg on, which becomes its last, until it ends. So many events came before.
    fn follow(
        &self,
        leg: &mut Leg<N, Self::Origin>,
        mut passage: Self::Passage,
        mut event: u32,
        stream: &mut Stream,
        found: &mut F,
    ) {
        let world = self.world();
        while event < world.integrator.max_events {
            let hit = if world.media.are_present {
                match self.fly(leg, passage.as_mut(), event, stream, found) {
                    Met::Surface(hit) => hit,
                    Met::Medium(collision) => {
                        if !self.collides(leg, &mut passage, &collision, event, stream, found) {
                            return;
                        }
                        event += u32::from(!Self::COUNTS_FLIGHTS);
                        continue;
                    }
                    Met::Nothing => return self.leaves(leg, &mut passage, found),
                    Met::Unknown => break,
                }
            } else {
                let (ahead, moved) = self.next(&mut leg.ray, [0.0, f32::INFINITY], event, found);
                leg.cone = leg.cone.from(moved);
                match ahead {
                    Ahead::Hit(hit) => hit,
                    Ahead::Nothing | Ahead::End(_) => {
                        return self.leaves(leg, &mut passage, found);
                    }
                    Ahead::Unknown => break,
                }
            };
            let (geometry, objects) = self.scenery();
            let material = &world.materials[objects[hit.instance as usize].material];
            let beam = (&leg.ray, &leg.cone);
            let mut encounter = Encounter::new(geometry, material, beam, &hit, self.wavelengths());
            let met = (material, &mut encounter, &hit);
            if !self.meets(leg, &mut passage, met, event, stream, found) {
                return;
            }
            event += 1;
        }
        self.cut(leg, &mut passage, found);
    }

    /// Continues along a leg until it comes to a surface that scatters, is scattered by a medium, or
    /// leaves the scene; its throughput is then what is left.
    #[inline(never)]
    fn fly(
        &self,
        leg: &mut Leg<N, Self::Origin>,
        passage: &mut Passage,
        event: u32,
        stream: &mut Stream,
        found: &mut F,
    ) -> Met<N> {
        let (world, (geometry, objects)) = (self.world(), self.scenery());
        let most = if Self::COUNTS_FLIGHTS {
            world.integrator.max_events
        } else {
            u32::MAX
        };
        // How far the ray was moved, and from where on it is in what is around it.
        let (mut moved, mut from) = (0.0, 0.0);
        // The ray begins behind each hit, so it passes no triangle twice.
        while passage.flights < most {
            let around = passage.inside.innermost().and_then(|(place, body)| {
                let medium = &world.media.media[body.medium? as usize];
                // Nothing happens to light that there is none of.
                let is_any = !leg.throughput.is_zero();
                is_any.then(|| {
                    let at = medium.at(leg.ray.direction(), self.wavelengths());
                    (place, body, medium, at)
                })
            });
            let (mut reach, mut u) = (f32::INFINITY, Vec2::ZERO);
            if let Some((.., medium)) = &around {
                stream.seek(Self::FLIGHTS.of(passage.flights));
                let [choice, distance, x, y] = stream.next4();
                reach = medium.reach(&leg.throughput, [choice, distance]);
                u = Vec2::new(x, y);
            }
            passage.flights += u32::from(around.is_some() || Self::COUNTS_FLIGHTS);
            let before = leg.throughput;
            let (ahead, gone) = self.next(&mut leg.ray, [from, reach], event, found);
            moved += gone;
            let hit = match ahead {
                Ahead::Hit(hit) => hit,
                Ahead::Nothing => return Met::Nothing,
                Ahead::Unknown => return Met::Unknown,
                Ahead::End(length) => {
                    let (place, body, medium, at) = around.expect("only a medium ends a flight");
                    leg.throughput *= at.scattered(&before, length);
                    return Met::Medium(Collision {
                        position: leg.ray.origin() + leg.ray.direction() * leg.ray.t_max(),
                        place,
                        medium: medium.met(leg.ray.direction(), u, at),
                        is_lit: body.is_matched,
                        before,
                        u,
                        moved,
                    });
                }
            };
            if let Some((.., medium)) = &around {
                leg.throughput *= medium.passed(&before, gone + hit.t - from);
            }
            let body = objects[hit.instance as usize].body;
            let mut passed = body.filter(|body| body.is_matched);
            if passed.is_some() || (around.is_some() && Self::COUNTS_FLIGHTS) {
                let surface = geometry.surface(&hit);
                let arrival = Arrival {
                    ray: &leg.ray,
                    around: around.map(|(place, ..)| place),
                    surface: &surface,
                    before,
                    after: leg.throughput,
                };
                if !self.arrives(&arrival, event, found) {
                    passed = None;
                } else if let Some(body) = passed {
                    let (normal, direction) = (surface.geometric_normal, leg.ray.direction());
                    let place = objects.body_place(hit.instance);
                    (passage.inside).leave_boundary(place, body, normal, direction);
                }
            }
            if passed.is_none() {
                leg.cone = leg.cone.from(moved);
                return Met::Surface(hit);
            }
            // The same ray goes on: behind the hit, which depends on ray and triangle alone.
            from = hit.t;
            leg.ray = leg.ray.starting_at(from.next_up());
        }
        Met::Unknown
    }
}
