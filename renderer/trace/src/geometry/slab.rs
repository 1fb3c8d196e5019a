//! The test of a ray against boxes. It is conservative: a box is never missed if the triangle test
//! would accept one of its triangles.
//!
//! There are two tests. [`SlabRay::one`] is exact to the bit and decides what is hit.
//! [`SlabRay::sixteen`] only saves time: it widens boxes by more than its own roundings, so that it
//! never leaves out what `one` accepts, whichever instructions it is compiled for.

use glam::{Vec3, Vec3A};

use super::bounds::Bounds;
use crate::simd::{Sixteen, WideRow};

/// Planes of boxes, by axis, side (least, greatest) and box.
pub(super) type BoxPlanes = [[WideRow; 2]; 3];

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

/// Bound of what the roundings of [`SlabRay::sixteen`] add to those of [`SlabRay::one`], relative
/// to the distances of planes from the origin, and to the origin's own coordinates. In `b · 1/d −
/// o · 1/d` products and difference have an error below (2 |b − o| + 3 |o|) · 2⁻²⁴ / |d|, in `one`
/// the error is below 2 |b − o| · 2⁻²⁴ / |d|. 8 of each is more than twice their sum.
const ROUGHNESS: f32 = 8.0 / 16_777_216.0;

/// Greatest 1/d of the quick test, relative to that of the longest axis. Along an axis across which a
/// ray runs it would be infinite, and `b · 1/d − o · 1/d` no number, so that no box would be left
/// out by that axis. With this the difference has the right sign, and planes at the error of the
/// origin are still farther away than anything along the ray.
const MOST_INVERSE: f32 = 1.267_650_6e30; // 2^100

/// Greatest 1/d of the quick test times a coordinate: products stay finite.
const MOST_PRODUCT: f32 = 4.253_529_6e37; // 2^125

/// The least that [`MOST_INVERSE`] may become by that. Rays whose direction is so short that it
/// would be less are not culled.
const LEAST_INVERSE: f32 = 1.099_511_6e12; // 2^40

/// Allows for the three roundings in each of the two compared distances, (b − o) · 1/d.
const FAR_FACTOR: f32 = 1.0 + 8.0 / 16_777_216.0;

/// A box widened by that part of the triangle test's error which goes with its own distance from the
/// origin of the coordinates.
pub(super) fn widened_for_hits(bounds: Bounds) -> Bounds {
    let far = bounds.min.abs().max(bounds.max.abs());
    bounds.widened((far + Vec3::splat(far.max_element())) * SHEAR_ERROR)
}

