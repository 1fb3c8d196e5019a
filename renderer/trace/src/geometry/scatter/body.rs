//! A shape as a rigid body of thin walls.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};

use crate::geometry::TriangleMesh;

/// Most corners that are looked at while a body turns; all of it counts once it lies.
const MOST_PROBES: usize = 3000;

/// A rigid body: triangles around their common centre of mass, as of a wall that is equally thick
/// everywhere.
#[derive(Clone, Debug)]
pub struct Body {
    middle: DVec3,
    corners: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Every how many corners one is a probe.
    stride: usize,
    radius: f64,
}

impl Body {
    /// The body of some meshes in their places.
    pub fn of<'a>(parts: impl IntoIterator<Item = (&'a TriangleMesh, DAffine3)>) -> Self {
        let mut corners = Vec::new();
        let mut triangles = Vec::new();
        for (mesh, place) in parts {
            let mut numbers = BTreeMap::new();
            for triangle in mesh.triangles() {
                triangles.push(triangle.map(|vertex| {
                    *numbers.entry(vertex).or_insert_with(|| {
                        let position = mesh.positions()[vertex as usize].as_dvec3();
                        corners.push(place.transform_point3(position));
                        corners.len() as u32 - 1
                    })
                }));
            }
        }
        let (mut moment, mut area) = (DVec3::ZERO, 0.0);
        for triangle in &triangles {
            let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
            let own = (b - a).cross(c - a).length();
            moment += own * (a + b + c) / 3.0;
            area += own;
        }
        let middle = moment / area;
        for corner in &mut corners {
            *corner -= middle;
        }
        let far = corners.iter().map(|corner| corner.length());
        Self {
            middle,
            radius: far.fold(0.0, f64::max),
            stride: corners.len().div_ceil(MOST_PROBES).max(1),
            corners,
            triangles,
        }
    }

    /// Its centre of mass in the frame of its shape.
    pub fn middle(&self) -> DVec3 {
        self.middle
    }

    /// Distance of its farthest corner from the centre of mass.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Distance of its farthest corner from the upright axis through the origin of its shape.
    pub fn width(&self) -> f64 {
        let corners = self.corners.iter();
        let far = corners.map(|corner| (*corner + self.middle).truncate().length());
        far.fold(0.0, f64::max)
    }

    /// Some of its corners, from the centre of mass.
    pub(super) fn probes(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.corners.iter().step_by(self.stride).copied()
    }

    /// All its triangles, from the centre of mass.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        let triangles = self.triangles.iter();
        triangles.map(|triangle| triangle.map(|corner| self.corners[corner as usize]))
    }
}
