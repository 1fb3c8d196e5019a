//! Polygons as triangles.
//!
//! - **In**: the corners of a polygon, in space, in their order.
//! - **Out**: triangles whose corners are those of the polygon and which cover it; every corner is
//!   one of a triangle, so that neighbouring faces meet along whole edges.
//! - **Left out**: polygons that cross themselves, and those without area: they stay a fan, the former
//!   are counted.
//!
//! A polygon is convex in most files, and its fan is right. Others are triangulated by Delaunay's
//! rule in the plane in which they appear largest, along their edges.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec3};
use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The triangles of a polygon.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cover {
    /// The fan around its first corner covers it, or it has no area.
    Fan,
    /// These, as numbers of its corners.
    Triangles(Vec<[usize; 3]>),
    /// It crosses itself, and nothing covers it.
    Nothing,
}

/// What covers a polygon.
pub(super) fn cover(corners: &[Vec3]) -> Cover {
    let points: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3()).collect();
    let from_first = |point: DVec3| point - points[0];
    let fan = points[1..].windows(2);
    let fan: Vec<DVec3> = fan
        .map(|pair| from_first(pair[0]).cross(from_first(pair[1])))
        .collect();
    let normal: DVec3 = fan.iter().sum();
    let has_area = fan.iter().any(|part| *part != DVec3::ZERO);
    if !normal.is_finite() || !has_area || fan.iter().all(|part| part.dot(normal) > 0.0) {
        return Cover::Fan;
    }
    // As much of it has one side up as the other.
    if normal == DVec3::ZERO {
        return Cover::Nothing;
    }
    // Leaving out a coordinate rounds nothing: corners on a line stay on one.
    let dropped = (0..3).max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()));
    let dropped = dropped.expect("there are three");
    let [across, up] = if normal[dropped] > 0.0 {
        [(dropped + 1) % 3, (dropped + 2) % 3]
    } else {
        [(dropped + 2) % 3, (dropped + 1) % 3]
    };
    let flat = points
        .iter()
        .map(|point| DVec2::new(point[across], point[up]));
    inside(&flat.collect::<Vec<_>>()).map_or(Cover::Nothing, Cover::Triangles)
}

/// The triangles inside of a polygon of the plane, counter-clockwise; `None` if it crosses itself.
fn inside(points: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let mut cdt = Cdt::new();
    let mut vertices = Vec::with_capacity(points.len());
    // Corners at one place are one vertex, that of the first of them.
    let mut corner_of: BTreeMap<usize, usize> = BTreeMap::new();
    for (corner, point) in points.iter().enumerate() {
        let vertex = cdt.insert(Point2::new(point.x, point.y)).ok()?;
        corner_of.entry(vertex.index()).or_insert(corner);
        vertices.push(vertex);
    }
    let sides = || vertices.iter().zip(vertices.iter().cycle().skip(1));
    for (&from, &to) in sides() {
        if !cdt.can_add_constraint(from, to) {
            return None;
        }
        cdt.add_constraint(from, to);
    }
    // A side that is passed twice, as the way to a hole and back, bounds nothing.
    let mut bounds = vec![false; cdt.num_undirected_edges()];
    for (&from, &to) in sides() {
        let mut at = from;
        while at != to {
            let (next, edge) = step(&cdt, at, to)?;
            bounds[edge] = !bounds[edge];
            at = next;
        }
    }
    let mut is_inside: BTreeMap<usize, bool> = BTreeMap::new();
    let mut open = Vec::new();
    let mut visit = |face: Option<FixedFaceHandle<InnerTag>>, inside: bool, open: &mut Vec<_>| {
        if let Some(face) = face
            && is_inside.insert(face.index(), inside).is_none()
        {
            open.push((face, inside));
        }
    };
    for edge in cdt.convex_hull() {
        let edge = edge.rev();
        let crossed = bounds[edge.as_undirected().fix().index()];
        visit(
            edge.face().as_inner().map(|face| face.fix()),
            crossed,
            &mut open,
        );
    }
    let mut triangles = Vec::new();
    while let Some((face, inside)) = open.pop() {
        let face = cdt.face(face);
        for edge in face.adjacent_edges() {
            let crossed = bounds[edge.as_undirected().fix().index()];
            let beyond = edge.rev().face().as_inner().map(|face| face.fix());
            visit(beyond, inside != crossed, &mut open);
        }
        if inside {
            let corners = face
                .vertices()
                .map(|vertex| corner_of[&vertex.fix().index()]);
            let least = (0..3).min_by_key(|&place| corners[place])?;
            triangles.push([0, 1, 2].map(|place| corners[(least + place) % 3]));
        }
    }
    triangles.sort_unstable();
    Some(triangles)
}

