//! The seam to leafmodel: grown leaves and bodies become meshes and materials, millimetres become metres.

use std::sync::Arc;

use glam::{DAffine3, Vec2};
use leafmodel::blade::stalk::StalkMesh;
use leafmodel::compound::{CompoundError, WholeLeaf};
use leafmodel::leaf::{Leaf, LeafError};
use leafmodel::optics::solid::ReflectanceTable;
use leafmodel::solid::{Solid, SolidError as GrowthError};
use thiserror::Error;

use crate::geometry::{MeshError, TriangleMesh};
use crate::material::contents_texture::ContentsTexture;
use crate::material::leaf::{LeafMaterial, LeafTissue};
use crate::material::palette::Palette;
use crate::material::solid::{SolidMaterial, SolidTissue};
use crate::scene::description;
use crate::scene::world::build_coat;
use crate::spectrum::Curve;

/// A grown leaf, ready to be placed: petiole, rachis and leaflets, or one blade alone.
#[derive(Debug)]
pub struct GrownLeaf {
    /// Blades and stalks, metres; a blade's base is at the origin, its midrib along +y, its adaxial side +z.
    pub meshes: Vec<TriangleMesh>,
    /// Content maps and coats of the different blades, then, if there are stalks, what those are made of.
    pub materials: Vec<LeafMaterial>,
    /// What stands where; one at least.
    pub pieces: Vec<Piece>,
}

/// A part of a leaf.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Which of [`GrownLeaf::meshes`].
    pub mesh: usize,
    /// Which of [`GrownLeaf::materials`].
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
    /// The contents of its stalks cannot be told.
    #[error(transparent)]
    Stalks(#[from] LeafError),
    /// The blade's mesh is refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Why a body of solid tissue cannot be grown.
#[derive(Debug, Error)]
pub enum SolidError {
    /// The plan cannot be carried out.
    #[error(transparent)]
    Growth(#[from] GrowthError),
    /// Its mesh is refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Grows a body of solid tissue, in the frame of its shape, whose pigments are those of `palette`; `table` is that of its
/// refractive index.
///
/// # Errors
///
/// [`SolidError`] if the plan cannot be carried out.
pub fn grow_solid(
    solid: &description::Solid,
    palette: Palette,
    table: Arc<ReflectanceTable>,
) -> Result<(TriangleMesh, SolidMaterial), SolidError> {
    let grown = Solid::grow(&solid.plan, &|| false)?;
    let mesh = TriangleMesh::new(
        metres(&grown.positions),
        Some(directions(&grown.normals)),
        Some(grown.uvs.iter().map(|uv| uv.as_vec2()).collect()),
        grown.triangles,
    )?;
    let map = grown.contents;
    let tissue = SolidTissue::Map(ContentsTexture::new(
        map.width as usize,
        map.height as usize,
        map.texels,
    ));
    let optics = solid.optics;
    let coat = build_coat(optics.coat);
    let material = SolidMaterial::new(tissue, palette, optics.tissue, table, coat);
    Ok((mesh, material))
}

/// Grows a leaf whose pigments are those of `palette`.
///
/// # Errors
///
/// [`PlantError`] if the plan cannot be carried out.
pub fn grow(leaf: &description::Leaf, palette: &Palette) -> Result<GrownLeaf, PlantError> {
    let whole = WholeLeaf::grow(&leaf.plan)?;
    let stalk_contents = whole.stalk_contents(&leaf.plan)?;
    let ratio = Curve::from_description(&leaf.abaxial_ratio);
    let coats = leaf.coats.map(build_coat);
    let material =
        |tissue| LeafMaterial::new(tissue, palette.clone(), ratio.clone(), coats.clone());
    let (mut meshes, mut materials) = (Vec::new(), Vec::new());
    // The mesh of each blade, and that of its stalk.
    let mut own = Vec::new();
    let stalk_material = whole.blades.len();
    for grown in whole.blades {
        own.push((meshes.len(), grown.petiole.is_some()));
        meshes.push(blade(&grown)?);
        if let Some(petiole) = &grown.petiole {
            meshes.push(stalk(petiole)?);
        }
        let map = grown.contents;
        materials.push(material(LeafTissue::Map(ContentsTexture::new(
            map.width as usize,
            map.height as usize,
            map.texels,
        ))));
    }
    let mut pieces = Vec::new();
    for placement in &whole.placements {
        let (mesh, has_stalk) = own[placement.blade];
        let to_leaf = DAffine3 {
            translation: placement.to_leaf.translation * 1e-3,
            ..placement.to_leaf
        };
        let piece = |mesh, material| Piece {
            mesh,
            material,
            to_leaf,
        };
        pieces.push(piece(mesh, placement.blade));
        pieces.extend(has_stalk.then(|| piece(mesh + 1, stalk_material)));
    }
    if let Some(axes) = &whole.axes {
        pieces.push(Piece {
            mesh: meshes.len(),
            material: stalk_material,
            to_leaf: DAffine3::IDENTITY,
        });
        meshes.push(stalk(axes)?);
    }
    if pieces.iter().any(|piece| piece.material == stalk_material) {
        // The tube's wall is a leaf of that.
        materials.push(material(LeafTissue::Uniform(stalk_contents)));
    }
    Ok(GrownLeaf {
        meshes,
        materials,
        pieces,
    })
}

fn blade(grown: &Leaf) -> Result<TriangleMesh, MeshError> {
    let blade = &grown.mesh;
    TriangleMesh::new(
        metres(&blade.positions),
        Some(directions(&blade.normals)),
        Some(
            blade
                .uvs
                .iter()
                .map(|uv| Vec2::new(uv.x as f32, uv.y as f32))
                .collect(),
        ),
        blade.triangles.clone(),
    )
}

/// Without texture coordinates: the same everywhere.
fn stalk(tubes: &StalkMesh) -> Result<TriangleMesh, MeshError> {
    TriangleMesh::new(
        metres(&tubes.positions),
        Some(directions(&tubes.normals)),
        None,
        tubes.triangles.clone(),
    )
}

fn metres(positions: &[glam::DVec3]) -> Vec<glam::Vec3> {
    let position = positions.iter();
    position.map(|&p| (p * 1e-3).as_vec3()).collect()
}

fn directions(normals: &[glam::DVec3]) -> Vec<glam::Vec3> {
    normals.iter().map(|normal| normal.as_vec3()).collect()
}
