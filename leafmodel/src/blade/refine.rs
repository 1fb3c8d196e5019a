//! Delaunay refinement: points added until every triangle is small and well shaped.
//!
//! Ruppert's scheme with a size field. A triangle that is too large or too pointed gets a new
//! vertex at its circumcentre; a forced edge that is too long, or has a vertex within the circle on
//! it, is halved. Departures: corners sharper than 60° are left as they are; edges that end in such
//! a corner are cut at powers of two from it, so that its two arms do not keep splitting each
//! other; and no edge is cut below a share of the target length, so that the refinement ends.
//!
//! # Source
//!
//! \[ruppert1995\], \[shewchuk2002\] for the arms of sharp corners.

use std::collections::VecDeque;

use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{Point2, Triangulation as _};

use super::error::BladeError;
use super::size_field::SizeField;
use super::skeleton::Skeleton;
use crate::shape::outline::Outline;

/// The triangulation that is refined.
pub(super) type Cdt = spade::ConstrainedDelaunayTriangulation<spade::Point2<f64>>;

/// Number of vertices, the first ones, that only form the frame around the leaf.
pub(super) const FRAME: usize = 4;
/// Circumradius over target edge above which a triangle is too large.
const LARGEST_RADIUS: f64 = 0.66;
/// Circumradius over shortest edge above which a triangle is too pointed: 1 / (2 sin 25°).
const POINTED: f64 = 1.183;
/// Shortest piece that a forced edge is cut to, as a share of the target length.
const FLOOR: f64 = 0.08;
/// Marks a vertex that is not on the margin.
const NONE: u32 = u32::MAX;
/// Cosine of the angle below which a corner counts as sharp.
const SHARP_COSINE: f64 = 0.5;

/// A triangulation during refinement.
pub(super) struct Refinement<'a> {
    pub(super) cdt: Cdt,
    outline: &'a Outline,
    size: &'a SizeField,
    /// For each vertex the next one on the margin, or [`NONE`].
    next: Vec<u32>,
    /// Whether two forced edges meet there at less than 60°.
    sharp: Vec<bool>,
    edges: VecDeque<[u32; 2]>,
    faces: VecDeque<[u32; 3]>,
}

impl<'a> Refinement<'a> {
    /// The triangulation of margin and skeleton alone.
    pub(super) fn new(
        margin: &[DVec2],
        holes: &[Vec<DVec2>],
        skeleton: &Skeleton,
        outline: &'a Outline,
        size: &'a SizeField,
    ) -> Self {
        let (low, high) = outline.bounds();
        let wide = DVec2::splat((high - low).max_element());
        let (low, high) = (low - wide, high + wide);
        let frame = [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ];
        let points: Vec<DVec2> = frame
            .iter()
            .chain(margin)
            .chain(holes.iter().flatten())
            .chain(&skeleton.points)
            .copied()
            .collect();
        // Vertices of the margin, then those of each hole.
        let mut count = 0;
        let mut margin_edges = Vec::new();
        let lengths = std::iter::once(margin.len()).chain(holes.iter().map(Vec::len));
        for length in lengths {
            let first = FRAME + count;
            margin_edges.extend((0..length).map(|i| [first + i, first + (i + 1) % length]));
            count += length;
        }
        let forced = margin_edges.clone();
        let vertices = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
        let mut cdt = Cdt::bulk_load_cdt(vertices, margin_edges).expect(
            "coordinates are finite, an outline does not cross itself, and no point repeats another",
        );
        assert_eq!(cdt.num_vertices(), points.len(), "no point repeats another");
        let vein = |i: u32| FixedVertexHandle::from_index(FRAME + count + i as usize);
        for &[a, b] in &skeleton.edges {
            // Veins may still cross after welding; then the thicker one, which was added first, is
            // kept.
            if cdt.can_add_constraint(vein(a), vein(b)) {
                cdt.add_constraint(vein(a), vein(b));
            }
        }
        let mut next = vec![NONE; points.len()];
        for [from, to] in forced {
            next[from] = to as u32;
        }
        let mut refinement = Self {
            sharp: (0..points.len()).map(|v| is_sharp(&cdt, v)).collect(),
            cdt,
            outline,
            size,
            next,
            edges: VecDeque::new(),
            faces: VecDeque::new(),
        };
        for face in refinement.cdt.inner_faces() {
            let corners = face.vertices().map(|v| v.fix().index() as u32);
            refinement.faces.push_back(corners);
        }
        for edge in refinement.cdt.undirected_edges() {
            if edge.is_constraint_edge() {
                let ends = edge.vertices().map(|v| v.fix().index() as u32);
                refinement.edges.push_back(ends);
            }
        }
        refinement
    }

    /// Whether two neighbouring vertices are neighbours on the margin.
    pub(super) fn is_margin(&self, [a, b]: [usize; 2]) -> bool {
        self.next[a] as usize == b || self.next[b] as usize == a
    }

