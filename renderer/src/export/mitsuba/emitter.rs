//! Lights.

use std::f64::consts::PI;

use glam::DVec3;

use crate::export::element::{Element, Layout};
use crate::light;
use crate::light::daylight::sun::HALF_DIAMETER as SUN_HALF_DIAMETER;
use crate::material::colour_map::ColourMap;
use crate::scene::description::light::area::AreaPattern;
use crate::scene::description::{Description, Light, Named, Spectrum};
use crate::scene::world::World;
use crate::spectrum::Curve;
use crate::spectrum::rgb::Primaries;

use super::colours;
use super::plugin::look_at;
use super::spectra::Spectra;
use super::units::{UNITS_PER_METRE, light_id, weights_file};

/// Distance of suns in scene radii. Over the scene irradiance deviates from that at the centre by
/// up to twice the inverse of this.
const SUN_DISTANCE: f64 = 1e5;

/// The emitter of a light with a place or a disc of its own; `None` if it is written with its shape
/// or [around](super::surroundings) the scene.
pub(super) fn emitter(
    light: &Named<Light>,
    world: &World,
    spectra: &mut Spectra,
) -> Option<Element> {
    match &light.value {
        Light::Area(_) | Light::Constant(_) | Light::Environment(_) | Light::Overcast(_) => None,
        Light::Daylight(day) => {
            let irradiance = day.lights().0.irradiance().written();
            let limb = Element::plugin("texture", "lamina_sun").with("name", "radiance");
            let spectrum = spectra.element("irradiance", &irradiance, 1.0);
            let limb = limb
                .holding(spectrum)
                .float("half_diameter", SUN_HALF_DIAMETER);
            let emitter = Element::plugin("emitter", "area").holding(limb);
            let towards = day.towards_sun();
            Some(disk(towards, SUN_HALF_DIAMETER, emitter, world))
        }
        Light::Distant(light) => {
            let half = 0.5 * light.angular_diameter;
            let sin = libm::sin(half);
            let emitter = area(&light.irradiance, None, 1.0 / (PI * sin * sin), spectra);
            Some(disk(light.towards, half, emitter, world))
        }
        Light::Spot(light) => {
            let places = [light.position, light.look_at];
            let [origin, target] = places.map(|place| place * UNITS_PER_METRE);
            let up = (target - origin).normalize().any_orthonormal_vector();
            let beam = light.cone_angle - light.penumbra_angle;
            // Intensity over the square of a distance in Mitsuba's units must equal irradiance in
            // ours.
            let factor = UNITS_PER_METRE * UNITS_PER_METRE;
            let spot = Element::plugin("emitter", "spot")
                .placed([look_at(origin, target, up)])
                .float("cutoff_angle", light.cone_angle.to_degrees())
                .float("beam_width", beam.max(0.0).to_degrees());
            Some(spot.holding(spectra.element("intensity", &light.intensity, factor)))
        }
    }
}

/// The emitter that makes a shape emit a radiance times a factor, in the pattern of an area light.
pub(super) fn area(
    radiance: &Spectrum,
    pattern: Option<(&str, &AreaPattern, Option<&ColourMap>)>,
    factor: f64,
    spectra: &mut Spectra,
) -> Element {
    let even = spectra.element("radiance", radiance, factor);
    let radiance = match pattern {
        None => even,
        Some((light, pattern, emission)) => {
            let texture = Element::plugin("texture", "lamina_pattern").with("name", "radiance");
            let texture = texture.holding(even).float("edge_share", pattern.edge);
            if emission.is_some() {
                texture.holding(colours::texture(&light_id(light), "colours", emission))
            } else if pattern.picture.is_some() {
                texture
                    .string("picture", weights_file(light))
                    .holding_all(primaries(spectra))
            } else {
                texture
            }
        }
    };
    Element::plugin("emitter", "area")
        .holding(radiance)
        .laid_out(Layout::Level)
}

