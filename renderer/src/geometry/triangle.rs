//! Does a ray meet a triangle? Watertight, eight triangles at a time.

use glam::Vec3;

use super::slab::{LANES, SlabRay, greater, less};

/// Eight triangles by vertex, axis and lane; lanes that are not used hold NaN, which no ray meets.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct TriangleBlock {
    vertices: [[[f32; LANES]; 3]; 3],
    ids: [u32; LANES],
}

/// A ray made ready for triangle tests: axes permuted so that the ray runs along the third, and sheared onto it.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShearRay {
    origin: [f32; 3],
    axes: [usize; 3],
    shear: [f32; 3],
    t_min: f32,
}

impl ShearRay {
    /// Prepares a ray; the direction is finite and not zero.
    #[inline]
    pub(super) fn new(origin: Vec3, direction: Vec3, t_min: f32) -> Self {
        let size = direction.abs();
        let z = if size.x > size.y && size.x > size.z {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let axes = if direction[z] < 0.0 {
            [y, x, z]
        } else {
            [x, y, z]
        };
        Self {
            origin: origin.to_array(),
            axes,
            shear: [
                direction[axes[0]] / direction[z],
                direction[axes[1]] / direction[z],
                1.0 / direction[z],
            ],
            t_min,
        }
    }
}

/// Where a ray meets a triangle: the distance, and the weights of the second and third vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TriangleHit {
    pub(super) t: f32,
    pub(super) b1: f32,
    pub(super) b2: f32,
}

impl TriangleBlock {
    /// Packs at most eight triangles with their numbers.
    pub(super) fn new(triangles: &[(u32, [Vec3; 3])]) -> Self {
        assert!(triangles.len() <= LANES, "a block has eight lanes");
        let mut block = Self {
            vertices: [[[f32::NAN; LANES]; 3]; 3],
            ids: [u32::MAX; LANES],
        };
        for (lane, (id, corners)) in triangles.iter().enumerate() {
            block.ids[lane] = *id;
            for (vertex, corner) in corners.iter().enumerate() {
                for axis in 0..3 {
                    block.vertices[vertex][axis][lane] = corner[axis];
                }
            }
        }
        block
    }

    /// Number of the triangle in a lane.
    pub(super) fn id(&self, lane: usize) -> u32 {
        self.ids[lane]
    }

    fn corner(&self, vertex: usize, lane: usize) -> [f32; 3] {
        self.vertices[vertex].map(|axis| axis[lane])
    }

    /// Calls `accept` for every lane that the ray may meet: bit `l` set if lane `l` passed the edge tests.
    ///
    /// The edge functions of \[woop2013\] on eight lanes in `f32`. A product that rounds keeps its order, so the sign
    /// of a difference of two products is right or the difference is 0; zeros pass here and are settled by
    /// [`TriangleBlock::hit`]. This loop is the seam for a hand-written kernel: any kernel that gives a superset of
    /// these bits gives the same hits.
    #[inline]
    pub(super) fn candidates(&self, ray: &ShearRay) -> u32 {
        let [kx, ky, kz] = ray.axes;
        let [sx, sy, _] = ray.shear;
        let mut xs = [[0.0_f32; LANES]; 3];
        let mut ys = [[0.0_f32; LANES]; 3];
        for vertex in 0..3 {
            let corner = &self.vertices[vertex];
            for lane in 0..LANES {
                let z = corner[kz][lane] - ray.origin[kz];
                xs[vertex][lane] = (corner[kx][lane] - ray.origin[kx]) - sx * z;
                ys[vertex][lane] = (corner[ky][lane] - ray.origin[ky]) - sy * z;
            }
        }
        let mut inside = [0_u32; LANES];
        for lane in 0..LANES {
            let u = xs[2][lane] * ys[1][lane] - ys[2][lane] * xs[1][lane];
            let v = xs[0][lane] * ys[2][lane] - ys[0][lane] * xs[2][lane];
            let w = xs[1][lane] * ys[0][lane] - ys[1][lane] * xs[0][lane];
            // The smallest and greatest of the three: signs agree, zeros with either.
            let least = less(less(u, v), w);
            let most = greater(greater(u, v), w);
            inside[lane] = u32::from(least >= 0.0) | u32::from(most <= 0.0);
        }
        inside.iter().rev().fold(0, |bits, &lane| bits << 1 | lane)
    }

    /// The hit in one lane, or `None`.
    ///
    /// `t` is never less than the distance at which the ray enters the triangle's own box, and a ray that misses that
    /// box misses the triangle. Both are facts about triangle and ray alone, and boxes of the tree contain that box:
    /// so culling by them changes nothing, even where rounding moves `t` (a triangle seen edge-on).
    #[inline]
    pub(super) fn hit(&self, lane: usize, ray: &ShearRay, slab: &SlabRay) -> Option<TriangleHit> {
        let [a, b, c] = [0, 1, 2].map(|vertex| self.corner(vertex, lane));
        let [kx, ky, kz] = ray.axes;
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
        // Written so that a NaN is a miss.
        if !(t >= ray.t_min && t < f32::INFINITY) {
            return None;
        }
        let low = |i: usize| a[i].min(b[i]).min(c[i]);
        let high = |i: usize| a[i].max(b[i]).max(c[i]);
        let enter = slab.one([low(0), low(1), low(2)], [high(0), high(1), high(2)])?;
        Some(TriangleHit {
            t: t.max(enter),
            b1: v / determinant,
            b2: w / determinant,
        })
    }
}
