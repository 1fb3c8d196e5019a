//! From margin and major veins to a constrained triangulation of the flat lamina.

use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{
    AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation,
};
use thiserror::Error;

use super::sites::Sites;
use crate::shape::outline::Outline;

/// Why a lamina could not be triangulated.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum TriangulationError {
    /// A point is not finite or too large.
    #[error("the point {x}, {y} of the lamina cannot be triangulated")]
    BadPoint {
        /// mm.
        x: f64,
        /// mm.
        y: f64,
    },
    /// Nothing lies inside the margin.
    #[error("no triangle lies within the margin: the longest edge is too long for this leaf")]
    Empty,
}

/// A triangulated lamina.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FlatMesh {
    /// Positions, mm.
    pub points: Vec<DVec2>,
    /// Counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
}

/// Least angle that refinement works towards; sharp corners of margin and veins keep theirs.
const LEAST_ANGLE_DEG: f64 = 20.0;

/// Triangulates the sites within the outline; margin and veins become edges.
///
/// Refinement leaves triangles alone that are smaller than `least_area` (mm²) and adds half as many vertices again at
/// the most: where veins meet the margin at tiny angles it would not come to an end.
pub(super) fn triangulate(
    outline: &Outline,
    sites: &Sites,
    least_area: f64,
) -> Result<FlatMesh, TriangulationError> {
    type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;
    let margin = sites.margin;
    let points: Vec<Point2<f64>> = sites.points.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let edges = (0..margin).map(|i| [i, (i + 1) % margin]).collect();
    let mut cdt = Cdt::bulk_load_cdt(points, edges).map_err(|_| {
        let bad = sites
            .points
            .iter()
            .find(|p| !p.is_finite())
            .copied()
            .unwrap_or_default();
        TriangulationError::BadPoint { x: bad.x, y: bad.y }
    })?;
    for &[from, to] in &sites.vein_edges {
        let (from, to) = (
            FixedVertexHandle::from_index(from),
            FixedVertexHandle::from_index(to),
        );
        // Veins that cross after they were made coarser keep one of the two edges.
        if cdt.can_add_constraint(from, to) {
            cdt.add_constraint(from, to);
        }
    }
    cdt.refine(
        RefinementParameters::<f64>::new()
            .with_angle_limit(AngleLimit::from_deg(LEAST_ANGLE_DEG))
            .with_min_required_area(least_area)
            .with_max_additional_vertices(sites.points.len() / 2)
            .keep_constraint_edges(),
    );
    let points: Vec<DVec2> = cdt
        .vertices()
        .map(|vertex| DVec2::new(vertex.position().x, vertex.position().y))
        .collect();
    let inside = label(&cdt, outline);
    let triangles = cdt
        .inner_faces()
        .filter(|face| inside[face.index()])
        .map(|face| face.vertices().map(|vertex| vertex.index() as u32))
        .filter(|&triangle| !is_line(&points, triangle))
        .collect();
    compact(&points, triangles)
}

/// Whether a triangle has no width to speak of: three points of a straight piece of margin, which rounding has made a
/// triangle. Its long side is then the margin.
fn is_line(points: &[DVec2], triangle: [u32; 3]) -> bool {
    let [a, b, c] = triangle.map(|vertex| points[vertex as usize]);
    let longest = a
        .distance_squared(b)
        .max(b.distance_squared(c))
        .max(c.distance_squared(a));
    (b - a).perp_dot(c - a) < 1e-9 * longest
}

/// Which faces lie within the margin: found for one face by its middle, passed on across edges that are no constraint.
fn label(cdt: &ConstrainedDelaunayTriangulation<Point2<f64>>, outline: &Outline) -> Vec<bool> {
    let mut known = vec![None; cdt.num_all_faces()];
    for seed in cdt.inner_faces() {
        if known[seed.index()].is_some() {
            continue;
        }
        let center = seed.center();
        let inside = outline.contains(DVec2::new(center.x, center.y));
        let mut open = vec![seed.fix()];
        known[seed.index()] = Some(inside);
        while let Some(face) = open.pop() {
            for edge in cdt.face(face).adjacent_edges() {
                if edge.is_constraint_edge() {
                    continue;
                }
                if let Some(next) = edge.rev().face().as_inner()
                    && known[next.index()].is_none()
                {
                    known[next.index()] = Some(inside);
                    open.push(next.fix());
                }
            }
        }
    }
    known
        .into_iter()
        .map(|inside| inside.unwrap_or(false))
        .collect()
}

/// Leaves out points that no triangle uses.
fn compact(points: &[DVec2], triangles: Vec<[u32; 3]>) -> Result<FlatMesh, TriangulationError> {
    if triangles.is_empty() {
        return Err(TriangulationError::Empty);
    }
    let mut number = vec![u32::MAX; points.len()];
    let mut used = Vec::new();
    let triangles = triangles
        .into_iter()
        .map(|triangle| {
            triangle.map(|old| {
                let new = &mut number[old as usize];
                if *new == u32::MAX {
                    *new = used.len() as u32;
                    used.push(points[old as usize]);
                }
                *new
            })
        })
        .collect();
    Ok(FlatMesh {
        points: used,
        triangles,
    })
}
