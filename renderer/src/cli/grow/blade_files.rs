//! The blade as a mesh file.

use std::fmt::Write as _;

use leafmodel::blade::BladeMesh;

/// The blade in millimetres, with normals, uv and thickness.
pub(super) fn ply(mesh: &BladeMesh) -> Vec<u8> {
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment lengths in mm\nelement vertex {}\n",
        mesh.positions.len()
    );
    for name in ["x", "y", "z", "nx", "ny", "nz", "u", "v", "thickness"] {
        let _ = writeln!(header, "property float {name}");
    }
    let _ = write!(
        header,
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.triangles.len()
    );
    let mut bytes = header.into_bytes();
    for (vertex, position) in mesh.positions.iter().enumerate() {
        let normal = mesh.normals[vertex];
        let uv = mesh.uvs[vertex];
        let thickness = mesh.thickness_mm[vertex];
        for value in position
            .to_array()
            .into_iter()
            .chain(normal.to_array())
            .chain([uv.x, uv.y, thickness])
        {
            bytes.extend_from_slice(&(value as f32).to_le_bytes());
        }
    }
    for triangle in &mesh.triangles {
        bytes.push(3);
        for index in triangle {
            bytes.extend_from_slice(&(*index as i32).to_le_bytes());
        }
    }
    bytes
}

/// The blade in millimetres as text.
pub(super) fn obj(mesh: &BladeMesh) -> String {
    let mut text = String::from("# lengths in mm\n");
    for (vertex, position) in mesh.positions.iter().enumerate() {
        let (normal, uv) = (mesh.normals[vertex], mesh.uvs[vertex]);
        let _ = writeln!(text, "v {} {} {}", position.x, position.y, position.z);
        let _ = writeln!(text, "vt {} {}", uv.x, uv.y);
        let _ = writeln!(text, "vn {} {} {}", normal.x, normal.y, normal.z);
    }
    for [a, b, c] in mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|index| index + 1))
    {
        let _ = writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}");
    }
    text
}
