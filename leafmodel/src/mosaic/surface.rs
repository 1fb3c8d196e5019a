//! Surfaces on which cells live: triangles, their neighbours, and a plane for each face.
//!
//! - **In**: any triangle mesh in millimetres: closed, or with margins (a leaf's sheet).
//! - **Out**: a [`Surface`]: neighbours across edges, areas, a flat frame per face, and the motion
//!   that unfolds a neighbour's frame into it.
//! - **Always true**: an edge has one face, or two of consistent orientation; every face has an
//!   area above 0.
//! - **Left out**: surfaces that branch (three faces at an edge) and one-sided surfaces.

mod adjacency;
mod doubled;
pub mod subdivide;
#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3};

use crate::not_grown::{NotGrown, not_grown};
use crate::random::{Use, uniform};

use self::adjacency::NONE;

/// Least area of a face as a share of the square of its longest edge; smaller faces have no
/// well-defined plane.
const LEAST_SHARE: f64 = 1e-12;

/// A rigid motion of the plane, from one face's frame to another's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unfold {
    /// Unit vector onto which the x axis is turned.
    pub turn: DVec2,
    /// Image of the origin, mm.
    pub shift: DVec2,
}

impl Unfold {
    /// The motion that moves nothing.
    pub const IDENTITY: Self = Self {
        turn: DVec2::X,
        shift: DVec2::ZERO,
    };

    /// Maps a point of the unfolded frame into the target frame.
    pub fn apply(&self, point: DVec2) -> DVec2 {
        self.turn.rotate(point) + self.shift
    }

    /// Maps a point of the target frame back into the unfolded frame.
    pub(crate) fn apply_inverse(&self, point: DVec2) -> DVec2 {
        self.turn_back(point - self.shift)
    }

    /// Maps a direction of the target frame back into the unfolded frame.
    pub(crate) fn turn_back(&self, direction: DVec2) -> DVec2 {
        DVec2::new(self.turn.x, -self.turn.y).rotate(direction)
    }

    /// First `inner`, then this motion.
    pub fn after(&self, inner: &Self) -> Self {
        Self {
            turn: self.turn.rotate(inner.turn),
            shift: self.apply(inner.shift),
        }
    }
}

/// A place on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The face it lies in.
    pub face: u32,
    /// Weights of the face's corners, each in [0, 1], sum 1.
    pub barycentric: [f64; 3],
}

impl SurfacePoint {
    /// A corner of a face, 0 to 2.
    pub fn corner(face: u32, corner: usize) -> Self {
        let mut barycentric = [0.0; 3];
        barycentric[corner] = 1.0;
        Self { face, barycentric }
    }
}

/// A triangle mesh with the neighbours of each face. Lengths are in millimetres.
#[derive(Clone, Debug)]
pub struct Surface {
    positions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    neighbours: Vec<[u32; 3]>,
    neighbour_edges: Vec<[u8; 3]>,
    corners: Vec<[DVec2; 3]>,
    unfolds: Vec<[Unfold; 3]>,
    area_up_to: Vec<f64>,
}

impl Surface {
    /// A surface from a mesh: vertices in mm and the corners of each face.
    ///
    /// Vertices at exactly equal positions, as at seams of texture coordinates, are merged; faces
    /// keep their order.
    ///
    /// # Errors
    ///
    /// Every [`NotGrown`] but [`NotGrown`] and the last; the first defect found.
    pub fn new(positions: Vec<DVec3>, faces: Vec<[u32; 3]>) -> Result<Self, NotGrown> {
        let (positions, faces) = adjacency::welded(positions, faces)?;
        let keys = adjacency::keys_of_vertices(&faces);
        let (neighbours, neighbour_edges) = adjacency::pair(&positions, &faces, &keys)?;
        Self::assemble(positions, faces, neighbours, neighbour_edges)
    }

    fn assemble(
        positions: Vec<DVec3>,
        faces: Vec<[u32; 3]>,
        neighbours: Vec<[u32; 3]>,
        neighbour_edges: Vec<[u8; 3]>,
    ) -> Result<Self, NotGrown> {
        let mut surface = Self {
            corners: Vec::new(),
            unfolds: Vec::new(),
            area_up_to: Vec::new(),
            positions,
            faces,
            neighbours,
            neighbour_edges,
        };
        surface.flatten()?;
        Ok(surface)
    }

