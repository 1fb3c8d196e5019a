//! The path estimator: unidirectional, with light samples at every vertex.

use glam::{Vec2, Vec3};

use crate::bsdf::{Scattered, View};
use crate::camera::FilmRay;
use crate::geometry::frame::Frame;
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::integrator::cone::Cone;
use crate::integrator::effort::Effort;
use crate::integrator::encounter::Encounter;
use crate::integrator::mis;
use crate::light::selection::Choice;
use crate::light::{Light, Receiver};
use crate::sampling::stream::Stream;
use crate::scene::world::World;
use crate::spectrum::{Lanes, Wavelengths};

mod through_leaf;

/// Number of sets of four random numbers before the first vertex: one for the places on film and
/// lens, one for the wavelengths. Without a lens the first set holds both.
pub const CAMERA_SETS: u32 = 2;
/// Number of sets of four random numbers that a vertex owns, used or not: one for the bounce, one
/// for the chosen light.
const VERTEX_SETS: u32 = 2;

/// The result of one path.
#[derive(Clone, Copy, Debug)]
pub struct PathResult<const N: usize> {
    /// Radiance along the camera ray, W m⁻² sr⁻¹ nm⁻¹.
    pub radiance: Lanes<N>,
    /// The first hit of the camera ray.
    pub first: Option<FirstHit<N>>,
    /// Number of rays traced, shadow rays included.
    pub rays: u32,
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

/// A path through a random place in a pixel, and its wavelengths; `stream` gives the random
/// numbers.
pub fn of_pixel<const N: usize>(
    world: &World,
    effort: Effort,
    x: u32,
    y: u32,
    stream: &mut Stream,
) -> (Wavelengths<N>, PathResult<N>) {
    // Place and lens are stratified together, since blur is in both; without a lens one set does.
    let [film_x, film_y, third, lens_y] = stream.next4();
    let wavelength = if world.camera.has_lens() {
        stream.next4()[0]
    } else {
        third
    };
    let lens_x = third;
    let wavelengths = world.wavelengths.draw::<N>(wavelength);
    let offset = world.filter.sample(Vec2::new(film_x, film_y));
    let place = Vec2::new(x as f32, y as f32) + offset;
    let seen = world.camera.ray(place, Vec2::new(lens_x, lens_y));
    let found = trace(world, effort, seen, &wavelengths, stream);
    (wavelengths, found)
}

/// Radiance that arrives along a ray. Of one of weight 0 only the first hit is found, for features.
///
/// At every vertex each sun and one other light are sampled and weighted against the bounce by the
/// power heuristic; at the first vertex the number of other lights is set by the effort. Russian
/// roulette is applied only below the effort's threshold and leaves the mean unchanged; the
/// survival probability is the throughput over that threshold. If none of the sampled lights
/// reaches the first vertex, its light comes by the bounce; then several paths continue from there,
/// as many as the effort sets.
pub fn trace<const N: usize>(
    world: &World,
    effort: Effort,
    FilmRay { ray, weight }: FilmRay,
    wavelengths: &Wavelengths<N>,
    stream: &mut Stream,
) -> PathResult<N> {
    let mut result = PathResult {
        radiance: Lanes::ZERO,
        first: None,
        rays: 0,
    };
    let from_camera = Leg {
        throughput: Lanes::ONE * weight,
        bounce: Bounce {
            pdf: f32::INFINITY,
            from: Receiver {
                position: ray.origin,
                normal: ray.direction,
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
    };
    paths.follow(from_camera, 0, stream, &mut result);
    result
}

/// A ray of a path and its origin.
struct Leg<const N: usize> {
    ray: Ray,
    cone: Cone,
    /// Factor on radiance along the ray, up to the camera.
    throughput: Lanes<N>,
    bounce: Bounce,
}

/// Data that all legs of a path share.
struct Paths<'a, const N: usize> {
    world: &'a World,
    effort: Effort,
    wavelengths: &'a Wavelengths<N>,
}

impl<const N: usize> Paths<'_, N> {
    /// Adds the radiance that a path finds from a leg on. Its ray was scattered `from` times
    /// before.
    fn follow(&self, mut leg: Leg<N>, from: u32, stream: &mut Stream, result: &mut PathResult<N>) {
        let (world, wavelengths) = (self.world, self.wavelengths);
        for depth in from.. {
            result.rays += 1;
            let Leg {
                ray,
                cone,
                throughput,
                bounce,
            } = &leg;
            let Some(hit) = world.geometry.intersect(ray) else {
                result.radiance +=
                    *throughput * from_infinity(world, ray.direction, bounce, wavelengths);
                return;
            };
            let material = world.material_of(hit.instance);
            let encounter =
                Encounter::new(&world.geometry, material, (ray, cone), &hit, wavelengths);
            let Encounter {
                surface,
                frame,
                bsdf,
                wo,
                width,
                has_relief,
            } = encounter;
            if let Some(number) = world.objects[surface.instance as usize].light {
                let found = emission(world, number, ray, &surface, bounce, wavelengths);
                result.radiance += *throughput * found;
            }
            if depth == 0 {
                let facing = if has_relief {
                    frame.to_world(bsdf.normal(wo))
                } else if wo.z < 0.0 {
                    -surface.shading_normal
                } else {
                    surface.shading_normal
                };
                result.first = Some(FirstHit {
                    position: surface.position,
                    normal: facing,
                    albedo: bsdf.albedo(wo),
                    object: world.objects[surface.instance as usize].object as u32,
                });
            }
            if throughput.is_zero() || world.integrator.max_depth.is_some_and(|most| depth >= most)
            {
                return;
            }
            if let Some(inside) = material.inside() {
                let entry = through_leaf::Entry {
                    inside,
                    at: (&hit, &surface, &frame, wo),
                    leg: (*throughput, width),
                    depth,
                };
                let Some(next) = self.through_leaf(&entry, stream, result) else {
                    return;
                };
                leg = next;
                continue;
            }
            let Some(view) = bsdf.seen_from(wo) else {
                return;
            };
            let set = CAMERA_SETS + depth * VERTEX_SETS;
            stream.seek(set);
            let numbers = stream.next4();
            let vertex = Vertex {
                paths: self,
                surface: &surface,
                frame: &frame,
                view: &view,
                receiver: Receiver {
                    position: surface.position,
                    normal: surface.shading_normal,
                },
                light_samples: if depth == 0 {
                    self.effort.light_samples
                } else {
                    1
                },
                throughput: *throughput,
                width,
                gathered: result.radiance,
            };
            let specular = bsdf.is_specular();
            if !specular {
                let [_, x, y, _] = numbers;
                let (light, rays) = sampled_light(world, &vertex, wavelengths, [x, y], stream);
                result.radiance += light;
                result.rays += rays;
            }
            if depth == 0 && self.effort.branches > 1 && !specular && result.radiance.is_zero() {
                for number in 0..self.effort.branches {
                    let mut stream = stream.part(number, self.effort.branches);
                    stream.seek(set);
                    let share = 1.0 / self.effort.branches as f32;
                    if let Some(leg) = vertex.bounce(stream.next4(), share, 0.0) {
                        self.follow(leg, 1, &mut stream, result);
                    }
                }
                return;
            }
            let Some(next) = vertex.bounce(numbers, 1.0, self.effort.roulette_below) else {
                return;
            };
            leg = next;
        }
    }
}

/// The bounce from which a ray originates.
struct Bounce {
    /// Density of its direction; infinite if no light sample could have chosen the same direction.
    pdf: f32,
    /// The point where it started; used only if the density is finite.
    from: Receiver,
    /// Number of lights chosen there.
    light_samples: u32,
}

/// An illuminated surface point.
struct Vertex<'a, const N: usize> {
    paths: &'a Paths<'a, N>,
    surface: &'a SurfacePoint,
    frame: &'a Frame,
    view: &'a View<'a, N>,
    receiver: Receiver,
    /// Number of lights that are chosen and sampled.
    light_samples: u32,
    /// Factor on radiance from here, up to the camera.
    throughput: Lanes<N>,
    /// Width of the ray that found it, m.
    width: f32,
    /// Radiance that the path has found so far.
    gathered: Lanes<N>,
}

