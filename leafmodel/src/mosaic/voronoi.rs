//! Cells as polygons: each face cut into the parts that lie nearest to each cell.
//!
//! Distances are measured in the plane into which a face's surroundings unfold ([`super::patch`]),
//! never through space. Within a face the tessellation is exact. On curved surfaces two faces may
//! unfold a far cell slightly differently, so that a border is offset at their common edge. Faces
//! far from all cells (in blocked areas) do not search themselves but take the cells found by
//! neighbours that are nearer to cells.
//!
//! - **In**: a [`Surface`] and the places of the cells.
//! - **Out**: convex pieces of faces with the cell they belong to and the cells beside them, areas,
//!   neighbours.
//! - **Always true**: the pieces of a face fill it and do not overlap; every cell that does not
//!   coincide with another has an area above 0.
//! - **Left out**: parts of a surface from which no cell can be reached stay empty.

#[cfg(test)]
pub(in crate::mosaic) mod tests;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::patch::PatchFinder;
use super::surface::{Surface, SurfacePoint};
use crate::plane::polygon;
use crate::plane::segment::Line;

/// Marks an edge of the face itself, with no cell beyond.
pub const FACE_EDGE: u32 = u32::MAX;
/// First search radius, in mean distances between cells.
const FIRST_RADIUS: f64 = 2.0;
/// Faces without any cell within this radius, in the same unit, use their neighbours' cells.
const FAR_RADIUS: f64 = 4.0;
/// Number of faces processed together.
const CHUNK: usize = 256;
/// Cells that are sorted by distance at first; hardly any piece needs more.
const FIRST_SORTED: usize = 24;

/// The part of a face that lies nearest to one cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The cell.
    pub cell: u32,
    /// Corners in the face's frame, mm, anticlockwise.
    pub corners: Vec<DVec2>,
    /// The cell across the edge from each corner to the next, or [`FACE_EDGE`].
    pub beside: Vec<u32>,
}

impl Piece {
    /// Its area, mm².
    pub fn area(&self) -> f64 {
        polygon::signed_area(&self.corners)
    }

    /// Its edges: both ends and the cell across.
    pub fn edges(&self) -> impl Iterator<Item = (DVec2, DVec2, u32)> + '_ {
        let count = self.corners.len();
        (0..count).map(move |k| {
            (
                self.corners[k],
                self.corners[(k + 1) % count],
                self.beside[k],
            )
        })
    }
}

/// A polygon in space that belongs to a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellPolygon {
    /// The cell.
    pub cell: u32,
    /// The face that it is part of.
    pub face: u32,
    /// Corners, mm, anticlockwise seen from outside.
    pub corners: Vec<DVec3>,
}

/// One face: its pieces, and the cells that can be nearest to points of it, in its frame.
#[derive(Clone, Debug, Default)]
struct Cut {
    pieces: Vec<Piece>,
    near: Vec<(u32, DVec2)>,
}

/// The Voronoi tessellation of a surface by its cells.
#[derive(Clone, Debug)]
pub struct Voronoi {
    cuts: Vec<Cut>,
    areas: Vec<f64>,
    /// For each cell its neighbours by rising number, with the length of the common border, mm.
    neighbours: Vec<Vec<(u32, f64)>>,
}

impl Voronoi {
    /// Tessellates a surface by cells at these places. Without cells all faces are empty.
    pub fn new(surface: &Surface, sites: &[SurfacePoint]) -> Self {
        let in_face = by_face(surface, sites);
        let spacing = (surface.total_area() / sites.len().max(1) as f64).sqrt();
        let mut found: Vec<Vec<(u32, DVec2)>> = if sites.is_empty() {
            vec![Vec::new(); in_face.len()]
        } else {
            let faces: Vec<u32> = (0..in_face.len() as u32).collect();
            let search = |chunk: &[u32]| {
                let mut finder = PatchFinder::new(surface);
                let near = |&face: &u32| near(surface, &mut finder, &in_face, face, spacing);
                chunk.iter().map(near).collect::<Vec<_>>()
            };
            faces.par_chunks(CHUNK).flat_map_iter(search).collect()
        };
        far(surface, &mut found);
        let cuts: Vec<Cut> = found
            .into_par_iter()
            .enumerate()
            .map(|(face, near)| cut_face(surface, face as u32, near))
            .collect();
        let mut areas = vec![0.0; sites.len()];
        let mut borders = Vec::new();
        for piece in cuts.iter().flat_map(|cut| &cut.pieces) {
            areas[piece.cell as usize] += piece.area();
            for (from, to, beside) in piece.edges() {
                if beside != FACE_EDGE {
                    borders.push((piece.cell, beside, from.distance(to)));
                }
            }
        }
        borders.sort_by_key(|&(cell, beside, _)| (cell, beside));
        let mut neighbours: Vec<Vec<(u32, f64)>> = vec![Vec::new(); sites.len()];
        for (cell, beside, length) in borders {
            let list = &mut neighbours[cell as usize];
            match list.last_mut() {
                Some((last, sum)) if *last == beside => *sum += length,
                Some(_) | None => list.push((beside, length)),
            }
        }
        Self {
            cuts,
            areas,
            neighbours,
        }
    }

