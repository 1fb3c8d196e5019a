//! A box.

use document::declared::{Declared, Defaults};
use glam::{Vec2, Vec3};

use crate::geometry::{MeshError, TriangleMesh};

/// A closed box around the origin, normals to the outside. Its faces are in the order −x, +x, −y, +y,
/// −z, +z; on each, uv goes from 0 to 1.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Cuboid {
    /// Extent along x, y and z.
    #[key("size_m", required, above(0.0, 1e6), default = [1.0; 3])]
    pub size: [f64; 3],
}

impl Cuboid {
    /// Its faces.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if it is too large or too small for single precision.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let half = Vec3::from_array(self.size.map(|extent| (0.5 * extent) as f32));
        let (mut positions, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for face in 0..6 {
            let (axis, sign) = (face / 2, if face % 2 == 0 { -1.0 } else { 1.0 });
            let (u_axis, v_axis) = ((axis + 1) % 3, (axis + 2) % 3);
            let first = positions.len() as u32;
            for corner in [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y] {
                let mut place = Vec3::ZERO;
                place[axis] = sign;
                // Mirrored on the lower face, so that corners go round counter-clockwise on both.
                place[u_axis] = sign * (2.0 * corner.x - 1.0);
                place[v_axis] = 2.0 * corner.y - 1.0;
                positions.push(place * half);
                uvs.push(corner);
            }
            triangles.extend([[0, 1, 2], [0, 2, 3]].map(|face: [u32; 3]| face.map(|i| first + i)));
        }
        TriangleMesh::new(positions, None, Some(uvs), triangles)
    }
}