impl<const N: usize> Vertex<'_, N> {
    /// The leg that leaves by a random bounce with a share of the throughput; `None` if Russian
    /// roulette, below a threshold, ends the path.
    fn bounce(&self, numbers: [f32; 4], share: f32, roulette_below: f32) -> Option<Leg<N>> {
        let [lobe, x, y, roulette] = numbers;
        let sample = self.view.sample(lobe, Vec2::new(x, y))?;
        let mut throughput = self.throughput * sample.weight * share;
        let Paths {
            world, wavelengths, ..
        } = self.paths;
        let brightness = world.wavelengths.brightness(wavelengths, &throughput);
        if brightness <= 0.0 {
            return None;
        }
        if brightness < roulette_below {
            let survival = brightness / roulette_below;
            if roulette >= survival {
                return None;
            }
            throughput *= 1.0 / survival;
        }
        let pdf = if sample.specular {
            f32::INFINITY
        } else {
            sample.pdf
        };
        Some(Leg {
            ray: self.surface.spawn(self.frame.to_world(sample.wi)),
            throughput,
            cone: Cone::scattered(self.width),
            bounce: Bounce {
                pdf,
                from: self.receiver,
                light_samples: self.light_samples,
            },
        })
    }
}

/// The radiance that the sampled lights contribute at a vertex, and the number of rays traced for
/// it.
fn sampled_light<const N: usize>(
    world: &World,
    vertex: &Vertex<'_, N>,
    wavelengths: &Wavelengths<N>,
    [x, y]: [f32; 2],
    stream: &Stream,
) -> (Lanes<N>, u32) {
    let (mut sum, mut rays) = (Lanes::ZERO, 0);
    for &number in &world.selection.always {
        let choice = Choice::certain(number);
        // A sun shares the random numbers of the bounce. Both contributions are added, so only
        // their covariance matters, and that is small for a disc of half a degree.
        let (light, traced) = direct(world, &choice, vertex, wavelengths, [x, y], None);
        sum += light;
        rays += traced;
    }
    if !world.selection.is_empty() {
        for number in 0..vertex.light_samples {
            let [which, x, y, coin] = stream.part(number, vertex.light_samples).next4();
            if let Some(choice) = world.selection.choose(&vertex.receiver, which) {
                let choice = Choice {
                    expected: choice.expected * vertex.light_samples as f32,
                    ..choice
                };
                let (light, traced) =
                    direct(world, &choice, vertex, wavelengths, [x, y], Some(coin));
                sum += light;
                rays += traced;
            }
        }
    }
    (sum, rays)
}

