//! The path estimator: unidirectional, with light samples at every vertex.

use glam::{Vec2, Vec3};

use crate::bsdf::{Scattered, View};
use crate::geometry::frame::Frame;
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::integrator::mis;
use crate::light::Light;
use crate::sampling::stream::Stream;
use crate::scene::world::World;
use crate::spectrum::{Lanes, Wavelengths};

/// Sets of four random numbers before the first vertex: film and wavelength, lens.
pub const CAMERA_SETS: u32 = 2;
/// Sets of four random numbers that a vertex owns, used or not: the bounce, and light that is chosen.
const VERTEX_SETS: u32 = 2;

/// What one path found.
#[derive(Clone, Copy, Debug)]
pub struct PathResult<const N: usize> {
    /// Radiance along the camera ray, W m⁻² sr⁻¹ nm⁻¹.
    pub radiance: Lanes<N>,
    /// What the camera ray met first.
    pub first: Option<FirstHit<N>>,
    /// Rays traced, shadow rays included.
    pub rays: u32,
}

/// What the camera ray met first.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit<const N: usize> {
    /// Distance, m.
    pub distance: f32,
    /// Point, world, m.
    pub position: Vec3,
    /// Shading normal on the side of the camera, world.
    pub normal: Vec3,
    /// Share of light that the surface scatters.
    pub albedo: Lanes<N>,
    /// Number of the object in the scene.
    pub object: u32,
}

/// Radiance that arrives along `ray`, whose direction is a unit vector.
///
/// At every vertex each sun and one other light are sampled and weighed against the bounce by the power heuristic. Roulette
/// is played below the scene's threshold only and leaves the mean as it is; its survival probability is the throughput
/// over that threshold.
pub fn trace<const N: usize>(
    world: &World,
    mut ray: Ray,
    wavelengths: Wavelengths<N>,
    stream: &mut Stream,
) -> PathResult<N> {
    let mut result = PathResult {
        radiance: Lanes::ZERO,
        first: None,
        rays: 0,
    };
    let mut throughput = Lanes::<N>::ONE;
    // Density of the bounce that led here; infinite if no light sample could have found the same way.
    let mut bounce_pdf = f32::INFINITY;
    for depth in 0_u32.. {
        result.rays += 1;
        let Some(hit) = world.geometry.intersect(&ray) else {
            result.radiance +=
                throughput * from_infinity(world, ray.direction, bounce_pdf, &wavelengths);
            break;
        };
        let surface = world.geometry.surface(&ray, &hit);
        if let Some(number) = world.objects[surface.instance as usize].light {
            let found = emission(world, number, &ray, &surface, bounce_pdf, &wavelengths);
            result.radiance += throughput * found;
        }
        let bsdf = world
            .material_of(surface.instance)
            .bsdf(surface.uv, &wavelengths);
        let frame = Frame::new(surface.shading_normal, surface.tangent);
        let wo = frame.to_local(-ray.direction);
        if depth == 0 {
            let facing = if wo.z < 0.0 {
                -surface.shading_normal
            } else {
                surface.shading_normal
            };
            result.first = Some(FirstHit {
                distance: (surface.position - ray.origin).length(),
                position: surface.position,
                normal: facing,
                albedo: bsdf.albedo(),
                object: world.objects[surface.instance as usize].object as u32,
            });
        }
        if world.integrator.max_depth.is_some_and(|most| depth >= most) {
            break;
        }
        let Some(view) = bsdf.seen_from(wo) else {
            break;
        };
        stream.seek(CAMERA_SETS + depth * VERTEX_SETS);
        let [lobe, bounce_x, bounce_y, roulette] = stream.next4();
        if !bsdf.is_specular() {
            let vertex = Vertex {
                surface: &surface,
                frame: &frame,
                view: &view,
            };
            for &number in &world.selection.always {
                // A sun shares the numbers of the bounce: what both find is added up, so that only their
                // covariance matters, and a disc of half a degree looks the same wherever it is lit from.
                let u = [0.0, bounce_x, bounce_y, 0.0];
                let (light, rays) = direct(world, number, 1.0, &vertex, &wavelengths, u);
                result.radiance += throughput * light;
                result.rays += rays;
            }
            if world.selection.chosen.is_empty() {
                // Nothing to choose from: no numbers are drawn.
            } else if let [which, x, y, _] = stream.next4()
                && let Some((number, choice)) = world.selection.choose(which)
            {
                let chance = world.selection.probability(number);
                let u = [choice, x, y, 0.0];
                let (light, rays) = direct(world, number, chance, &vertex, &wavelengths, u);
                result.radiance += throughput * light;
                result.rays += rays;
            }
        }
        let Some(sample) = view.sample(lobe, Vec2::new(bounce_x, bounce_y)) else {
            break;
        };
        throughput *= sample.weight;
        let brightest = throughput.max_lane();
        if brightest <= 0.0 {
            break;
        }
        let threshold = world.integrator.roulette_below as f32;
        if brightest < threshold {
            let survival = brightest / threshold;
            if roulette >= survival {
                break;
            }
            throughput *= 1.0 / survival;
        }
        bounce_pdf = if sample.specular {
            f32::INFINITY
        } else {
            sample.pdf
        };
        ray = surface.spawn(frame.to_world(sample.wi));
    }
    result
}

