//! Axis-aligned boxes.

use glam::{DAffine3, DVec3, Vec3};

/// An axis-aligned box, `min ≤ max`, or [`Bounds::EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) min: Vec3,
    pub(super) max: Vec3,
}

impl Bounds {
    /// Contains nothing; the neutral element of [`Bounds::union`].
    pub(super) const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// The smallest box around some points.
    pub(super) fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |bounds, point| Self {
            min: bounds.min.min(point),
            max: bounds.max.max(point),
        })
    }

    /// The smallest box around both.
    pub(super) fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    pub(super) fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Half the surface; proportional to the chance that a random line meets the box.
    pub(super) fn half_area(self) -> f32 {
        let d = self.max - self.min;
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    pub(super) fn center(self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// A box around the image of this one, rounded outwards and widened by a few roundings of its coordinates.
    pub(super) fn transformed(self, to_world: &DAffine3) -> Self {
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner in 0..8_u32 {
            let pick =
                |axis: u32, low: f32, high: f32| if corner >> axis & 1 == 0 { low } else { high };
            let point = to_world.transform_point3(DVec3::new(
                f64::from(pick(0, self.min.x, self.max.x)),
                f64::from(pick(1, self.min.y, self.max.y)),
                f64::from(pick(2, self.min.z, self.max.z)),
            ));
            min = min.min(point);
            max = max.max(point);
        }
        // The ray is carried into the mesh's frame in f32: what it meets there may lie this far outside here.
        let pad = (max.abs().max(min.abs())) * 2.0_f64.powi(-21);
        Self {
            min: (min - pad).as_vec3(),
            max: (max + pad).as_vec3(),
        }
    }
}
