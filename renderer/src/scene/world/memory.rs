//! Memory that a world takes while it is built, as far as it can be said before.

use super::error::WorldError;
use crate::geometry::TriangleMesh;
use crate::geometry::scatter::Most;

/// Memory of a triangle with its fraction of the trees while they are built, bytes; measured with
/// spheres of 16.8 million triangles (4.9 GB).
pub(super) const OF_A_TRIANGLE: f64 = 290.0;

/// Memory of an instance of a mesh, bytes: its placement with its fraction of the upper tree;
/// measured with 168,000 leaves of two parts (363 MB).
pub(super) const OF_AN_INSTANCE: f64 = 1100.0;

/// Memory that is left for what is built next.
#[derive(Debug)]
pub(super) struct Memory {
    /// What may be taken in all, bytes; infinite if nobody limits it.
    all: f64,
    left: f64,
}

impl Memory {
    pub(super) fn new(most_bytes: Option<f64>) -> Self {
        let all = most_bytes.unwrap_or(f64::INFINITY);
        Self { all, left: all }
    }

    /// Takes what meshes need with their trees.
    pub(super) fn take_meshes(&mut self, meshes: &[TriangleMesh]) -> Result<(), WorldError> {
        let triangles: usize = meshes.iter().map(|mesh| mesh.triangles().len()).sum();
        let needed = triangles as f64 * OF_A_TRIANGLE;
        if needed > self.left {
            return Err(WorldError::Memory {
                triangles,
                needed,
                allowed: self.all,
            });
        }
        self.left -= needed;
        Ok(())
    }

    /// How many things there may be if each is so many instances.
    pub(super) fn most(&self, instances: usize) -> Most {
        let things = self.left / (instances.max(1) as f64 * OF_AN_INSTANCE);
        // Infinity becomes the greatest number.
        Most::UNBOUND.and(Most::InMemory(things as usize))
    }

    /// Takes what instances need.
    pub(super) fn take_instances(&mut self, instances: usize) {
        self.left -= instances as f64 * OF_AN_INSTANCE;
    }
}
