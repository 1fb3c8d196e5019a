//! A mesh placed in the scene.

use document::limits::Limits;
use glam::{Affine3A, DAffine3, DVec3, Mat3, Mat3A};

/// A mesh placed in the scene. Its place is in double precision until it is known relative to the
/// origin around which rays are traced, so that it is as exact far from the scene's origin as there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index of the mesh.
    pub mesh: u32,
    /// Linear part of the transform from the mesh's frame to the scene's; invertible. It may rotate,
    /// scale, shear and mirror.
    pub linear: Mat3,
    /// Where the origin of the mesh's frame lies in the scene, m.
    pub translation: DVec3,
}

impl Instance {
    /// A mesh, placed by the transform from its frame to the scene's.
    pub fn new(mesh: u32, to_scene: &DAffine3) -> Self {
        Self {
            mesh,
            linear: to_scene.matrix3.as_mat3(),
            translation: to_scene.translation,
        }
    }

    /// From the mesh's frame to the scene's.
    pub fn to_scene(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(self.linear.as_dmat3(), self.translation)
    }

    /// From the mesh's frame to the scene's, moved so that `origin` is the origin.
    pub fn around(&self, origin: DVec3) -> Affine3A {
        Affine3A {
            matrix3: Mat3A::from(self.linear),
            translation: (self.translation - origin).as_vec3a(),
        }
    }
}

/// Limits of world coordinates, m. Beyond them single precision does not resolve a leaf.
pub const COORDINATES_M: Limits = Limits::closed(-1e6, 1e6);

/// Distance of places from the scene's origin up to which rays are traced around that, m. Single
/// precision resolves 0.01 mm there.
pub const FAR: f64 = 100.0;

/// The origin around which rays near a point of the scene are traced in single precision: the
/// scene's own, or for a point far from it that point in whole metres.
pub fn origin_near(point: DVec3) -> DVec3 {
    if point.length() <= FAR {
        DVec3::ZERO
    } else {
        point.round()
    }
}
