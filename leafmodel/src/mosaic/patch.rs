//! The neighbourhood of a face, unfolded into the face's plane.
//!
//! Faces are laid beside one another like an unfolded paper model. Distances in that plane equal
//! those along the surface if the straight line between the two points stays in the unfolded faces.
//! On developable surfaces they are exact. Near a vertex at which the surface is curved a face can
//! be reached around either side; the shorter way is used.
//!
//! - **In**: a [`Surface`], a face, and a radius.
//! - **Out**: a [`Patch`]: the faces within that radius, each with the motion that unfolds it.
//! - **Always true**: no face occurs twice; a face comes after one that it touches; the first is
//!   the face itself.

#[cfg(test)]
mod tests;

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::surface::{Surface, Unfold};
use crate::plane::segment::Line;

/// The faces near a face, unfolded into its plane.
#[derive(Clone, Debug)]
pub struct Patch {
    faces: Vec<(u32, Unfold)>,
}

impl Patch {
    /// The face in whose frame the others lie.
    #[cfg(test)]
    pub(super) fn base(&self) -> u32 {
        self.faces[0].0
    }

    /// The faces that can hold points within the radius of any point of the base, by rising
    /// distance, the base first, each with the motion from its frame to that of the base.
    pub fn faces(&self) -> &[(u32, Unfold)] {
        &self.faces
    }

    /// The motion from the frame of a face to that of the base; `None` if the face is not in the
    /// patch. A linear search.
    #[cfg(test)]
    pub(super) fn unfold(&self, face: u32) -> Option<Unfold> {
        let found = self.faces.iter().find(|(other, _)| *other == face);
        found.map(|(_, unfold)| *unfold)
    }
}

/// Finds patches of one surface. It should be reused, since its working memory is as large as the
/// surface.
#[derive(Debug)]
pub struct PatchFinder<'a> {
    surface: &'a Surface,
    /// The number of the search in which a face was last reached.
    reached: Vec<u32>,
    search: u32,
    queue: BinaryHeap<Entry>,
}

/// The region from which distances in a patch are measured.
#[derive(Clone, Copy)]
enum Hub {
    /// The base, a triangle.
    Face([DVec2; 3]),
    /// A disc in the base's plane.
    Disc(DVec2, f64),
}

/// An entry of the queue of faces to be laid out.
#[derive(Debug)]
struct Entry {
    distance: f64,
    /// Distance to the middle of the edge over which it is entered, which decides between faces
    /// around a vertex that are equally near.
    middle: f64,
    face: u32,
    /// The edge of the face over which it is entered; 3 for the base.
    edge: u8,
    unfold: Unfold,
}

impl Ord for Entry {
    /// The order is reversed, since the queue returns the greatest entry.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_distance = other.distance.total_cmp(&self.distance);
        let by_middle = other.middle.total_cmp(&self.middle);
        by_distance.then(by_middle).then(other.face.cmp(&self.face))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl<'a> PatchFinder<'a> {
    /// A finder for patches of a surface.
    pub fn new(surface: &'a Surface) -> Self {
        Self {
            surface,
            reached: vec![0; surface.faces().len()],
            search: 0,
            queue: BinaryHeap::new(),
        }
    }

    /// The patch of a face: every face that can hold points within `radius_mm` of any of its
    /// points.
    pub fn patch(&mut self, face: u32, radius_mm: f64) -> Patch {
        let hub = Hub::Face(self.surface.corners(face));
        self.search(face, hub, radius_mm)
    }

    /// The faces that can hold points within `radius_mm` of the disc of `hub_mm` about the middle
    /// of a face.
    pub(crate) fn patch_of_disc(&mut self, face: u32, hub_mm: f64, radius_mm: f64) -> Patch {
        let centre = self.surface.flat(&self.surface.centre(face));
        self.search(face, Hub::Disc(centre, hub_mm), radius_mm)
    }

    fn search(&mut self, base: u32, hub: Hub, radius_mm: f64) -> Patch {
        self.search += 1;
        self.queue.clear();
        self.queue.push(Entry {
            distance: 0.0,
            middle: 0.0,
            face: base,
            edge: 3,
            unfold: Unfold::IDENTITY,
        });
        let mut faces = Vec::new();
        while let Some(entry) = self.queue.pop() {
            let reached = &mut self.reached[entry.face as usize];
            if *reached == self.search {
                continue;
            }
            *reached = self.search;
            faces.push((entry.face, entry.unfold));
            self.neighbours_of(&entry, hub, radius_mm);
        }
        Patch { faces }
    }

    fn neighbours_of(&mut self, entry: &Entry, hub: Hub, radius_mm: f64) {
        let corners = self
            .surface
            .corners(entry.face)
            .map(|corner| entry.unfold.apply(corner));
        for edge in 0..3 {
            if edge == usize::from(entry.edge) {
                continue;
            }
            let Some(face) = self.surface.neighbour(entry.face, edge) else {
                continue;
            };
            if self.reached[face as usize] == self.search {
                continue;
            }
            let (a, b) = (corners[edge], corners[(edge + 1) % 3]);
            let distance = hub.distance(a, b).max(entry.distance);
            if distance > radius_mm {
                continue;
            }
            let hinge = self.surface.unfold(entry.face, edge);
            let theirs = self.surface.neighbour_edge(entry.face, edge);
            let (Some(hinge), Some(theirs)) = (hinge, theirs) else {
                continue;
            };
            self.queue.push(Entry {
                distance,
                middle: hub.middle().distance_squared(0.5 * (a + b)),
                face,
                edge: theirs as u8,
                unfold: entry.unfold.after(&hinge),
            });
        }
    }
}

impl Hub {
    fn middle(&self) -> DVec2 {
        match *self {
            Self::Face([a, b, c]) => (a + b + c) / 3.0,
            Self::Disc(centre, _) => centre,
        }
    }

    /// Distance to an edge.
    fn distance(&self, a: DVec2, b: DVec2) -> f64 {
        match *self {
            Self::Face(corners) => {
                let mut least = f64::INFINITY;
                for k in 0..3 {
                    let (p, q) = (corners[k], corners[(k + 1) % 3]);
                    let (edge, side) = (Line::new([a, b]), Line::new([p, q]));
                    least = least.min(edge.distance_squared(p));
                    least = least
                        .min(side.distance_squared(a))
                        .min(side.distance_squared(b));
                }
                least.sqrt()
            }
            Self::Disc(centre, radius) => (Line::new([a, b]).distance(centre) - radius).max(0.0),
        }
    }
}
