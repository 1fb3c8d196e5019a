//! Where a ray meets the geometry.

/// Where a ray meets the geometry first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Number of the instance.
    pub instance: u32,
    /// Number of the triangle in the instance's mesh.
    pub triangle: u32,
    /// Weight of the triangle's second vertex.
    pub b1: f32,
    /// Weight of the triangle's third vertex.
    pub b2: f32,
    /// Block and lane in which the mesh's tree holds the triangle: its corners are still in the
    /// cache there.
    pub(super) place: u32,
}
