//! The blade as triangles.

mod smoothing;

pub use super::error::BladeError;
use glam::{DVec2, DVec3};
use thiserror::Error;

use super::BladeForm;
use super::frame::UvFrame;
use super::relief::Relief;
use super::size_field::SizeField;
use super::skeleton::Skeleton;
use super::stance::{Posture, Settled};
use super::triangulate::{Triangulation, triangulate};
use crate::shape::outline::Outline;
use crate::venation::conformal_map::ConformalMap;
use crate::venation::network::{VeinSegment, VenationNetwork};

/// Greatest number of triangles of one blade.
pub(super) const MOST_TRIANGLES: usize = 4_000_000;

/// A sheet of triangles in space, with properties at each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeMesh {
    /// Places, mm; base of the leaf at the origin, midrib along +y, adaxial side +z.
    pub positions: Vec<DVec3>,
    /// Unit normals on the adaxial side.
    pub normals: Vec<DVec3>,
    /// Texture coordinates, 0 to 1 over the box around the flat outline.
    pub uvs: Vec<DVec2>,
    /// Thickness of the sheet, mm, > 0.
    pub thickness_mm: Vec<f64>,
    /// Places on the flat lamina, mm, in the frame of the outline.
    pub lamina: Vec<DVec2>,
    /// Vertices of each triangle, counter-clockwise seen from the adaxial side.
    pub triangles: Vec<[u32; 3]>,
}

/// What is wrong with a mesh. Meshes from [`BladeMesh::build`] have no defects.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum MeshDefect {
    /// The lists of a mesh have different lengths, or there is no triangle.
    #[error("the lists of vertices differ in length, or the mesh is empty")]
    Lists,
    /// A triangle refers to a vertex that does not exist, or to one vertex twice.
    #[error("triangle {triangle} does not join three vertices of the mesh")]
    BadTriangle {
        /// Number of the triangle.
        triangle: usize,
    },
    /// A vertex has a number that is not finite, a normal that is not of unit length, or no
    /// thickness.
    #[error("vertex {vertex} has a bad number")]
    BadVertex {
        /// Number of the vertex.
        vertex: usize,
    },
    /// A vertex that no triangle uses.
    #[error("no triangle uses vertex {vertex}")]
    Unused {
        /// Number of the vertex.
        vertex: usize,
    },
    /// An edge with more than two faces, or with two that do not run along it in opposite
    /// directions.
    #[error("the edge from vertex {from} to vertex {to} is used twice in the same direction")]
    Edge {
        /// Its first vertex.
        from: u32,
        /// Its second vertex.
        to: u32,
    },
    /// The border is not one closed curve, so the sheet has holes or parts.
    #[error("the border is in {loops} pieces")]
    Border {
        /// How many closed curves it has, or 0 if it branches.
        loops: usize,
    },
    /// A triangle that is clockwise or without area on the flat lamina, or turned away from its
    /// normals in space.
    #[error("triangle {triangle} is turned over")]
    TurnedOver {
        /// Number of the triangle.
        triangle: usize,
    },
    /// The triangles do not cover what the border encloses.
    #[error("the triangles cover {covered} mm² of {enclosed} mm²")]
    Area {
        /// Sum of the areas of the flat triangles, mm².
        covered: f64,
        /// Area of the outline, mm².
        enclosed: f64,
    },
}

/// Share by which the areas of triangles and outline may differ: the mesh keeps the margin except
/// for points nearer together than a thousandth of an edge.
const SAME_AREA: f64 = 1e-6;

impl BladeMesh {
    /// Makes the blade of a leaf: cuts the lamina within `outline` into triangles with the major
    /// veins of `network` as edges, raises those veins, and bends the whole.
    ///
    /// # Errors
    ///
    /// [`BladeError`] if a field of `form` is out of range, if the mesh would be too large, or if
    /// the form turns the blade inside out.
    pub fn build(
        outline: &Outline,
        network: &VenationNetwork,
        form: &BladeForm,
    ) -> Result<Self, BladeError> {
        let frame = UvFrame::around(outline.points());
        Self::build_holed((outline, &[], &frame), network, form, None, &|_| 0.0)
    }

    /// As [`BladeMesh::build`], with holes: simple counter-clockwise polygons inside the margin, mm,
    /// that neither touch it nor each other. Texture coordinates are those of a frame, the blade
    /// has come to lie as `settled` says, and each flat point stands `lifted` mm above that place,
    /// along the blade's normal: continuous but across cuts.
    ///
    /// # Errors
    ///
    /// As [`BladeMesh::build`].
    pub fn build_holed(
        (outline, holes, frame): (&Outline, &[Vec<DVec2>], &UvFrame),
        network: &VenationNetwork,
        form: &BladeForm,
        settled: Option<&Settled>,
        lifted: &dyn Fn(DVec2) -> f64,
    ) -> Result<Self, BladeError> {
        let veins: Vec<VeinSegment> = network.segments().collect();
        let posture = Posture::new(form, outline, (network.map(), &veins), settled);
        Self::within(
            (outline, holes, frame),
            &veins,
            form,
            &posture,
            settled.is_some(),
            lifted,
        )
    }

