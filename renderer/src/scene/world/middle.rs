//! Where an object is, for a camera that focuses on it.

use glam::{DVec3, Vec3};

use super::placing::WorldObjects;
use crate::geometry::{Instance, TriangleMesh};

/// The middle of the box, along the axes of the world, around all parts of an object in all its
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
        let (low, high) = meshes[instance.mesh as usize].bounds();
        for corner in 0..8 {
            let side = |axis: usize| {
                if corner >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            let corner = Vec3::new(side(0), side(1), side(2));
            let point = instance.to_world.transform_point3(corner).as_dvec3();
            least = least.min(point);
            most = most.max(point);
        }
    }
    0.5 * (least + most)
}
