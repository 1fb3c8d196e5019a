//! Axis-aligned boxes.

use glam::{DMat3, DVec3, Vec3, Vec3A};

/// Bound of the error of a hit's place, relative to the greatest distance of a corner of its box: a
/// hundred roundings, where the triangle test has some ten.
const BEYOND_ERROR: f32 = 128.0 / 16_777_216.0;

/// An axis-aligned box, `min ≤ max`, or [`Bounds::EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) min: Vec3,
    pub(super) max: Vec3,
}

impl Bounds {
    /// The empty box, the neutral element of [`Bounds::union`].
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

    /// The box with its sides moved outwards by at least `by`.
    pub(super) fn widened(self, by: Vec3) -> Self {
        let down = |a: Vec3| Vec3::from_array(a.to_array().map(f32::next_down));
        let up = |a: Vec3| Vec3::from_array(a.to_array().map(f32::next_up));
        Self {
            min: down(self.min - by),
            max: up(self.max + by),
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

    /// Whether a ray leads away from the box or past it along one of the axes, so that all of it lies
    /// behind or beside the ray. Without rounding; always so for [`Bounds::EMPTY`].
    #[inline(always)]
    pub(super) fn is_behind(&self, origin: Vec3A, direction: Vec3A) -> bool {
        let below = Vec3A::from(self.max).cmplt(origin) & direction.cmpge(Vec3A::ZERO);
        let above = Vec3A::from(self.min).cmpgt(origin) & direction.cmple(Vec3A::ZERO);
        (below | above).any()
    }

    /// Whether all of the box lies beyond the end of a ray at `limit`, by more than what the roundings
    /// of a hit in it can bring nearer; not so if the limit is not finite.
    #[inline(always)]
    pub(super) fn is_beyond(&self, origin: Vec3A, direction: Vec3A, limit: f32) -> bool {
        let (low, high) = (Vec3A::from(self.min), Vec3A::from(self.max));
        let reach = (low - origin).abs().max((high - origin).abs());
        let error = Vec3A::splat(reach.max_element() * BEYOND_ERROR);
        let end = origin + direction * Vec3A::splat(limit);
        let above = (low - error).cmpgt(end) & direction.cmpge(Vec3A::ZERO);
        let below = (high + error).cmplt(end) & direction.cmple(Vec3A::ZERO);
        (above | below).any()
    }

    /// Greatest magnitude of a coordinate.
    pub(super) fn farthest(&self) -> f32 {
        self.min.abs().max(self.max.abs()).max_element()
    }

    pub(super) fn center(self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Least and greatest coordinates of the images of some boxes.
    pub(super) fn of_transformed(boxes: &[Self], linear: &DMat3, offset: DVec3) -> (DVec3, DVec3) {
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let stretch = DMat3::from_cols(
            linear.x_axis.abs(),
            linear.y_axis.abs(),
            linear.z_axis.abs(),
        );
        for bounds in boxes {
            let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
            let center = *linear * ((low + high) * 0.5) + offset;
            let reach = stretch * ((high - low) * 0.5);
            min = min.min(center - reach);
            max = max.max(center + reach);
        }
        (min, max)
    }

    /// A box around the images of some boxes, rounded outwards and widened by a few roundings of
    /// its coordinates.
    pub(super) fn around_transformed(boxes: &[Self], linear: &DMat3, offset: DVec3) -> Self {
        let (min, max) = Self::of_transformed(boxes, linear, offset);
        // Rays are carried into the mesh's frame in f32, so hits may lie this far outside the box.
        let pad = (max.abs().max(min.abs())) * 2.0_f64.powi(-21);
        Self {
            min: (min - pad).as_vec3(),
            max: (max + pad).as_vec3(),
        }
    }
}
