//! Lights.

use std::f64::consts::PI;
use std::path::Path;

use glam::DVec3;

use crate::export::element::{Element, Layout};
use crate::scene::description::{Light, Named, Spectrum};
use crate::scene::world::World;

use super::plugin::look_at;
use super::spectra::Spectra;
use super::units::UNITS_PER_METRE;

/// Distance of suns in scene radii. Over the scene irradiance deviates from that at the centre by
/// up to twice the inverse of this.
const SUN_DISTANCE: f64 = 1e5;

/// Path, within the export, of the picture of an environment light.
pub(super) fn environment_file(light: &str, file: &Path) -> String {
    let ending = file
        .extension()
        .and_then(|ending| ending.to_str())
        .unwrap_or("exr");
    format!("maps/environment-{light}.{ending}")
}

/// The emitter of a light; `None` if it is written with its shape or not at all.
pub(super) fn emitter(
    light: &Named<Light>,
    world: &World,
    spectra: &mut Spectra,
) -> Option<Element> {
    match &light.value {
        // Daylight was refused before anything is written.
        Light::Area { .. } | Light::Daylight(_) => None,
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
        Light::Spot {
            position,
            look_at: target,
            cone_angle,
            penumbra_angle,
            intensity,
        } => {
            let [origin, target] = [position, target].map(|place| place * UNITS_PER_METRE);
            let up = (target - origin).normalize().any_orthonormal_vector();
            let beam = cone_angle - penumbra_angle;
            // Intensity over the square of a distance in Mitsuba's units must equal irradiance in
            // ours.
            let factor = UNITS_PER_METRE * UNITS_PER_METRE;
            let spot = Element::plugin("emitter", "spot")
                .placed([look_at(origin, target, up)])
                .float("cutoff_angle", cone_angle.to_degrees())
                .float("beam_width", beam.max(0.0).to_degrees());
            Some(spot.holding(spectra.element("intensity", intensity, factor)))
        }
    }
}

/// The emitter that makes a shape emit a radiance times a factor.
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
    let middle = ((low + high).as_dvec3() * 0.5 + world.origin) * UNITS_PER_METRE;
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

    #[test]
    fn daylight_is_refused_before_anything_is_written() {
        let text = format!("{SCENE}[lights.noon.daylight]\nelevation_deg = 60\n");
        let scene = parse(&text, "scene.toml", Path::new("."), &[]);
        let scene = scene.expect("the test's own scene is right").description;
        let world = World::build(&scene).expect("the test's own scene can be built");
        let folder = tempfile::tempdir().expect("a folder");
        let out = folder.path().join("out");
        let refused = crate::export::mitsuba::write(&scene, &world, &out);
        let text = refused.expect_err("Mitsuba has no such light").to_string();
        assert!(text.contains("lights.noon.daylight"), "{text}");
        assert!(!out.exists());
    }
}
