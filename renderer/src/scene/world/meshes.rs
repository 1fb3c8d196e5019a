//! Meshes from files, and of shapes that a scene gives by numbers.

use glam::{DVec3, Vec2, Vec3};

use super::WorldError;
use crate::geometry::{MeshError, TriangleMesh};
use crate::scene::assets;
use crate::scene::description;
use crate::scene::plants::tube;

pub(super) fn build_mesh(name: &str, mesh: &description::Mesh) -> Result<TriangleMesh, WorldError> {
    let named = |source| WorldError::Mesh {
        name: name.to_owned(),
        source,
    };
    match mesh {
        description::Mesh::Rectangle { width, height } => {
            let (x, y) = (0.5 * *width as f32, 0.5 * *height as f32);
            let corners = [(-x, -y), (x, -y), (x, y), (-x, y)];
            TriangleMesh::new(
                corners.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec(),
                None,
                Some(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]),
                vec![[0, 1, 2], [0, 2, 3]],
            )
            .map_err(named)
        }
        description::Mesh::Sphere { radius, segments } => sphere(*radius, *segments).map_err(named),
        description::Mesh::Axes(axes) => {
            let (positions, normals) = tube(axes);
            TriangleMesh::new(positions, Some(normals), None, axes.triangles.clone()).map_err(named)
        }
        description::Mesh::File { file, scale } => {
            let bytes = assets::read(file).map_err(|source| WorldError::Asset {
                place: format!("meshes.{name}"),
                source,
            })?;
            let extension = file
                .extension()
                .and_then(|ending| ending.to_str())
                .unwrap_or("");
            crate::geometry::import(&bytes, extension, *scale as f32).map_err(|source| {
                WorldError::Import {
                    name: name.to_owned(),
                    file: file.clone(),
                    source,
                }
            })
        }
    }
}

/// A sphere of longitude–latitude triangles whose vertices lie on it, with its exact normals.
fn sphere(radius: f64, segments: u32) -> Result<TriangleMesh, MeshError> {
    let rings = (segments / 2).max(2);
    let mut normals = Vec::new();
    let mut uvs = Vec::new();
    for ring in 0..=rings {
        let (sin_theta, cos_theta) =
            libm::sincos(std::f64::consts::PI * f64::from(ring) / f64::from(rings));
        for segment in 0..=segments {
            let (sin_phi, cos_phi) =
                libm::sincos(std::f64::consts::TAU * f64::from(segment) / f64::from(segments));
            // South first, so that v grows with z.
            let normal = DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, -cos_theta);
            normals.push(normal.as_vec3());
            uvs.push(Vec2::new(
                segment as f32 / segments as f32,
                ring as f32 / rings as f32,
            ));
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let lower = ring * (segments + 1) + segment;
            let upper = lower + segments + 1;
            if ring > 0 {
                triangles.push([lower, lower + 1, upper + 1]);
            }
            if ring + 1 < rings {
                triangles.push([lower, upper + 1, upper]);
            }
        }
    }
    let positions = normals
        .iter()
        .map(|&normal| normal * radius as f32)
        .collect();
    TriangleMesh::new(positions, Some(normals), Some(uvs), triangles)
}
