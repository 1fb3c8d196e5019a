//! Light that a path finds by its own way, weighted against the samples of lights.

use glam::Vec3;

use super::paths::Bounce;
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::integrator::mis;
use crate::light::Light;
use crate::light::selection::LightSelection;
use crate::spectrum::{Lanes, Wavelengths};

/// Light from infinity that a bounce or the camera ray found.
pub(super) fn from_infinity<const N: usize>(
    (lights, selection): (&[Light], &LightSelection),
    direction: Vec3,
    bounce: &Bounce,
    wavelengths: &Wavelengths<N>,
) -> Lanes<N> {
    let mut sum = Lanes::ZERO;
    for &number in &selection.at_infinity {
        let light = &lights[number];
        let samples = if bounce.pdf.is_infinite() {
            0.0
        } else {
            let chosen = bounce.light_samples as f32;
            selection.samples_of_infinite(number, &bounce.from, chosen)
        };
        if samples > 0.0 {
            if let Some((radiance, pdf)) = light.at_infinity(direction, wavelengths) {
                sum += radiance * mis::power(bounce.pdf, pdf * samples);
            }
        } else if let Some(radiance) = light.radiance_at_infinity(direction, wavelengths) {
            sum += radiance;
        }
    }
    sum
}

/// Light of an emitting surface that a bounce or the camera ray hit.
pub(super) fn emission<const N: usize>(
    (lights, selection): (&[Light], &LightSelection),
    number: usize,
    ray: &Ray,
    surface: &SurfacePoint,
    bounce: &Bounce,
    wavelengths: &Wavelengths<N>,
) -> Lanes<N> {
    let Light::Area(light) = &lights[number] else {
        return Lanes::ZERO;
    };
    let normal = surface.geometric_normal;
    let place = (surface.triangle, surface.position);
    let Some(radiance) = light.emitted(ray.direction(), normal, place, wavelengths) else {
        return Lanes::ZERO;
    };
    if bounce.pdf.is_infinite() {
        return radiance;
    }
    let light_pdf = light.patch_of(surface.triangle).map_or(0.0, |part| {
        bounce.light_samples as f32
            * selection.probability_of_part(number, part, &bounce.from)
            * light.pdf(part, &bounce.from, surface.position)
    });
    radiance * mis::power(bounce.pdf, light_pdf)
}
