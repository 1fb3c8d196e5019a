//! Rays, and what they hit.

use glam::{Vec3, Vec4};

/// The points `origin + t · direction` with `t_min ≤ t ≤ t_max`.
///
/// Two vectors of four numbers, each written at once: a copy of 16 bytes waits until all that was
/// written into them is through, and rays are copied where light goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin, m, and smallest `t` of a hit.
    origin_and_t_min: Vec4,
    /// Direction, and largest `t` of a hit.
    direction_and_t_max: Vec4,
}

impl Ray {
    /// The whole ray from `origin` on: `t` from 0 to infinity.
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self {
            origin_and_t_min: origin.extend(0.0),
            direction_and_t_max: direction.extend(f32::INFINITY),
        }
    }

    /// The same with this smallest `t` of a hit, ≥ 0.
    #[inline]
    #[must_use]
    pub fn starting_at(mut self, t_min: f32) -> Self {
        self.origin_and_t_min.w = t_min;
        self
    }

    /// The same with this largest `t` of a hit; may be infinite.
    #[inline]
    #[must_use]
    pub fn up_to(mut self, t_max: f32) -> Self {
        self.direction_and_t_max.w = t_max;
        self
    }

    /// Where `t` is 0, m.
    #[inline]
    pub fn origin(&self) -> Vec3 {
        self.origin_and_t_min.truncate()
    }

    /// Direction of any length above 0; `t` is in units of this length. It is never normalised here.
    #[inline]
    pub fn direction(&self) -> Vec3 {
        self.direction_and_t_max.truncate()
    }

    /// Smallest `t` of a hit, ≥ 0.
    #[inline]
    pub fn t_min(&self) -> f32 {
        self.origin_and_t_min.w
    }

    /// Largest `t` of a hit; may be infinite.
    #[inline]
    pub fn t_max(&self) -> f32 {
        self.direction_and_t_max.w
    }

    /// The point at `t`.
    #[cfg(test)]
    pub(crate) fn at(&self, t: f32) -> Vec3 {
        self.origin() + self.direction() * t
    }

    /// Whether the ray can hit anything: finite, with a direction, and an interval that is not
    /// empty.
    pub(super) fn is_proper(&self) -> bool {
        self.origin().is_finite()
            && self.direction().is_finite()
            && self.direction() != Vec3::ZERO
            && self.t_min() <= self.t_max()
    }
}

/// The nearest intersection of a ray with the geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction.
    pub t: f32,
    /// Number of the instance.
    pub instance: u32,
    /// Number of the triangle in the instance's mesh.
    pub triangle: u32,
    /// Weight of the triangle's second vertex.
    pub b1: f32,
    /// Weight of the triangle's third vertex.
    pub b2: f32,
    /// Block and lane of the triangle in the tree by which it is traced, where its corners are
    /// likely still in the cache.
    pub(super) place: u32,
}
