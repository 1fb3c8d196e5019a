//! Why a scene cannot be built.

use std::path::PathBuf;

use thiserror::Error;

use crate::camera::thin_lens::LensError;
use crate::film::MOST_RADIANCE;
use crate::geometry::scatter::{ScatterError, VolumeError};
use crate::geometry::{GeometryError, ImportError, MeshError};
use crate::scene::assets::AssetError;
use crate::scene::description::light::LightError;
use crate::scene::plants::{PlantError, SolidError};

/// Bytes of a GiB.
const GIB: f64 = 1024.0 * 1024.0 * 1024.0;

/// Why a described scene cannot be built.
#[derive(Debug, Error)]
pub enum WorldError {
    /// A mesh of the scene is not valid.
    #[error("meshes.{name}: {source}")]
    Mesh {
        /// Name in the scene.
        name: String,
        /// What is wrong with it.
        source: MeshError,
    },
    /// A mesh file cannot be understood.
    #[error("meshes.{name}: {file}: {source}")]
    Import {
        /// Name in the scene.
        name: String,
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        source: ImportError,
    },
    /// A file cannot be read or has other contents.
    #[error("{place}: {source}")]
    Asset {
        /// Block of the scene that names it.
        place: String,
        /// What is wrong with it.
        source: AssetError,
    },
    /// A leaf cannot be grown.
    #[error("leaves.{name}: {source}")]
    Plant {
        /// Name in the scene.
        name: String,
        /// Why.
        source: Box<PlantError>,
    },
    /// A body of solid tissue cannot be grown.
    #[error("solids.{name}: {source}")]
    Solid {
        /// Name in the scene.
        name: String,
        /// Why.
        source: Box<SolidError>,
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
    /// There is no room for what is strewn.
    #[error("objects.{name}.scatter: {source}")]
    Scatter {
        /// Name of the object.
        name: String,
        /// Why.
        source: ScatterError,
    },
    /// A box cannot be filled with leaves.
    #[error("objects.{name}.volume: {source}")]
    Volume {
        /// Name of the object.
        name: String,
        /// Why.
        source: VolumeError,
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
    /// The camera cannot be focused on its object.
    #[error("camera.perspective.focus_object: {0}")]
    Focus(LensError),
    /// The geometry as a whole cannot be built.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
}
