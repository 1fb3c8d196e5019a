//! The path estimator: unidirectional, with light samples at every vertex.

pub(super) mod drops;
mod found;
pub(super) mod lamps;
pub(super) mod media;
mod result;
pub(super) mod scatterer;
mod through_leaf;
mod vertex;

use glam::{Vec2, Vec3};

use self::found::{emission, from_infinity};
use self::lamps::sampled_light;
use self::media::{Collision, Met, Passage};
pub use self::result::{FirstHit, PathResult};
use self::scatterer::Scatterer;
pub(super) use self::vertex::Vertex;
use crate::camera::FilmRay;
use crate::geometry::Hit;
use crate::geometry::ray::Ray;
use crate::integrator::cone::Cone;
use crate::integrator::effort::Effort;
use crate::integrator::encounter::Encounter;
use crate::light::Receiver;
use crate::light::selection::LightSelection;
use crate::sampling::dimensions::picture as sets;
use crate::sampling::stream::Stream;
use crate::scene::world::World;
use crate::spectrum::{Lanes, Wavelengths};

/// Adds to `result` what a path through a random place in a pixel finds; `stream` gives the random
/// numbers. Returns its wavelengths.
pub fn of_pixel<const N: usize>(
    world: &World,
    effort: Effort,
    [x, y]: [u32; 2],
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
    let wavelengths = world.wavelengths.draw::<N>(wavelength);
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
        bounce: Bounce {
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

/// A ray of a path and its origin.
#[derive(Clone, Copy)]
pub(super) struct Leg<const N: usize> {
    ray: Ray,
    cone: Cone,
    /// Factor on radiance along the ray, up to the camera.
    throughput: Lanes<N>,
    bounce: Bounce,
}

/// Data that all legs of a path share.
pub(super) struct Paths<'a, const N: usize> {
    pub(super) world: &'a World,
    pub(super) effort: Effort,
    pub(super) wavelengths: &'a Wavelengths<N>,
    /// Whether the path excites fluorescence; then its wavelengths are not of the film.
    pub(super) excites: bool,
}

impl<const N: usize> Paths<'_, N> {
    /// Adds the radiance that a path finds from a leg on, which becomes its last. Its ray was
    /// scattered `from` times before; `passage` is where it starts, in scenes with media.
    pub(super) fn follow(
        &self,
        leg: &mut Leg<N>,
        mut passage: Passage,
        from: u32,
        stream: &mut Stream,
        result: &mut PathResult<N>,
    ) {
        let (world, wavelengths) = (self.world, self.wavelengths);
        let lights = (&world.lights[..], self.selection());
        for depth in from..world.integrator.max_events {
            let is_last = world.integrator.max_depth.is_some_and(|most| depth >= most);
            let found = if world.media.are_present {
                match self.advance(leg, &mut passage, depth == 0, stream, result) {
                    Met::Surface(hit) => Some(hit),
                    Met::Nothing => None,
                    Met::Medium(collision) => {
                        if leg.throughput.is_zero() || is_last {
                            result.end_early(leg.throughput);
                            return;
                        }
                        if !self.collide(leg, &passage, &collision, depth, stream, result) {
                            return;
                        }
                        continue;
                    }
                }
            } else {
                self.meet(&leg.ray, depth == 0, result)
            };
            let Some(hit) = &found else {
                let way = leg.ray.direction();
                result.radiance +=
                    leg.throughput * from_infinity(lights, way, &leg.bounce, wavelengths);
                return;
            };
            let material = world.material_of(hit.instance);
            let mut encounter = Encounter::new(
                &world.geometry,
                material,
                (&leg.ray, &leg.cone),
                hit,
                wavelengths,
            );
            let Ok(film) = self.film_over(leg, passage.drops, &mut encounter, hit) else {
                continue;
            };
            let Leg {
                ray,
                throughput,
                bounce,
                ..
            } = &*leg;
            let (surface, frame, bsdf) = (&encounter.surface, &encounter.frame, &encounter.bsdf);
            let (wo, width) = (encounter.wo, encounter.width);
            if let Some(number) = world.objects[surface.instance as usize].light {
                let found = emission(lights, number, ray, surface, bounce, wavelengths);
                result.radiance += *throughput * found;
            }
            if depth == 0 && result.first.is_none() {
                result.first = Some(FirstHit::new(world, &encounter));
            }
            if throughput.is_zero() || is_last {
                result.end_early(*throughput);
                return;
            }
            if let Some(inside) = material.inside() {
                let entry = through_leaf::Entry {
                    inside,
                    at: (hit, surface, frame, wo),
                    passage: &passage,
                    leg: (*throughput, width),
                    depth,
                };
                let Some(mut next) = self.through_leaf(&entry, stream, result) else {
                    return;
                };
                if let Some(film) = film {
                    let place = (encounter.facet(&world.geometry), frame, wo);
                    passage.drops = film.leave(passage.drops, place, &mut next);
                }
                *leg = next;
                continue;
            }
            // By reference: a view is large, and would be moved out of the option.
            let view = bsdf.seen_from(wo);
            let Some(view) = &view else {
                return;
            };
            let gathered = result.radiance;
            let vertex = self.on_surface((&encounter, view), leg, &passage, depth, gathered);
            if let Some(leaf) = self.fluorescing(material) {
                let way = (&*leg, &passage);
                let found = self.emitted(leaf, &encounter, way, depth, stream);
                result.take(*throughput, &found);
            }
            if !self.scatter(&vertex, &passage, depth, stream, (leg, result)) {
                return;
            }
            if let Some(beyond) = vertex.passage_towards(&passage, leg.ray.direction()) {
                passage = beyond;
            }
            if let Some(film) = film {
                let place = (encounter.facet(&world.geometry), frame, wo);
                passage.drops = film.leave(passage.drops, place, leg);
            }
        }
        result.end_early(leg.throughput);
    }

    /// What a ray hits in a scene without media.
    #[inline(always)]
    fn meet(&self, ray: &Ray, is_first: bool, result: &mut PathResult<N>) -> Option<Hit> {
        result.rays += 1;
        if !is_first {
            for &number in &self.selection().at_infinity {
                self.world.lights[number].prefetch(ray.direction());
            }
        }
        self.world.geometry.intersect(ray)
    }

    /// Turns a leg that a medium has scattered into that by which the path goes on; false if it does
    /// not. Adds the light of lamps there.
    fn collide(
        &self,
        leg: &mut Leg<N>,
        passage: &Passage,
        collision: &Collision,
        depth: u32,
        stream: &mut Stream,
        result: &mut PathResult<N>,
    ) -> bool {
        let vertex = Vertex {
            paths: self,
            scatterer: Scatterer::Medium {
                position: collision.position,
                way: leg.ray.direction(),
                phase: collision.phase,
            },
            receiver: Receiver {
                position: collision.position,
                normal: Vec3::ZERO,
            },
            is_lit: collision.is_lit,
            light_samples: self.light_samples(depth),
            throughput: leg.throughput,
            width: leg.cone.width_at(leg.ray.t_max()),
            gathered: result.radiance,
            inside: &passage.inside,
            boundary: None,
            cap: None,
        };
        self.scatter(&vertex, passage, depth, stream, (leg, result))
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

    /// The lights that are sampled.
    pub(super) fn selection(&self) -> &LightSelection {
        self.world.selections.of(self.effort.sample_skies)
    }

    /// How much of a throughput counts: as the film sees it, or of light that excites, the brightest
    /// lane.
    fn brightness(&self, throughput: &Lanes<N>) -> f32 {
        if self.excites {
            throughput.max_lane()
        } else {
            let sampler = &self.world.wavelengths;
            sampler.brightness(self.wavelengths, throughput)
        }
    }

    /// Number of lights that are chosen and sampled at a vertex.
    fn light_samples(&self, depth: u32) -> u32 {
        if depth == 0 {
            self.effort.light_samples
        } else {
            1
        }
    }
}

/// The bounce from which a ray originates.
#[derive(Clone, Copy)]
struct Bounce {
    /// Density of its direction; infinite if no light sample could have chosen the same direction.
    pdf: f32,
    /// The point where it started; used only if the density is finite.
    from: Receiver,
    /// Number of lights chosen there.
    light_samples: u32,
}
