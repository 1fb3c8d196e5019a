//! Meshes from files: PLY and OBJ.
//!
//! The bytes are not trusted: nothing is allocated for counts claimed by a header before the bytes
//! for them are there, and every error names its place. Faces with more than three corners are
//! split into triangles.

mod obj;
mod ply;
mod polygon;
mod raw;

use document::source::escaped;

pub use self::raw::ImportError;
use super::mesh::TriangleMesh;

/// Reads a mesh from a file with the given `extension` (`ply` or `obj`, in any case); `scale` is
/// metres per unit of the file.
///
/// PLY: ASCII or binary; `vertex` with x y z, optionally nx ny nz, optionally u v (or s t, or
/// `texture_u` `texture_v`); `face` and `tristrips` with `vertex_indices` (or `vertex_index`);
/// everything else is ignored. OBJ: v, vt, vn, f (or fo) with negative indices, also over several
/// lines that end in a backslash; uvs are kept if every corner has one; free-form surfaces are
/// counted; materials and groups are ignored.
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
    if raw.triangles.is_empty() && raw.free_form > 0 {
        let surfaces = raw.free_form;
        return Err(ImportError::FreeForm { surfaces });
    }
    raw.triangulate();
    for position in &mut raw.positions {
        *position *= scale;
    }
    let mesh = TriangleMesh::new(raw.positions, raw.normals, raw.uvs, raw.triangles)?;
    Ok(mesh
        .with_crossing(raw.crossing)
        .beside_free_form(raw.free_form))
}

#[cfg(test)]
mod tests;
