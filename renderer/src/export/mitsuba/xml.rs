//! The scene description `scene.xml`.

use std::collections::BTreeSet;

use crate::plugin::element::{Document, Element};
use crate::scene::description::Description;
use crate::scene::world::World;

use super::bsdf::bsdf;
use super::emitter::emitter;
use super::media::media;
use super::sensor::sensor;
use super::shapes::{self, MeshFile};
use super::stock::Stock;
use super::surroundings;
use crate::export::names::material_id;
use crate::plugin::spectra::Spectra;

/// The text of `scene.xml`, and the meshes that it uses; spectra that go into files are added to
/// `spectra`.
pub(super) fn scene(
    scene: &Description,
    world: &World,
    stock: Option<&Stock<'_>>,
    spectra: &mut Spectra,
) -> (String, BTreeSet<MeshFile>) {
    let root = Element::new("scene").with("version", "3.0.0");
    let mut document = Document::new(&root);
    document.add(&integrator(scene, world.media.are_present));
    document.add(&sensor(scene, &world.view));
    for number in 0..world.materials.len() {
        let id = material_id(scene, world, number);
        let own = stock.and_then(|stock| stock.bsdf(number, &id));
        document.add(&own.unwrap_or_else(|| bsdf(scene, world, number, spectra)));
    }
    for medium in media(scene, spectra) {
        document.add(&medium);
    }
    let meshes = shapes::write(&mut document, scene, world, spectra);
    for light in &scene.lights {
        if let Some(emitter) = emitter(&light.value, world, spectra) {
            document.add(&emitter);
        }
    }
    for emitter in surroundings::emitters(scene, world, spectra) {
        document.add(&emitter);
    }
    (document.finish(), meshes)
}

/// The integrator; only that of media heeds boundaries without a change of index in shadows.
fn integrator(scene: &Description, has_media: bool) -> Element {
    // Mitsuba counts the camera's own hit as depth 1.
    let depth = scene.integrator.max_depth;
    let depth = depth.map_or(-1, |most| i64::from(most) + 1);
    let plugin = Element::plugin("integrator", if has_media { "volpath" } else { "path" })
        .integer("max_depth", depth)
        .integer("rr_depth", 1000);
    if scene.integrator.hide_lights {
        plugin.boolean("hide_emitters", true)
    } else {
        plugin
    }
}
