//! The ray.

use glam::Vec3;

/// The points `origin + t · direction` with `t_min ≤ t ≤ t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where `t` is 0, m.
    pub origin: Vec3,
    /// Direction of any length above 0; `t` is in units of this length. It is never normalised
    /// here.
    pub direction: Vec3,
    /// Smallest `t` of a hit, ≥ 0.
    pub t_min: f32,
    /// Largest `t` of a hit; may be infinite.
    pub t_max: f32,
}

impl Ray {
    /// The whole ray from `origin` on: `t` from 0 to infinity.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self {
            origin,
            direction,
            t_min: 0.0,
            t_max: f32::INFINITY,
        }
    }

    /// The point at `t`.
    #[cfg(test)]
    pub(crate) fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }

    /// Whether the ray can hit anything: finite, with a direction, and an interval that is not
    /// empty.
    pub(super) fn is_proper(&self) -> bool {
        self.origin.is_finite()
            && self.direction.is_finite()
            && self.direction != Vec3::ZERO
            && self.t_min <= self.t_max
    }
}
