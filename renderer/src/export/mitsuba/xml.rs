//! The scene description `scene.xml`.

use std::collections::BTreeSet;

use crate::camera;
use crate::export::element::{Document, Element};
use crate::scene::description::Description;
use crate::scene::world::World;

use super::bsdf::bsdf;
use super::emitter::emitter;
use super::plugin::look_at;
use super::shapes::{self, MeshFile};
use super::spectra::{self, Spectra};
use super::units::UNITS_PER_METRE;

/// The text of `scene.xml`, and the meshes that it uses; spectra that go into files are added to
/// `spectra`.
pub(super) fn scene(
    scene: &Description,
    world: &World,
    spectra: &mut Spectra,
) -> (String, BTreeSet<MeshFile>) {
    let root = Element::new("scene").with("version", "3.0.0");
    let mut document = Document::new(&root);
    document.add(&integrator(scene));
    document.add(&sensor(scene));
    for number in 0..world.materials.len() {
        document.add(&bsdf(scene, world, number, spectra));
    }
    let meshes = shapes::write(&mut document, scene, world, spectra);
    for light in &scene.lights {
        if let Some(emitter) = emitter(light, world, spectra) {
            document.add(&emitter);
        }
    }
    (document.finish(), meshes)
}

fn integrator(scene: &Description) -> Element {
    // Mitsuba counts the camera's own hit as depth 1.
    let depth = scene.integrator.max_depth;
    let depth = depth.map_or(-1, |most| i64::from(most) + 1);
    Element::plugin("integrator", "path")
        .integer("max_depth", depth)
        .integer("rr_depth", 1000)
}

fn sensor(scene: &Description) -> Element {
    let camera = &scene.camera;
    let axes = camera::Camera::axes(camera);
    let origin = camera.position * UNITS_PER_METRE;
    let target = origin + axes.z_axis * UNITS_PER_METRE;
    let has_lens = camera.lens_radius > 0.0;
    let kind = if has_lens { "thinlens" } else { "perspective" };
    let mut sensor = Element::plugin("sensor", kind)
        .placed([look_at(origin, target, axes.y_axis)])
        .float("fov", camera.vertical_fov.to_degrees())
        .string("fov_axis", "y")
        .float("near_clip", 0.1)
        .parameter("float", "far_clip", "1e9");
    if has_lens {
        sensor = sensor
            .float("aperture_radius", camera.lens_radius * UNITS_PER_METRE)
            .float("focus_distance", camera.focus_distance * UNITS_PER_METRE);
    }
    let sampler = Element::plugin("sampler", "independent");
    let bands = super::bands(scene);
    let bands = bands.iter().enumerate();
    let film = Element::plugin("film", "specfilm")
        .integer("width", scene.film.width)
        .integer("height", scene.film.height)
        .string("component_format", "float32")
        .holding(Element::plugin("rfilter", "box"))
        .holding_all(bands.map(|(number, band)| spectra::response(number, band)));
    sensor
        .holding(sampler.integer("sample_count", scene.film.spp))
        .holding(film)
}
