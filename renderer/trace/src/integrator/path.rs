//! The path estimator: unidirectional, with light samples at every vertex.

pub(super) mod drops;
mod found;
pub(super) mod lamps;
pub(super) mod paths;
mod result;
mod through_leaf;
pub(super) mod vertex;

use glam::{Vec2, Vec3};

use self::drops::Passage;
use self::found::{emission, from_infinity};
use self::lamps::sampled_light;
use self::paths::{Bounce, Leg, Paths};
pub use self::result::{FirstHit, PathResult};
use self::vertex::Vertex;
use crate::camera::FilmRay;
use crate::geometry::ray::Ray;
use crate::geometry::{Geometry, Hit};
use crate::integrator::effort::Effort;
use crate::light::Receiver;
use crate::material::Material;
use crate::sampling::dimensions::{Sets, picture as sets};
use crate::sampling::stream::Stream;
use crate::spectrum::{Lanes, Wavelengths};
use crate::walk::cone::Cone;
use crate::walk::encounter::Encounter;
use crate::walk::{Ahead, Arrival, Collision, Scatterer, Walk};
use crate::world::{World, WorldObjects};

/// Adds to `result` what a path through a random place in a pixel finds at the wavelengths of a group of
/// channels; `stream` gives the random numbers. Returns its wavelengths.
pub fn of_pixel<const N: usize>(
    world: &World,
    effort: Effort,
    ([x, y], group): ([u32; 2], usize),
    stream: &mut Stream,
    result: &mut PathResult<N>,
) -> Wavelengths<N> {
    // Place and lens are stratified together, since blur is in both; without a lens one set does.
    stream.seek(sets::PLACE.of(0));
    let [film_x, film_y, third, lens_y] = stream.next4();
    let wavelength = if world.camera.has_lens() {
        stream.seek(sets::WAVELENGTHS.of(0));
        stream.next4()[0]
    } else {
        third
    };
    let lens_x = third;
    let wavelengths = world.wavelengths.draw::<N>(wavelength, group);
    let offset = world.filter.sample(Vec2::new(film_x, film_y));
    let place = Vec2::new(x as f32, y as f32) + offset;
    let seen = world.camera.ray(place, Vec2::new(lens_x, lens_y));
    trace(world, effort, seen, &wavelengths, stream, result);
    wavelengths
}

/// Adds to `result` the radiance that arrives along a ray. Of one of weight 0 only the first hit is
/// found, for features.
///
/// At every vertex each sun and one other light are sampled and weighted against the bounce by the
/// power heuristic; at the first vertex the number of other lights is set by the effort. Russian
/// roulette is applied only below the effort's threshold and leaves the mean unchanged; the
/// survival probability is the throughput over that threshold. If none of the sampled lights
/// reaches the first vertex, its light comes by the bounce. So the effort sets how many paths
/// continue from there, apart for a first vertex that is lit and for one that is not.
pub fn trace<const N: usize>(
    world: &World,
    effort: Effort,
    FilmRay { ray, weight }: FilmRay,
    wavelengths: &Wavelengths<N>,
    stream: &mut Stream,
    result: &mut PathResult<N>,
) {
    let mut from_camera = Leg {
        throughput: Lanes::ONE * weight,
        origin: Bounce {
            pdf: f32::INFINITY,
            from: Receiver {
                position: ray.origin(),
                normal: ray.direction(),
            },
            light_samples: 0,
        },
        cone: Cone::of_pixel(world.camera.pixel_span()),
        ray,
    };
    let paths = Paths {
        world,
        effort,
        wavelengths,
        excites: false,
    };
    let passage = Passage::of_camera(world);
    paths.follow(&mut from_camera, passage, 0, stream, result);
}

