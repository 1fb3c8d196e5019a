//! The watertight test of a ray against eight triangles at a time.

use glam::{Vec3, Vec3A};

use super::bounds::Bounds;
use super::slab::{SlabRay, longest};
use crate::simd::{Eight, LANES, Row};

/// Eight triangles by vertex, axis and lane; unused lanes hold NaN, which no ray hits.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct TriangleBlock {
    vertices: [[Row; 3]; 3],
    ids: [u32; LANES],
}

/// An axis of space. An enum, so that the compiler knows that there are three.
#[derive(Clone, Copy, Debug)]
enum Axis {
    X,
    Y,
    Z,
}

/// A ray prepared for triangle tests: axes permuted so that the ray runs along the third, and
/// sheared onto it.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShearRay {
    origin: [f32; 3],
    axes: [Axis; 3],
    shear: [f32; 3],
    t_min: f32,
}

impl ShearRay {
    /// Prepares a ray; the direction is finite and not zero.
    #[inline(always)]
    pub(super) fn new(origin: Vec3A, direction: Vec3A, t_min: f32) -> Self {
        let z = longest(direction);
        let along = direction.to_array()[z];
        let axes = AXES[z][usize::from(along < 0.0)];
        let shear = (direction / Vec3A::splat(along)).to_array();
        Self {
            origin: origin.to_array(),
            axes,
            shear: [
                shear[axes[0] as usize],
                shear[axes[1] as usize],
                1.0 / along,
            ],
            t_min,
        }
    }
}

/// Two axes across a ray and one along it, by the axis along and by whether the ray runs down it.
const AXES: [[[Axis; 3]; 2]; 3] = [
    [[Axis::Y, Axis::Z, Axis::X], [Axis::Z, Axis::Y, Axis::X]],
    [[Axis::Z, Axis::X, Axis::Y], [Axis::X, Axis::Z, Axis::Y]],
    [[Axis::X, Axis::Y, Axis::Z], [Axis::Y, Axis::X, Axis::Z]],
];

/// The constants for the projection of eight corners, in every lane. There are no closures here or
/// below: before being inlined, they would be compiled as separate functions without the level's
/// instructions.
struct ShearLanes<E: Eight> {
    x: E::F,
    y: E::F,
    origin: [E::F; 3],
}

impl<E: Eight> ShearLanes<E> {
    #[inline(always)]
    fn new(e: E, ray: &ShearRay) -> Self {
        let [kx, ky, kz] = ray.axes;
        Self {
            x: e.splat(ray.shear[0]),
            y: e.splat(ray.shear[1]),
            origin: [
                e.splat(ray.origin[kx as usize]),
                e.splat(ray.origin[ky as usize]),
                e.splat(ray.origin[kz as usize]),
            ],
        }
    }

    /// Corners relative to the ray: across it twice, and along it, not yet scaled.
    #[inline(always)]
    fn project(&self, e: E, ray: &ShearRay, corner: &[Row; 3]) -> [E::F; 3] {
        let [kx, ky, kz] = ray.axes;
        let z = e.sub(e.load(&corner[kz as usize]), self.origin[2]);
        let x = e.sub(e.load(&corner[kx as usize]), self.origin[0]);
        let y = e.sub(e.load(&corner[ky as usize]), self.origin[1]);
        [e.sub(x, e.mul(self.x, z)), e.sub(y, e.mul(self.y, z)), z]
    }
}

/// A hit of a triangle: the distance, and the weights of the second and third vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TriangleHit {
    pub(super) t: f32,
    pub(super) b1: f32,
    pub(super) b2: f32,
}

impl TriangleBlock {
    /// Packs at most eight triangles with their numbers.
    ///
    /// # Panics
    ///
    /// If there are more.
    pub(super) fn new(triangles: impl IntoIterator<Item = (u32, [Vec3; 3])>) -> Self {
        let mut block = Self {
            vertices: [[Row([f32::NAN; LANES]); 3]; 3],
            ids: [u32::MAX; LANES],
        };
        for (lane, (id, corners)) in triangles.into_iter().enumerate() {
            block.ids[lane] = id;
            for (vertex, corner) in corners.iter().enumerate() {
                for axis in 0..3 {
                    block.vertices[vertex][axis].0[lane] = corner[axis];
                }
            }
        }
        block
    }

    /// Number of the triangle in a lane.
    pub(super) fn id(&self, lane: usize) -> u32 {
        self.ids[lane]
    }

    /// Corners of the triangle in a lane.
    pub(super) fn corners(&self, lane: usize) -> [Vec3; 3] {
        [0, 1, 2].map(|vertex| Vec3::from_array(self.corner(vertex, lane)))
    }

