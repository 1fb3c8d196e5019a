//! A flat disc.

use document::declared::{Declared, Defaults};
use glam::{Vec2, Vec3};

use crate::geometry::{MeshError, TriangleMesh};

/// A disc in the xy plane around the origin, normal +z, with uv from 0 to 1 over the square around
/// it. It is a regular polygon with the area of the disc, so that leaf areas are exact.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Disc {
    /// Radius of a disc of its area.
    #[key("radius_m", required, above(0.0, 1e6), default = 0.01)]
    pub radius: f64,
    /// Its corners.
    #[key("segments", 8..=4096, default = 24)]
    pub segments: u32,
}

impl Disc {
    /// Its triangles around the first corner.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if the radius is too large or too small for single precision.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let &Self { radius, segments } = self;
        let step = std::f64::consts::TAU / f64::from(segments);
        // n/2 r² sin(2π/n) = π radius².
        let corner = radius * (step / libm::sin(step)).sqrt();
        let mut positions = Vec::with_capacity(segments as usize);
        let mut uvs = Vec::with_capacity(segments as usize);
        for number in 0..segments {
            let (sin, cos) = libm::sincos(step * f64::from(number));
            positions.push(Vec3::new((corner * cos) as f32, (corner * sin) as f32, 0.0));
            uvs.push(Vec2::new(0.5 + 0.5 * cos as f32, 0.5 + 0.5 * sin as f32));
        }
        let triangles = (1..segments - 1).map(|number| [0, number, number + 1]);
        TriangleMesh::new(positions, None, Some(uvs), triangles.collect())
    }
}