impl<'w, const N: usize> Walk<'w, N, PathResult<N>> for Paths<'w, N> {
    type Origin = Bounce;
    type Passage = Passage;

    const FLIGHTS: Sets = sets::FLIGHT;
    const COUNTS_FLIGHTS: bool = false;

    #[inline(always)]
    fn world(&self) -> &'w World {
        self.world
    }

    #[inline(always)]
    fn scenery(&self) -> (&Geometry, &WorldObjects) {
        (&self.world.geometry, &self.world.objects)
    }

    #[inline(always)]
    fn wavelengths(&self) -> &Wavelengths<N> {
        self.wavelengths
    }

    #[inline(always)]
    fn next(
        &self,
        ray: &mut Ray,
        [from, reach]: [f32; 2],
        event: u32,
        result: &mut PathResult<N>,
    ) -> (Ahead, f32) {
        result.rays += 1;
        if event > 0 {
            for &number in &self.selection().at_infinity {
                self.world.lights[number].prefetch(ray.direction());
            }
        }
        *ray = ray.up_to(f32::INFINITY);
        // Within a closed body there is something ahead. Where a ray passes an edge, rounding may
        // turn the order of two boundaries round, so that it takes itself for inside: then it is
        // in the open here, and does not walk on for ever.
        let world = self.world;
        let mut hit = world.geometry.intersect(ray);
        if event == 0 && world.integrator.hide_lights {
            while let Some(lamp) = hit
                && world.objects[lamp.instance as usize].light.is_some()
            {
                *ray = ray.starting_at(lamp.t.next_up());
                hit = world.geometry.intersect(ray);
            }
        }
        let ahead = match hit {
            None => Ahead::Nothing,
            Some(hit) if from + reach < hit.t => {
                *ray = ray.up_to(from + reach);
                Ahead::End(from + reach - from)
            }
            Some(hit) => Ahead::Hit(hit),
        };
        (ahead, 0.0)
    }

    /// The camera's ray notes the first surface.
    fn arrives(&self, at: &Arrival<'_, N>, event: u32, result: &mut PathResult<N>) -> bool {
        let surface = at.surface;
        if event == 0 && result.first.is_none() {
            if self.world.objects[surface.instance as usize].holdout {
                return false;
            }
            let against = at.ray.direction().dot(surface.shading_normal) < 0.0;
            result.first = Some(FirstHit {
                position: surface.position,
                normal: surface.shading_normal * if against { 1.0 } else { -1.0 },
                albedo: Lanes::ONE,
                object: self.world.objects[surface.instance as usize].object as u32,
            });
        }
        true
    }

    fn collides(
        &self,
        leg: &mut Leg<N>,
        passage: &mut Passage,
        collision: &Collision<N>,
        event: u32,
        stream: &mut Stream,
        result: &mut PathResult<N>,
    ) -> bool {
        let Collision {
            position,
            medium,
            place,
            ..
        } = collision;
        let way = leg.ray.direction();
        if event == 0 && result.first.is_none() {
            result.first = Some(FirstHit {
                position: *position,
                normal: -way,
                albedo: medium.albedo(),
                object: self.world.objects.object_of(*place) as u32,
            });
        }
        if self.ends(leg, event, result) {
            return false;
        }
        let vertex = Vertex {
            paths: self,
            scatterer: Scatterer::Medium {
                position: *position,
                way,
                medium: *medium,
            },
            receiver: Receiver {
                position: *position,
                normal: Vec3::ZERO,
            },
            is_lit: collision.is_lit,
            light_samples: self.light_samples(event),
            throughput: leg.throughput,
            width: leg.cone.width_at(leg.ray.t_max()),
            gathered: result.radiance,
            inside: &passage.around.inside,
            boundary: None,
            cap: None,
        };
        self.scatter(&vertex, passage, event, stream, (leg, result))
    }

    #[inline(always)]
    fn meets(
        &self,
        leg: &mut Leg<N>,
        passage: &mut Passage,
        (material, encounter, hit): (&'w Material, &mut Encounter<'w, N>, &Hit),
        event: u32,
        stream: &mut Stream,
        result: &mut PathResult<N>,
    ) -> bool {
        let world = self.world;
        let Ok(film) = self.film_over(leg, passage.drops, encounter, hit) else {
            return true;
        };
        let encounter = &*encounter;
        let (surface, wo) = (&encounter.surface, encounter.wo);
        let object = &world.objects[surface.instance as usize];
        if event == 0 && object.holdout {
            return false;
        }
        if let Some(number) = object.light {
            let lights = (&world.lights[..], self.selection());
            let (ray, bounce) = (&leg.ray, &leg.origin);
            let found = emission(lights, number, ray, surface, bounce, self.wavelengths);
            result.radiance += leg.throughput * found;
        }
        if event == 0 && result.first.is_none() {
            result.first = Some(FirstHit::new(world, encounter));
        }
        if self.ends(leg, event, result) {
            return false;
        }
        if let Some(inside) = material.inside() {
            let entry = through_leaf::Entry {
                inside,
                at: (hit, surface, &encounter.frame, wo),
                passage,
                leg: (leg.throughput, encounter.width),
                depth: event,
            };
            let Some(next) = self.through_leaf(&entry, stream, result) else {
                return false;
            };
            *leg = next;
        } else {
            // By reference: a view is large, and would be moved out of the option.
            let view = encounter.bsdf.seen_from(wo);
            let Some(view) = &view else {
                return false;
            };
            let gathered = result.radiance;
            let vertex = self.on_surface((encounter, view), leg, passage, event, gathered);
            if let Some(leaf) = self.fluorescing(material) {
                let way = (&*leg, &*passage);
                let found = self.emitted(leaf, encounter, way, event, stream);
                result.take(leg.throughput, &found);
            }
            if !self.scatter(&vertex, passage, event, stream, (leg, result)) {
                return false;
            }
            if let Some(beyond) = vertex.passage_towards(passage, leg.ray.direction()) {
                *passage = beyond;
            }
        }
        if let Some(film) = film {
            let place = (encounter.facet(&world.geometry), &encounter.frame, wo);
            passage.drops = film.leave(passage.drops, place, leg);
        }
        true
    }

    fn leaves(&self, leg: &mut Leg<N>, _: &mut Passage, result: &mut PathResult<N>) {
        if self.world.integrator.hide_lights && result.first.is_none() {
            return;
        }
        let lights = (&self.world.lights[..], self.selection());
        let way = leg.ray.direction();
        result.radiance +=
            leg.throughput * from_infinity(lights, way, &leg.origin, self.wavelengths);
    }

    fn cut(&self, leg: &mut Leg<N>, _: &mut Passage, result: &mut PathResult<N>) {
        result.end_early(leg.throughput);
    }
}

