//! `[meshes.NAME.…]`: rectangle, sphere, file.

use leafmodel::document::keys::{Keys, Variant};
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{FilePath, Integer, Number};

use crate::scene::description::Mesh;

/// Range of the extents of shapes, m.
const EXTENTS_M: Number = Number(Limits::above(0.0, 1e6));
/// Largest mesh file that is read, bytes.
const MOST_MESH_BYTES: u64 = 4 << 30;

/// The keys of one of `[meshes]`.
pub(super) fn mesh(mesh: &mut Mesh, keys: &mut Keys<'_>) {
    keys.kind(mesh, &KINDS);
}

const KINDS: [Variant<Mesh>; 3] = [
    Variant {
        name: "rectangle",
        about: "A rectangle in the xy plane around the origin, its normal along +z.",
        new: || Mesh::Rectangle {
            width: 1.0,
            height: 1.0,
        },
        is: |mesh| matches!(mesh, Mesh::Rectangle { .. }),
        declare: |mesh, keys| {
            if let Mesh::Rectangle { width, height } = mesh {
                keys.required("width_m", width, EXTENTS_M, "Extent along x.");
                keys.required("height_m", height, EXTENTS_M, "Extent along y.");
            }
        },
    },
    Variant {
        name: "sphere",
        about: "A sphere around the origin.",
        new: Mesh::unit_sphere,
        is: |mesh| matches!(mesh, Mesh::Sphere { .. }),
        declare: |mesh, keys| {
            if let Mesh::Sphere { radius, segments } = mesh {
                keys.required("radius_m", radius, EXTENTS_M, "Its radius.");
                let about = "Triangles around the equator, half as many from pole to pole.";
                keys.key("segments", segments, Integer::within(8, 4096), about);
            }
        },
    },
    Variant {
        name: "file",
        about: "The mesh of a PLY or OBJ file.",
        new: || Mesh::File {
            file: std::path::PathBuf::new(),
            scale: 1.0,
        },
        is: |mesh| matches!(mesh, Mesh::File { .. }),
        declare: |mesh, keys| {
            if let Mesh::File { file, scale } = mesh {
                const PATH: FilePath = FilePath::of(
                    "the path of a PLY or OBJ file",
                    &["ply", "obj"],
                    MOST_MESH_BYTES,
                );
                super::file(keys, "path", file, PATH, "The file.");
                let limits = Number(Limits::above(0.0, 1e6));
                keys.key("scale", scale, limits, "Metres per unit of the file.");
            }
        },
    },
];

impl Mesh {
    /// A sphere with all defaults.
    pub(super) fn unit_sphere() -> Self {
        Self::Sphere {
            radius: 1.0,
            segments: 64,
        }
    }
}
