//! Surfaces over a lattice of longitude and latitude.

use document::declared::{Declared, Defaults};
use glam::{DVec3, Vec2, Vec3};

use crate::geometry::{MeshError, TriangleMesh};

/// A sphere around the origin, of longitude–latitude triangles whose vertices lie on it.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Sphere {
    /// Its radius.
    #[key("radius_m", required, above(0.0, 1e6), default = 1.0)]
    pub radius: f64,
    /// Triangles around the equator, half as many from pole to pole.
    #[key("segments", 8..=4096, default = 64)]
    pub segments: u32,
}

impl Sphere {
    /// Its surface, with its exact normals.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if the radius is too large or too small for single precision.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        globe(self.segments, std::f64::consts::PI, |direction| {
            let normal = direction.as_vec3();
            (normal * self.radius as f32, normal)
        })
    }
}

/// A surface that starts `open` radians from the upper pole and ends there; with π it starts at the
/// lower pole and is closed. `point` gives position and normal in a direction from its middle.
pub(super) fn globe(
    segments: u32,
    open: f64,
    point: impl Fn(DVec3) -> (Vec3, Vec3),
) -> Result<TriangleMesh, MeshError> {
    let rings = (segments / 2).max(2);
    let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
    let from = std::f64::consts::PI - open;
    for ring in 0..=rings {
        let theta = from + open * f64::from(ring) / f64::from(rings);
        let (sin_theta, cos_theta) = libm::sincos(theta);
        for segment in 0..=segments {
            let (sin_phi, cos_phi) =
                libm::sincos(std::f64::consts::TAU * f64::from(segment) / f64::from(segments));
            // South first, so that v grows with z.
            let direction = DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, -cos_theta);
            let (position, normal) = point(direction);
            positions.push(position);
            normals.push(normal);
            uvs.push(Vec2::new(
                segment as f32 / segments as f32,
                ring as f32 / rings as f32,
            ));
        }
    }
    let mut triangles = Vec::new();
    let starts_at_pole = from == 0.0;
    for ring in 0..rings {
        for segment in 0..segments {
            let lower = ring * (segments + 1) + segment;
            let upper = lower + segments + 1;
            if ring > 0 || !starts_at_pole {
                triangles.push([lower, lower + 1, upper + 1]);
            }
            if ring + 1 < rings {
                triangles.push([lower, upper + 1, upper]);
            }
        }
    }
    TriangleMesh::new(positions, Some(normals), Some(uvs), triangles)
}
