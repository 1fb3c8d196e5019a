//! Blades and stalks as one mesh file.

use std::fmt::Write as _;

use glam::{DAffine3, DVec2, DVec3};
use leafmodel::blade::stalk::StalkMesh;
use leafmodel::compound::WholeLeaf;
use rayon::prelude::*;

use crate::checkpoint::PROGRAM;
use crate::image::tone::from_srgb;

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

/// The unit of lengths in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum LengthUnit {
    /// Metres
    #[default]
    M,
    /// Millimetres
    Mm,
}

impl LengthUnit {
    fn per_mm(self) -> f64 {
        match self {
            Self::M => 1e-3,
            Self::Mm => 1.0,
        }
    }

    fn symbol(self) -> &'static str {
        match self {
            Self::M => "m",
            Self::Mm => "mm",
        }
    }
}

/// All parts of a leaf.
pub(crate) struct Parts<'l> {
    parts: Vec<BladePart<'l>>,
    unit: LengthUnit,
}

impl<'l> Parts<'l> {
    /// Blades and their stalks in their places, then the axes.
    pub(crate) fn of(leaf: &'l WholeLeaf, unit: LengthUnit) -> Self {
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
        Self { parts, unit }
    }

    /// Its size in a file and what that holds.
    pub(crate) fn extent(&self) -> String {
        let places = self.placed().map(|(position, ..)| position);
        let around = places
            .map(|p| (p, p))
            .reduce(|(low, high), (a, b)| (low.min(a), high.max(b)));
        let size = around.map_or(DVec3::ZERO, |(low, high)| high - low);
        let [x, y, z] = size.to_array().map(|side| format!("{side:.4}"));
        let (unit, triangles) = (self.unit.symbol(), self.triangles());
        format!("{x} {unit} × {y} {unit} × {z} {unit}, {triangles} triangles")
    }

    /// Place, normal, uv and thickness of every vertex, in the unit of the file.
    fn placed(&self) -> impl Iterator<Item = (DVec3, DVec3, DVec2, f64)> {
        let per_mm = self.unit.per_mm();
        let vertices = self.parts.iter().flat_map(BladePart::vertices);
        vertices.map(move |(position, normal, uv, thickness)| {
            (position * per_mm, normal, uv, thickness * per_mm)
        })
    }

    /// Total number of triangles.
    pub(crate) fn triangles(&self) -> usize {
        self.parts.iter().map(|part| part.triangles.len()).sum()
    }

    fn vertices(&self) -> usize {
        self.parts.iter().map(|part| part.positions.len()).sum()
    }

    /// Corners of all triangles, numbered through all parts.
    fn faces(&self) -> impl Iterator<Item = (usize, [u32; 3])> {
        let mut first = 0;
        self.parts.iter().flat_map(move |part| {
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
        "ply\nformat binary_little_endian 1.0\ncomment Lamina {PROGRAM}, lengths in {}\nelement vertex {}\n",
        parts.unit.symbol(),
        parts.vertices()
    );
    for name in ["x", "y", "z", "nx", "ny", "nz", "s", "t", "thickness"] {
        let _ = writeln!(header, "property float {name}");
    }
    let _ = write!(
        header,
        "element face {}\nproperty list uchar int vertex_indices\nproperty uchar part\nend_header\n",
        parts.triangles()
    );
    let mut bytes = header.into_bytes();
    for (position, normal, uv, thickness) in parts.placed() {
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

/// The materials of an OBJ: those of its blades, each with a picture, and that of its stalks.
pub(crate) fn mtl(pictures: &[String], stalks: [u8; 3]) -> String {
    let mut text = format!("# Lamina {PROGRAM}, colours under D65\n");
    for (number, picture) in pictures.iter().enumerate() {
        let _ = writeln!(
            text,
            "newmtl blade-{}\nKd 1 1 1\nmap_Kd {picture}",
            number + 1
        );
    }
    let [r, g, b] = stalks.map(|value| from_srgb(f64::from(value) / 255.0));
    let _ = writeln!(text, "newmtl stalks\nKd {r:.4} {g:.4} {b:.4}");
    text
}

/// OBJ with an object and a material, `blade-1` and so on or `stalks`, for each run of faces of one
/// part; `materials` is the name of the file that has these.
pub(crate) fn obj(parts: &Parts<'_>, materials: &str) -> String {
    let vertices: Vec<_> = parts.placed().collect();
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
    let unit = parts.unit.symbol();
    let head = format!("# Lamina {PROGRAM}, lengths in {unit}\nmtllib {materials}\n");
    let all: Vec<String> = rayon::iter::once(head)
        .chain(vertices)
        .chain(faces)
        .collect();
    all.concat()
}

#[cfg(test)]
mod tests {
    use leafmodel::species::find;

    use super::*;
    use crate::geometry::import;

    #[test]
    fn meshes_are_read_back_in_metres_or_millimetres_with_texture_coordinates() {
        let mut plan = find("birch-autumn").expect("a preset").plan();
        (plan.length_mm, plan.map_size) = (20.0, 16);
        plan.venation = find("arcuate").expect("a preset").plan().venation;
        let leaf = WholeLeaf::grow(&plan.form_alone().expect("a good plan")).expect("it grows");
        let [metres, millimetres] =
            [LengthUnit::M, LengthUnit::Mm].map(|unit| Parts::of(&leaf, unit));
        let read = |bytes: &[u8], kind, scale| import(bytes, kind, scale).expect("a mesh");
        let own = read(&ply(&metres), "ply", 1.0);
        assert!(String::from_utf8_lossy(&ply(&metres)[..300]).contains("property float s\n"));
        let (low, high) = own.bounds();
        assert!((0.02..0.04).contains(&(high.y - low.y)), "{low} {high}");
        for (file, kind, scale) in [
            (ply(&millimetres), "ply", 1e-3),
            (obj(&metres, "leaf.mtl").into_bytes(), "obj", 1.0),
            (obj(&millimetres, "leaf.mtl").into_bytes(), "obj", 1e-3),
        ] {
            let other = read(&file, kind, scale);
            assert_eq!(other.triangles().len(), own.triangles().len());
            assert!(other.uvs().is_some() && own.uvs().is_some());
            let (other_low, other_high) = other.bounds();
            // Rounding of 32-bit numbers of some hundredths of a metre.
            assert!(other_low.distance(low) < 1e-8 && other_high.distance(high) < 1e-8);
        }
    }
}
