//! Hairs as tubes of triangles.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

use glam::DVec3;

use super::plan::HairPlan;

/// Sides of a hair's cross-section, and pieces along it.
pub(super) const SIDES: usize = 3;
const PIECES: usize = 4;

/// Hairs in space. Lengths are millimetres.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct HairMesh {
    /// Places of the vertices; each hair has [`HairMesh::VERTICES`] in a row, the tip last.
    pub positions: Vec<DVec3>,
    /// Unit normals, outward.
    pub normals: Vec<DVec3>,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl HairMesh {
    /// Vertices of one hair.
    pub const VERTICES: usize = SIDES * PIECES + 1;

    /// Number of hairs.
    pub fn count(&self) -> usize {
        self.positions.len() / Self::VERTICES
    }

    /// Adds a hair: a tube that bends in the plane of `out` and `lean` and tapers to a point.
    pub(super) fn add(&mut self, plan: &HairPlan, root: &Root) {
        let Root {
            foot,
            out,
            lean,
            chance: [long, leaning, bending],
        } = *root;
        let length = plan.length_mm * (1.0 + plan.length_spread * (2.0 * long - 1.0)).max(0.05);
        let radius = 0.0005 * plan.diameter_um;
        let start = (plan.lean * (0.75 + 0.5 * leaning)).min(0.499 * PI);
        // A hair never bends back into the face.
        let end = (start + plan.bend * (0.5 + bending)).min(0.5 * PI.max(start));
        let side = out.cross(lean).normalize();
        let first = self.positions.len() as u32;
        let mut at = foot;
        for piece in 0..PIECES {
            let t = piece as f64 / PIECES as f64;
            let angle = start + (end - start) * t;
            let direction = out * libm::cos(angle) + lean * libm::sin(angle);
            let up = direction.cross(side).normalize();
            // Parallel near the foot, then to a point.
            let thick = radius * (1.0 - t * t);
            for number in 0..SIDES {
                let turn = 2.0 * PI * number as f64 / SIDES as f64;
                let normal = side * libm::cos(turn) + up * libm::sin(turn);
                self.positions.push(at + normal * thick);
                self.normals.push(normal);
            }
            at += direction * (length / PIECES as f64);
        }
        self.positions.push(at);
        let tip = out * libm::cos(end) + lean * libm::sin(end);
        self.normals.push(tip.normalize());
        let ring = |piece: usize, number: usize| first + (piece * SIDES + number % SIDES) as u32;
        for number in 0..SIDES {
            for piece in 0..PIECES - 1 {
                let [a, b] = [ring(piece, number), ring(piece, number + 1)];
                let [c, d] = [ring(piece + 1, number), ring(piece + 1, number + 1)];
                self.triangles.extend([[a, b, d], [a, d, c]]);
            }
            let [a, b] = [ring(PIECES - 1, number), ring(PIECES - 1, number + 1)];
            self.triangles.push([a, b, first + (SIDES * PIECES) as u32]);
        }
    }
}

/// The foot of a hair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) foot: DVec3,
    /// Unit: straight out of the face, or out of the margin.
    pub(super) out: DVec3,
    /// Unit, at right angles to it: where it leans.
    pub(super) lean: DVec3,
    /// Three random numbers for its shape.
    pub(super) chance: [f64; 3],
}