    /// The pieces of a face.
    pub fn pieces(&self, face: u32) -> &[Piece] {
        &self.cuts[face as usize].pieces
    }

    /// Area of each cell, mm².
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// The cells that share a border with a cell by rising number, and the border's length, mm.
    pub fn neighbours(&self, cell: u32) -> &[(u32, f64)] {
        &self.neighbours[cell as usize]
    }

    /// The cell nearest to a place of a face's frame (mm); `None` where no cell can be reached.
    pub fn nearest(&self, face: u32, flat: DVec2) -> Option<u32> {
        let near = &self.cuts[face as usize].near;
        let mut best = None;
        let mut least = f64::INFINITY;
        for &(cell, at) in near {
            let distance = at.distance_squared(flat);
            if distance < least {
                least = distance;
                best = Some(cell);
            }
        }
        best
    }

    /// All pieces as polygons in space, face by face.
    pub fn polygons<'a>(&'a self, surface: &'a Surface) -> impl Iterator<Item = CellPolygon> + 'a {
        self.cuts.iter().zip(0..).flat_map(move |(cut, face)| {
            cut.pieces.iter().map(move |piece| CellPolygon {
                cell: piece.cell,
                face,
                corners: piece
                    .corners
                    .iter()
                    .map(|&corner| surface.position(&surface.point(face, corner)))
                    .collect(),
            })
        })
    }
}

/// For each face the cells in it, in its frame.
fn by_face(surface: &Surface, sites: &[SurfacePoint]) -> Vec<Vec<(u32, DVec2)>> {
    let mut in_face = vec![Vec::new(); surface.faces().len()];
    for (site, number) in sites.iter().zip(0..) {
        in_face[site.face as usize].push((number, surface.flat(site)));
    }
    in_face
}

/// The cells that can be nearest to a point of a face; none if all cells are far away.
fn near(
    surface: &Surface,
    finder: &mut PatchFinder,
    in_face: &[Vec<(u32, DVec2)>],
    face: u32,
    spacing: f64,
) -> Vec<(u32, DVec2)> {
    let triangle = surface.corners(face);
    let mut within = |radius: f64| {
        let mut found: Vec<(u32, DVec2)> = Vec::new();
        for (other, unfold) in finder.patch(face, radius).faces() {
            let cells = in_face[*other as usize].iter();
            found.extend(cells.map(|&(cell, at)| (cell, unfold.apply(at))));
        }
        let bound = bound(&triangle, &found);
        (found, bound)
    };
    let mut radius = FIRST_RADIUS * spacing;
    let (mut found, mut bound) = within(radius);
    if found.is_empty() {
        radius = FAR_RADIUS * spacing;
        (found, bound) = within(radius);
    }
    if bound > radius && bound.is_finite() {
        (found, bound) = within(bound);
    }
    keep_within(&triangle, bound, &mut found);
    found
}

/// An upper bound of the distance from any point of the face to its nearest cell.
fn bound(triangle: &[DVec2; 3], found: &[(u32, DVec2)]) -> f64 {
    let farthest = found.iter().map(|(_, at)| {
        let far = triangle.map(|corner| corner.distance_squared(*at));
        far[0].max(far[1]).max(far[2])
    });
    farthest.fold(f64::INFINITY, f64::min).sqrt()
}

/// Drops the cells that are nearest to no point of the face.
fn keep_within(triangle: &[DVec2; 3], bound: f64, found: &mut Vec<(u32, DVec2)>) {
    let slack = bound * (1.0 + 1e-9);
    found.retain(|(_, at)| distance_to_triangle(triangle, *at) <= slack);
    found.sort_by_key(|(cell, _)| *cell);
}

