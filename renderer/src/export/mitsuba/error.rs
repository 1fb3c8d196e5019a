//! Why a scene cannot be exported to Mitsuba.

use std::path::PathBuf;

use thiserror::Error;

use crate::export::gltf::GltfError;
use crate::image::ImageError;
use crate::scene::assets::AssetError;

/// Why a scene could not be exported.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The folder or a file in it cannot be written.
    #[error("{path}: {source}")]
    Write {
        /// The file or folder that was being written.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A map cannot be written.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The picture of a light cannot be read any more.
    #[error(transparent)]
    Asset(#[from] AssetError),
    /// Light that changes its wavelength.
    #[error(
        "a leaf fluoresces, which cannot be exported: Mitsuba's light keeps its wavelength; leave \
         `fluorescence` out"
    )]
    Fluorescence,
    /// A lens that Mitsuba does not have; the key that says so.
    #[error(
        "camera.perspective.{0} cannot be exported: Mitsuba's thin lens is round, open over the \
         whole picture and parallel to the film; leave the key out"
    )]
    Lens(&'static str),
    /// Bodies within each other.
    #[error(
        "the objects `{first}` and `{second}` are transparent bodies that touch or lie within each \
         other, of which one holds a medium or has the index of air: Mitsuba must be told what is \
         around the inner one, and a scene does not say so; move them apart"
    )]
    Nested {
        /// Name of an object.
        first: String,
        /// Name of the other.
        second: String,
    },
    /// The camera stands in a medium.
    #[error("the camera stands within a transparent body: move it out, to export the scene")]
    CameraInside,
    /// A leaf whose inside is followed; the block that says so.
    #[error(
        "{0}.optics = \"layers\" cannot be exported: Mitsuba follows no light through a leaf of \
         layers; write \"plates\""
    )]
    Layers(String),
    /// Tangents for a map of normals; the object that has them.
    #[error(
        "the object `{0}` has a map of normals with tangents of its file, which cannot be exported: the \
         plugin for Mitsuba has those of the texture coordinates; save the glTF file without tangents"
    )]
    Tangents(String),
    /// A model of several materials, for which Mitsuba has no BSDF of its own; the material.
    #[error(
        "`{0}` is a model of several materials, which only the plugins have: leave --stock out"
    )]
    Slots(String),
    /// A picture of a material cannot be made.
    #[error(transparent)]
    Colours(#[from] GltfError),
    /// The folder exists and holds something other than an export.
    #[error(
        "{0} exists and holds no lamina.json: name a new folder, or one that was exported before"
    )]
    NotOurs(PathBuf),
}
