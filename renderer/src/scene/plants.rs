//! The seam to leafmodel: grown leaves become meshes and materials, millimetres become metres.

use glam::Vec2;
use leafmodel::leaf::{Leaf, LeafError};
use thiserror::Error;

use crate::geometry::{MeshError, TriangleMesh};
use crate::material::contents_texture::ContentsTexture;
use crate::material::leaf::{LeafMaterial, LeafTissue};
use crate::scene::description;
use crate::scene::world::build_coat;
use crate::spectrum::Curve;

/// A grown leaf, ready to be placed.
#[derive(Debug)]
pub struct GrownLeaf {
    /// The blade, metres, base at the origin, midrib along +y, adaxial side +z.
    pub mesh: TriangleMesh,
    /// Its contents map and coats.
    pub material: LeafMaterial,
}

/// Why a leaf cannot be grown.
#[derive(Debug, Error)]
pub enum PlantError {
    /// The plan cannot be carried out.
    #[error(transparent)]
    Leaf(#[from] LeafError),
    /// The blade's mesh is refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Grows a leaf.
///
/// # Errors
///
/// [`PlantError`] if the plan cannot be carried out.
pub fn grow(leaf: &description::Leaf) -> Result<GrownLeaf, PlantError> {
    let grown = Leaf::grow(&leaf.plan)?;
    let blade = &grown.mesh;
    let mesh = TriangleMesh::new(
        blade
            .positions
            .iter()
            .map(|&position| (position * 1e-3).as_vec3())
            .collect(),
        Some(
            blade
                .normals
                .iter()
                .map(|normal| normal.as_vec3())
                .collect(),
        ),
        Some(
            blade
                .uvs
                .iter()
                .map(|uv| Vec2::new(uv.x as f32, uv.y as f32))
                .collect(),
        ),
        blade.triangles.clone(),
    )?;
    let map = grown.contents;
    let material = LeafMaterial {
        tissue: LeafTissue::Map(ContentsTexture::new(
            map.width as usize,
            map.height as usize,
            map.texels,
        )),
        abaxial_ratio: Curve::from_description(&leaf.abaxial_ratio),
        coats: leaf.coats.map(build_coat),
    };
    Ok(GrownLeaf { mesh, material })
}
