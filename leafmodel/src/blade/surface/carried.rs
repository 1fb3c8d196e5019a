//! Slopes that the mesh carries: those of its shading normals, against the blade without relief.

use glam::{DVec2, DVec3};

use super::super::frame::UvFrame;
use super::super::mesh::{BladeMesh, vertex_normals};
use crate::buckets::Buckets;

/// Places within a texel, per side, at which slopes are taken.
pub(super) const PLACES: usize = 3;

/// The slopes of a mesh's relief over a map, row by row.
#[derive(Debug)]
pub(super) struct Carried<'a> {
    mesh: &'a BladeMesh,
    /// The relief's normal at each vertex, for a blade that is otherwise flat.
    normals: Vec<DVec3>,
    frame: &'a UvFrame,
    size: [usize; 2],
    /// Numbers of the triangles that reach into each row.
    members: Buckets,
}

impl<'a> Carried<'a> {
    /// The relief of veins, if `with_veins`, and of the bulge on a map of `size` texels; `None` if
    /// the mesh has none.
    pub(super) fn new(
        mesh: &'a BladeMesh,
        with_veins: bool,
        frame: &'a UvFrame,
        size: [usize; 2],
    ) -> Option<Self> {
        let height = |relief: &[f64; 2]| relief[1] + if with_veins { relief[0] } else { 0.0 };
        let heights: Vec<f64> = mesh.relief_mm.iter().map(height).collect();
        if heights.windows(2).all(|pair| pair[0] == pair[1]) {
            return None;
        }
        let places = mesh.lamina.iter().zip(&heights);
        let places: Vec<DVec3> = places.map(|(p, z)| p.extend(*z)).collect();
        let mut carried = Self {
            mesh,
            normals: vertex_normals(&places, &mesh.triangles),
            frame,
            size,
            members: Buckets::default(),
        };
        carried.sort();
        Some(carried)
    }

    /// Counting sort of the triangles into the rows of the map.
    fn sort(&mut self) {
        let triangles = &self.mesh.triangles;
        let rows = |triangle: &[u32; 3]| {
            let ys = triangle.map(|v| self.place(v).y);
            let (low, high) = (ys[0].min(ys[1]).min(ys[2]), ys[0].max(ys[1]).max(ys[2]));
            let last = self.size[1] - 1;
            (low.max(0.0) as usize).min(last)..=(high.max(0.0) as usize).min(last)
        };
        let members = (0..)
            .zip(triangles)
            .flat_map(|(number, triangle)| rows(triangle).map(move |row| (row, number)));
        self.members = Buckets::new(self.size[1], members);
    }

    /// A vertex in texels.
    fn place(&self, vertex: u32) -> DVec2 {
        let size = DVec2::new(self.size[0] as f64, self.size[1] as f64);
        (self.mesh.lamina[vertex as usize] - self.frame.min) / self.frame.size * size
    }

    /// Slopes at `PLACES²` places of each texel of a row, `PLACES` lines of `PLACES · width`; 0
    /// beyond the mesh.
    pub(super) fn row(&self, row: usize) -> Vec<DVec2> {
        let across = PLACES * self.size[0];
        let mut slopes = vec![DVec2::ZERO; PLACES * across];
        let step = 1.0 / PLACES as f64;
        for &number in self.members.list(row) {
            let triangle = self.mesh.triangles[number as usize];
            let [a, b, c] = triangle.map(|v| self.place(v));
            let normals = triangle.map(|v| self.normals[v as usize]);
            let doubled = (b - a).perp_dot(c - a);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            for line in 0..PLACES {
                let y = row as f64 + (line as f64 + 0.5) * step;
                if y < low.y || y > high.y {
                    continue;
                }
                let [left, right] = span([a, b, c], y);
                // A place more on either side, for rounding.
                let first = (left / step - 1.5).ceil().max(0.0) as usize;
                let end = ((right / step + 1.5).floor().max(0.0) as usize).min(across);
                for column in first..end {
                    let p = DVec2::new((column as f64 + 0.5) * step, y);
                    let weights = [
                        (c - b).perp_dot(p - b),
                        (a - c).perp_dot(p - c),
                        (b - a).perp_dot(p - a),
                    ]
                    .map(|area| area / doubled);
                    // A place on an edge belongs to both of its triangles, which agree there.
                    if weights.iter().all(|weight| *weight >= -1e-9) {
                        let normal: DVec3 = (0..3).map(|i| normals[i] * weights[i]).sum();
                        slopes[line * across + column] = -normal.truncate() / normal.z;
                    }
                }
            }
        }
        slopes
    }
}

/// From where to where a level line at a height that it reaches runs within a triangle.
fn span([a, b, c]: [DVec2; 3], y: f64) -> [f64; 2] {
    let mut span = [f64::INFINITY, f64::NEG_INFINITY];
    for (from, to) in [(a, b), (b, c), (c, a)] {
        if y < from.y.min(to.y) || y > from.y.max(to.y) {
            continue;
        }
        let rise = to.y - from.y;
        let ends = if rise == 0.0 {
            [from.x, to.x]
        } else {
            [from.x + ((y - from.y) / rise).clamp(0.0, 1.0) * (to.x - from.x); 2]
        };
        for x in ends {
            span = [span[0].min(x), span[1].max(x)];
        }
    }
    span
}

#[cfg(test)]
mod tests;
