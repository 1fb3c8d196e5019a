//! A mesh placed in the world.

use glam::Affine3A;

/// A mesh placed in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index of the mesh.
    pub mesh: u32,
    /// Mesh frame to world, metres; invertible. It may rotate, scale, shear and mirror.
    pub to_world: Affine3A,
}
