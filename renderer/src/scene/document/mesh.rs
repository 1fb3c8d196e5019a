//! `[meshes.NAME.…]`: rectangle, sphere, file.

use super::limits::Limits;
use super::path::{Wanted, resolve};
use super::reader::Block;
use crate::scene::description::Mesh;

/// Extents of shapes, m.
const EXTENTS_M: Limits = Limits::above(0.0, 1e6);
/// Largest mesh file that is read, bytes.
const MOST_MESH_BYTES: u64 = 4 << 30;

/// Reads one block of `[meshes]`.
pub(crate) fn read_mesh(section: &Block<'_>) -> Option<Mesh> {
    let (variant, block) = section.variant(&["rectangle", "sphere", "file"])?;
    let mesh = match variant {
        "rectangle" => {
            let width = block.number("width_m", EXTENTS_M);
            let height = block.number("height_m", EXTENTS_M);
            width
                .zip(height)
                .map(|(width, height)| Mesh::Rectangle { width, height })
        }
        "sphere" => {
            let radius = block.number("radius_m", EXTENTS_M);
            let segments = block.integer_or("segments", 8, 4096, 64) as u32;
            radius.map(|radius| Mesh::Sphere { radius, segments })
        }
        _ => {
            let wanted = Wanted {
                endings: &["ply", "obj"],
                most_bytes: MOST_MESH_BYTES,
            };
            let file = block
                .text("path", "the path of a PLY or OBJ file")
                .and_then(|(path, at)| resolve(block.cx, path, at, wanted));
            let scale = block.number_or("scale", Limits::above(0.0, 1e6), 1.0);
            file.map(|file| Mesh::File { file, scale })
        }
    };
    block.finish();
    mesh
}
