//! Meshes from files: PLY and OBJ.
//!
//! The bytes are not trusted: counts that a header claims allocate nothing before the bytes for
//! them are there, and every error says where it is. Faces with more than three corners are cut
//! into a fan.

mod obj;
mod ply;

use glam::{Vec2, Vec3};
use leafmodel::document::source::escaped;
use thiserror::Error;

use super::mesh::{MeshError, TriangleMesh};

/// Corners that one face may have.
const MOST_CORNERS: usize = 1 << 16;

/// Why a file is not a mesh.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ImportError {
    /// The file's name does not end in `ply` or `obj`.
    #[error("cannot read meshes from .{extension} files; .ply and .obj can be read")]
    UnknownFormat {
        /// The end of the name.
        extension: String,
    },
    /// A line of text that cannot be understood.
    #[error("line {line}: {what}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// Binary data that cannot be understood.
    #[error("byte {byte}: {what}")]
    Byte {
        /// Counted from 0.
        byte: usize,
        /// What is wrong.
        what: String,
    },
    /// The file was read, but what it holds cannot be rendered.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// A piece of the file as messages show it: in quotes, safe to print, no longer than a line.
fn shown(text: &str) -> String {
    const MOST: usize = 60;
    format!("\"{}\"", escaped(text, MOST))
}

/// What a file holds, before it is cleaned.
#[derive(Debug, Default)]
struct RawMesh {
    positions: Vec<Vec3>,
    normals: Option<Vec<Vec3>>,
    uvs: Option<Vec<Vec2>>,
    triangles: Vec<[u32; 3]>,
}

impl RawMesh {
    /// Adds a face, cut into a fan about its first corner.
    fn push_fan(&mut self, corners: &[u32]) {
        for pair in corners[1..].windows(2) {
            self.triangles.push([corners[0], pair[0], pair[1]]);
        }
    }
}

/// Reads a mesh whose name ended in `extension` (`ply` or `obj`, in any case), `scale` metres to
/// the file's unit.
///
/// PLY: ASCII or binary; `vertex` with x y z, perhaps nx ny nz, perhaps u v (or s t, `texture_u`
/// `texture_v`), `face` with `vertex_indices` (or `vertex_index`); everything else is passed over.
/// OBJ: v, vt, vn, f with negative indices; uvs are kept if every corner has one; materials and
/// groups are passed over.
///
/// # Errors
///
/// [`ImportError`], with the line or byte where the file cannot be understood.
pub fn import(bytes: &[u8], extension: &str, scale: f32) -> Result<TriangleMesh, ImportError> {
    let mut raw = match extension.to_ascii_lowercase().as_str() {
        "ply" => ply::parse(bytes)?,
        "obj" => obj::parse(bytes)?,
        _ => {
            return Err(ImportError::UnknownFormat {
                extension: escaped(extension, 60),
            });
        }
    };
    for position in &mut raw.positions {
        *position *= scale;
    }
    Ok(TriangleMesh::new(
        raw.positions,
        raw.normals,
        raw.uvs,
        raw.triangles,
    )?)
}

#[cfg(test)]
mod tests;
