//! Models from glTF 2.0 files (\[gltf2022\]): a mesh, and the base colours of its materials.
//!
//! - **In**: the bytes of a `.gltf` or `.glb` file and of the files that it names; they are not
//!   trusted.
//! - **Out**: all triangles of the file's scene as one mesh, in metres with +z up, and the colours
//!   over its texture coordinates; the names of what was left out.
//! - **Always true**: nothing is allocated for counts that the file's bytes cannot hold; every index
//!   is checked.
//! - **Left out**: sparse accessors, and all that [`Model::left_out`] may name.
//!
//! A file's materials have pictures of their own. Here they lie side by side along u, each where
//! [`crate::material::colour_map::Slot::begins`] says, and the texture coordinates of each part of
//! the mesh are moved there: so one mesh has one map of colours.

mod accessors;
mod base_colours;
mod container;
mod cut_out;
mod left_out;
mod masks;
mod painted;
mod pictures;
mod surfaces;
mod textures;

#[cfg(test)]
mod tests;

use std::io::Cursor;

use leafmodel::document::source::escaped;
use thiserror::Error;

use crate::geometry::{MeshError, TriangleMesh};
use crate::image::{ImageError, claimed};
use crate::material::colour_map::ColourMap;

pub use container::{Container, FileKind};

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
    fn invalid(place: impl Into<String>, what: impl Into<String>) -> Self {
        Self::Invalid {
            place: place.into(),
            what: what.into(),
        }
    }
}

/// A piece of the file for messages: quoted, safe to print, at most one line long.
fn shown(text: &str) -> String {
    const MOST: usize = 60;
    format!("\"{}\"", escaped(text, MOST))
}

/// A mesh and its colours.
#[derive(Clone, Debug)]
pub struct Model {
    /// All triangles, m, +z up.
    pub mesh: TriangleMesh,
    /// The base colours, if they were asked for.
    pub colours: Option<ColourMap>,
    /// What the file has and this lacks, in words.
    pub left_out: Vec<String>,
}

/// Bytes of a file that a glTF file names, by its name as written there.
pub type Files<'a> = &'a dyn Fn(&str) -> Option<&'a [u8]>;

/// What a model will have, known before any of it is decoded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claims {
    /// Triangles of all nodes.
    pub triangles: u64,
    /// Memory of its pictures while they are read, bytes.
    pub pictures: f64,
}

/// What a model claims to have; its pictures count only if `colours` are asked for.
///
/// # Errors
///
/// [`ModelError`], with the place in the file.
pub fn claims<'a>(
    container: &Container<'a>,
    files: Files<'a>,
    colours: bool,
) -> Result<Claims, ModelError> {
    let root = container.root();
    let mut pictures = 0.0;
    if colours {
        let buffers = container.buffers(files)?;
        for number in textures::images(root) {
            let bytes = |bytes: &[u8]| Ok(claimed::bytes(Cursor::new(bytes)));
            pictures += pictures::picture(root, number, &buffers, files, bytes)?;
        }
    }
    Ok(Claims {
        triangles: surfaces::claimed(root)?,
        pictures,
    })
}

/// Reads a model; `scale` is metres per unit of the file. `files` gives the bytes of each of
/// [`Container::files`]. Pictures are decoded only if `colours` are asked for.
///
/// # Errors
///
/// [`ModelError`], with the place in the file.
pub fn read<'a>(
    container: &Container<'a>,
    files: Files<'a>,
    scale: f64,
    colours: bool,
) -> Result<Model, ModelError> {
    let root = container.root();
    let buffers = container.buffers(files)?;
    let accessors = accessors::Accessors::new(root, &buffers);
    let mut left_out = left_out::of_document(root);
    let mut patches = surfaces::patches(root, &accessors, scale, &mut left_out)?;
    let some = !patches.is_empty();
    masks::cut_out(root, &mut patches, &buffers, files)?;
    if patches.is_empty() {
        let only = match left_out.iter().find(|what| what.contains("lines")) {
            _ if some => " that the alpha masks of its materials leave",
            Some(_) => ", only lines and points",
            None => "",
        };
        return Err(ModelError::NoTriangles(only.to_owned()));
    }
    if colours {
        painted::paint(root, &mut patches, &mut left_out);
    }
    let slots = base_colours::side_by_side(root, &mut patches, &mut left_out);
    let colours = if colours {
        Some(base_colours::colours(root, &slots, &buffers, files)?)
    } else {
        None
    };
    let mesh = surfaces::joined(patches)?;
    let left_out = left_out.into_iter().collect();
    Ok(Model {
        mesh,
        colours,
        left_out,
    })
}
