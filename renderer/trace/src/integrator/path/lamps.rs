//! Light samples at a vertex.

use glam::{Vec2, Vec3};

use super::vertex::Vertex;
use crate::bsdf::Scattered;
use crate::geometry::Ray;
use crate::integrator::mis;
use crate::light::selection::Choice;
use crate::medium::Inside;
use crate::sampling::stream::Stream;
use crate::spectrum::{Lanes, Wavelengths};
use crate::world::World;

/// The radiance that the sampled lights contribute at a vertex, and the number of rays traced for
/// it.
pub(in crate::integrator) fn sampled_light<const N: usize>(
    world: &World,
    vertex: &Vertex<'_, N>,
    wavelengths: &Wavelengths<N>,
    [x, y]: [f32; 2],
    stream: &Stream,
) -> (Lanes<N>, u32) {
    let (mut sum, mut rays) = (Lanes::ZERO, 0);
    let selection = vertex.paths.selection();
    for &number in &selection.always {
        let choice = Choice::certain(number);
        // A sun shares the random numbers of the bounce, where paths do not branch. Both
        // contributions are added, so only their covariance matters, and that is small for a disc
        // of half a degree.
        let (light, traced) = direct(world, &choice, vertex, wavelengths, [x, y], None);
        sum += light;
        rays += traced;
    }
    if !selection.is_empty() {
        for number in 0..vertex.light_samples {
            let [which, x, y, coin] = stream.part(number, vertex.light_samples).next4();
            if let Some(choice) = selection.choose(&vertex.receiver, which) {
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
    let Scattered { f: scattered, pdf } = vertex.scatterer.scatter(sample.wi);
    if scattered.is_zero() || sample.radiance.is_zero() {
        return (Lanes::ZERO, 0);
    }
    let light_pdf = sample.pdf * choice.expected;
    let by_bounce = if sample.is_point { 0.0 } else { pdf };
    let weight = mis::power_over_own(light_pdf, by_bounce);
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
        Some(point) => vertex.scatterer.spawn_to(sample.wi, point),
        None => vertex.scatterer.spawn(sample.wi),
    };
    if world.media.are_present {
        let inside = vertex.inside_towards(sample.wi);
        let (share, rays) = transmittance(world, shadow, sample.point, inside, wavelengths);
        return (added * share, rays);
    }
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

/// Share of light that comes straight along a ray, to a point at its end or from infinity, through
/// media and boundaries with one index on both sides; and the number of rays traced for it.
#[inline(never)]
fn transmittance<const N: usize>(
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
            let medium = world.media.media[number as usize].at(ray.direction(), wavelengths);
            left *= medium.transmittance(length);
        }
        let Some(hit) = hit else {
            return (left, rays);
        };
        let body = world.objects[hit.instance as usize].body;
        let Some(body) = body.filter(|body| body.is_matched && !left.is_zero()) else {
            return (Lanes::ZERO, rays);
        };
        let surface = world.geometry.surface(&hit);
        let place = world.objects.body_place(hit.instance);
        let normal = surface.geometric_normal;
        inside.leave_boundary(place, body, normal, ray.direction());
        from = hit.t;
        ray = ray.starting_at(from.next_up());
    }
}
