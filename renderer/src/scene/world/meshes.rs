//! Meshes from files, and of shapes that a scene gives by numbers.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::WorldError;
use crate::geometry::TriangleMesh;
use crate::geometry::shapes::{cuboid, disc, sphere};
use crate::material::colour_map::ColourMap;
use crate::material::model::Finish;
use crate::scene::assets;
use crate::scene::description;
use crate::scene::model::Wanted;
use crate::scene::plants::tube;

/// What a mesh from a glTF file says of its own surface, as far as it is wanted.
#[derive(Default)]
pub(super) struct OwnSurface {
    /// Its base colours.
    pub(super) colours: Option<ColourMap>,
    /// Roughness, metal and normals of each slot of the colours.
    pub(super) finishes: Option<Arc<[Finish]>>,
    /// The light that it emits.
    pub(super) emission: Option<ColourMap>,
}

/// A mesh that was built.
pub(in crate::scene) struct Built {
    pub(in crate::scene) mesh: TriangleMesh,
    /// Its own surface, as far as it has one and that is wanted.
    pub(super) surface: OwnSurface,
    /// What of its file was left out.
    pub(super) left_out: Vec<String>,
}

/// Reads or makes a mesh; `wanted` says what of its own surface is.
pub(in crate::scene) fn build_mesh(
    name: &str,
    shape: &description::Shape,
    wanted: Wanted,
) -> Result<Built, WorldError> {
    let plain = |mesh| Built {
        mesh,
        surface: OwnSurface::default(),
        left_out: Vec::new(),
    };
    let mesh = match shape {
        description::Shape::Mesh(mesh) => mesh,
        description::Shape::Body(body) => {
            let (positions, normals) = tube(body);
            let mesh = TriangleMesh::new(positions, Some(normals), None, body.triangles.clone());
            let named = |source| WorldError::Mesh {
                name: name.to_owned(),
                source,
            };
            return mesh.map(plain).map_err(named);
        }
    };
    if let description::Mesh::Gltf {
        file,
        beside,
        scale,
    } = mesh
    {
        let model = assets::model(file, beside, *scale, wanted);
        let model = model.map_err(|source| WorldError::Asset {
            place: format!("meshes.{name}"),
            source,
        })?;
        return Ok(Built {
            mesh: model.mesh,
            surface: OwnSurface {
                colours: model.colours,
                finishes: model.finishes.map(Arc::from),
                emission: model.emission,
            },
            left_out: model.left_out,
        });
    }
    plain_mesh(name, mesh).map(plain)
}

fn plain_mesh(name: &str, mesh: &description::Mesh) -> Result<TriangleMesh, WorldError> {
    let named = |source| WorldError::Mesh {
        name: name.to_owned(),
        source,
    };
    match mesh {
        description::Mesh::Rectangle { width, height } => {
            let (x, y) = (0.5 * *width as f32, 0.5 * *height as f32);
            let corners = [(-x, -y), (x, -y), (x, y), (-x, y)];
            TriangleMesh::new(
                corners.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec(),
                None,
                Some(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]),
                vec![[0, 1, 2], [0, 2, 3]],
            )
            .map_err(named)
        }
        description::Mesh::Sphere { radius, segments } => sphere(*radius, *segments).map_err(named),
        description::Mesh::Box { size } => cuboid(*size).map_err(named),
        description::Mesh::Disc { radius, segments } => disc(*radius, *segments).map_err(named),
        description::Mesh::Drop(drop) => drop.mesh().map_err(named),
        description::Mesh::Lump(lump) => lump.mesh().map_err(named),
        description::Mesh::Terrain(terrain) => terrain.mesh().map_err(named),
        description::Mesh::Masonry(wall) => wall.mesh().map_err(named),
        description::Mesh::Gltf { .. } => unreachable!("it has colours and was built before"),
        description::Mesh::File { file, scale } => {
            let bytes = assets::read(file).map_err(|source| WorldError::Asset {
                place: format!("meshes.{name}"),
                source,
            })?;
            let extension = file
                .extension()
                .and_then(|ending| ending.to_str())
                .unwrap_or("");
            crate::geometry::import(&bytes, extension, *scale as f32).map_err(|source| {
                WorldError::Import {
                    name: name.to_owned(),
                    file: file.clone(),
                    source,
                }
            })
        }
    }
}