    /// As [`BladeMesh::build`], from pieces of vein in a map of the blade. Pieces are connected
    /// where their ends have the same bits.
    ///
    /// # Errors
    ///
    /// As [`BladeMesh::build`].
    pub fn from_veins(
        outline: &Outline,
        veins: &[VeinSegment],
        map: ConformalMap,
        form: &BladeForm,
    ) -> Result<Self, BladeError> {
        let frame = UvFrame::around(outline.points());
        let posture = Posture::new(form, outline, (map, veins), None);
        let cut = (outline, &[][..], &frame);
        Self::within(cut, veins, form, &posture, false, &|_| 0.0)
    }

    fn within(
        (outline, holes, frame): (&Outline, &[Vec<DVec2>], &UvFrame),
        veins: &[VeinSegment],
        form: &BladeForm,
        posture: &Posture<'_>,
        is_settled: bool,
        lifted: &dyn Fn(DVec2) -> f64,
    ) -> Result<Self, BladeError> {
        form.validate()?;
        let major = form.major(veins);
        let size = SizeField::new(form, &major);
        let skeleton = if holes.is_empty() {
            Skeleton::new(outline, &size, &major)
        } else {
            let clear = clear_of(holes, &major, &size);
            Skeleton::new(outline, &size, &clear)
        };
        let flat = triangulate(outline, holes, &size, &skeleton, MOST_TRIANGLES)?;
        let relief = Relief::new(form, &major);
        let mut mesh = Self::raised(flat, frame, |p| {
            let height = relief.height(p);
            let thinner = if form.margin.is_even() {
                1.0
            } else {
                form.margin.at(outline.distance_to_margin(p))
            };
            (
                posture.place(p, lifted(p) - height),
                form.thickness_mm * thinner + height,
            )
        });
        if is_settled {
            mesh.smooth_turned_over();
        }
        let faces = mesh.turned_over().count();
        if faces > 0 {
            return Err(BladeError::TurnedOver { faces });
        }
        Ok(mesh)
    }

    /// A flat triangulation brought into space by `place`, which gives position and thickness.
    fn raised(flat: Triangulation, frame: &UvFrame, place: impl Fn(DVec2) -> (DVec3, f64)) -> Self {
        let (positions, thickness_mm): (Vec<DVec3>, Vec<f64>) =
            flat.points.iter().map(|&p| place(p)).unzip();
        let normals = vertex_normals(&positions, &flat.triangles);
        Self {
            normals,
            positions,
            thickness_mm,
            uvs: flat.points.iter().map(|&p| frame.uv(p)).collect(),
            lamina: flat.points,
            triangles: flat.triangles,
        }
    }

    /// The triangles that face away from a normal of their corners.
    fn turned_over(&self) -> impl Iterator<Item = &[u32; 3]> {
        self.triangles.iter().filter(|t| !self.faces_out(t))
    }

    /// Whether a triangle faces the same way as its vertices' normals.
    fn faces_out(&self, triangle: &[u32; 3]) -> bool {
        let normal = face_normal(triangle.map(|v| self.positions[v as usize]));
        triangle
            .iter()
            .all(|&v| normal.dot(self.normals[v as usize]) > 0.0)
    }

    /// Area of a triangle on the flat lamina, mm², > 0 if counter-clockwise.
    fn flat_area(&self, triangle: &[u32; 3]) -> f64 {
        let [a, b, c] = triangle.map(|v| self.lamina[v as usize]);
        0.5 * (b - a).perp_dot(c - a)
    }

    /// Checks what every mesh must satisfy: all numbers finite, normals of unit length, every
    /// vertex used; each edge with one face, or with two of consistent orientation; the border one
    /// closed curve; no triangle turned over on the lamina or in space; and the flat triangles
    /// covering `outline_area` (mm²) within 1e-6 of it.
    ///
    /// # Errors
    ///
    /// The first [`MeshDefect`] found.
    pub fn validate(&self, outline_area: f64) -> Result<(), MeshDefect> {
        self.validate_holed(outline_area, 0)
    }

