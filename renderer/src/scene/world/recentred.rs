//! A scene moved as a whole, so that single precision is fine enough around a camera far from the
//! origin.

use glam::{DMat4, DVec3};

use crate::scene::description::{Description, Light};

/// The scene, with everything that has a place moved by an offset.
pub(super) fn moved(scene: &Description, by: DVec3) -> Description {
    let mut scene = scene.clone();
    scene.camera = scene.camera.moved(by);
    for object in &mut scene.objects {
        let object = &mut object.value;
        object.to_world = DMat4::from_translation(by) * object.to_world;
        for place in object.instances.iter_mut().flatten() {
            *place = place.moved(by);
        }
    }
    for light in &mut scene.lights {
        match &mut light.value {
            Light::Spot {
                position, look_at, ..
            } => {
                *position += by;
                *look_at += by;
            }
            Light::Distant { .. }
            | Light::Constant { .. }
            | Light::Environment { .. }
            | Light::Daylight(_)
            | Light::Overcast { .. }
            // Its parts have taken its place.
            | Light::Rig(_)
            // Its place is that of its object.
            | Light::Area { .. } => {}
        }
    }
    scene
}
