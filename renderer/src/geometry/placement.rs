//! Instances prepared for tracing.

use glam::{DMat3, DVec3, Mat3, Vec3, Vec3A};

use super::instance::Instance;
use super::ray::Ray;

/// The data of an instance that a ray needs, in one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Carrier {
    /// World to local, for rays.
    pub(super) linear: Mat3,
    pub(super) offset: Vec3,
    pub(super) mesh: u32,
    pub(super) instance: u32,
}

impl Carrier {
    /// Origin and direction of the ray in the local frame, with the same `t`.
    #[inline(always)]
    pub(super) fn carry(&self, ray: &Ray) -> (Vec3A, Vec3A) {
        let [x, y, z] = [
            Vec3A::from(self.linear.x_axis),
            Vec3A::from(self.linear.y_axis),
            Vec3A::from(self.linear.z_axis),
        ];
        let (o, d) = (ray.origin, ray.direction);
        (
            x * Vec3A::splat(o.x)
                + y * Vec3A::splat(o.y)
                + z * Vec3A::splat(o.z)
                + Vec3A::from(self.offset),
            x * Vec3A::splat(d.x) + y * Vec3A::splat(d.y) + z * Vec3A::splat(d.z),
        )
    }
}

/// An instance with derived data. "Local" is the frame in which its mesh is traced.
#[derive(Clone, Debug)]
pub(super) struct Placement {
    pub(super) instance: Instance,
    /// Local to world.
    pub(super) linear: DMat3,
    pub(super) offset: DVec3,
    /// Transforms normals to the world.
    pub(super) normals: DMat3,
    /// Local to world in single precision, for directions that are normalised afterwards.
    pub(super) linear_f32: Mat3,
    pub(super) normals_f32: Mat3,
    pub(super) carrier: Carrier,
}
