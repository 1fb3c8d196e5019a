//! Meshes as binary PLY.

use crate::geometry::TriangleMesh;

/// Little-endian PLY with positions (m), and normals, uv and colours where the mesh has them; mirrored
/// in x if `mirrored`. Mitsuba calls the colours `vertex_tint`; it makes spectra of its own of what it takes
/// for colours by its name.
pub(super) fn ply(mesh: &TriangleMesh, mirrored: bool) -> Vec<u8> {
    let side = if mirrored { -1.0 } else { 1.0 };
    let mut lines = vec![
        "ply".to_owned(),
        "format binary_little_endian 1.0".to_owned(),
        format!("element vertex {}", mesh.positions().len()),
    ];
    let mut property =
        |names: &[&str]| lines.extend(names.iter().map(|name| format!("property float {name}")));
    property(&["x", "y", "z"]);
    if mesh.normals().is_some() {
        property(&["nx", "ny", "nz"]);
    }
    if mesh.uvs().is_some() {
        property(&["u", "v"]);
    }
    if mesh.colours().is_some() {
        property(&["tint_0", "tint_1", "tint_2"]);
    }
    lines.push(format!("element face {}", mesh.triangles().len()));
    lines.push("property list uchar uint vertex_indices".to_owned());
    lines.push("end_header\n".to_owned());
    let header = lines.join("\n");
    let mut bytes = header.into_bytes();
    for (vertex, position) in mesh.positions().iter().enumerate() {
        let mut write = |values: &[f32]| {
            for value in values {
                bytes.extend_from_slice(&value.to_le_bytes());
            }
        };
        write(&[side * position.x, position.y, position.z]);
        if let Some(normals) = mesh.normals() {
            let normal = normals[vertex];
            write(&[side * normal.x, normal.y, normal.z]);
        }
        if let Some(uvs) = mesh.uvs() {
            write(&uvs[vertex].to_array());
        }
        if let Some(colours) = mesh.colours() {
            write(&colours[vertex]);
        }
    }
    for triangle in mesh.triangles() {
        bytes.push(3);
        let [a, b, c] = *triangle;
        for index in if mirrored { [a, c, b] } else { [a, b, c] } {
            bytes.extend_from_slice(&index.to_le_bytes());
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use super::*;
    use crate::geometry::import;

    #[test]
    fn what_is_written_reads_back_as_the_same_mesh() {
        let mesh = TriangleMesh::new(
            vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.1)],
            Some(vec![Vec3::Z; 4]),
            Some(vec![Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE]),
            vec![[0, 1, 2], [1, 3, 2]],
        )
        .expect("two good faces");
        let back = import(&ply(&mesh, false), "ply", 1.0).expect("it is a PLY file");
        assert_eq!(back.positions(), mesh.positions());
        assert_eq!(back.normals(), mesh.normals());
        assert_eq!(back.uvs(), mesh.uvs());
        assert_eq!(back.triangles(), mesh.triangles());
    }
}
