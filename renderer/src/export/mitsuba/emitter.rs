//! Lights.

use std::f64::consts::PI;
use std::path::Path;

use glam::DVec3;

use crate::export::element::{Element, Layout};
use crate::scene::description::{Light, Named, Spectrum};
use crate::scene::world::World;

use super::plugin::look_at;
use super::spectra::Spectra;
use super::xml::UNITS_PER_METRE;

/// Suns stand this many scene radii away: irradiance differs over the scene by twice its inverse, either way from the
/// middle.
const SUN_DISTANCE: f64 = 1e5;

/// Where in the export the picture of an environment light lies.
pub(super) fn environment_file(light: &str, file: &Path) -> String {
    let ending = file
        .extension()
        .and_then(|ending| ending.to_str())
        .unwrap_or("exr");
    format!("maps/environment-{light}.{ending}")
}

/// A light; `None` of one that is written with its shape.
pub(super) fn emitter(
    light: &Named<Light>,
    world: &World,
    spectra: &mut Spectra,
) -> Option<Element> {
    match &light.value {
        Light::Area { .. } => None,
        Light::Constant { radiance } => {
            let constant = Element::plugin("emitter", "constant");
            Some(constant.holding(spectra.element("radiance", radiance, 1.0)))
        }
        Light::Distant {
            towards,
            angular_diameter,
            irradiance,
        } => Some(sun(*towards, *angular_diameter, irradiance, world, spectra)),
        Light::Environment {
            file,
            scale,
            rotation,
            ..
        } => {
            let turn = |axis, degrees: f64| {
                let turn = Element::new("rotate").with(axis, 1);
                turn.with("angle", degrees)
            };
            let picture = Element::plugin("emitter", "envmap")
                .string("filename", environment_file(&light.name, file))
                .float("scale", *scale)
                .placed([turn("x", 90.0), turn("z", rotation.to_degrees())]);
            Some(picture.remarked("Mitsuba makes spectra of this picture in its own way."))
        }
    }
}

/// What makes a shape shine with a radiance times a factor.
pub(super) fn area(radiance: &Spectrum, factor: f64, spectra: &mut Spectra) -> Element {
    Element::plugin("emitter", "area")
        .holding(spectra.element("radiance", radiance, factor))
        .laid_out(Layout::Level)
}

/// A disk of the sun's angular size, seen from the middle of the scene.
fn sun(
    towards: DVec3,
    angular_diameter: f64,
    irradiance: &Spectrum,
    world: &World,
    spectra: &mut Spectra,
) -> Element {
    let (low, high) = world.geometry.bounds();
    let middle = (low + high).as_dvec3() * 0.5 * UNITS_PER_METRE;
    let distance = SUN_DISTANCE * f64::from((high - low).length()) * 0.5 * UNITS_PER_METRE;
    let radius = distance * libm::tan(0.5 * angular_diameter);
    let sin = libm::sin(0.5 * angular_diameter);
    let up = towards.any_orthonormal_vector();
    let black = Element::new("spectrum").with("name", "reflectance");
    let black = Element::plugin("bsdf", "diffuse").holding(black.with("value", 0));
    Element::plugin("shape", "disk")
        .placed([
            Element::new("scale").with("value", radius),
            look_at(middle + towards * distance, middle, up),
        ])
        .holding(black.laid_out(Layout::Inline))
        .holding(area(irradiance, 1.0 / (PI * sin * sin), spectra))
}