/// The same box, widened by the error of [`SlabRay::sixteen`] too.
pub(super) fn widened_for_culling(bounds: Bounds) -> Bounds {
    let far = bounds.min.abs().max(bounds.max.abs());
    widened_for_hits(bounds).widened(far * ROUGHNESS)
}

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
    /// For the quick test: distance to a plane over its coordinate, for planes that the ray meets
    /// first and last, and distance to the plane of coordinate 0.
    near_inverse: [f32; 3],
    far_inverse: [f32; 3],
    near_offset: [f32; 3],
    far_offset: [f32; 3],
    /// A bit for each axis along which the direction is negative.
    down: u32,
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
        Self::within_reach(origin, direction, t_min, reach, 0.0)
    }

    /// The same for boxes that are widened already: [`SlabRay::one`] for those of
    /// [`widened_for_hits`], [`SlabRay::sixteen`] for those of [`widened_for_culling`]. `farthest` is at
    /// least the magnitude of each of their coordinates.
    ///
    /// Errors go with distances, which are at most those of the box and of the ray from the origin of
    /// the coordinates together. So a box far away does not widen those nearby.
    #[inline(always)]
    pub(super) fn among_widened(
        origin: Vec3A,
        direction: Vec3A,
        t_min: f32,
        farthest: f32,
    ) -> Self {
        Self::within_reach(origin, direction, t_min, origin.abs(), farthest)
    }

    /// For boxes whose planes are within `reach` of the origin.
    #[inline(always)]
    fn within_reach(
        origin: Vec3A,
        direction: Vec3A,
        t_min: f32,
        reach: Vec3A,
        farthest: f32,
    ) -> Self {
        let axis = longest(direction);
        let along = reach.to_array()[axis];
        let error = (reach + Vec3A::splat(along)) * SHEAR_ERROR;
        let inverse = direction.recip();
        // Decided by the sign of 1/d, so that a direction of −0 agrees with its −∞.
        let down = inverse.is_negative_bitmask();
        let shift = error.copysign(inverse);
        let wide = (error + (reach + origin.abs()) * ROUGHNESS).copysign(inverse);
        // At least 1, so that what it divides stays finite.
        let coordinates = (origin.abs() + reach).max_element().max(farthest).max(1.0);
        // 1/d along the longest axis.
        let least = inverse.abs().min_element();
        let mut most = MOST_INVERSE * least;
        if most * coordinates > MOST_PRODUCT {
            most = MOST_PRODUCT / coordinates;
        }
        let (near_inverse, far) = if most >= LEAST_INVERSE * least {
            let most = Vec3A::splat(most);
            (inverse.min(most).max(-most), 0.0)
        } else {
            (Vec3A::ZERO, f32::MAX)
        };
        let far_inverse = near_inverse * FAR_FACTOR;
        Self {
            near_origin: (origin + shift).to_array(),
            far_origin: (origin - shift).to_array(),
            inverse: inverse.to_array(),
            near_inverse: near_inverse.to_array(),
            far_inverse: far_inverse.to_array(),
            near_offset: (-(origin + wide) * near_inverse - far).to_array(),
            far_offset: (-(origin - wide) * far_inverse + far).to_array(),
            down,
            t_min: greater(t_min, 0.0),
        }
    }

    /// Distances at which the ray enters sixteen boxes at the earliest, all at least +0, and a bit
    /// for each box that it may meet no later than `limit`.
    ///
    /// The distance is at most that of [`SlabRay::one`] for any box inside, and the bit is set if
    /// `one` meets any box inside no later than `limit`.
    #[inline(always)]
    pub(super) fn sixteen<E: Sixteen>(&self, e: E, planes: &BoxPlanes, limit: f32) -> (E::W, u32) {
        let mut enter = e.splat_wide(self.t_min);
        // −0 may come before 0 here; as a limit it is 0.
        let mut leave = e.splat_wide(limit + 0.0);
        for (axis, sides) in planes.iter().enumerate() {
            let side = (self.down >> axis & 1) as usize;
            let near = e.load_wide(&sides[side]);
            let (inverse, offset) = (self.near_inverse[axis], self.near_offset[axis]);
            let near = e.mul_add_roughly(near, e.splat_wide(inverse), e.splat_wide(offset));
            let far = e.load_wide(&sides[side ^ 1]);
            let (inverse, offset) = (self.far_inverse[axis], self.far_offset[axis]);
            let far = e.mul_add_roughly(far, e.splat_wide(inverse), e.splat_wide(offset));
            enter = e.greater_roughly(near, enter);
            leave = e.less_roughly(far, leave);
        }
        (enter, e.at_most_roughly(enter, leave))
    }

    /// The distance at which the ray enters a box; `None` if it misses it.
    ///
    /// Every operation is monotonic in the box, so a box inside another never enters earlier nor
    /// leaves later.
    #[inline(always)]
    pub(super) fn one(&self, bounds: &Bounds) -> Option<f32> {
        let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
        let mut enter = self.t_min;
        let mut leave = f32::INFINITY;
        for axis in 0..3 {
            let (near, far) = if self.down >> axis & 1 == 0 {
                (min[axis], max[axis])
            } else {
                (max[axis], min[axis])
            };
            let inverse = self.inverse[axis];
            enter = greater((near - self.near_origin[axis]) * inverse, enter);
            let inverse = inverse * FAR_FACTOR;
            leave = less((far - self.far_origin[axis]) * inverse, leave);
        }
        (enter <= leave).then_some(enter)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::Numbers;
    use super::*;
    use crate::simd::{Level, Task};

    /// The quick test of a box, in all lanes.
    struct Quick<'a>(&'a SlabRay, BoxPlanes, f32);

    impl Task for Quick<'_> {
        type Output = (WideRow, u32);

        #[inline(always)]
        fn run<E: Sixteen>(self, e: E) -> Self::Output {
            let (enter, met) = self.0.sixteen(e, &self.1, self.2);
            (e.store_wide(enter), met)
        }
    }

    /// How a number is stretched: over scales, onto the origin's planes, or not at all.
    fn stretched(numbers: &mut Numbers, scale: f32) -> Vec3 {
        let at = (numbers.cube() - 0.5) * scale;
        match (numbers.cube().x * 4.0) as u32 {
            0 => at * 1e-6,
            1 => Vec3::new(at.x, 0.0, at.z),
            2 => at.round(),
            _ => at,
        }
    }

    #[test]
    fn a_ray_along_an_axis_leaves_out_the_boxes_beside_it() {
        let scene = Bounds::around([Vec3::splat(-100.0), Vec3::splat(100.0)]);
        for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
            for length in [1e-9, 1.0, 1e12] {
                let mut direction = Vec3::ZERO;
                direction[axis] = sign * length;
                for corner in [Vec3::splat(3.0), Vec3::splat(-3.0)] {
                    let bounds = Bounds::around([corner, corner * 1.1]);
                    let (low, high) = (bounds.min.to_array(), bounds.max.to_array());
                    let planes =
                        [0, 1, 2].map(|axis| [low, high].map(|side| WideRow::splat(side[axis])));
                    let from = |offset: f32| {
                        let mut origin = corner * offset;
                        origin[axis] = -sign * 50.0;
                        let slab = SlabRay::new(origin.into(), direction.into(), 0.0, &scene);
                        let met = Level::all()
                            .into_iter()
                            .map(|level| level.run(Quick(&slab, planes, f32::INFINITY)).1);
                        (slab.one(&bounds).is_some(), met.collect::<Vec<_>>())
                    };
                    let levels = Level::all().len();
                    assert_eq!(from(1.05), (true, vec![0xffff; levels]));
                    assert_eq!(from(1.2), (false, vec![0; levels]));
                    assert_eq!(from(0.9), (false, vec![0; levels]));
                }
            }
        }
    }

    #[test]
    fn a_box_far_away_does_not_widen_those_nearby() {
        let nearby = Bounds::around([Vec3::ZERO, Vec3::splat(0.1)]);
        let far = Bounds::around([Vec3::splat(7e5), Vec3::splat(7.1e5)]);
        let origin = Vec3::new(0.0, 0.05, -1.0);
        for (beside, is_met) in [(-1e-3, false), (1e-3, true)] {
            let from = Vec3A::from(origin + Vec3::X * beside);
            let slab = SlabRay::among_widened(from, Vec3A::Z, 0.0, far.farthest());
            assert_eq!(slab.one(&widened_for_hits(nearby)).is_some(), is_met);
            let bounds = widened_for_culling(nearby);
            let (low, high) = (bounds.min.to_array(), bounds.max.to_array());
            let planes = [0, 1, 2].map(|axis| [low, high].map(|side| WideRow::splat(side[axis])));
            for level in Level::all() {
                let (_, met) = level.run(Quick(&slab, planes, f32::INFINITY));
                assert_eq!(met != 0, is_met, "{}", level.name());
            }
        }
    }

    #[test]
    fn what_the_exact_test_accepts_the_quick_one_never_leaves_out_at_any_level() {
        let mut numbers = Numbers::new(3);
        let (mut met, mut tried) = (0, 0);
        for round in 0..40_000 {
            // Scenes of all sizes, near the origin of the coordinates and far from it.
            let size = [1e-3, 1.0, 300.0][round % 3];
            let away = [0.0, 1.0, 1e4][round / 3 % 3] * size;
            let centre = (numbers.cube() - 0.5) * away;
            let inner = Bounds::around([0, 1].map(|_| centre + stretched(&mut numbers, size)));
            let outer = inner.union(Bounds::around([centre + stretched(&mut numbers, size)]));
            let scene = outer.union(Bounds::around([centre - size, centre + size]));
            let origin = centre + stretched(&mut numbers, 3.0 * size);
            // Towards a corner, an edge or the inside, so that many rays graze the box.
            let mix = numbers.cube().round();
            let aim = inner.min * (Vec3::ONE - mix) + inner.max * mix;
            let mut direction = aim - origin;
            if round % 5 == 0 {
                direction.x = 0.0;
            }
            if direction == Vec3::ZERO {
                continue;
            }
            let (from, towards) = (origin.into(), direction.into());
            let (slab, decides, quick) = if round % 2 == 0 {
                (
                    SlabRay::new(from, towards, 0.0, &scene),
                    inner,
                    [inner, outer],
                )
            } else {
                let farthest = widened_for_culling(scene).farthest();
                let slab = SlabRay::among_widened(from, towards, 0.0, farthest);
                (
                    slab,
                    widened_for_hits(inner),
                    [inner, outer].map(widened_for_culling),
                )
            };
            let Some(exact) = slab.one(&decides) else {
                continue;
            };
            tried += 1;
            for bounds in &quick {
                let (low, high) = (bounds.min.to_array(), bounds.max.to_array());
                let planes =
                    [0, 1, 2].map(|axis| [low, high].map(|side| WideRow::splat(side[axis])));
                // A ray may end at −0.
                let limit = if exact == 0.0 { -0.0 } else { exact };
                for level in Level::all() {
                    let (enter, bits) = level.run(Quick(&slab, planes, limit));
                    assert_eq!(bits, 0xffff, "{}: {bounds:?} from {origin}", level.name());
                    assert!(
                        enter.get(0) <= exact && enter.get(0).is_sign_positive(),
                        "{}: enters {bounds:?} from {origin} at {}, exactly at {exact}",
                        level.name(),
                        enter.get(0)
                    );
                    met += 1;
                }
            }
        }
        assert!(tried > 10_000 && met >= 4 * tried, "{tried} boxes met");
    }
}
