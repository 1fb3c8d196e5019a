//! Why geometry was refused.

use thiserror::Error;

/// Instances and tree nodes share 32 bits.
pub(super) const MOST_INSTANCES: usize = 1 << 29;

/// Why meshes and instances were refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GeometryError {
    /// An instance refers to a mesh that does not exist.
    #[error(
        "instance {instance} names mesh {mesh}, but there are {meshes} meshes (counted from 0)"
    )]
    NoSuchMesh {
        /// Number of the instance.
        instance: usize,
        /// The missing mesh.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// A transform is not finite, flattens the mesh, or takes it beyond what `f32` can hold.
    #[error("the transform of instance {instance} {what}")]
    Transform {
        /// Number of the instance.
        instance: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// There are more instances than can be numbered.
    #[error("there are {given} instances; the most is {MOST_INSTANCES}")]
    TooManyInstances {
        /// How many there are.
        given: usize,
    },
}