impl<const N: usize> Paths<'_, N> {
    /// Whether a path ends where it is, because nothing is left of it or by the limit of its depth.
    #[inline(always)]
    fn ends(&self, leg: &Leg<N>, depth: u32, result: &mut PathResult<N>) -> bool {
        let most = self.world.integrator.max_depth;
        let ends = leg.throughput.is_zero() || most.is_some_and(|most| depth >= most);
        if ends {
            result.end_early(leg.throughput);
        }
        ends
    }

    /// Adds the light of lamps at a vertex, and that of the paths that go on from the first one if
    /// they are several; otherwise turns the leg into that by which the path goes on. False if it
    /// does not.
    #[inline(always)]
    fn scatter(
        &self,
        vertex: &Vertex<'_, N>,
        passage: &Passage,
        depth: u32,
        stream: &mut Stream,
        (leg, result): (&mut Leg<N>, &mut PathResult<N>),
    ) -> bool {
        let set = sets::VERTEX.of(depth);
        stream.seek(set);
        let numbers = stream.next4();
        // Without what a leaf emits: whether a path branches depends on lamps alone.
        let mut gathered = vertex.gathered;
        if vertex.is_lit {
            let [_, mut x, mut y, _] = numbers;
            if depth == 0 && self.effort.may_branch() && !self.selection().always.is_empty() {
                // How many paths go on depends on the suns. If they shared the numbers of the
                // bounce, those of a lit vertex would be a choice among all, and the mean wrong in
                // penumbras.
                let mut first = stream.clone();
                first.seek(sets::FIRST_SUNS.of(0));
                [x, y, ..] = first.next4();
            }
            let (light, rays) = sampled_light(self.world, vertex, self.wavelengths, [x, y], stream);
            gathered += light;
            result.radiance += light;
            result.rays += rays;
        }
        let branches = match (depth == 0 && vertex.is_lit, gathered.is_zero()) {
            (true, true) => self.effort.branches,
            (true, false) => self.effort.lit_branches,
            (false, _) => 1,
        };
        if branches > 1 {
            for number in 0..branches {
                let mut stream = stream.part(number, branches);
                stream.seek(set);
                let share = 1.0 / branches as f32;
                if vertex.bounce(stream.next4(), share, 0.0, leg) {
                    let beyond = vertex.passage_towards(passage, leg.ray.direction());
                    self.follow(leg, beyond.unwrap_or(*passage), 1, &mut stream, result);
                }
            }
            return false;
        }
        vertex.bounce(numbers, 1.0, self.effort.roulette_below, leg)
    }
}
