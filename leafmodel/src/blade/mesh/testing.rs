//! Meshes for tests, and what is wrong with a mesh.

use thiserror::Error;

use super::{BladeError, BladeMesh, Displacement};
use crate::blade::BladeForm;
use crate::blade::frame::UvFrame;
use crate::blade::stance::Posture;
use crate::shape::outline::Outline;
use crate::venation::conformal_map::ConformalMap;
use crate::venation::network::VeinSegment;

/// What is wrong with a mesh. Meshes from [`BladeMesh::build`] have no defects.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub(crate) enum MeshDefect {
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
    /// As [`BladeMesh::build`], from pieces of vein in a map of the blade. Pieces are connected
    /// where their ends have the same bits.
    ///
    /// # Errors
    ///
    /// As [`BladeMesh::build`].
    pub(crate) fn from_veins(
        outline: &Outline,
        veins: &[VeinSegment],
        map: ConformalMap,
        form: &BladeForm,
    ) -> Result<Self, BladeError> {
        let displaced = Displacement::NONE;
        Self::from_veins_displaced(outline, veins, map, form, displaced)
    }

    /// As [`BladeMesh::from_veins`], `displaced`.
    ///
    /// # Errors
    ///
    /// As [`BladeMesh::build`].
    pub(crate) fn from_veins_displaced(
        outline: &Outline,
        veins: &[VeinSegment],
        map: ConformalMap,
        form: &BladeForm,
        displaced: Displacement<'_>,
    ) -> Result<Self, BladeError> {
        let frame = UvFrame::around(outline.points());
        let posture = Posture::new(form, outline, (map, veins), None);
        let cut = (outline, &[][..], &frame);
        Self::within(cut, veins, form, &posture, false, displaced)
    }

    /// Area of a triangle on the flat lamina, mm², > 0 if counter-clockwise.
    pub(crate) fn flat_area(&self, triangle: &[u32; 3]) -> f64 {
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
    pub(crate) fn validate(&self, outline_area: f64) -> Result<(), MeshDefect> {
        self.validate_holed(outline_area, 0)
    }

    /// As [`BladeMesh::validate`], for a blade with so many holes, each with a border of its own;
    /// the area is that without them.
    ///
    /// # Errors
    ///
    /// The first [`MeshDefect`] found.
    pub(crate) fn validate_holed(&self, outline_area: f64, holes: usize) -> Result<(), MeshDefect> {
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
            self.relief_mm.len(),
        ];
        if self.triangles.is_empty() || lengths != [count; 5] {
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
                && self.relief_mm[vertex]
                    .iter()
                    .all(|height| height.is_finite())
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
