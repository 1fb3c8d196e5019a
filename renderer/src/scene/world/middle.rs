//! Where an object is, for a camera that focuses on it.

use glam::DVec3;

use super::seen::corners_of;
use crate::geometry::{Instance, TriangleMesh};
use trace::world::WorldObjects;

/// The middle of the box, along the axes of the scene, around all parts of an object in all its
/// places, m.
///
/// Each part counts with its box in its own frame, so that an object with a million places costs
/// no more than its places.
pub(super) fn of_object(
    object: usize,
    meshes: &[TriangleMesh],
    instances: &[Instance],
    objects: &WorldObjects,
) -> DVec3 {
    let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (number, instance) in instances.iter().enumerate() {
        if objects[number].object != object {
            continue;
        }
        for corner in corners_of(instance, meshes) {
            least = least.min(corner);
            most = most.max(corner);
        }
    }
    0.5 * (least + most)
}
