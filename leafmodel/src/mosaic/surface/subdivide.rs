//! Subdivision of surfaces, for cells that are small compared with the faces.

use glam::DVec3;

use super::adjacency::NONE;
use super::{Surface, SurfacePoint, adjacency};
use crate::not_grown::{NotGrown, not_grown};

/// Greatest number of faces: 6 GB of them while they are halved, enough for half a million cells at
/// the start.
const MOST_FACES: usize = 1 << 23;

/// The places of the faces of a subdivided surface in the original one.
#[derive(Clone, Debug)]
pub struct Ancestry {
    /// For each new face the old face, and the weights of its corners for each of the new corners.
    faces: Vec<(u32, [[f64; 3]; 3])>,
}

impl Ancestry {
    fn of(surface: &Surface) -> Self {
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = (0..surface.faces.len() as u32).map(|face| (face, corners));
        Self {
            faces: faces.collect(),
        }
    }

    /// The old face that a new face is a part of.
    #[cfg(test)]
    pub(crate) fn face(&self, face: u32) -> u32 {
        self.faces[face as usize].0
    }

    /// A point of the subdivided surface on the old one.
    pub(crate) fn carry_back(&self, point: &SurfacePoint) -> SurfacePoint {
        let (face, corners) = &self.faces[point.face as usize];
        let weight = |k: usize| {
            (0..3)
                .map(|i| point.barycentric[i] * corners[i][k])
                .sum::<f64>()
        };
        SurfacePoint {
            face: *face,
            barycentric: [weight(0), weight(1), weight(2)],
        }
    }
}

/// The error of a mesh of so short edges that it would have more faces than there may be.
fn too_many(most: usize, max_edge_mm: f64) -> NotGrown {
    not_grown!(
        "to cut the mesh until no edge is longer than {max_edge_mm} mm takes more than {most} faces"
    )
}

impl Surface {
    /// The surface with edges halved until none is longer than `max_edge_mm`, and the places of its
    /// faces on this one.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for a length that is not positive;
    /// [`NotGrown`].
    pub fn subdivided(&self, max_edge_mm: f64) -> Result<(Self, Ancestry), NotGrown> {
        self.subdivided_to(max_edge_mm, MOST_FACES)
    }

    /// [`Surface::subdivided`] with another limit to the number of faces.
    pub(super) fn subdivided_to(
        &self,
        max_edge_mm: f64,
        most_faces: usize,
    ) -> Result<(Self, Ancestry), NotGrown> {
        if !(max_edge_mm.is_finite() && max_edge_mm > 0.0) {
            return Err(not_grown!(
                "the longest edge is {max_edge_mm} mm; it has to be positive and finite"
            ));
        }
        let expected = self.total_area() / (max_edge_mm * max_edge_mm);
        if expected > most_faces as f64 {
            return Err(too_many(most_faces, max_edge_mm));
        }
        let mut surface = self.clone();
        let mut ancestry = Ancestry::of(self);
        while surface.longest_edge() > max_edge_mm {
            (surface, ancestry) = surface.halved(&ancestry, max_edge_mm, most_faces)?;
        }
        Ok((surface, ancestry))
    }

    /// Halves the long edges once.
    fn halved(
        &self,
        ancestry: &Ancestry,
        max_edge: f64,
        most_faces: usize,
    ) -> Result<(Self, Ancestry), NotGrown> {
        let edges = self.edge_numbers();
        let mut cut = Cut {
            positions: self.positions.clone(),
            faces: Vec::new(),
            keys: Vec::new(),
            ancestry: Vec::new(),
            inner: u64::MAX,
        };
        // The vertex in the middle of an edge, made by the first of its faces.
        let mut middles: Vec<u32> = vec![NONE; 3 * self.faces.len()];
        for face in 0..self.faces.len() {
            let ids = self.faces[face];
            let (old, weights) = ancestry.faces[face];
            let mut marked = [NONE; 3];
            for k in 0..3 {
                let (a, b) = (self.corners[face][k], self.corners[face][(k + 1) % 3]);
                let middle = &mut middles[(edges[face][k] >> 1) as usize];
                // Both faces of an edge must agree on its length, so the first one decides.
                let first = edges[face][k] & 1 == 0;
                if first && a.distance(b) > max_edge {
                    *middle = cut.positions.len() as u32;
                    cut.positions.push(self.middle(ids[k], ids[(k + 1) % 3]));
                }
                marked[k] = *middle;
            }
            cut.face(ids, edges[face], marked, old, weights);
            // Slender faces with long edges need more faces than their area suggests.
            if cut.faces.len() > most_faces {
                return Err(too_many(most_faces, max_edge));
            }
        }
        let (neighbours, neighbour_edges) = adjacency::pair(&cut.positions, &cut.faces, &cut.keys)?;
        let surface = Self::assemble(cut.positions, cut.faces, neighbours, neighbour_edges)?;
        Ok((
            surface,
            Ancestry {
                faces: cut.ancestry,
            },
        ))
    }

