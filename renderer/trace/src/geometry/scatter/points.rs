//! Random points of a surface, and the distances between them.

use glam::{DAffine3, DVec2, DVec3};

use super::cells::Cells;
use super::place::ScatterError;
use crate::geometry::TriangleMesh;

/// Most triangles of a surface, in all its places (2.9 GB).
const MOST_TRIANGLES: usize = 20_000_000;

/// A surface in the world.
#[derive(Clone, Debug, Default)]
pub struct Ground {
    triangles: Vec<[DVec3; 3]>,
}

/// The triangles of some meshes in their places.
pub fn triangles<'a>(
    parts: impl IntoIterator<Item = (&'a TriangleMesh, DAffine3)>,
) -> impl Iterator<Item = [DVec3; 3]> {
    parts.into_iter().flat_map(|(mesh, place)| {
        let corner =
            move |vertex: u32| place.transform_point3(mesh.positions()[vertex as usize].as_dvec3());
        // A place that mirrors would turn what faces up down.
        let mirrors = place.matrix3.determinant() < 0.0;
        mesh.triangles().iter().map(move |triangle| {
            let [a, b, c] = triangle.map(corner);
            if mirrors { [a, c, b] } else { [a, b, c] }
        })
    })
}

impl Ground {
    /// The surface of some meshes in their places.
    ///
    /// # Errors
    ///
    /// [`ScatterError::TooFine`] if it has more than 20 million triangles.
    pub fn of<'a>(
        parts: impl IntoIterator<Item = (&'a TriangleMesh, DAffine3)>,
    ) -> Result<Self, ScatterError> {
        let triangles: Vec<_> = triangles(parts).take(MOST_TRIANGLES + 1).collect();
        Self::check_size(triangles.len())?;
        Ok(Self { triangles })
    }

    /// Refuses a surface of so many triangles.
    ///
    /// # Errors
    ///
    /// [`ScatterError::TooFine`] if they are more than 20 million.
    pub fn check_size(triangles: usize) -> Result<(), ScatterError> {
        if triangles > MOST_TRIANGLES {
            let most = MOST_TRIANGLES;
            return Err(ScatterError::TooFine { most });
        }
        Ok(())
    }

    /// Its greatest height, m; −∞ without any triangle.
    pub fn top(&self) -> f64 {
        let corners = self.triangles.iter().flatten();
        corners
            .map(|corner| corner.z)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Its triangles.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.triangles.iter().copied()
    }

    /// What of it counts: all that is in a rectangle of the plan, by area, or what of that faces
    /// up, by the area of its plan.
    pub(super) fn measure(&self, within: Option<[DVec2; 2]>, plan: bool) -> Measure {
        let mut measure = Measure::default();
        for triangle in &self.triangles {
            match within {
                None => measure.add(*triangle, plan),
                Some([least, most]) if is_within(triangle, least, most) => {
                    measure.add(*triangle, plan);
                }
                Some(rectangle) if is_beside(triangle, rectangle) => {}
                Some(rectangle) => {
                    let polygon = clipped(triangle, rectangle);
                    for pair in polygon.windows(2).skip(1) {
                        measure.add([polygon[0], pair[0], pair[1]], plan);
                    }
                }
            }
        }
        measure
    }
}

/// Whether all of a triangle lies over a rectangle of the plan.
fn is_within(triangle: &[DVec3; 3], least: DVec2, most: DVec2) -> bool {
    let mut corners = triangle.iter().map(|corner| corner.truncate());
    corners.all(|at| at.cmpge(least).all() && at.cmple(most).all())
}

/// Whether a triangle lies wholly beyond one side of a rectangle of the plan.
fn is_beside(triangle: &[DVec3; 3], [least, most]: [DVec2; 2]) -> bool {
    let [a, b, c] = triangle.map(DVec3::truncate);
    a.min(b).min(c).cmpgt(most).any() || a.max(b).max(c).cmplt(least).any()
}

/// The part of a triangle over a rectangle of the plan: a convex polygon, perhaps empty
/// (Sutherland and Hodgman 1974).
fn clipped(triangle: &[DVec3; 3], [least, most]: [DVec2; 2]) -> Vec<DVec3> {
    let mut polygon = triangle.to_vec();
    for (axis, bound, sign) in [
        (0, least.x, 1.0),
        (0, most.x, -1.0),
        (1, least.y, 1.0),
        (1, most.y, -1.0),
    ] {
        let inside = |point: DVec3| sign * (point[axis] - bound);
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (number, &point) in polygon.iter().enumerate() {
            let next = polygon[(number + 1) % polygon.len()];
            let (here, there) = (inside(point), inside(next));
            if here >= 0.0 {
                kept.push(point);
            }
            if here * there < 0.0 {
                kept.push(point.lerp(next, here / (here - there)));
            }
        }
        polygon = kept;
    }
    polygon
}

/// Triangles with running sums of their areas.
#[derive(Clone, Debug, Default)]
pub(super) struct Measure {
    triangles: Vec<[DVec3; 3]>,
    sums: Vec<f64>,
}

impl Measure {
    fn add(&mut self, triangle: [DVec3; 3], plan: bool) {
        let [a, b, c] = triangle;
        let cross = (b - a).cross(c - a);
        let area = 0.5 * if plan { cross.z } else { cross.length() };
        if area > 0.0 {
            self.triangles.push(triangle);
            self.sums.push(self.total() + area);
        }
    }

    /// Its triangles.
    pub(super) fn triangles(&self) -> &[[DVec3; 3]] {
        &self.triangles
    }

    /// The whole area, m².
    pub(super) fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    /// Least and greatest x and y.
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        let corners = self.triangles.iter().flatten();
        corners.fold(
            [DVec2::INFINITY, DVec2::NEG_INFINITY],
            |[least, most], p| [least.min(p.truncate()), most.max(p.truncate())],
        )
    }

    /// A point, each equally likely, with the normal of its triangle.
    pub(super) fn point(&self, [which, across, along]: [f64; 3]) -> (DVec3, DVec3) {
        let sum = which * self.total();
        let number = self.sums.partition_point(|&to_here| to_here <= sum);
        let [a, b, c] = self.triangles[number.min(self.triangles.len() - 1)];
        let root = across.sqrt();
        let point = a * (1.0 - root) + b * (root * (1.0 - along)) + c * (root * along);
        (point, (b - a).cross(c - a).normalize_or(DVec3::Z))
    }
}

/// Points that keep a distance from one another, if it is above 0.
#[derive(Clone, Debug)]
pub(super) struct Spaced(Cells<DVec3>);

impl Spaced {
    pub(super) fn new(least: f64) -> Self {
        Self(Cells::of_edge(least))
    }

    /// Whether a point is far enough from all that are taken.
    pub(super) fn has_room(&self, point: DVec3) -> bool {
        let least = self.0.edge();
        let mut near = self.0.around(point);
        least <= 0.0 || near.all(|other| other.distance(point) >= least)
    }

    pub(super) fn take(&mut self, point: DVec3) {
        if self.0.edge() > 0.0 {
            self.0.add(point, point);
        }
    }
}
