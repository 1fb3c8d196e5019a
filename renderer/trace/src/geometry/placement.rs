//! Instances prepared for tracing.

use glam::{DMat3, DVec3, Mat3, Vec3, Vec3A};
use thiserror::Error;

use super::bounds::Bounds;
use super::instance::Instance;
use super::ray::Ray;

/// Instances and tree nodes share 32 bits.
pub(super) const MOST_INSTANCES: usize = 1 << 29;

/// Why meshes and instances were refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GeometryError {
    /// An instance refers to a mesh that does not exist.
    #[error(
        "instance {instance} names mesh {mesh}, but there are {meshes} meshes (counted from 0)"
    )]
    NoSuchMesh {
        /// Number of the instance.
        instance: usize,
        /// The missing mesh.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// A transform is not finite, flattens the mesh, or takes it beyond what `f32` can hold.
    #[error("the transform of instance {instance} {what}")]
    Transform {
        /// Number of the instance.
        instance: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// There are more instances than can be numbered.
    #[error("there are {given} instances; the most is {MOST_INSTANCES}")]
    TooManyInstances {
        /// How many there are.
        given: usize,
    },
}

/// The data of an instance that a ray needs, in one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Carrier {
    /// World to local, for rays.
    linear: Mat3,
    offset: Vec3,
    /// Whether `linear` is the identity.
    is_shift: bool,
    /// Number of the tree that is traced.
    pub(super) tree: u32,
    /// Number of the instance; of joined ones the first, and the tree knows each.
    pub(super) instance: u32,
}

impl Carrier {
    /// Of joined instances, of which this is one and whose frame has this origin in the world.
    pub(super) fn of_joined(tree: u32, instance: u32, center: Vec3) -> Self {
        Self {
            linear: Mat3::IDENTITY,
            offset: -center,
            is_shift: true,
            tree,
            instance,
        }
    }

    /// Origin and direction of the ray in the local frame, with the same `t`.
    #[inline(always)]
    pub(super) fn carry(&self, ray: &Ray) -> (Vec3A, Vec3A) {
        if self.is_shift {
            let origin = Vec3A::from(ray.origin()) + Vec3A::from(self.offset);
            return (origin, ray.direction().into());
        }
        let [x, y, z] = [
            Vec3A::from(self.linear.x_axis),
            Vec3A::from(self.linear.y_axis),
            Vec3A::from(self.linear.z_axis),
        ];
        let (o, d) = (ray.origin(), ray.direction());
        (
            x * Vec3A::splat(o.x)
                + y * Vec3A::splat(o.y)
                + z * Vec3A::splat(o.z)
                + Vec3A::from(self.offset),
            x * Vec3A::splat(d.x) + y * Vec3A::splat(d.y) + z * Vec3A::splat(d.z),
        )
    }
}

/// An instance with derived data. "Local" is the frame in which it is traced: that of its mesh about
/// the mesh's centre, or of joined instances that of the world about theirs.
#[derive(Clone, Debug)]
pub(super) struct Placement {
    pub(super) instance: Instance,
    /// Local to world.
    pub(super) linear: DMat3,
    pub(super) offset: DVec3,
    /// Transforms a triangle's local normal, by its winding, to the world.
    normals: DMat3,
    /// Local to world in single precision, for directions that are normalised afterwards.
    pub(super) linear_f32: Mat3,
    /// The mesh's normals to the world, likewise.
    pub(super) normals_f32: Mat3,
    /// Whether it mirrors the mesh.
    pub(super) is_mirrored: bool,
    pub(super) carrier: Carrier,
}

impl Placement {
    /// An instance of a mesh with this centre, which is traced around `origin` by a tree of its own.
    ///
    /// # Errors
    ///
    /// [`GeometryError::Transform`].
    pub(super) fn new(
        number: usize,
        instance: Instance,
        origin: DVec3,
        center: Vec3,
    ) -> Result<Self, GeometryError> {
        let refuse = |what| GeometryError::Transform {
            instance: number,
            what,
        };
        let to_world = instance.around(origin).as_daffine3();
        let linear = to_world.matrix3;
        let offset = to_world.transform_point3(center.as_dvec3());
        if !linear.is_finite() || !offset.is_finite() {
            return Err(refuse("is not finite"));
        }
        let size = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
        // The determinant is relative to the lengths of the axes. Below this, rounding in f32 would
        // decide where the mesh is.
        let determinant = linear.determinant();
        if determinant.abs() <= size * 1e-6 || size == 0.0 {
            return Err(refuse(
                "flattens the mesh: it has no inverse that 32-bit numbers can hold",
            ));
        }
        let inverse = linear.inverse();
        let carrier = Carrier {
            linear: inverse.as_mat3(),
            offset: (-(inverse * offset)).as_vec3(),
            is_shift: linear == DMat3::IDENTITY,
            tree: instance.mesh,
            instance: number as u32,
        };
        if !carrier.linear.is_finite() || !carrier.offset.is_finite() {
            return Err(refuse("has an inverse beyond 32-bit numbers"));
        }
        Ok(Self {
            instance,
            linear,
            offset,
            normals: inverse.transpose(),
            linear_f32: rescaled(linear),
            normals_f32: rescaled(inverse.transpose()),
            is_mirrored: determinant < 0.0,
            carrier,
        })
    }

    /// The same instance, traced in the world by a tree about this centre.
    pub(super) fn join(&mut self, carrier: Carrier, center: Vec3) {
        let side = if self.is_mirrored { -1.0 } else { 1.0 };
        self.linear = DMat3::IDENTITY;
        self.offset = center.as_dvec3();
        self.normals = DMat3::IDENTITY * side;
        self.linear_f32 = Mat3::IDENTITY;
        self.carrier = carrier;
    }

    /// A local point in the world.
    #[inline]
    pub(super) fn to_world(&self, local: DVec3) -> DVec3 {
        if self.carrier.is_shift {
            local + self.offset
        } else {
            self.linear * local + self.offset
        }
    }

    /// A triangle's local normal, by its winding, in the world; not of unit length.
    #[inline]
    pub(super) fn normal_to_world(&self, local: DVec3) -> DVec3 {
        if self.carrier.is_shift {
            // −1 times the identity for a mirrored mesh that was joined.
            local * self.normals.x_axis.x
        } else {
            self.normals * local
        }
    }

    /// A world direction in the local frame, whose products with local lengths are those of the
    /// direction with lengths in the world.
    #[inline]
    pub(super) fn direction_to_local(&self, world: Vec3) -> Vec3 {
        if self.carrier.is_shift {
            return world;
        }
        (self.linear.transpose() * world.as_dvec3()).as_vec3()
    }

    /// For each coordinate, the sum of the magnitudes of the terms that carry a world point into
    /// the local frame.
    pub(super) fn to_local_size(&self, world: Vec3) -> Vec3 {
        if self.carrier.is_shift {
            return world.abs() + self.carrier.offset.abs();
        }
        let columns = self.carrier.linear;
        columns.x_axis.abs() * world.x.abs()
            + columns.y_axis.abs() * world.y.abs()
            + columns.z_axis.abs() * world.z.abs()
            + self.carrier.offset.abs()
    }

    /// A box in the world around some local ones.
    pub(super) fn world_bounds(&self, local: &[Bounds]) -> Bounds {
        Bounds::around_transformed(local, &self.linear, self.offset)
    }
}

/// A transform of directions in single precision, scaled so that its numbers are near 1.
fn rescaled(matrix: DMat3) -> Mat3 {
    let size = matrix.x_axis.length() + matrix.y_axis.length() + matrix.z_axis.length();
    (matrix * (1.0 / size)).as_mat3()
}
