//! Models from glTF 2.0 files (\[gltf2022\]): a mesh, and what its materials say of its surface.
//!
//! - **In**: the bytes of a `.gltf` or `.glb` file and of the files that it names; they are not
//!   trusted.
//! - **Out**: all triangles of the file's scene as one mesh, in metres with +z up, the colours over its
//!   texture coordinates, and roughness, metal and normals; the names of what was left out.
//! - **Always true**: nothing is allocated for counts that the file's bytes cannot hold; every index
//!   is checked.
//! - **Left out**: sparse accessors, and all that [`Model::left_out`] may name.
//!
//! A file's materials have pictures of their own. Here they lie side by side along u, each where
//! [`crate::material::colour_map::Slot::begins`] says, and the texture coordinates of each part of
//! the mesh are moved there: so one mesh has one map of colours.

mod accessors;
mod container;
mod cut_out;
mod error;
mod file;
mod left_out;
mod masks;
mod parts;
mod pictures;
mod surfaces;
mod textures;

#[cfg(test)]
mod tests;

use std::io::Cursor;

use self::pictures::Pictures;
use crate::geometry::TriangleMesh;
use crate::image::claimed;
use crate::material::colour_map::ColourMap;
use crate::material::model::Finish;

pub use container::{Container, FileKind, Files};
pub use error::ModelError;
pub use file::ModelFile;
pub use left_out::Wanted;

/// A mesh and its surface.
#[derive(Clone, Debug)]
pub struct Model {
    /// All triangles, m, +z up.
    pub mesh: TriangleMesh,
    /// The base colours, if they are wanted.
    pub colours: Option<ColourMap>,
    /// For each slot of the colours what their material says besides, if it is wanted.
    pub finishes: Option<Vec<Finish>>,
    /// The light that it emits, in units of what an emission of 1 stands for, if it is wanted.
    pub emission: Option<ColourMap>,
    /// What the file has and this lacks, in words.
    pub left_out: Vec<String>,
}

/// What a model will have, known before any of it is decoded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claims {
    /// Triangles of all nodes.
    pub triangles: u64,
    /// Memory of its pictures while they are read, bytes.
    pub pictures: f64,
}

/// What a model claims to have; its pictures count only if anything of them is wanted.
///
/// # Errors
///
/// [`ModelError`], with the place in the file.
pub fn claims<'a>(
    container: &Container<'a>,
    files: Files<'a>,
    wanted: Wanted,
) -> Result<Claims, ModelError> {
    let root = container.root();
    let mut pictures = 0.0;
    if wanted != Wanted::default() {
        let buffers = container.buffers(files)?;
        let all = Pictures::new(root, &buffers, files);
        for number in textures::images(root) {
            let bytes = |bytes: &[u8]| Ok(claimed::bytes(Cursor::new(bytes)));
            pictures += all.decode(number, bytes)?;
        }
    }
    Ok(Claims {
        triangles: surfaces::claimed(root)?,
        pictures,
    })
}

/// Reads a model; `scale` is metres per unit of the file. `files` gives the bytes of each of
/// [`Container::files`]. Only the pictures are decoded that are needed for what is `wanted`.
///
/// # Errors
///
/// [`ModelError`], with the place in the file.
pub fn read<'a>(
    container: &Container<'a>,
    files: Files<'a>,
    scale: f64,
    wanted: Wanted,
) -> Result<Model, ModelError> {
    let root = container.root();
    let buffers = container.buffers(files)?;
    let accessors = accessors::Accessors::new(root, &buffers);
    let mut pictures = Pictures::new(root, &buffers, files);
    let mut left_out = left_out::of_document(root, wanted);
    let mut patches = surfaces::patches(root, &accessors, scale, &mut left_out)?;
    let some = !patches.is_empty();
    masks::cut_out(&pictures, &mut patches)?;
    if patches.is_empty() {
        let only = match left_out.iter().find(|what| what.contains("lines")) {
            _ if some => " that the alpha masks of its materials leave",
            Some(_) => ", only lines and points",
            None => "",
        };
        return Err(ModelError::NoTriangles(only.to_owned()));
    }
    for patch in &mut patches {
        patch.has_colours &= wanted.colours;
        patch.has_tangents &= wanted.finishes;
    }
    let parts = parts::side_by_side(&mut patches, &mut left_out);
    let mesh = surfaces::joined(&patches)?;
    let mut colours = None;
    if wanted.colours {
        let map = parts::colours(&parts, &mut pictures, &mut left_out)?;
        let is_tinted = mesh.colours().is_some();
        colours = Some(if is_tinted { map.tinted() } else { map });
    }
    let mut finishes = None;
    if wanted.finishes {
        finishes = Some(parts::finishes(&parts, &mut pictures, &mut left_out)?);
    }
    let mut emission = None;
    if wanted.emission {
        emission = Some(parts::emission(&parts, &mut pictures, &mut left_out)?);
    }
    let left_out = left_out.into_iter().collect();
    Ok(Model {
        mesh,
        colours,
        finishes,
        emission,
        left_out,
    })
}
