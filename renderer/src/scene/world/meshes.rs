//! Meshes from files, and of shapes that a scene gives by numbers.

use std::sync::Arc;

use super::error::{BlockError, WorldError};
use crate::geometry::{self, TriangleMesh};
use crate::material::colour_map::ColourMap;
use crate::material::model::Finish;
use crate::scene::assets;
use crate::scene::description::{FileMesh, Mesh, Shape};
use crate::scene::model::Wanted;
use crate::scene::plants::stalk;

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
pub(crate) struct Built {
    pub(crate) mesh: TriangleMesh,
    /// Its own surface, as far as it has one and that is wanted.
    pub(super) surface: OwnSurface,
    /// What of its file was left out.
    pub(crate) left_out: Vec<String>,
}

/// Reads or makes a mesh; `wanted` says what of its own surface is.
pub(crate) fn build_mesh(name: &str, shape: &Shape, wanted: Wanted) -> Result<Built, WorldError> {
    let plain = |mesh| Built {
        mesh,
        surface: OwnSurface::default(),
        left_out: Vec::new(),
    };
    let place = format!("meshes.{name}");
    let asset = |source| WorldError::Asset {
        place: place.clone(),
        source,
    };
    let mesh = match shape {
        Shape::Body(body) => stalk(body).into_mesh(),
        Shape::Mesh(Mesh::Rectangle(rectangle)) => rectangle.mesh(),
        Shape::Mesh(Mesh::Sphere(sphere)) => sphere.mesh(),
        Shape::Mesh(Mesh::Box(cuboid)) => cuboid.mesh(),
        Shape::Mesh(Mesh::Disc(disc)) => disc.mesh(),
        Shape::Mesh(Mesh::Drop(drop)) => drop.mesh(),
        Shape::Mesh(Mesh::Lump(lump)) => lump.mesh(),
        Shape::Mesh(Mesh::Terrain(terrain)) => terrain.mesh(),
        Shape::Mesh(Mesh::Masonry(wall)) => wall.mesh(),
        Shape::Mesh(Mesh::Gltf(model)) => {
            let model = assets::model(model, wanted).map_err(asset)?;
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
        Shape::Mesh(Mesh::File(FileMesh { path, scale })) => {
            let file = &path.file;
            let bytes = assets::read(file).map_err(asset)?;
            let ending = file.extension().and_then(|ending| ending.to_str());
            let mesh = geometry::import(&bytes, ending.unwrap_or(""), *scale as f32);
            let file = file.clone();
            let import = |source| WorldError::of(place)(BlockError::Import { file, source });
            return mesh.map(plain).map_err(import);
        }
    };
    mesh.map(plain).map_err(WorldError::of(place))
}