    /// As [`BladeMesh::validate`], for a blade with so many holes, each with a border of its own;
    /// the area is that without them.
    ///
    /// # Errors
    ///
    /// The first [`MeshDefect`] found.
    pub fn validate_holed(&self, outline_area: f64, holes: usize) -> Result<(), MeshDefect> {
        self.check_vertices()?;
        self.check_edges(1 + holes)?;
        for (triangle, corners) in self.triangles.iter().enumerate() {
            // The area is neither NaN nor negative.
            let has_area = self.flat_area(corners) > 0.0;
            if !(has_area && self.faces_out(corners)) {
                return Err(MeshDefect::TurnedOver { triangle });
            }
        }
        let covered: f64 = self.triangles.iter().map(|t| self.flat_area(t)).sum();
        if (covered - outline_area).abs() > SAME_AREA * outline_area {
            return Err(MeshDefect::Area {
                covered,
                enclosed: outline_area,
            });
        }
        Ok(())
    }

    fn check_vertices(&self) -> Result<(), MeshDefect> {
        let count = self.positions.len();
        let lengths = [
            self.normals.len(),
            self.uvs.len(),
            self.thickness_mm.len(),
            self.lamina.len(),
        ];
        if self.triangles.is_empty() || lengths != [count; 4] {
            return Err(MeshDefect::Lists);
        }
        let mut used = vec![false; count];
        for (triangle, &[a, b, c]) in self.triangles.iter().enumerate() {
            if a == b || b == c || c == a || a.max(b).max(c) as usize >= count {
                return Err(MeshDefect::BadTriangle { triangle });
            }
            for v in [a, b, c] {
                used[v as usize] = true;
            }
        }
        for (vertex, &used) in used.iter().enumerate() {
            let thickness = self.thickness_mm[vertex];
            let good = self.positions[vertex].is_finite()
                && self.uvs[vertex].is_finite()
                && self.lamina[vertex].is_finite()
                && (self.normals[vertex].length() - 1.0).abs() < 1e-9
                && thickness.is_finite()
                && thickness > 0.0;
            if !good {
                return Err(MeshDefect::BadVertex { vertex });
            }
            if !used {
                return Err(MeshDefect::Unused { vertex });
            }
        }
        Ok(())
    }

    fn check_edges(&self, borders: usize) -> Result<(), MeshDefect> {
        let mut edges: Vec<[u32; 2]> = self
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .collect();
        edges.sort_unstable();
        if let Some(pair) = edges.windows(2).find(|pair| pair[0] == pair[1]) {
            let [from, to] = pair[0];
            return Err(MeshDefect::Edge { from, to });
        }
        // Directed edges without a partner form the border: one leaves each of its vertices, and
        // together they form one loop.
        let border: Vec<[u32; 2]> = edges
            .iter()
            .copied()
            .filter(|&[a, b]| edges.binary_search(&[b, a]).is_err())
            .collect();
        if border.is_empty() || border.windows(2).any(|pair| pair[0][0] == pair[1][0]) {
            return Err(MeshDefect::Border { loops: 0 });
        }
        let mut walked = vec![false; border.len()];
        let mut loops = 0;
        for start in 0..border.len() {
            let mut at = start;
            if !walked[at] {
                loops += 1;
            }
            while !walked[at] {
                walked[at] = true;
                let to = border[at][1];
                at = border
                    .binary_search_by_key(&to, |edge| edge[0])
                    .map_err(|_| MeshDefect::Border { loops: 0 })?;
            }
        }
        if loops == borders {
            Ok(())
        } else {
            Err(MeshDefect::Border { loops })
        }
    }
}

/// Veins that keep clear of holes, so that the mesh has no slivers there.
fn clear_of(holes: &[Vec<DVec2>], veins: &[VeinSegment], size: &SizeField) -> Vec<VeinSegment> {
    let is_clear = |p: DVec2| {
        let near = 0.8 * size.at(p);
        holes.iter().all(|hole| {
            let sides = hole.iter().zip(hole.iter().cycle().skip(1));
            sides.into_iter().all(|(&a, &b)| {
                let way = b - a;
                let along = ((p - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
                (a + way * along).distance(p) > near
            })
        })
    };
    let veins = veins.iter().copied();
    veins
        .filter(|vein| is_clear(vein.from) && is_clear(vein.to))
        .collect()
}

fn face_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Mean of the normals of the faces at each vertex, weighted by their angles there: independent of
/// how a flat part is cut into triangles.
pub(super) fn vertex_normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let corners = triangle.map(|v| positions[v as usize]);
        let normal = face_normal(corners).normalize_or_zero();
        for i in 0..3 {
            let [at, next, last] = [0, 1, 2].map(|j| corners[(i + j) % 3]);
            let (u, v) = (next - at, last - at);
            let angle = libm::atan2(u.cross(v).length(), u.dot(v));
            sums[triangle[i] as usize] += normal * angle;
        }
    }
    sums.iter().map(|sum| sum.normalize_or(DVec3::Z)).collect()
}