/// Gives faces without cells those of their neighbours, starting with faces nearest to cells.
fn far(surface: &Surface, found: &mut [Vec<(u32, DVec2)>]) {
    let mut next: Vec<u32> = (0..found.len() as u32).collect();
    loop {
        next.retain(|&face| found[face as usize].is_empty());
        let mut ring = Vec::new();
        for &face in &next {
            let triangle = surface.corners(face);
            let centre = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
            let mut taken: Vec<(u32, DVec2)> = Vec::new();
            for edge in 0..3 {
                let beyond = surface
                    .neighbour(face, edge)
                    .zip(surface.unfold(face, edge));
                let Some((neighbour, unfold)) = beyond else {
                    continue;
                };
                let cells = found[neighbour as usize].iter();
                taken.extend(cells.map(|&(cell, at)| (cell, unfold.apply(at))));
            }
            if taken.is_empty() {
                continue;
            }
            // A cell may have different places over different neighbours; the nearest is kept.
            taken.sort_by(|a, b| {
                let to = |at: DVec2| at.distance_squared(centre);
                a.0.cmp(&b.0).then(to(a.1).total_cmp(&to(b.1)))
            });
            taken.dedup_by_key(|(cell, _)| *cell);
            keep_within(&triangle, bound(&triangle, &taken), &mut taken);
            ring.push((face, taken));
        }
        if ring.is_empty() {
            return;
        }
        // The next faces to fill are neighbours of those just filled.
        next.clear();
        for (face, taken) in ring {
            found[face as usize] = taken;
            next.extend((0..3).filter_map(|edge| surface.neighbour(face, edge)));
        }
        next.sort_unstable();
        next.dedup();
    }
}

/// Distance of a point to a triangle, 0 inside.
pub(super) fn distance_to_triangle(corners: &[DVec2; 3], p: DVec2) -> f64 {
    let inside =
        (0..3).all(|k| (corners[(k + 1) % 3] - corners[k]).perp_dot(p - corners[k]) >= 0.0);
    if inside {
        return 0.0;
    }
    (0..3)
        .map(|k| Line::new([corners[k], corners[(k + 1) % 3]]).distance(p))
        .fold(f64::INFINITY, f64::min)
}

/// Cuts a face by the bisectors between the cells near it.
fn cut_face(surface: &Surface, face: u32, near: Vec<(u32, DVec2)>) -> Cut {
    let triangle = surface.corners(face);
    let mut pieces = Vec::new();
    let mut others = Vec::with_capacity(near.len());
    let mut polygon: Vec<(DVec2, u32)> = Vec::with_capacity(12);
    let mut spare = Vec::with_capacity(12);
    for &(cell, at) in &near {
        others.clear();
        others.extend(
            near.iter()
                .map(|&(other, place)| (place.distance_squared(at), other, place)),
        );
        let mut sorted = 0;
        polygon.clear();
        polygon.extend(triangle.map(|p| (p, FACE_EDGE)));
        for i in 0..others.len() {
            // The nearest cells come first, since they cut away most. Few are needed, so no more are sorted.
            if i == sorted {
                let more = sorted.max(FIRST_SORTED);
                sort_first(&mut others[sorted..], more);
                sorted += more;
            }
            let (distance, other, place) = others[i];
            if other == cell {
                continue;
            }
            if place == at {
                // Of coinciding cells the first one gets the whole polygon.
                if other < cell {
                    polygon.clear();
                }
                continue;
            }
            // The remaining cells are no nearer; beyond twice the distance to the farthest corner
            // none can cut.
            let furthest = polygon
                .iter()
                .map(|(p, _)| p.distance_squared(at))
                .fold(0.0, f64::max);
            if distance > 4.0 * furthest * (1.0 + 1e-9) {
                break;
            }
            clip(&polygon, at, place, other, &mut spare);
            std::mem::swap(&mut polygon, &mut spare);
            if polygon.is_empty() {
                break;
            }
        }
        if polygon.len() >= 3 {
            let (corners, beside) = polygon.iter().copied().unzip();
            let piece = Piece {
                cell,
                corners,
                beside,
            };
            if piece.area() > 0.0 {
                pieces.push(piece);
            }
        }
    }
    Cut { pieces, near }
}

/// Brings the nearest `count` cells to the front, sorted by distance and number.
fn sort_first(others: &mut [(f64, u32, DVec2)], count: usize) {
    let order =
        |a: &(f64, u32, DVec2), b: &(f64, u32, DVec2)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if count < others.len() {
        others.select_nth_unstable_by(count, order);
    }
    let first = count.min(others.len());
    others[..first].sort_unstable_by(order);
}

/// The part of a polygon that is at least as near to `at` as to `other`; new edges are tagged.
fn clip(polygon: &[(DVec2, u32)], at: DVec2, other: DVec2, tag: u32, kept: &mut Vec<(DVec2, u32)>) {
    kept.clear();
    let normal = other - at;
    let middle = at.midpoint(other);
    let beyond = |p: DVec2| (p - middle).dot(normal);
    for (k, &(p, edge)) in polygon.iter().enumerate() {
        let (q, _) = polygon[(k + 1) % polygon.len()];
        let (sp, sq) = (beyond(p), beyond(q));
        let crossing = || p + (q - p) * (sp / (sp - sq));
        if sp <= 0.0 {
            kept.push((p, edge));
            if sq > 0.0 {
                kept.push((crossing(), tag));
            }
        } else if sq <= 0.0 {
            kept.push((crossing(), edge));
        }
    }
}
