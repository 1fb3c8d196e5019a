//! Shapes as triangles: `[meshes.NAME.…]`.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::value_kind::{FilePath, NamedFile};

use crate::geometry::shapes::{Cuboid, Disc, Drop, Lump, Masonry, Rectangle, Sphere, Terrain};
use crate::scene::model::ModelFile;

/// A shape.
#[derive(Clone, Debug, Declared)]
pub enum Mesh {
    /// A rectangle in the xy plane around the origin, its normal along +z.
    Rectangle(Rectangle),
    /// A sphere around the origin.
    Sphere(Sphere),
    /// A closed box around the origin.
    Box(Cuboid),
    /// A flat disc around the origin, its normal along +z.
    Disc(Disc),
    /// A drop of water that stands on z = 0.
    Drop(Drop),
    /// A pebble or crumb around the origin.
    Lump(Lump),
    /// Uneven ground around the origin.
    Terrain(Terrain),
    /// A wall of bricks, or the mortar between them, that stands on z = 0 and faces +x.
    Masonry(Masonry),
    /// The mesh of a PLY or OBJ file.
    File(FileMesh),
    /// The mesh of a glTF 2.0 file, and the base colours for a material with `mesh`.
    Gltf(ModelFile),
}

impl Default for Mesh {
    fn default() -> Self {
        Self::Sphere(Sphere::default())
    }
}

/// A PLY or OBJ file, inside the scene's folder.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct FileMesh {
    /// The file.
    #[key(
        "path",
        required,
        FilePath::of("the path of a PLY or OBJ file", &["ply", "obj"], 4 << 30)
    )]
    pub path: NamedFile,
    /// Metres per unit of the file.
    #[key("scale", above(0.0, 1e6), default = 1.0)]
    pub scale: f64,
}