/// What the materials of a model emit that is the light with this number, if it is one.
pub(super) fn emission<'w>(
    scene: &Description,
    world: &'w World,
    number: usize,
) -> Option<&'w ColourMap> {
    let before = scene.lights[..number].iter();
    let first: usize = before.map(|light| light.value.parts()).sum();
    if let Some(light::Light::Area(area)) = world.lights.get(first) {
        area.emission()
    } else {
        None
    }
}

/// The spectra of red, green and blue under an even white of 1.
fn primaries(spectra: &mut Spectra) -> [Element; 3] {
    let primaries = Primaries::new(Curve::Constant(1.0)).curves();
    let named = ["red", "green", "blue"].into_iter().zip(&primaries);
    let elements: Vec<_> = named
        .map(|(name, curve)| spectra.element(name, &curve.written(), 1.0))
        .collect();
    elements
        .try_into()
        .unwrap_or_else(|_| unreachable!("three"))
}

/// Distance of what shines from infinity, mm, and the middle of the scene, mm.
pub(super) fn far(world: &World) -> (f64, DVec3) {
    let (low, high) = world.geometry.bounds();
    let middle = ((low + high).as_dvec3() * 0.5 + world.geometry.origin()) * UNITS_PER_METRE;
    let radius = f64::from((high - low).length()) * 0.5 * UNITS_PER_METRE;
    (SUN_DISTANCE * radius, middle)
}

/// A shape that shines and reflects nothing.
pub(super) fn shining(shape: Element, emitter: Element) -> Element {
    let black = Element::new("spectrum").with("name", "reflectance");
    let black = Element::plugin("bsdf", "diffuse").holding(black.with("value", 0));
    shape
        .holding(black.laid_out(Layout::Inline))
        .holding(emitter)
}

/// A disk of the size of a disc in the sky with this half of an angle, seen from the middle of the
/// scene.
fn disk(towards: DVec3, half: f64, emitter: Element, world: &World) -> Element {
    let (distance, middle) = far(world);
    let up = towards.any_orthonormal_vector();
    let disk = Element::plugin("shape", "disk").placed([
        Element::new("scale").with("value", distance * libm::tan(half)),
        look_at(middle + towards * distance, middle, up),
    ]);
    shining(disk, emitter)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::scene::load::parse;

    const SCENE: &str = r#"
format = 1
[film.spectral]
size = [8, 8]
spp = 1
bands_nm = [550]
[camera.perspective]
position_m = [0, -1, 1]
look_at_m = [0, 0, 0]
vertical_fov_deg = 40
[meshes.floor.rectangle]
width_m = 1
height_m = 1
[materials.grey.diffuse]
reflectance = 0.5
[objects.floor]
mesh = "floor"
material = "grey"
[lights.bench.spot]
intensity_w_sr_nm = 2
position_m = [0, 0, 1]
look_at_m = [0.5, 0, 1]
cone_angle_deg = 30
penumbra_angle_deg = 10
"#;

    #[test]
    fn a_spot_is_mitsubas_with_the_intensity_for_millimetres() {
        let scene = parse(SCENE, "scene.toml", Path::new("."), &[]);
        let scene = scene.expect("the test's own scene is right").description;
        let world = World::build(&scene).expect("the test's own scene can be built");
        let spot = emitter(&scene.lights[0], &world, &mut Spectra::default());
        let text = spot.expect("a spot stands alone").to_string();
        for part in [
            "<emitter type=\"spot\">",
            "<lookat origin=\"0, 0, 1000\" target=\"500, 0, 1000\"",
            "<spectrum name=\"intensity\" value=\"300:2000000, 2600:2000000\"/>",
        ] {
            assert!(text.contains(part), "{part} is not in {text}");
        }
        for (name, degrees) in [("cutoff_angle", 30.0), ("beam_width", 20.0)] {
            let (_, value) = text.split_once(name).expect(name);
            let value: f64 = value
                .split('"')
                .nth(2)
                .and_then(|value| value.parse().ok())
                .expect("a number");
            assert!((value - degrees).abs() < 1e-9, "{name}: {value}");
        }
    }
}