/// The next vertex on the way along a side, and the edge to it: the side itself, or a part of it
/// that ends at a corner on it.
fn step(
    cdt: &Cdt,
    from: FixedVertexHandle,
    to: FixedVertexHandle,
) -> Option<(FixedVertexHandle, usize)> {
    let [start, end] = [from, to].map(|vertex| cdt.vertex(vertex).position());
    let along = DVec2::new(end.x - start.x, end.y - start.y);
    let edge = cdt.get_edge_from_neighbors(from, to).or_else(|| {
        cdt.vertex(from).out_edges().find(|edge| {
            let next = edge.to().position();
            let onward = DVec2::new(next.x - start.x, next.y - start.y);
            edge.is_constraint_edge()
                && edge.side_query(end).is_on_line()
                && onward.dot(along) > 0.0
        })
    })?;
    Some((edge.to().fix(), edge.as_undirected().fix().index()))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    /// The area that triangles cover, those of the other orientation taken off, and all of it.
    fn areas(points: &[Vec3], triangles: &[[usize; 3]]) -> [f64; 2] {
        let twice = triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|corner| points[corner].as_dvec3());
            0.5 * (b - a).cross(c - a).z
        });
        twice.fold([0.0; 2], |[net, all], area| [net + area, all + area.abs()])
    }

    /// The triangles of a polygon that something covers.
    fn triangles(points: &[Vec3]) -> Vec<[usize; 3]> {
        match cover(points) {
            Cover::Fan => (1..points.len() - 1).map(|i| [0, i, i + 1]).collect(),
            Cover::Triangles(triangles) => triangles,
            Cover::Nothing => panic!("{points:?} crosses itself"),
        }
    }

    fn flat(points: &[[f32; 2]]) -> Vec<Vec3> {
        points.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect()
    }

    #[test]
    fn a_concave_polygon_is_covered_and_nothing_else() {
        let ell = flat(&[
            [1.0, -1.0],
            [1.0, 0.0],
            [0.0, 0.0],
            [0.0, 1.0],
            [-1.0, 1.0],
            [-1.0, -1.0],
        ]);
        for turn in 0..6 {
            let mut points = ell.clone();
            points.rotate_left(turn);
            let triangles = triangles(&points);
            assert_eq!(triangles.len(), 4);
            assert_eq!(
                areas(&points, &triangles),
                [3.0, 3.0],
                "{turn}: {triangles:?}"
            );
        }
    }

    #[test]
    fn every_corner_is_one_of_a_triangle_though_it_lies_on_a_line() {
        let points = flat(&[
            [-1.0, -1.0],
            [0.0, -1.0],
            [1.0, -1.0],
            [1.0, 1.0],
            [-1.0, 1.0],
        ]);
        let triangles = triangles(&points);
        assert_eq!(areas(&points, &triangles), [4.0, 4.0]);
        assert_eq!(triangles.len(), 3);
        for corner in 0..points.len() {
            assert!(
                triangles.iter().flatten().any(|&used| used == corner),
                "{corner}"
            );
        }
    }

    #[test]
    fn repeated_corners_count_once_and_a_way_to_a_hole_bounds_nothing() {
        let points = flat(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        assert_eq!(cover(&points), Cover::Triangles(vec![[0, 2, 3]]));
        // A square of 4 with a hole of 2, which a way from corner to corner joins.
        let outer = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
        let hole = [[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0], [1.0, 1.0]];
        let points = flat(&[&outer[..], &hole[..]].concat());
        let triangles = triangles(&points);
        assert_eq!(areas(&points, &triangles), [12.0, 12.0]);
    }

    #[test]
    fn what_is_convex_or_has_no_area_stays_a_fan_and_nothing_covers_what_crosses_itself() {
        for (points, expected) in [
            ([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], Cover::Fan),
            ([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]], Cover::Fan),
            (
                [[0.0, 0.0], [1.0, f32::NAN], [2.0, 2.0], [3.0, 0.0]],
                Cover::Fan,
            ),
            (
                [[0.0, 0.0], [3.0, 3.0], [3.0, 0.0], [0.0, 2.0]],
                Cover::Nothing,
            ),
            // Both of its sides are as large.
            (
                [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]],
                Cover::Nothing,
            ),
        ] {
            assert_eq!(cover(&flat(&points)), expected, "{points:?}");
        }
    }

    proptest! {
        #![proptest_config(fixed(128))]

        #[test]
        fn a_star_of_any_shape_in_any_plane_is_covered(
            radii in proptest::collection::vec(0.1_f64..1.0, 4..40),
            turn in 0_usize..40,
            tilt in -1.0_f64..1.0,
        ) {
            let count = radii.len();
            let corner = |(place, radius): (usize, &f64)| {
                let angle = std::f64::consts::TAU * place as f64 / count as f64;
                let (sin, cos) = angle.sin_cos();
                DVec3::new(radius * cos, radius * sin, tilt * radius * (cos - 0.5 * sin)).as_vec3()
            };
            let mut points: Vec<Vec3> = radii.iter().enumerate().map(corner).collect();
            points.rotate_left(turn % count);
            let triangles = triangles(&points);
            let [net, all] = areas(&points, &triangles);
            let next = points.iter().cycle().skip(1);
            let expected: f64 = points.iter().zip(next).map(|(a, b)| {
                0.5 * (f64::from(a.x) * f64::from(b.y) - f64::from(a.y) * f64::from(b.x))
            }).sum();
            prop_assert!((net - expected).abs() < 1e-9 && (all - expected).abs() < 1e-9);
            prop_assert_eq!(triangles.len(), count - 2);
        }
    }
}