    /// Adds vertices until nothing is left to do. Forced edges come first, since circumcentres must
    /// not be tried while edges that still have to be cut are in the way.
    pub(super) fn run(&mut self, limit: usize) -> Result<(), BladeError> {
        // A triangulation has twice as many triangles as vertices.
        while self.next.len() <= limit / 2 {
            if let Some([a, b]) = self.edges.pop_front() {
                if self.needs_cut(a, b) {
                    self.cut(a, b);
                }
            } else if let Some(corners) = self.faces.pop_front() {
                self.improve(corners);
            } else {
                return Ok(());
            }
        }
        Err(BladeError::TooFine(limit))
    }

    fn point(&self, v: u32) -> DVec2 {
        place(self.cdt.vertex(handle(v)).position())
    }

    /// Whether the forced edge still exists, and is too long or has a vertex within its circle.
    fn needs_cut(&self, a: u32, b: u32) -> bool {
        let Some(edge) = self.cdt.get_edge_from_neighbors(handle(a), handle(b)) else {
            return false;
        };
        if !edge.is_constraint_edge() {
            return false;
        }
        let (pa, pb) = (self.point(a), self.point(b));
        if pa.distance(pb) > self.size.at(pa.midpoint(pb)) {
            return true;
        }
        [edge, edge.rev()].into_iter().any(|side| {
            side.opposite_vertex().is_some_and(|apex| {
                let p = place(apex.position());
                let middle = (pa + pb + p) / 3.0;
                (pa - p).dot(pb - p) < 0.0 && self.outline.contains(middle)
            })
        })
    }

    /// Cuts a forced edge in two unless the pieces would be too short. Returns whether it did.
    fn cut(&mut self, a: u32, b: u32) -> bool {
        let (pa, pb) = (self.point(a), self.point(b));
        let length = pa.distance(pb);
        let middle = pa.midpoint(pb);
        if length < 2.0 * FLOOR * self.size.at(middle) {
            return false;
        }
        let Some(edge) = self.cdt.get_edge_from_neighbors(handle(a), handle(b)) else {
            return false;
        };
        let edge = edge.as_undirected().fix();
        let p = match (self.sharp[a as usize], self.sharp[b as usize]) {
            (true, false) => pa.lerp(pb, shell(length) / length),
            (false, true) => pb.lerp(pa, shell(length) / length),
            (true, true) | (false, false) => middle,
        };
        self.cdt.remove_constraint_edge(edge);
        let v = self.insert(p, a);
        self.force(a, v);
        self.force(v, b);
        if self.next[a as usize] == b {
            self.next[a as usize] = v;
            self.next[v as usize] = b;
        } else if self.next[b as usize] == a {
            self.next[b as usize] = v;
            self.next[v as usize] = a;
        }
        self.edges.push_back([a, v]);
        self.edges.push_back([v, b]);
        self.look_around(v);
        true
    }

    fn force(&mut self, a: u32, b: u32) {
        // The piece lies, up to rounding, where a forced edge lay: nothing can cross it but its
        // other piece.
        if self.cdt.can_add_constraint(handle(a), handle(b)) {
            self.cdt.add_constraint(handle(a), handle(b));
        }
    }

    fn insert(&mut self, p: DVec2, near: u32) -> u32 {
        let v = self
            .cdt
            .insert_with_hint(Point2::new(p.x, p.y), handle(near))
            .expect("a point between finite points is finite")
            .index();
        if v == self.next.len() {
            self.next.push(NONE);
            self.sharp.push(false);
        }
        v as u32
    }

    /// Queues the faces around a new vertex, and the forced edges of those faces, for inspection.
    fn look_around(&mut self, v: u32) {
        for out in self.cdt.vertex(handle(v)).out_edges() {
            let Some(face) = out.face().as_inner() else {
                continue;
            };
            let corners = face.vertices().map(|v| v.fix().index() as u32);
            self.faces.push_back(corners);
            let across = out.next();
            if across.is_constraint_edge() {
                let ends = across.vertices().map(|v| v.fix().index() as u32);
                self.edges.push_back(ends);
            }
        }
    }

