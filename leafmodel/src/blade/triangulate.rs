//! A flat lamina cut into triangles whose edges follow the margin and the major veins.
//!
//! Constrained Delaunay triangulation of margin and [`Skeleton`], refined by [`super::refine`],
//! with inside and outside distinguished by crossings of the margin.

use glam::DVec2;
use spade::Triangulation as _;

use super::error::BladeError;
use super::refine::{FRAME, Refinement};
use super::size_field::SizeField;
use super::skeleton::Skeleton;
use crate::plane::polygon;
use crate::shape::outline::Outline;

/// Neighbours on the margin closer than this share of the longest edge become one point: so short
/// an edge does not matter to the shape and would not survive single precision.
const SHORTEST_MARGIN_EDGE: f64 = 1e-3;
/// Area of a triangle over that of the square on its edge, on average over refined meshes
/// (measured).
const TRIANGLE_SHARE: f64 = 0.4;

/// A flat triangulation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Triangulation {
    /// Vertices, mm, in the frame of the outline.
    pub(super) points: Vec<DVec2>,
    /// Vertices of each triangle, counter-clockwise.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Cuts the inside of `outline` into triangles, with `veins` as edges.
///
/// # Errors
///
/// [`BladeError::TooFine`] if that would take more than `limit` triangles.
pub(super) fn triangulate(
    outline: &Outline,
    holes: &[Vec<DVec2>],
    size: &SizeField,
    skeleton: &Skeleton,
    limit: usize,
) -> Result<Triangulation, BladeError> {
    let least = outline.area() / (size.longest() * size.longest()) / (2.0 * TRIANGLE_SHARE);
    if least > limit as f64 {
        return Err(BladeError::TooFine(limit));
    }
    let margin = margin_points(outline, SHORTEST_MARGIN_EDGE * size.longest());
    let mut refinement = Refinement::new(&margin, holes, skeleton, outline, size);
    refinement.run(limit)?;
    let whole = inside(&refinement);
    Ok(if holes.is_empty() {
        whole
    } else {
        pierced(whole, holes)
    })
}

/// The margin without points that nearly coincide with the one before.
fn margin_points(outline: &Outline, shortest: f64) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = Vec::with_capacity(outline.points().len());
    for &p in outline.points() {
        if points.last().is_none_or(|q| q.distance(p) >= shortest) {
            points.push(p);
        }
    }
    while points.len() > 3 && points[0].distance(points[points.len() - 1]) < shortest {
        points.pop();
    }
    // In a sinus as narrow as that, leaving out a point might make the margin cross itself.
    let still_a_margin = Outline::new(points.clone(), outline.base(), outline.base()).is_ok();
    if still_a_margin || points.len() == outline.points().len() {
        points
    } else {
        outline.points().to_vec()
    }
}

/// A triangulation without the triangles inside holes, along whose margins it has edges.
fn pierced(whole: Triangulation, holes: &[Vec<DVec2>]) -> Triangulation {
    let Triangulation { points, triangles } = whole;
    let is_left = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| points[v as usize]);
        let middle = (a + b + c) / 3.0;
        !holes.iter().any(|hole| polygon::contains(hole, middle))
    };
    let triangles: Vec<[u32; 3]> = triangles.into_iter().filter(is_left).collect();
    let mut used = vec![false; points.len()];
    for &v in triangles.iter().flatten() {
        used[v as usize] = true;
    }
    let mut number = Vec::with_capacity(points.len());
    let mut kept = Vec::with_capacity(points.len());
    for (p, used) in points.into_iter().zip(used) {
        number.push(kept.len() as u32);
        if used {
            kept.push(p);
        }
    }
    let renumbered = |corners: [u32; 3]| corners.map(|v| number[v as usize]);
    Triangulation {
        triangles: triangles.into_iter().map(renumbered).collect(),
        points: kept,
    }
}

/// The faces inside the margin, found by walking from the outside without crossing it.
fn inside(refinement: &Refinement) -> Triangulation {
    let cdt = &refinement.cdt;
    let mut outer = vec![false; cdt.num_all_faces()];
    let mut walk = vec![cdt.outer_face().fix()];
    outer[walk[0].index()] = true;
    let frame = cdt
        .vertices()
        .take(FRAME)
        .flat_map(|corner| corner.out_edges().map(|edge| edge.face().fix()));
    for face in frame {
        if !outer[face.index()] {
            outer[face.index()] = true;
            walk.push(face);
        }
    }
    while let Some(face) = walk.pop() {
        let Some(face) = cdt.face(face).as_inner() else {
            continue;
        };
        for edge in face.adjacent_edges() {
            let beyond = edge.rev().face().fix();
            let ends = [edge.from().fix().index(), edge.to().fix().index()];
            if !outer[beyond.index()] && !refinement.is_margin(ends) {
                outer[beyond.index()] = true;
                walk.push(beyond);
            }
        }
    }
    // Vertices keep their order; those of the frame, which bound outer faces only, are left out.
    let points = cdt
        .vertices()
        .skip(FRAME)
        .map(|v| DVec2::new(v.position().x, v.position().y))
        .collect();
    let triangles = cdt
        .inner_faces()
        .filter(|face| !outer[face.fix().index()])
        .map(|face| face.vertices().map(|v| (v.fix().index() - FRAME) as u32))
        .collect();
    Triangulation { points, triangles }
}