/// A surface point being lit.
struct Vertex<'a, const N: usize> {
    surface: &'a SurfacePoint,
    frame: &'a Frame,
    view: &'a View<'a, N>,
}

/// Light from infinity that a bounce (or the camera) found by itself.
fn from_infinity<const N: usize>(
    world: &World,
    direction: Vec3,
    bounce_pdf: f32,
    wavelengths: &Wavelengths<N>,
) -> Lanes<N> {
    let mut sum = Lanes::ZERO;
    for (number, light) in world.lights.iter().enumerate() {
        if let Some((radiance, pdf)) = light.at_infinity(direction, wavelengths) {
            let light_pdf = pdf * world.selection.probability(number);
            sum += radiance * mis::power(bounce_pdf, light_pdf);
        }
    }
    sum
}

/// Light of a shining surface that a bounce (or the camera) ran into.
fn emission<const N: usize>(
    world: &World,
    number: usize,
    ray: &Ray,
    surface: &SurfacePoint,
    bounce_pdf: f32,
    wavelengths: &Wavelengths<N>,
) -> Lanes<N> {
    let Light::Area(light) = &world.lights[number] else {
        return Lanes::ZERO;
    };
    let offset = surface.position - ray.origin;
    let distance = offset.length();
    light
        .emitted(
            ray.direction,
            surface.geometric_normal,
            distance,
            wavelengths,
        )
        .map_or(Lanes::ZERO, |(radiance, pdf)| {
            radiance * mis::power(bounce_pdf, pdf * world.selection.probability(number))
        })
}

/// What one light sends to a vertex and on towards the camera; `chance` is the probability that it was asked.
///
/// Also the number of rays it took.
fn direct<const N: usize>(
    world: &World,
    number: usize,
    chance: f32,
    vertex: &Vertex<'_, N>,
    wavelengths: &Wavelengths<N>,
    u: [f32; 4],
) -> (Lanes<N>, u32) {
    let place = Vec2::new(u[1], u[2]);
    let light = &world.lights[number];
    let Some(sample) = light.sample(vertex.surface.position, wavelengths, u[0], place) else {
        return (Lanes::ZERO, 0);
    };
    let wi = vertex.frame.to_local(sample.wi);
    let Scattered { f, pdf } = vertex.view.scatter(wi);
    let scattered = f * wi.z.abs();
    if scattered.is_zero() || sample.radiance.is_zero() {
        return (Lanes::ZERO, 0);
    }
    let shadow = match sample.point {
        Some(point) => vertex.surface.spawn_to(point),
        None => vertex.surface.spawn(sample.wi),
    };
    if world.geometry.occluded(&shadow) {
        return (Lanes::ZERO, 1);
    }
    let light_pdf = sample.pdf * chance;
    let weight = mis::power(light_pdf, pdf) / light_pdf;
    (scattered * sample.radiance * weight, 1)
}