    /// Gives a bad triangle inside the leaf a vertex at its circumcentre, or cuts the edges in its
    /// way.
    fn improve(&mut self, [a, b, c]: [u32; 3]) {
        let Some(start) = self.cdt.get_edge_from_neighbors(handle(a), handle(b)) else {
            return;
        };
        let same = start
            .opposite_vertex()
            .is_some_and(|v| v.fix().index() == c as usize);
        let [pa, pb, pc] = [a, b, c].map(|v| self.point(v));
        let middle = (pa + pb + pc) / 3.0;
        if !same || !self.outline.contains(middle) {
            return;
        }
        let Some((centre, radius)) = circumcircle(pa, pb, pc) else {
            return;
        };
        let target = self.size.at(middle);
        let (shortest, opposite) = [
            (pb.distance(pc), a),
            (pc.distance(pa), b),
            (pa.distance(pb), c),
        ]
        .into_iter()
        .min_by(|x, y| x.0.total_cmp(&y.0))
        .expect("three edges");
        let large = radius > LARGEST_RADIUS * target;
        // In a sharp corner of the shape itself a pointed triangle cannot be avoided.
        let pointed = radius > POINTED * shortest
            && !self.sharp[opposite as usize]
            && radius > FLOOR * target;
        if !(large || pointed) {
            return;
        }
        let in_the_way = self.edges_in_the_way(start.fix(), centre);
        if in_the_way.is_empty() {
            if self.outline.contains(centre) {
                let v = self.insert(centre, a);
                self.look_around(v);
            }
            return;
        }
        let mut any = false;
        for [a, b] in in_the_way {
            any |= self.cut(a, b);
        }
        if any {
            self.faces.push_back([a, b, c]);
        }
    }

    /// Forced edges that have `p` within their circle or hide it: those around the faces whose
    /// circumcircle holds it.
    fn edges_in_the_way(
        &self,
        start: spade::handles::FixedDirectedEdgeHandle,
        p: DVec2,
    ) -> Vec<[u32; 2]> {
        let mut found = Vec::new();
        let first = self.cdt.directed_edge(start).face().fix();
        let mut seen = vec![first];
        let mut walk = vec![first];
        while let Some(face) = walk.pop() {
            let Some(face) = self.cdt.face(face).as_inner() else {
                continue;
            };
            for edge in face.adjacent_edges() {
                let [from, to] = [edge.from(), edge.to()].map(|v| place(v.position()));
                if edge.is_constraint_edge() {
                    let hidden = (to - from).perp_dot(p - from) <= 0.0;
                    if hidden || (from - p).dot(to - p) < 0.0 {
                        found.push([edge.from(), edge.to()].map(|v| v.fix().index() as u32));
                    }
                    continue;
                }
                let beyond = edge.rev().face();
                let holds = beyond.as_inner().is_some_and(|beyond| {
                    let [a, b, c] = beyond.vertices().map(|v| place(v.position()));
                    circumcircle(a, b, c).is_none_or(|(centre, radius)| centre.distance(p) < radius)
                });
                if holds && !seen.contains(&beyond.fix()) {
                    seen.push(beyond.fix());
                    walk.push(beyond.fix());
                }
            }
        }
        found
    }
}

fn place(p: Point2<f64>) -> DVec2 {
    DVec2::new(p.x, p.y)
}

fn handle(v: u32) -> FixedVertexHandle {
    FixedVertexHandle::from_index(v as usize)
}

/// The power of two that is nearest to half of `length` (within a third and two thirds of it).
fn shell(length: f64) -> f64 {
    let exponent = libm::floor(libm::log2(length * (2.0 / 3.0)));
    libm::exp2(exponent)
}

/// Centre and radius of the circle through three points; `None` if they are on a line.
fn circumcircle(a: DVec2, b: DVec2, c: DVec2) -> Option<(DVec2, f64)> {
    let (ab, ac) = (b - a, c - a);
    let doubled = 2.0 * ab.perp_dot(ac);
    let offset = (ac.perp() * -ab.length_squared() + ab.perp() * ac.length_squared()) / doubled;
    offset.is_finite().then(|| (a + offset, offset.length()))
}

/// Whether two forced edges meet at a vertex at less than 60°.
fn is_sharp(cdt: &Cdt, vertex: usize) -> bool {
    let vertex = cdt.vertex(FixedVertexHandle::from_index(vertex));
    let at = place(vertex.position());
    let arms: Vec<DVec2> = vertex
        .out_edges()
        .filter(|edge| edge.is_constraint_edge())
        .map(|edge| (place(edge.to().position()) - at).normalize())
        .collect();
    (0..arms.len()).any(|i| (0..i).any(|j| arms[i].dot(arms[j]) > SHARP_COSINE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circumcircle_goes_through_all_three_points() {
        let [a, b, c] = [(0.3, -1.0), (2.0, 0.5), (-0.4, 1.9)].map(DVec2::from);
        let (centre, radius) = circumcircle(a, b, c).expect("not on a line");
        for p in [a, b, c] {
            assert!((centre.distance(p) - radius).abs() < 1e-12);
        }
        assert_eq!(circumcircle(DVec2::ZERO, DVec2::X, DVec2::X * 2.0), None);
    }

    #[test]
    fn a_shell_leaves_at_least_a_third_on_both_sides() {
        for step in 1..2000 {
            let length = 0.01 * f64::from(step);
            let share = shell(length) / length;
            assert!(share > 0.333_33 && share < 0.666_67, "{length}: {share}");
        }
    }
}
