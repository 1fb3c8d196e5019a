//! Why a scene cannot be built.

use std::path::PathBuf;

use thiserror::Error;

use crate::film::MOST_RADIANCE;
use crate::geometry::scatter::{ScatterError, VolumeError};
use crate::geometry::{GeometryError, ImportError, MeshError};
use crate::scene::assets::AssetError;
use crate::scene::description::FocusError;
use crate::scene::description::light::LightError;
use crate::scene::plants::{PlantError, SolidError};

/// Bytes of a GiB.
const GIB: f64 = 1024.0 * 1024.0 * 1024.0;

/// Why a described scene cannot be built.
#[derive(Debug, Error)]
pub enum WorldError {
    /// A block cannot be built.
    #[error("{place}: {source}")]
    Block {
        /// Where it is in the scene, such as `meshes.wall`.
        place: String,
        /// Why.
        source: Box<BlockError>,
    },
    /// A file cannot be read or has other contents.
    #[error("{place}: {source}")]
    Asset {
        /// Block of the scene that names it.
        place: String,
        /// What is wrong with it.
        source: AssetError,
    },
    /// A light cannot be made.
    #[error(transparent)]
    Light(#[from] LightError),
    /// The mesh of a body with a medium in it has holes.
    #[error(
        "objects.{object}: its mesh does not enclose a body with normals to the outside, and \
         `interior` of the material `{material}` fills one: use a closed mesh, such as a box, a sphere \
         or a lump"
    )]
    OpenBody {
        /// Name of the object.
        object: String,
        /// Name of its material.
        material: String,
    },
    /// The meshes take more memory than is allowed.
    #[error(
        "the meshes of this scene have {triangles} triangles, which need about {:.1} GiB of memory while their trees are built, more \
         than the {:.1} GiB that are allowed: make them coarser, or allow it with --memory {}",
        .needed / GIB, .allowed / GIB, (.needed / GIB).ceil()
    )]
    Memory {
        /// How many there are.
        triangles: usize,
        /// Memory that they need, bytes.
        needed: f64,
        /// Memory that is allowed, bytes.
        allowed: f64,
    },
    /// The picture cannot be balanced by its light.
    #[error(
        "picture.white_light: the light `{name}` {why}: name another one, or write `white` or \
         `white_object` instead"
    )]
    WhiteLight {
        /// Name of the light.
        name: String,
        /// Why not.
        why: &'static str,
    },
    /// A light is brighter than a film can record.
    #[error(
        "lights.{name}: at {nm:.0} nm it shows {radiance:.1e} W m^-2 sr^-1 nm^-1 or more, and a film \
         records at most {:.1e}: scale all lights down, which scales the picture alike; `d65` and \
         `blackbody_k` have the value of `scale` at 560 nm",
        MOST_RADIANCE
    )]
    TooBright {
        /// Name of the light.
        name: String,
        /// A wavelength at which it is, nm.
        nm: f32,
        /// Its radiance there, or that of white paper in its light.
        radiance: f32,
    },
    /// The camera cannot be focused.
    #[error(transparent)]
    Focus(#[from] FocusError),
    /// The geometry as a whole cannot be built.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
}

impl WorldError {
    /// That a block cannot be built; `place` as in [`WorldError::Block`].
    pub(crate) fn of<E: Into<BlockError>>(place: String) -> impl FnOnce(E) -> Self {
        |source| Self::Block {
            place,
            source: Box::new(source.into()),
        }
    }
}

/// Why a block of a scene cannot be built.
#[derive(Debug, Error)]
pub enum BlockError {
    /// A mesh is not valid.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A mesh file cannot be understood.
    #[error("{file}: {source}")]
    Import {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        source: ImportError,
    },
    /// A leaf cannot be grown.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// A body of solid tissue cannot be grown.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// There is no room for what is strewn.
    #[error(transparent)]
    Scatter(#[from] ScatterError),
    /// A box cannot be filled with leaves.
    #[error(transparent)]
    Volume(#[from] VolumeError),
}
