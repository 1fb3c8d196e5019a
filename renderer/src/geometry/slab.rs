//! The test of a ray against boxes. It is conservative: a box is never missed if the triangle test
//! would accept one of its triangles.

use glam::Vec3A;

use super::bounds::Bounds;
use crate::simd::{Eight, Row};

/// Planes of boxes, by plane (min x, y, z, max x, y, z) and box.
pub(super) type BoxPlanes = [Row; 6];

/// A row of [`BoxPlanes`]. It is an enum, so that the compiler needs no bounds check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Plane {
    MinX,
    MinY,
    MinZ,
    MaxX,
    MaxY,
    MaxZ,
}

/// Lower and upper plane of each axis.
const PLANES: [[Plane; 2]; 3] = [
    [Plane::MinX, Plane::MaxX],
    [Plane::MinY, Plane::MaxY],
    [Plane::MinZ, Plane::MaxZ],
];

/// The planes that a ray meets first, indexed by a bit for each axis along which its direction is
/// negative.
const NEAR_PLANES: [[Plane; 3]; 8] = {
    let mut planes = [[Plane::MinX; 3]; 8];
    let mut down = 0;
    while down < 8 {
        let mut axis = 0;
        while axis < 3 {
            planes[down][axis] = PLANES[axis][down >> axis & 1];
            axis += 1;
        }
        down += 1;
    }
    planes
};

/// The axis along which a direction is longest, along which the triangle test shears. It is
/// computed without a branch, which could not be predicted.
#[inline(always)]
pub(super) fn longest(direction: Vec3A) -> usize {
    let [x, y, z] = direction.abs().to_array();
    let not_x = usize::from(!(x > y && x > z));
    not_x * (1 + usize::from(y <= z))
}

/// Bound of the error of a vertex' position in the sheared triangle test, relative to its distances
/// from the origin across (x) and along (z) the ray: `(x − oₓ) − s (z − o_z)` with |s| ≤ 1 has an
/// error below (2 |x| + 4 |z|) · 2⁻²⁴ to first order. 8 (|x| + |z|) leaves room for the rounding of
/// the shifted origin and of `b − o` below.
const SHEAR_ERROR: f32 = 8.0 / 16_777_216.0;

/// Allows for the three roundings in each of the two compared distances, (b − o) · 1/d.
const FAR_FACTOR: f32 = 1.0 + 8.0 / 16_777_216.0;

/// A ray prepared for box tests in one tree.
///
/// # Source
///
/// \[ize2013\] (the factor on the far distance) and \[woop2013\] (origins moved apart by the error
/// of the triangle test, so that boxes never cut off what that test accepts).
#[derive(Clone, Copy, Debug)]
pub(super) struct SlabRay {
    /// Origin for near planes and for far planes: shifted outwards by the error.
    near_origin: [f32; 3],
    far_origin: [f32; 3],
    inverse: [f32; 3],
    /// Planes that the ray meets first and last on each axis.
    near_plane: [Plane; 3],
    far_plane: [Plane; 3],
    t_min: f32,
}

/// The greater number; `b` if `a` is NaN, like the machine's `max`.
#[inline]
pub(super) fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The lesser number; `b` if `a` is NaN.
#[inline]
pub(super) fn less(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

impl SlabRay {
    /// Prepares a ray for boxes inside `bounds`. The direction is finite and not zero.
    #[inline(always)]
    pub(super) fn new(origin: Vec3A, direction: Vec3A, t_min: f32, bounds: &Bounds) -> Self {
        let (low, high) = (Vec3A::from(bounds.min), Vec3A::from(bounds.max));
        let reach = (low - origin).abs().max((high - origin).abs());
        let along = reach.to_array()[longest(direction)];
        let error = (reach + Vec3A::splat(along)) * SHEAR_ERROR;
        let inverse = direction.recip();
        // Decided by the sign of 1/d, so that a direction of −0 agrees with its −∞.
        let down = inverse.is_negative_bitmask() as usize;
        let shift = error.copysign(inverse);
        Self {
            near_origin: (origin + shift).to_array(),
            far_origin: (origin - shift).to_array(),
            inverse: inverse.to_array(),
            near_plane: NEAR_PLANES[down & 7],
            far_plane: NEAR_PLANES[!down & 7],
            t_min: greater(t_min, 0.0),
        }
    }

    /// Distances at which the ray enters eight boxes, and a bit for each box that it meets no later
    /// than `limit`.
    ///
    /// Every operation is monotonic in the box, so a box inside another never enters earlier nor
    /// leaves later. A plane in which the ray lies (0 · ∞) is ignored, which is conservative.
    #[inline(always)]
    pub(super) fn eight<E: Eight>(&self, e: E, planes: &BoxPlanes, limit: f32) -> (E::F, u32) {
        let mut enter = e.splat(self.t_min);
        let mut leave = e.splat(f32::INFINITY);
        for axis in 0..3 {
            let near = e.load(&planes[self.near_plane[axis] as usize]);
            let far = e.load(&planes[self.far_plane[axis] as usize]);
            let inverse = e.splat(self.inverse[axis]);
            let near = e.mul(e.sub(near, e.splat(self.near_origin[axis])), inverse);
            let far = e.mul(e.sub(far, e.splat(self.far_origin[axis])), inverse);
            enter = e.greater(near, enter);
            leave = e.less(far, leave);
        }
        let last = e.less(e.mul(leave, e.splat(FAR_FACTOR)), e.splat(limit));
        (enter, e.at_most(enter, last))
    }

    /// As [`SlabRay::eight`], for one box, bit for bit; `None` if it is missed, else the distance
    /// of entry.
    #[inline(always)]
    pub(super) fn one(&self, min: [f32; 3], max: [f32; 3]) -> Option<f32> {
        let mut enter = self.t_min;
        let mut leave = f32::INFINITY;
        for axis in 0..3 {
            let (near, far) = if self.near_plane[axis] == PLANES[axis][0] {
                (min[axis], max[axis])
            } else {
                (max[axis], min[axis])
            };
            enter = greater((near - self.near_origin[axis]) * self.inverse[axis], enter);
            leave = less((far - self.far_origin[axis]) * self.inverse[axis], leave);
        }
        (enter <= leave * FAR_FACTOR).then_some(enter)
    }
}
