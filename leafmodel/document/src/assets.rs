//! Pictures and meshes that a document names, as whoever reads the document decodes them.

use std::fmt::Debug;
use std::path::Path;

use glam::DVec3;

/// Rows of a picture from the lowest up, some values a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Pixels across.
    pub width: usize,
    /// Values of one pixel after the other.
    pub values: Vec<f32>,
}

/// Triangles of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangles {
    /// Points, in the file's unit times the scale.
    pub positions: Vec<DVec3>,
    /// Points of each triangle.
    pub faces: Vec<[u32; 3]>,
    /// Normals of the points, if the file has them; not all need have a length.
    pub normals: Option<Vec<DVec3>>,
    /// What was left out of the file or has no right form, in words; nothing mostly.
    pub dropped: Option<String>,
}

/// Decodes files. This crate reads no pictures and no meshes; a program that does hands one of
/// these to [`Context`](super::context::Context).
///
/// Every error is a piece of a sentence whose subject is the file, and what to do about it.
pub trait Assets: Debug + Sync {
    /// Grey from 0 to 1 of a picture, or one of its channels.
    ///
    /// # Errors
    ///
    /// What is wrong with the file.
    fn grey(&self, file: &Path, channel: Option<&str>) -> Result<Raster, String>;

    /// Grey of a PNG as it is stored, 0 to 1, rows from the top.
    ///
    /// # Errors
    ///
    /// What is wrong with the file.
    fn weights(&self, file: &Path) -> Result<Raster, String>;

    /// Contents of a map, one after the other in their usual order.
    ///
    /// # Errors
    ///
    /// What is wrong with the file.
    fn contents(&self, file: &Path) -> Result<Raster, String>;

    /// The triangles of a mesh.
    ///
    /// # Errors
    ///
    /// What is wrong with the file, and what to do about it.
    fn mesh(&self, file: &Path, scale: f64) -> Result<Triangles, (String, &'static str)>;
}
