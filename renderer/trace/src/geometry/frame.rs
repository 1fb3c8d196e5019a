//! Orthonormal frames.

use glam::Vec3;

/// Three unit vectors at right angles: `across = along × normal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Local +x.
    pub across: Vec3,
    /// Local +y; on a surface the direction in which the texture coordinate v grows.
    pub along: Vec3,
    /// Local +z.
    pub normal: Vec3,
}

impl Frame {
    /// The frame of a unit normal, with the tangent made orthogonal to it.
    pub fn new(normal: Vec3, along: Vec3) -> Self {
        let along = (along - normal * normal.dot(along))
            .try_normalize()
            .unwrap_or_else(|| normal.any_orthonormal_vector());
        Self {
            across: along.cross(normal),
            along,
            normal,
        }
    }

    /// A frame of a unit normal whose tangent is a function of the normal.
    pub fn from_normal(normal: Vec3) -> Self {
        Self::new(normal, normal.any_orthonormal_vector())
    }

    /// Components in this frame.
    pub fn to_local(&self, w: Vec3) -> Vec3 {
        Vec3::new(w.dot(self.across), w.dot(self.along), w.dot(self.normal))
    }

    /// The vector with these components.
    pub fn to_world(&self, w: Vec3) -> Vec3 {
        self.across * w.x + self.along * w.y + self.normal * w.z
    }
}
