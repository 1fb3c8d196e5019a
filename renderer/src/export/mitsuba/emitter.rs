//! Lights.

use glam::DVec3;

use crate::light;
use crate::material::colour_map::ColourMap;
use crate::plugin::element::{Element, Layout};
use crate::plugin::emitter::Emitter;
use crate::plugin::spectra::Spectra;
use crate::plugin::{UNITS_PER_METRE, look_at};
use crate::scene::description::Light;
use crate::scene::world::World;

/// Distance of suns in scene radii. Over the scene irradiance deviates from that at the centre by
/// up to twice the inverse of this.
const SUN_DISTANCE: f64 = 1e5;

/// The emitter of a light with a place or a disc of its own; `None` if it is written with its shape
/// or [around](super::surroundings) the scene.
pub(super) fn emitter(light: &Light, world: &World, spectra: &mut Spectra) -> Option<Element> {
    match light.emitter(spectra) {
        Emitter::OnShape | Emitter::Around(_) => None,
        Emitter::Placed(emitter) => Some(emitter),
        Emitter::Disc {
            towards,
            half,
            emitter,
        } => Some(disk(towards, half, emitter, world)),
    }
}

/// What the materials of a model emit that is the light of which these were built, if it is one.
pub(super) fn emission(built: &[light::Light]) -> Option<&ColourMap> {
    if let [light::Light::Area(area)] = built {
        area.emission()
    } else {
        None
    }
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
        let spot = emitter(&scene.lights[0].value, &world, &mut Spectra::default());
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