    /// Checks that the faces around each vertex form a single fan. Cells can live on other surfaces
    /// too, since they cross edges only.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the first vertex with more than one fan.
    pub(crate) fn check_vertices(&self) -> Result<(), NotGrown> {
        let mut walked = vec![[false; 3]; self.faces.len()];
        let mut met = vec![false; self.positions.len()];
        for face in 0..self.faces.len() {
            for corner in 0..3 {
                if walked[face][corner] {
                    continue;
                }
                let vertex = self.faces[face][corner];
                if std::mem::replace(&mut met[vertex as usize], true) {
                    let at = self.positions[vertex as usize];
                    return Err(not_grown!(
                        "not a manifold: parts of the mesh touch at {at} mm in a point only"
                    ));
                }
                // In both directions around the vertex, across the edges that start and end there.
                for side in [0, 2] {
                    let mut at = (face, corner);
                    loop {
                        walked[at.0][at.1] = true;
                        let edge = (at.1 + side) % 3;
                        let next = self.neighbours[at.0][edge];
                        if next == NONE {
                            break;
                        }
                        let corners = &self.faces[next as usize];
                        let Some(there) = corners.iter().position(|&other| other == vertex) else {
                            break;
                        };
                        at = (next as usize, there);
                        if walked[at.0][at.1] {
                            break;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The same faces and neighbours with new positions of the vertices, in the order of
    /// [`Surface::positions`].
    ///
    /// # Errors
    ///
    /// [`NotGrown`], [`NotGrown`].
    ///
    /// # Panics
    ///
    /// If the number of `positions` differs from that of the vertices.
    pub fn moved(&self, positions: Vec<DVec3>) -> Result<Self, NotGrown> {
        assert_eq!(
            positions.len(),
            self.positions.len(),
            "as many vertices as before"
        );
        adjacency::check_finite(&positions)?;
        Self::assemble(
            positions,
            self.faces.clone(),
            self.neighbours.clone(),
            self.neighbour_edges.clone(),
        )
    }

    /// Computes frames, areas and unfoldings from the positions.
    fn flatten(&mut self) -> Result<(), NotGrown> {
        let mut total = 0.0;
        for (face, ids) in self.faces.iter().enumerate() {
            let [a, b, c] = ids.map(|id| self.positions[id as usize]);
            let (along, up) = (b - a, c - a);
            let normal = along.cross(up);
            let area = normal.length() / 2.0;
            let longest = along.length_squared().max(up.length_squared());
            let longest = longest.max(b.distance_squared(c));
            if area <= LEAST_SHARE * longest || !area.is_finite() {
                return Err(not_grown!(
                    "face {face} has no area; its corners are {a} mm, {b} mm and {c} mm"
                ));
            }
            let length = along.length();
            let x = along / length;
            let corners = [
                DVec2::ZERO,
                DVec2::new(length, 0.0),
                DVec2::new(up.dot(x), 2.0 * area / length),
            ];
            self.corners.push(corners);
            total += area;
            self.area_up_to.push(total);
        }
        for face in 0..self.faces.len() {
            self.unfolds
                .push([0, 1, 2].map(|edge| self.hinge(face, edge)));
        }
        Ok(())
    }

    /// The motion that unfolds the neighbour across an edge into the face's plane.
    fn hinge(&self, face: usize, edge: usize) -> Unfold {
        let neighbour = self.neighbours[face][edge];
        if neighbour == NONE {
            return Unfold::IDENTITY;
        }
        let theirs = usize::from(self.neighbour_edges[face][edge]);
        let (mine, other) = (&self.corners[face], &self.corners[neighbour as usize]);
        // Both faces have the same orientation, so the neighbour runs along the edge in reverse.
        let (end, start) = (mine[edge], mine[(edge + 1) % 3]);
        let (from, to) = (other[theirs], other[(theirs + 1) % 3]);
        let wanted = (end - start).normalize();
        let present = (to - from).normalize();
        let turn = DVec2::new(present.dot(wanted), present.perp_dot(wanted)).normalize();
        let shift = 0.5 * (end + start - turn.rotate(from + to));
        Unfold { turn, shift }
    }

    /// The vertices after welding, mm.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Corners of the faces, as indices of [`Surface::positions`]; faces in the order of the mesh.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The face across edge `edge` (from corner `edge` to the next) of a face; `None` across a
    /// margin.
    pub fn neighbour(&self, face: u32, edge: usize) -> Option<u32> {
        let neighbour = self.neighbours[face as usize][edge];
        (neighbour != NONE).then_some(neighbour)
    }

    /// The number that the shared edge has in the neighbour across `edge`; `None` across a margin.
    pub(crate) fn neighbour_edge(&self, face: u32, edge: usize) -> Option<usize> {
        self.neighbour(face, edge)?;
        Some(usize::from(self.neighbour_edges[face as usize][edge]))
    }

    /// The motion that unfolds the neighbour across `edge` into the frame of the face; `None`
    /// across a margin.
    pub fn unfold(&self, face: u32, edge: usize) -> Option<Unfold> {
        self.neighbour(face, edge)?;
        Some(self.unfolds[face as usize][edge])
    }

    /// The corners of a face in its own frame, mm: the first at the origin, the second on the x
    /// axis, the third above it.
    pub fn corners(&self, face: u32) -> [DVec2; 3] {
        self.corners[face as usize]
    }

    /// Area of a face, mm².
    pub fn area(&self, face: u32) -> f64 {
        let corners = &self.corners[face as usize];
        corners[1].x * corners[2].y / 2.0
    }

    /// Area of all faces, mm².
    pub fn total_area(&self) -> f64 {
        self.area_up_to.last().copied().unwrap_or_default()
    }

    /// Unit normal of a face, on the side from which its corners go round anticlockwise.
    pub fn normal(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.faces[face as usize].map(|id| self.positions[id as usize]);
        (b - a).cross(c - a).normalize()
    }

    /// A point in space, mm.
    pub fn position(&self, point: &SurfacePoint) -> DVec3 {
        let corners = self.faces[point.face as usize].map(|id| self.positions[id as usize]);
        let [u, v, w] = point.barycentric;
        corners[0] * u + corners[1] * v + corners[2] * w
    }

    /// A point in the frame of its face, mm.
    pub fn flat(&self, point: &SurfacePoint) -> DVec2 {
        let corners = &self.corners[point.face as usize];
        let [u, v, w] = point.barycentric;
        corners[0] * u + corners[1] * v + corners[2] * w
    }

    /// The point of a face at a place of its frame (mm); places outside are clamped to the face.
    pub fn point(&self, face: u32, flat: DVec2) -> SurfacePoint {
        let [_, b, c] = self.corners[face as usize];
        let w = (flat.y / c.y).clamp(0.0, 1.0);
        let v = ((flat.x - w * c.x) / b.x).clamp(0.0, 1.0 - w);
        SurfacePoint {
            face,
            barycentric: [1.0 - v - w, v, w],
        }
    }

    /// The centre of a face.
    pub fn centre(&self, face: u32) -> SurfacePoint {
        let third = 1.0 / 3.0;
        SurfacePoint {
            face,
            barycentric: [third; 3],
        }
    }

    /// A point of the surface from three numbers in [0, 1): uniform by area if they are uniform and
    /// independent.
    pub fn sample(&self, u: [f64; 3]) -> SurfacePoint {
        let wanted = u[0] * self.total_area();
        let face = self.area_up_to.partition_point(|&area| area <= wanted);
        let root = u[1].sqrt();
        let (v, w) = (root * (1.0 - u[2]), root * u[2]);
        SurfacePoint {
            face: face.min(self.faces.len() - 1) as u32,
            barycentric: [(1.0 - root).max(0.0), v, w],
        }
    }

    /// Points uniform over the surface at which patterns are compared; the same for the same seed.
    pub fn probes(&self, count: u64, seed: u64) -> Vec<SurfacePoint> {
        let probe = |number: u64| {
            let draw = |k| uniform(seed, Use::PatternProbe, 3 * number + k);
            self.sample([draw(0), draw(1), draw(2)])
        };
        (0..count).map(probe).collect()
    }

    /// Longest edge of all, mm.
    pub(crate) fn longest_edge(&self) -> f64 {
        let sides = self.corners.iter().flat_map(|corners| {
            [0, 1, 2].map(|edge: usize| corners[edge].distance_squared(corners[(edge + 1) % 3]))
        });
        sides.fold(0.0, f64::max).sqrt()
    }
}
