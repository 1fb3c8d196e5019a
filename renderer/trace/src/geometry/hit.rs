//! Hits.

/// The nearest intersection of a ray with the geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction.
    pub t: f32,
    /// Number of the instance.
    pub instance: u32,
    /// Number of the triangle in the instance's mesh.
    pub triangle: u32,
    /// Weight of the triangle's second vertex.
    pub b1: f32,
    /// Weight of the triangle's third vertex.
    pub b2: f32,
    /// Block and lane of the triangle in the tree by which it is traced, where its corners are
    /// likely still in the cache.
    pub(super) place: u32,
}
