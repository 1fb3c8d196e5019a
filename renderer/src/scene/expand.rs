//! From what a scene file says to shapes and places: lights of rigs are set up, plants grow, and leaves
//! that differ become leaves of their own.

mod boughs;
mod individuals;
mod planted;
pub(super) mod rigs;
mod walls;

use leafmodel::document::names::Named;

pub(super) use self::planted::Fault;
use self::planted::Planted;
use super::authored::{Authored, Light};
use super::description::{Description, Instrument, Shape};

/// The scene as shapes and places.
///
/// # Errors
///
/// The first [`Fault`], if a plant cannot grow or leaves cannot differ as they should.
pub(super) fn expand(authored: Authored) -> Result<Description, Fault> {
    let objects = authored.objects.iter();
    let planted = Planted {
        of_object: objects.map(|object| object.value.plant).collect(),
        plants: authored.plants,
    };
    let mut scene = Description {
        name: authored.name,
        source: authored.source,
        film: authored.film,
        picture: authored.picture,
        camera: authored.camera,
        integrator: authored.integrator,
        media: authored.media,
        materials: authored.materials,
        meshes: renamed(authored.meshes, Shape::Mesh),
        leaves: authored.leaves,
        solids: authored.solids,
        lights: Vec::new(),
        objects: renamed(authored.objects, |object| object.placed),
        instruments: authored.instruments,
        crossing: Vec::new(),
    };
    take_spectra(&authored.lights, &mut scene.instruments);
    rigs::set_up(&mut scene, authored.lights);
    individuals::grow_apart(&mut scene, &planted)?;
    boughs::place(&mut scene, &planted)?;
    Ok(scene)
}

/// Other values by the same names.
fn renamed<A, B>(blocks: Vec<Named<A>>, other: impl Fn(A) -> B) -> Vec<Named<B>> {
    let blocks = blocks.into_iter();
    let blocks = blocks.map(|Named { name, value }| Named {
        name,
        value: other(value),
    });
    blocks.collect()
}

/// Gives instruments the spectra of the lights that they name, by their numbers in the file.
fn take_spectra(lights: &[Named<Light>], instruments: &mut [Named<Instrument>]) {
    for instrument in instruments {
        if let Some(incident) = &mut instrument.value.incident
            && let Some(number) = incident.light
            && let Light::Single(light) = &lights[number].value
        {
            incident.spectrum = light.relative_spectrum();
        }
    }
}
