//! Why a glTF file cannot be used.

use leafmodel::document::source::escaped;
use thiserror::Error;

use crate::geometry::MeshError;
use crate::image::ImageError;

/// Why a glTF file cannot be used.
#[derive(Debug, Error)]
pub enum ModelError {
    /// It is no glTF 2.0 file, or a damaged one.
    #[error("byte {byte}: {what}")]
    Container {
        /// Counted from 0.
        byte: usize,
        /// What is wrong.
        what: String,
    },
    /// Its JSON cannot be understood.
    #[error("its JSON, {0}")]
    Json(String),
    /// A part of its JSON says what must not be.
    #[error("{place}: {what}")]
    Invalid {
        /// The part, such as `meshes[0].primitives[1]`.
        place: String,
        /// What is wrong.
        what: String,
    },
    /// It needs an extension that is not known.
    #[error(
        "it requires the extension {0}, which is not read: save it again without (export \
         uncompressed geometry and PNG or JPEG pictures)"
    )]
    Extension(String),
    /// Nothing in it has triangles.
    #[error("its scene has no triangles{0}")]
    NoTriangles(String),
    /// A picture cannot be read.
    #[error("images[{number}]: {source}")]
    Picture {
        /// Number of the picture in the file.
        number: usize,
        /// What is wrong with it.
        source: ImageError,
    },
    /// What it holds cannot be rendered.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl ModelError {
    pub(super) fn invalid(place: impl Into<String>, what: impl Into<String>) -> Self {
        Self::Invalid {
            place: place.into(),
            what: what.into(),
        }
    }
}

/// A piece of the file for messages: quoted, safe to print, at most one line long.
pub(super) fn shown(text: &str) -> String {
    const MOST: usize = 60;
    format!("\"{}\"", escaped(text, MOST))
}