    fn corner(&self, vertex: usize, lane: usize) -> [f32; 3] {
        self.vertices[vertex].each_ref().map(|axis| axis.0[lane])
    }

    /// A bit for each lane in which [`TriangleBlock::hit`] may find something no farther than
    /// `limit`.
    ///
    /// The edge functions of \[woop2013\] on eight lanes. Rounding is monotonic, so the sign of a
    /// difference of two products is right or the difference is 0; zeros pass here and are decided
    /// by `hit`. In the other lanes `t` has the same bits as in `hit`, so hits outside the ray's
    /// interval are left out.
    #[inline(always)]
    pub(super) fn candidates<E: Eight>(&self, e: E, ray: &ShearRay, limit: f32) -> u32 {
        let [a, b, c] = &self.vertices;
        let lanes = ShearLanes::new(e, ray);
        let [ax, ay, az] = lanes.project(e, ray, a);
        let [bx, by, bz] = lanes.project(e, ray, b);
        let [cx, cy, cz] = lanes.project(e, ray, c);
        let u = e.sub(e.mul(cx, by), e.mul(cy, bx));
        let v = e.sub(e.mul(ax, cy), e.mul(ay, cx));
        let w = e.sub(e.mul(bx, ay), e.mul(by, ax));
        // The smallest and greatest of the three: signs agree, zeros with either.
        let least = e.less(e.less(u, v), w);
        let most = e.greater(e.greater(u, v), w);
        let zero = e.splat(0.0);
        let inside = e.at_most(zero, least) | e.at_most(most, zero);
        if inside == 0 {
            return 0;
        }
        let strictly = e.below(zero, least) | e.below(most, zero);
        let sz = e.splat(ray.shear[2]);
        let sum = e.add(
            e.add(e.mul(u, e.mul(sz, az)), e.mul(v, e.mul(sz, bz))),
            e.mul(w, e.mul(sz, cz)),
        );
        let t = e.div(sum, e.add(e.add(u, v), w));
        let within = e.at_most(e.splat(ray.t_min), t) & e.at_most(t, e.splat(limit));
        inside & (within | !strictly)
    }

    /// The hit in one lane, or `None`.
    ///
    /// `t` is never less than the distance at which the ray enters the triangle's own box, and a
    /// ray that misses that box misses the triangle. Both depend on triangle and ray alone, and the
    /// boxes of the tree contain that box. So culling never changes a result, even where rounding
    /// moves `t` (a triangle seen edge-on).
    #[inline(always)]
    pub(super) fn hit(&self, lane: usize, ray: &ShearRay, slab: &SlabRay) -> Option<TriangleHit> {
        let [a, b, c] = [0, 1, 2].map(|vertex| self.corner(vertex, lane));
        let [kx, ky, kz] = ray.axes.map(|axis| axis as usize);
        let [sx, sy, sz] = ray.shear;
        let project = |corner: [f32; 3]| {
            let z = corner[kz] - ray.origin[kz];
            let x = (corner[kx] - ray.origin[kx]) - sx * z;
            let y = (corner[ky] - ray.origin[ky]) - sy * z;
            (x, y, sz * z)
        };
        let (ax, ay, az) = project(a);
        let (bx, by, bz) = project(b);
        let (cx, cy, cz) = project(c);
        let mut u = cx * by - cy * bx;
        let mut v = ax * cy - ay * cx;
        let mut w = bx * ay - by * ax;
        if u == 0.0 || v == 0.0 || w == 0.0 {
            // Products of two 24-bit numbers fit 53 bits: here the sign is exact.
            let [ax, ay, bx, by, cx, cy] = [ax, ay, bx, by, cx, cy].map(f64::from);
            u = (cx * by - cy * bx) as f32;
            v = (ax * cy - ay * cx) as f32;
            w = (bx * ay - by * ax) as f32;
        }
        let ahead = u >= 0.0 && v >= 0.0 && w >= 0.0;
        let behind = u <= 0.0 && v <= 0.0 && w <= 0.0;
        if !ahead && !behind {
            return None;
        }
        let determinant = u + v + w;
        if determinant == 0.0 {
            return None;
        }
        let t = (u * az + v * bz + w * cz) / determinant;
        // Written so that NaN is a miss.
        if !(t >= ray.t_min && t < f32::INFINITY) {
            return None;
        }
        let low = |i: usize| a[i].min(b[i]).min(c[i]);
        let high = |i: usize| a[i].max(b[i]).max(c[i]);
        let enter = slab.one(&Bounds {
            min: Vec3::new(low(0), low(1), low(2)),
            max: Vec3::new(high(0), high(1), high(2)),
        })?;
        Some(TriangleHit {
            t: t.max(enter),
            b1: v / determinant,
            b2: w / determinant,
        })
    }
}
