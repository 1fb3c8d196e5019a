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
    shear: Vec3A,
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
            shear: Vec3A::new(
                shear[axes[0] as usize],
                shear[axes[1] as usize],
                1.0 / along,
            ),
            t_min,
        }
    }

    /// A corner relative to the ray: across it twice, and along it.
    #[inline(always)]
    fn project(&self, corner: [f32; 3]) -> (f32, f32, f32) {
        let [kx, ky, kz] = self.axes;
        let (kx, ky, kz) = (kx as usize, ky as usize, kz as usize);
        let [sx, sy, sz] = self.shear.to_array();
        let z = corner[kz] - self.origin[kz];
        let x = (corner[kx] - self.origin[kx]) - sx * z;
        let y = (corner[ky] - self.origin[ky]) - sy * z;
        (x, y, sz * z)
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
            x: e.splat(ray.shear.x),
            y: e.splat(ray.shear.y),
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

/// What a ray has to do with eight triangles.
pub(super) struct Candidates {
    /// A bit for each lane in which there may be a hit no farther than the limit.
    pub(super) lanes: u32,
    /// A bit for each lane whose triangle is hit, if it is, inside its edges.
    strictly: u32,
    /// Of the three vertices, not yet divided by their sum.
    weights: [Row; 3],
    /// Distances along the ray.
    t: Row,
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
    #[inline]
    pub(super) fn corners(&self, lane: usize) -> [Vec3; 3] {
        let [a, b, c] = self.coordinates(lane);
        [
            Vec3::from_array(a),
            Vec3::from_array(b),
            Vec3::from_array(c),
        ]
    }

    /// Their coordinates. Here too there are no closures: compiled as functions of their own, they
    /// cost a close-up 5 % of its time.
    #[inline(always)]
    fn coordinates(&self, lane: usize) -> [[f32; 3]; 3] {
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = &self.vertices;
        [
            [ax.0[lane], ay.0[lane], az.0[lane]],
            [bx.0[lane], by.0[lane], bz.0[lane]],
            [cx.0[lane], cy.0[lane], cz.0[lane]],
        ]
    }

    /// The lanes in which there may be a hit no farther than `limit`; `None` if there are none.
    ///
    /// The edge functions of \[woop2013\] on eight lanes. Rounding is monotonic, so the sign of a
    /// difference of two products is right or the difference is 0; zeros pass here and are decided
    /// by [`TriangleBlock::hit`].
    #[inline(always)]
    pub(super) fn candidates<E: Eight>(
        &self,
        e: E,
        ray: &ShearRay,
        limit: f32,
    ) -> Option<Candidates> {
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
            return None;
        }
        let strictly = e.below(zero, least) | e.below(most, zero);
        let sz = e.splat(ray.shear.z);
        let sum = e.add(
            e.add(e.mul(u, e.mul(sz, az)), e.mul(v, e.mul(sz, bz))),
            e.mul(w, e.mul(sz, cz)),
        );
        let t = e.div(sum, e.add(e.add(u, v), w));
        let within = e.at_most(e.splat(ray.t_min), t) & e.at_most(t, e.splat(limit));
        let lanes = inside & (within | !strictly);
        if lanes == 0 {
            return None;
        }
        Some(Candidates {
            lanes,
            strictly,
            weights: [e.store(u), e.store(v), e.store(w)],
            t: e.store(t),
        })
    }

    /// The hit in one lane of the candidates, or `None`.
    ///
    /// `t` is never less than the distance at which the ray enters the triangle's own box, and a
    /// ray that misses that box misses the triangle. Both depend on triangle and ray alone, and the
    /// boxes of the tree contain that box. So culling never changes a result, even where rounding
    /// moves `t` (a triangle seen edge-on).
    #[inline(always)]
    pub(super) fn hit(
        &self,
        lane: usize,
        candidates: &Candidates,
        ray: &ShearRay,
        slab: &SlabRay,
    ) -> Option<TriangleHit> {
        let corners = self.coordinates(lane);
        let found = if candidates.strictly >> lane & 1 == 1 {
            let [u, v, w] = &candidates.weights;
            (candidates.t.0[lane], [u.0[lane], v.0[lane], w.0[lane]])
        } else {
            Self::on_an_edge(corners, ray)?
        };
        Self::in_box(corners, found, ray, slab)
    }

    /// The hit at a distance and with these weights, if it is ahead and the ray meets the triangle's
    /// box.
    #[inline(always)]
    fn in_box(
        [a, b, c]: [[f32; 3]; 3],
        (t, [u, v, w]): (f32, [f32; 3]),
        ray: &ShearRay,
        slab: &SlabRay,
    ) -> Option<TriangleHit> {
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
        let determinant = u + v + w;
        Some(TriangleHit {
            t: t.max(enter),
            b1: v / determinant,
            b2: w / determinant,
        })
    }

    /// Distance and weights of a hit on an edge or a corner; `None` if it is beside the triangle.
    #[cold]
    #[inline(never)]
    fn on_an_edge(corners: [[f32; 3]; 3], ray: &ShearRay) -> Option<(f32, [f32; 3])> {
        let [(ax, ay, az), (bx, by, bz), (cx, cy, cz)] = corners.map(|corner| ray.project(corner));
        // Products of two 24-bit numbers fit 53 bits: here the sign is exact.
        let [ax, ay, bx, by, cx, cy] = [ax, ay, bx, by, cx, cy].map(f64::from);
        let u = (cx * by - cy * bx) as f32;
        let v = (ax * cy - ay * cx) as f32;
        let w = (bx * ay - by * ax) as f32;
        let ahead = u >= 0.0 && v >= 0.0 && w >= 0.0;
        let behind = u <= 0.0 && v <= 0.0 && w <= 0.0;
        let determinant = u + v + w;
        if !(ahead || behind) || determinant == 0.0 {
            return None;
        }
        let t = (u * az + v * bz + w * cz) / determinant;
        Some((t, [u, v, w]))
    }

    /// The hit in one lane, found without looking at the others: what a search must find.
    #[cfg(test)]
    pub(super) fn hit_alone(
        &self,
        lane: usize,
        ray: &ShearRay,
        slab: &SlabRay,
    ) -> Option<TriangleHit> {
        let corners = self.coordinates(lane);
        let [(ax, ay, az), (bx, by, bz), (cx, cy, cz)] = corners.map(|corner| ray.project(corner));
        let weights = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
        let (t, weights) = if weights.contains(&0.0) {
            Self::on_an_edge(corners, ray)?
        } else {
            let [u, v, w] = weights;
            if weights.iter().any(|weight| (*weight > 0.0) != (u > 0.0)) {
                return None;
            }
            ((u * az + v * bz + w * cz) / (u + v + w), weights)
        };
        Self::in_box(corners, (t, weights), ray, slab)
    }
}
