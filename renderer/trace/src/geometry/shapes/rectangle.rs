//! A flat rectangle.

use document::declared::{Declared, Defaults};
use glam::{Vec2, Vec3};

use crate::geometry::{MeshError, TriangleMesh};

/// A rectangle in the xy plane around the origin, normal +z, uv from 0 to 1.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Rectangle {
    /// Extent along x.
    #[key("width_m", required, above(0.0, 1e6), default = 1.0)]
    pub width: f64,
    /// Extent along y.
    #[key("height_m", required, above(0.0, 1e6), default = 1.0)]
    pub height: f64,
}

impl Rectangle {
    /// Two triangles.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if it is too large or too small for single precision.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let (x, y) = (0.5 * self.width as f32, 0.5 * self.height as f32);
        let corners = [(-x, -y), (x, -y), (x, y), (-x, y)];
        TriangleMesh::new(
            corners.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec(),
            None,
            Some(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]),
            vec![[0, 1, 2], [0, 2, 3]],
        )
    }
}
