//! The shapes of bodies.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::buckets::Buckets;
use crate::mosaic::shapes::{
    Shape, ShapeError, ellipsoid, ellipsoid_triangles, lathe, rounded_cube,
};

/// The shape of a body, mm.
#[derive(Clone, Debug, PartialEq)]
pub enum SolidShape {
    /// An ellipsoid around the origin; a sphere if its semi-axes are equal.
    Ellipsoid {
        /// Half the extents along x, y and z.
        semi_axes_mm: DVec3,
    },
    /// A cube around the origin with rounded edges.
    RoundedCube {
        /// Length of a side.
        side_mm: f64,
        /// Radius of its edges, up to half the side.
        corner_radius_mm: f64,
    },
    /// A solid of revolution: a smooth profile around the z axis.
    Lathe {
        /// Points (distance from the axis, height), mm, from the lowest part of the profile on.
        profile_mm: Vec<DVec2>,
    },
    /// An imported mesh.
    Mesh(Arc<SolidMesh>),
}

/// An imported mesh and its file.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidMesh {
    /// Name of the file in the scene.
    pub file: String,
    /// Millimetres per unit of the file.
    pub scale_mm: f64,
    /// The triangles, mm.
    pub shape: Shape,
}

impl SolidShape {
    /// Area, mm², to within a tenth, computed from few triangles.
    ///
    /// # Errors
    ///
    /// [`ShapeError`] if there is no such shape.
    pub fn area(&self) -> Result<f64, ShapeError> {
        let size = match self {
            Self::Ellipsoid { semi_axes_mm } => semi_axes_mm.max_element(),
            Self::RoundedCube { side_mm, .. } => *side_mm,
            // The height of the profile above the origin does not matter.
            Self::Lathe { profile_mm } => {
                let of = |part: fn(f64, f64) -> f64, value: fn(&DVec2) -> f64| {
                    profile_mm.iter().map(value).reduce(part).unwrap_or(0.0)
                };
                let height = of(f64::max, |point| point.y) - of(f64::min, |point| point.y);
                of(f64::max, |point| point.x).max(0.5 * height)
            }
            Self::Mesh(mesh) => return Ok(area(&mesh.shape)),
        };
        self.triangles(0.1 * size).map(|shape| area(&shape))
    }

    /// About how many triangles [`SolidShape::triangles`] makes of a shape of this area, mm².
    ///
    /// # Errors
    ///
    /// [`ShapeError::TooFine`].
    pub(super) fn count_of_triangles(
        &self,
        max_edge_mm: f64,
        area: f64,
    ) -> Result<f64, ShapeError> {
        match self {
            Self::Ellipsoid { semi_axes_mm } => ellipsoid_triangles(*semi_axes_mm, max_edge_mm),
            // Even ones, half as large as those whose edges are all as long as they may be.
            Self::RoundedCube { .. } | Self::Lathe { .. } => {
                Ok(area / (0.2 * max_edge_mm * max_edge_mm))
            }
            Self::Mesh(mesh) => Ok(mesh.shape.faces.len() as f64),
        }
    }

    /// The shape as triangles with edges of at most `max_edge_mm`; imported meshes are not changed.
    ///
    /// # Errors
    ///
    /// [`ShapeError`] if there is no such shape.
    pub fn triangles(&self, max_edge_mm: f64) -> Result<Shape, ShapeError> {
        match self {
            Self::Ellipsoid { semi_axes_mm } => ellipsoid(*semi_axes_mm, max_edge_mm),
            Self::RoundedCube {
                side_mm,
                corner_radius_mm,
            } => rounded_cube(*side_mm, *corner_radius_mm, max_edge_mm),
            Self::Lathe { profile_mm } => lathe(profile_mm, max_edge_mm),
            Self::Mesh(mesh) => Ok(mesh.shape.clone()),
        }
    }
}

fn area(shape: &Shape) -> f64 {
    let corner = |vertex: u32| shape.positions[vertex as usize];
    let doubled = shape.faces.iter().map(|&[a, b, c]| {
        let (a, b, c) = (corner(a), corner(b), corner(c));
        (b - a).cross(c - a).length()
    });
    0.5 * doubled.sum::<f64>()
}

/// Adds normals to a mesh without normals. At each corner of a face the normal is the area-weighted
/// mean of the adjacent faces that differ from it in direction by less than 45°. So rounded parts
/// look smooth and edges stay sharp: across an edge a mean would deviate so far from both faces
/// that light on them could not be reflected. A point has one vertex for each of its normals.
pub fn creased(positions: &[DVec3], faces: &[[u32; 3]]) -> Shape {
    let crease = std::f64::consts::FRAC_1_SQRT_2;
    let doubled: Vec<DVec3> = faces
        .iter()
        .map(|&[a, b, c]| {
            let corner = |vertex: u32| positions[vertex as usize];
            (corner(b) - corner(a)).cross(corner(c) - corner(a))
        })
        .collect();
    let around = Buckets::around(positions.len(), faces.iter().copied());
    let mut shape = Shape {
        positions: Vec::new(),
        normals: Vec::new(),
        faces: Vec::with_capacity(faces.len()),
    };
    let mut vertices: Vec<Vec<u32>> = vec![Vec::new(); positions.len()];
    for (number, face) in faces.iter().enumerate() {
        let own = doubled[number].normalize_or_zero();
        let corners = face.map(|point| {
            let point = point as usize;
            let near = around.list(point).iter();
            let near = near.map(|&other| doubled[other as usize]);
            let near = near.filter(|other| other.normalize_or_zero().dot(own) > crease);
            let normal = near.sum::<DVec3>().try_normalize().unwrap_or(own);
            let known = vertices[point].iter();
            let found = known.copied().find(|&vertex| {
                let other = shape.normals[vertex as usize];
                other == normal
            });
            found.unwrap_or_else(|| {
                let vertex = shape.positions.len() as u32;
                shape.positions.push(positions[point]);
                shape.normals.push(normal);
                vertices[point].push(vertex);
                vertex
            })
        });
        shape.faces.push(corners);
    }
    shape
}

/// Unit normals at the points of a mesh without normals: the area-weighted mean of the adjacent
/// faces.
pub fn smooth_normals(positions: &[DVec3], faces: &[[u32; 3]]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for &[a, b, c] in faces {
        let corner = |vertex: u32| positions[vertex as usize];
        let normal = (corner(b) - corner(a)).cross(corner(c) - corner(a));
        for vertex in [a, b, c] {
            sums[vertex as usize] += normal;
        }
    }
    sums.into_iter()
        .map(|sum| sum.try_normalize().unwrap_or(DVec3::Z))
        .collect()
}
