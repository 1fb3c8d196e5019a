//! Grown leaves as plain data.

use glam::{DAffine3, Vec2, Vec3};
use leafmodel::blade::surface::{Cover, SlopeMoments};
use leafmodel::compound::CompoundError;
use leafmodel::leaf::LeafError;
use leafmodel::optics::{Contents, Texel};
use thiserror::Error;

use crate::geometry::{MeshError, TriangleMesh};

/// A part of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Index into [`super::GrownLeaf::meshes`].
    pub mesh: usize,
    /// Index into [`super::GrownLeaf::materials`].
    pub material: usize,
    /// From the mesh to the leaf, metres; may mirror.
    pub to_leaf: DAffine3,
}

/// Why a leaf cannot be grown.
#[derive(Debug, Error)]
pub enum PlantError {
    /// The plan cannot be carried out.
    #[error(transparent)]
    Leaf(#[from] CompoundError),
    /// The contents of its stalks cannot be computed.
    #[error(transparent)]
    Stalks(#[from] LeafError),
    /// The blade's mesh is refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// The data of a grown leaf, in metres, from which a [`GrownLeaf`] is made.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct LeafParts {
    /// As [`super::GrownLeaf::meshes`].
    pub(in crate::scene) meshes: Vec<MeshParts>,
    /// The contents of the different blades.
    pub(in crate::scene) maps: Vec<MapParts>,
    /// Contents of the stalks, if there are any.
    pub(in crate::scene) stalk: Option<Contents>,
    /// Contents of the walls of hairs, by kind.
    pub(in crate::scene) hairs: Vec<Contents>,
    /// As [`super::GrownLeaf::pieces`].
    pub(in crate::scene) pieces: Vec<Piece>,
}

/// The data of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct MeshParts {
    pub(in crate::scene) positions: Vec<Vec3>,
    pub(in crate::scene) normals: Vec<Vec3>,
    /// `None` for stalks, whose contents are uniform.
    pub(in crate::scene) uvs: Option<Vec<Vec2>>,
    pub(in crate::scene) triangles: Vec<[u32; 3]>,
}

impl MeshParts {
    /// The mesh.
    pub(in crate::scene) fn into_mesh(self) -> Result<TriangleMesh, MeshError> {
        TriangleMesh::new(self.positions, Some(self.normals), self.uvs, self.triangles)
    }
}

/// The data of a map of contents.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct MapParts {
    pub(in crate::scene) width: usize,
    pub(in crate::scene) height: usize,
    /// Width and height, mm.
    pub(in crate::scene) size_mm: [f64; 2],
    pub(in crate::scene) texels: Vec<Texel>,
    /// The relief, if the blade has one.
    pub(in crate::scene) surface: Option<SurfaceParts>,
}

/// The data of a relief: slopes on a map of as many texels.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct SurfaceParts {
    pub(in crate::scene) texels: Vec<[SlopeMoments; 2]>,
    /// As many texels, or none.
    pub(in crate::scene) cover: Vec<Cover>,
    pub(in crate::scene) size_mm: [f32; 2],
}
