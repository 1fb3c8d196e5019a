//! The shapes of bodies.

use std::sync::Arc;

use crate::mosaic::shapes::lathe::lathe;

use glam::{DVec2, DVec3};

use crate::buckets::Buckets;
use crate::document::assets::Triangles;
use crate::document::named_asset::decoded;
use crate::document::{Declared, Keys, Limits, ListOf, Number, Numbers, Text};
use crate::mosaic::Surface;
use crate::mosaic::shapes::{Shape, ellipsoid, ellipsoid_triangles, rounded_cube};
use crate::not_grown::NotGrown;

/// The shape of a body.
#[derive(Clone, Debug, Declared, PartialEq)]
pub enum SolidShape {
    /// About the origin.
    Sphere {
        /// Its radius.
        #[key("radius_mm", required, within(EXTENTS_MM), default = 1.0)]
        radius_mm: f64,
    },
    /// About the origin.
    Ellipsoid {
        /// Half its extents along x, y and z.
        #[key("semi_axes_mm", required, within(EXTENTS_MM), default = DVec3::ONE)]
        semi_axes_mm: DVec3,
    },
    /// About the origin.
    ///
    /// It is a cube with rounded edges.
    RoundedCube {
        /// Its side.
        #[key("side_mm", required, within(EXTENTS_MM), default = 2e5)]
        side_mm: f64,
        /// Radius of the edges, half a side at most.
        #[key("corner_radius_mm", required, above(0.0, 0.5 * *side_mm), default = 1.0)]
        corner_radius_mm: f64,
    },
    /// Turned about the z axis.
    #[key(last = turned)]
    Lathe {
        /// Points (distance from the axis, height), mm, from the lowest part of the profile on.
        #[key(flat, with = profile)]
        profile_mm: Vec<DVec2>,
    },
    /// A file.
    #[key(with = mesh)]
    Mesh(Arc<SolidMesh>),
}

/// Extents of bodies.
const EXTENTS_MM: Limits = Limits::closed(0.01, 1e5);

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

impl Default for SolidMesh {
    fn default() -> Self {
        Self {
            file: String::new(),
            scale_mm: 1.0,
            shape: Shape::default(),
        }
    }
}

fn profile(profile_mm: &mut Vec<DVec2>, keys: &mut Keys<'_>) {
    let mut points: Vec<[f64; 2]> = profile_mm.iter().map(DVec2::to_array).collect();
    let list = ListOf {
        of: Numbers::<2>(Limits::closed(-1e5, 1e5)),
        least: 2,
        most: 1000,
        wanted: "a list of 2 to 1000 points, [distance from the axis, height]",
    };
    let about = "Points from below, [distance from the axis, height].";
    keys.required("profile_mm", &mut points, list, about);
    *profile_mm = points.into_iter().map(DVec2::from_array).collect();
}

/// Reports points that make no body once they are turned about the axis.
fn turned(shape: &mut SolidShape, keys: &mut Keys<'_>) {
    if keys.is_sound()
        && let Err(error) = shape.area()
    {
        let help = "let the profile run from below, on one side of the axis";
        keys.refuse(&["profile_mm"], error.to_string(), help);
    }
}

fn mesh(mesh: &mut Arc<SolidMesh>, keys: &mut Keys<'_>) {
    let (mut file, mut scale_mm) = (mesh.file.clone(), mesh.scale_mm);
    let path = Text("the path of a PLY or OBJ file");
    keys.required("path", &mut file, path, "The file.");
    let limits = Number(Limits::above(0.0, 1e6));
    keys.key("scale_mm", &mut scale_mm, limits, "The file's unit.");
    let shape = decoded(keys, "path", &["ply", "obj"], |assets, path| {
        let read = assets.mesh(path, scale_mm)?;
        if let (Some(dropped), Some(block)) = (&read.dropped, keys.reader())
            && let Some(node) = block.node("path")
        {
            let code = "scene::faces_left_out";
            let help = "mend the mesh: each face has an area and corners of its own";
            block.cx.warn(&node.at, code, dropped.clone(), help);
        }
        shape_of(read)
    });
    if let Some(shape) = shape {
        *mesh = Arc::new(SolidMesh {
            file,
            scale_mm,
            shape,
        });
    }
}

/// A mesh on which cells can live, with normals of length 1.
fn shape_of(read: Triangles) -> Result<Shape, (String, &'static str)> {
    const MEND: &str = "mend the mesh: each edge has at most two faces, both turned the same way, and the faces around a point hang together";
    let Triangles {
        positions, faces, ..
    } = read;
    Surface::new(positions.clone(), faces.clone())
        .and_then(|surface| surface.check_vertices())
        .map_err(|error| (error.to_string(), MEND))?;
    let Some(normals) = read.normals else {
        return Ok(creased(&positions, &faces));
    };
    // Those that have none are the mean of the faces around.
    let smooth = smooth_normals(&positions, &faces);
    let both = normals.iter().zip(smooth);
    let normals = both.map(|(normal, smooth)| normal.try_normalize().unwrap_or(smooth));
    Ok(Shape {
        normals: normals.collect(),
        positions,
        faces,
    })
}

impl SolidShape {
    /// Area, mm², to within a tenth, computed from few triangles.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] if there is no such shape.
    pub fn area(&self) -> Result<f64, NotGrown> {
        let size = match self {
            Self::Sphere { radius_mm } => *radius_mm,
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
    /// [`NotGrown`] for too many triangles.
    pub(super) fn count_of_triangles(&self, max_edge_mm: f64, area: f64) -> Result<f64, NotGrown> {
        match self {
            Self::Sphere { radius_mm } => {
                ellipsoid_triangles(DVec3::splat(*radius_mm), max_edge_mm)
            }
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
    /// [`NotGrown`] if there is no such shape.
    pub fn triangles(&self, max_edge_mm: f64) -> Result<Shape, NotGrown> {
        match self {
            Self::Sphere { radius_mm } => ellipsoid(DVec3::splat(*radius_mm), max_edge_mm),
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
pub(crate) fn creased(positions: &[DVec3], faces: &[[u32; 3]]) -> Shape {
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
pub(crate) fn smooth_normals(positions: &[DVec3], faces: &[[u32; 3]]) -> Vec<DVec3> {
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
