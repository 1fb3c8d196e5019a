//! Meshes, transforms and rays for the tests of this module.

use glam::{Affine3A, DVec3, EulerRot, Mat3, Quat, Vec2, Vec3};

use super::{Geometry, Instance, Ray, TriangleMesh};
use crate::sampling::mixer::scramble;

/// Pseudo-random numbers, the same on every run.
pub(super) struct Numbers(u64);

impl Numbers {
    pub(super) fn new(seed: u64) -> Self {
        Self(scramble(seed))
    }

    /// In [0, 1).
    pub(super) fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(1);
        (scramble(self.0) >> 40) as f32 / 16_777_216.0
    }

    /// In [-1, 1)³.
    pub(super) fn cube(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    pub(super) fn direction(&mut self) -> Vec3 {
        loop {
            let point = self.cube();
            if point.length_squared() > 0.01 && point.length_squared() <= 1.0 {
                return point.normalize();
            }
        }
    }

    pub(super) fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f32) as usize).min(n - 1)
    }

    /// A rotation, a shear, unequal scales, perhaps a mirror, and a shift.
    pub(super) fn affine(&mut self, shift: f32) -> Affine3A {
        let turn = self.cube() * 3.0;
        let rotation = Mat3::from_quat(Quat::from_euler(EulerRot::XYZ, turn.x, turn.y, turn.z));
        let shear = Mat3::from_cols(
            Vec3::new(0.5 + self.unit(), 0.0, 0.0),
            Vec3::new(
                self.unit() - 0.5,
                if self.unit() < 0.5 { -1.2 } else { 0.8 },
                0.0,
            ),
            Vec3::new(self.unit() - 0.5, self.unit() - 0.5, 1.5),
        );
        Affine3A::from_mat3_translation(rotation * shear, self.cube() * shift)
    }
}

/// Random triangles in a cube of half-width `scale` around `center`.
pub(super) fn soup(seed: u64, count: u32, scale: f32, center: Vec3) -> TriangleMesh {
    let mut numbers = Numbers::new(seed);
    let mut positions = Vec::new();
    for _ in 0..count {
        let (at, size) = (numbers.cube(), 0.02 + 0.3 * numbers.unit());
        for _ in 0..3 {
            positions.push((at + numbers.cube() * size) * scale + center);
        }
    }
    let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh::new(positions, None, None, triangles).expect("random triangles have area")
}

/// A wavy blade `width` × `height` (m) around `center`, in the xy plane, of `2 · columns · rows`
/// triangles, with uvs.
pub(super) fn blade(
    columns: u32,
    rows: u32,
    width: f32,
    height: f32,
    center: Vec3,
) -> TriangleMesh {
    let (mut positions, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..=rows {
        for i in 0..=columns {
            let (u, v) = (i as f32 / columns as f32, j as f32 / rows as f32);
            let z = 0.02 * width * (libm::sinf(19.0 * u) + libm::sinf(13.0 * v + 2.0 * u));
            positions.push(Vec3::new((u - 0.5) * width, (v - 0.5) * height, z) + center);
            uvs.push(Vec2::new(u, v));
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let a = j * (columns + 1) + i;
            let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleMesh::new(positions, None, Some(uvs), triangles).expect("a blade has area")
}

/// Placed meshes, of which those that stand more than once have trees of their own.
pub(super) fn placed(meshes: Vec<TriangleMesh>, to_world: &[(u32, Affine3A)]) -> Geometry {
    placed_with(meshes, to_world, 0)
}

/// Placed meshes; those that stand more than once are joined, if together they have at most so many
/// triangles.
pub(super) fn placed_with(
    meshes: Vec<TriangleMesh>,
    to_world: &[(u32, Affine3A)],
    most_repeated: usize,
) -> Geometry {
    let instances = to_world
        .iter()
        .map(|&(mesh, to_world)| Instance::new(mesh, &to_world.as_daffine3()))
        .collect();
    Geometry::built(meshes, instances, DVec3::ZERO, most_repeated)
        .expect("the transforms can be inverted")
}

pub(super) fn alone(mesh: TriangleMesh) -> Geometry {
    placed(vec![mesh], &[(0, Affine3A::IDENTITY)])
}

/// A ray through the bounds of a geometry, from outside or from within.
pub(super) fn ray_through(numbers: &mut Numbers, geometry: &Geometry) -> Ray {
    let (min, max) = geometry.bounds();
    let (middle, half) = ((min + max) * 0.5, (max - min) * 0.5);
    let target = middle + numbers.cube() * half;
    let origin = if numbers.unit() < 0.5 {
        middle + numbers.direction() * half.length() * 2.0
    } else {
        middle + numbers.cube() * half
    };
    // Directions may have any length.
    Ray::new(origin, (target - origin) * (0.1 + 10.0 * numbers.unit()))
}
