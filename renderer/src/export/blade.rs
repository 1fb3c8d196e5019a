//! Blades and stalks as one mesh file.

use std::fmt::Write as _;

use glam::{DAffine3, DVec2, DVec3};
use leafmodel::blade::stalk::StalkMesh;
use leafmodel::compound::WholeLeaf;
use rayon::prelude::*;

use crate::checkpoint::PROGRAM;

/// Vertices or faces that one thread writes at a time.
const LINES: usize = 4096;

/// A blade or tubes, with their place.
struct BladePart<'l> {
    /// Number of the blade among the different ones, from 1: the map of the first is NAME.exr,
    /// those of others are NAME-k.exr. 0 for stalks.
    number: usize,
    positions: &'l [DVec3],
    normals: &'l [DVec3],
    uvs: &'l [DVec2],
    thickness_mm: &'l [f64],
    triangles: &'l [[u32; 3]],
    place: DAffine3,
}

/// All parts of a leaf, in millimetres.
pub(crate) struct Parts<'l>(Vec<BladePart<'l>>);

impl<'l> Parts<'l> {
    /// Blades and their stalks in their places, then the axes.
    pub(crate) fn of(leaf: &'l WholeLeaf) -> Self {
        let mut parts = Vec::new();
        for placement in &leaf.placements {
            let blade = &leaf.blades[placement.blade];
            let place = placement.to_leaf;
            let mesh = &blade.mesh;
            parts.push(BladePart {
                number: placement.blade + 1,
                positions: &mesh.positions,
                normals: &mesh.normals,
                uvs: &mesh.uvs,
                thickness_mm: &mesh.thickness_mm,
                triangles: &mesh.triangles,
                place,
            });
            parts.extend(blade.petiole.iter().map(|stalk| (stalk, place)).map(tubes));
        }
        let axes = leaf.axes.iter();
        parts.extend(axes.map(|axes| tubes((axes, DAffine3::IDENTITY))));
        // Parts with the same number become consecutive.
        parts.sort_by_key(|part: &BladePart<'_>| (part.number == 0, part.number));
        Self(parts)
    }

    /// Total number of triangles.
    pub(crate) fn triangles(&self) -> usize {
        self.0.iter().map(|part| part.triangles.len()).sum()
    }

    fn vertices(&self) -> usize {
        self.0.iter().map(|part| part.positions.len()).sum()
    }

    /// Corners of all triangles, numbered through all parts.
    fn faces(&self) -> impl Iterator<Item = (usize, [u32; 3])> {
        let mut first = 0;
        self.0.iter().flat_map(move |part| {
            let before = first;
            first += part.positions.len() as u32;
            let mirrored = part.place.matrix3.determinant() < 0.0;
            part.triangles.iter().map(move |&[a, b, c]| {
                let corners = if mirrored { [a, c, b] } else { [a, b, c] };
                (part.number, corners.map(|corner| corner + before))
            })
        })
    }
}

fn tubes((stalk, place): (&StalkMesh, DAffine3)) -> BladePart<'_> {
    BladePart {
        number: 0,
        positions: &stalk.positions,
        normals: &stalk.normals,
        uvs: &stalk.uvs,
        thickness_mm: &stalk.thickness_mm,
        triangles: &stalk.triangles,
        place,
    }
}

impl BladePart<'_> {
    /// Place, normal, uv and thickness of every vertex.
    fn vertices(&self) -> impl Iterator<Item = (DVec3, DVec3, DVec2, f64)> {
        let moved = self.place != DAffine3::IDENTITY;
        let scale = libm::cbrt(self.place.matrix3.determinant().abs());
        (0..self.positions.len()).map(move |i| {
            let (position, normal) = (self.positions[i], self.normals[i]);
            let (uv, thickness) = (self.uvs[i], self.thickness_mm[i]);
            if !moved {
                return (position, normal, uv, thickness);
            }
            // Places only rotate, mirror and scale uniformly, so normals transform like directions.
            let normal = self.place.transform_vector3(normal).normalize();
            let position = self.place.transform_point3(position);
            (position, normal, uv, scale * thickness)
        })
    }
}

/// PLY with normals, uv and thickness, and the number of the part for each face.
pub(crate) fn ply(parts: &Parts<'_>) -> Vec<u8> {
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment Lamina {PROGRAM}, lengths in mm\nelement vertex {}\n",
        parts.vertices()
    );
    for name in ["x", "y", "z", "nx", "ny", "nz", "u", "v", "thickness"] {
        let _ = writeln!(header, "property float {name}");
    }
    let _ = write!(
        header,
        "element face {}\nproperty list uchar int vertex_indices\nproperty uchar part\nend_header\n",
        parts.triangles()
    );
    let mut bytes = header.into_bytes();
    for (position, normal, uv, thickness) in parts.0.iter().flat_map(BladePart::vertices) {
        for value in position
            .to_array()
            .into_iter()
            .chain(normal.to_array())
            .chain([uv.x, uv.y, thickness])
        {
            bytes.extend_from_slice(&(value as f32).to_le_bytes());
        }
    }
    for (part, triangle) in parts.faces() {
        bytes.push(3);
        for index in triangle {
            bytes.extend_from_slice(&(index as i32).to_le_bytes());
        }
        // A leaf has far fewer different blades than 255.
        bytes.push(part.min(255) as u8);
    }
    bytes
}

/// OBJ with an object and a material, `blade-1` and so on or `stalks`, for each run of faces of one
/// part.
pub(crate) fn obj(parts: &Parts<'_>) -> String {
    let vertices: Vec<_> = parts.0.iter().flat_map(BladePart::vertices).collect();
    let vertices = vertices.par_chunks(LINES).map(|some| {
        let mut text = String::new();
        for (position, normal, uv, _) in some {
            let _ = writeln!(text, "v {} {} {}", position.x, position.y, position.z);
            let _ = writeln!(text, "vt {} {}", uv.x, uv.y);
            let _ = writeln!(text, "vn {} {} {}", normal.x, normal.y, normal.z);
        }
        text
    });
    let faces: Vec<_> = parts.faces().collect();
    let faces = faces.par_chunk_by(|(one, _), (next, _)| one == next);
    let faces = faces.flat_map(|run| {
        let name = match run[0].0 {
            0 => "stalks".to_owned(),
            number => format!("blade-{number}"),
        };
        let head = format!("o {name}\nusemtl {name}\n");
        let lines = run.par_chunks(LINES).map(|some| {
            let mut text = String::new();
            for (_, triangle) in some {
                let [a, b, c] = triangle.map(|index| index + 1);
                let _ = writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}");
            }
            text
        });
        rayon::iter::once(head).chain(lines)
    });
    let head = format!("# Lamina {PROGRAM}, lengths in mm\n");
    let all: Vec<String> = rayon::iter::once(head)
        .chain(vertices)
        .chain(faces)
        .collect();
    all.concat()
}