/// Light from infinity that a bounce or the camera ray found.
fn from_infinity<const N: usize>(
    world: &World,
    direction: Vec3,
    bounce: &Bounce,
    wavelengths: &Wavelengths<N>,
) -> Lanes<N> {
    let mut sum = Lanes::ZERO;
    for &number in &world.selection.at_infinity {
        let light = &world.lights[number];
        if let Some((radiance, pdf)) = light.at_infinity(direction, wavelengths) {
            let chosen = bounce.light_samples as f32;
            let samples = world
                .selection
                .samples_of_infinite(number, &bounce.from, chosen);
            sum += radiance * mis::power(bounce.pdf, pdf * samples);
        }
    }
    sum
}

/// Light of an emitting surface that a bounce or the camera ray hit.
fn emission<const N: usize>(
    world: &World,
    number: usize,
    ray: &Ray,
    surface: &SurfacePoint,
    bounce: &Bounce,
    wavelengths: &Wavelengths<N>,
) -> Lanes<N> {
    let Light::Area(light) = &world.lights[number] else {
        return Lanes::ZERO;
    };
    let normal = surface.geometric_normal;
    let place = (surface.triangle, surface.position);
    let Some(radiance) = light.emitted(ray.direction, normal, place, wavelengths) else {
        return Lanes::ZERO;
    };
    if bounce.pdf.is_infinite() {
        return radiance;
    }
    let light_pdf = light.patch_of(surface.triangle).map_or(0.0, |part| {
        bounce.light_samples as f32
            * world
                .selection
                .probability_of_part(number, part, &bounce.from)
            * light.pdf(part, &bounce.from, surface.position)
    });
    radiance * mis::power(bounce.pdf, light_pdf)
}

/// Light samples that would add less than this share of the path's radiance so far, in every lane,
/// undergo Russian roulette before the shadow ray.
const FAINT: f32 = 0.2;

/// The contribution of a chosen light at a vertex, up to the camera, and the number of rays traced
/// for it.
///
/// `place` selects a place on the light; `coin` is the random number for the roulette of faint
/// samples, which is skipped without it.
fn direct<const N: usize>(
    world: &World,
    choice: &Choice,
    vertex: &Vertex<'_, N>,
    wavelengths: &Wavelengths<N>,
    place: [f32; 2],
    coin: Option<f32>,
) -> (Lanes<N>, u32) {
    let light = &world.lights[choice.light];
    let place = Vec2::from_array(place);
    let Some(sample) = light.sample(choice.part, &vertex.receiver, wavelengths, place) else {
        return (Lanes::ZERO, 0);
    };
    let wi = vertex.frame.to_local(sample.wi);
    let Scattered { f, pdf } = vertex.view.scatter(wi);
    let scattered = f * wi.z.abs();
    if scattered.is_zero() || sample.radiance.is_zero() {
        return (Lanes::ZERO, 0);
    }
    let light_pdf = sample.pdf * choice.expected;
    let by_bounce = if sample.is_point { 0.0 } else { pdf };
    let weight = mis::power(light_pdf, by_bounce) / light_pdf;
    let mut added = vertex.throughput * scattered * sample.radiance * weight;
    // This is unbiased, since the radiance found before does not depend on this sample.
    if let Some(coin) = coin {
        let survival = survival(added, vertex.gathered * FAINT);
        if coin >= survival {
            return (Lanes::ZERO, 0);
        }
        if survival < 1.0 {
            added *= 1.0 / survival;
        }
    }
    let shadow = match sample.point {
        Some(point) => vertex.surface.spawn_to(point),
        None => vertex.surface.spawn(sample.wi),
    };
    if world.geometry.occluded(&shadow) {
        return (Lanes::ZERO, 1);
    }
    (added, 1)
}

/// The greatest ratio, over the lanes, of `added` to `enough`; infinite if `enough` is 0 in a lane
/// to which anything is added.
fn survival<const N: usize>(added: Lanes<N>, enough: Lanes<N>) -> f32 {
    let mut greatest = 0.0_f32;
    for (added, enough) in added.0.into_iter().zip(enough.0) {
        // 0 / 0 is NaN, which `max` ignores.
        greatest = greatest.max(added / enough);
    }
    greatest
}