    fn middle(&self, a: u32, b: u32) -> DVec3 {
        0.5 * (self.positions[a as usize] + self.positions[b as usize])
    }

    /// For each edge of each face twice its number, and one more in the second of its faces.
    ///
    /// Vertices do not identify edges: in a doubled sheet two edges may have the same ends.
    fn edge_numbers(&self) -> Vec<[u64; 3]> {
        let mut numbers = vec![[0; 3]; self.faces.len()];
        let mut next = 0;
        for face in 0..self.faces.len() {
            for edge in 0..3 {
                let neighbour = self.neighbours[face][edge];
                let theirs = usize::from(self.neighbour_edges[face][edge]);
                let seen = neighbour != NONE && (neighbour as usize, theirs) < (face, edge);
                numbers[face][edge] = if seen {
                    numbers[neighbour as usize][theirs] | 1
                } else {
                    next += 2;
                    next - 2
                };
            }
        }
        numbers
    }
}

/// The faces of the subdivided surface under construction.
struct Cut {
    positions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    keys: Vec<[u64; 3]>,
    ancestry: Vec<(u32, [[f64; 3]; 3])>,
    /// Keys for edges inside old faces, counted down.
    inner: u64,
}

/// A corner or the middle of an edge of the face being cut: its vertex and its weights.
type Node = (u32, [f64; 3]);

impl Cut {
    fn face(
        &mut self,
        ids: [u32; 3],
        edges: [u64; 3],
        marked: [u32; 3],
        old: u32,
        weights: [[f64; 3]; 3],
    ) {
        let count = marked.iter().filter(|&&middle| middle != NONE).count();
        // Turned so that the cases below are always the same: one mark on the first edge, two on
        // the first and second.
        let first = match count {
            1 => (0..3).find(|&k| marked[k] != NONE).unwrap_or(0),
            2 => (0..3).find(|&k| marked[(k + 2) % 3] == NONE).unwrap_or(0),
            _ => 0,
        };
        let at = |k: usize| (first + k) % 3;
        let corner = |k: usize| -> Node { (ids[at(k)], weights[at(k)]) };
        let middle = |k: usize| -> Node {
            let (a, b) = (weights[at(k)], weights[at(k + 1)]);
            (marked[at(k)], [0, 1, 2].map(|i| 0.5 * (a[i] + b[i])))
        };
        // The halves of an edge, at its start and at its end in the direction of this face.
        let whole = |k: usize| edges[at(k)] & !1;
        let start = |k: usize| (1 << 62) | edges[at(k)];
        let end = |k: usize| (1 << 62) | (edges[at(k)] ^ 1);
        let [a, b, c] = [corner(0), corner(1), corner(2)];
        match count {
            0 => self.push(old, [a, b, c], [whole(0), whole(1), whole(2)]),
            1 => {
                let inner = self.inner_key();
                let m = middle(0);
                self.push(old, [a, m, c], [start(0), inner, whole(2)]);
                self.push(old, [m, b, c], [end(0), whole(1), inner]);
            }
            2 => {
                let (m, n) = (middle(0), middle(1));
                let (across, diagonal) = (self.inner_key(), self.inner_key());
                self.push(old, [m, b, n], [end(0), start(1), across]);
                // The shorter diagonal of the rest.
                let place = |node: Node| self.positions[node.0 as usize];
                if place(a).distance_squared(place(n)) <= place(m).distance_squared(place(c)) {
                    self.push(old, [a, m, n], [start(0), across, diagonal]);
                    self.push(old, [a, n, c], [diagonal, end(1), whole(2)]);
                } else {
                    self.push(old, [m, n, c], [across, end(1), diagonal]);
                    self.push(old, [a, m, c], [start(0), diagonal, whole(2)]);
                }
            }
            _ => {
                let nodes = [middle(0), middle(1), middle(2)];
                let inner = [self.inner_key(), self.inner_key(), self.inner_key()];
                self.push(old, [a, nodes[0], nodes[2]], [start(0), inner[0], end(2)]);
                self.push(old, [b, nodes[1], nodes[0]], [start(1), inner[1], end(0)]);
                self.push(old, [c, nodes[2], nodes[1]], [start(2), inner[2], end(1)]);
                self.push(old, nodes, [inner[1], inner[2], inner[0]]);
            }
        }
    }

    fn inner_key(&mut self) -> u64 {
        self.inner -= 1;
        self.inner
    }

    fn push(&mut self, old: u32, nodes: [Node; 3], keys: [u64; 3]) {
        self.faces.push(nodes.map(|node| node.0));
        self.keys.push(keys);
        self.ancestry.push((old, nodes.map(|node| node.1)));
    }
}
