//! From cells to tissue: the weights of cell types at a place, blended across borders between
//! different types.
//!
//! Inside a patch of one type its weight is 1. Across a border between cells of different types the
//! weights change smoothly over a given width. Borders between cells of the same type have no
//! effect.
//!
//! - **In**: a surface, cells with their types, the width over which types blend.
//! - **Out**: weights of the types at any point, and the contents of the tissue there.
//! - **Always true**: weights are in [0, 1] and add up to 1; they change continuously within a
//!   face.
//! - **Left out**: any mixing other than linear in contents per area. Linear mixing holds for
//!   pigments of neighbouring cells in one light path.

pub mod sheet;
#[cfg(test)]
mod tests;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec2;
use rayon::prelude::*;

use super::control::{Controls, CylinderControl};
use super::patch::PatchFinder;
use super::simulation::Mosaic;
use super::surface::{Surface, SurfacePoint};
use super::voronoi::{FACE_EDGE, Voronoi};
use crate::not_grown::{NotGrown, not_grown};
use crate::numeric::smooth_step;
use crate::optics::{Contents, PerConstituent};
use crate::plane::segment::Line;

/// Number of faces processed together.
const CHUNK: usize = 256;
/// Most faces that are laid out while borders are searched, which takes some two minutes of a
/// processor.
const MOST_LAID_OUT: u64 = 40_000_000;

/// First search radius for borders, in mean distances between cells.
const FIRST_RADIUS: f64 = 4.0;

/// A border between cells of different types, in the frame of a face.
#[derive(Clone, Copy, Debug)]
struct Border {
    from: DVec2,
    to: DVec2,
    kinds: [u16; 2],
}

/// The types of cells at every point of a surface.
#[derive(Clone, Debug)]
pub struct TypeField {
    voronoi: Voronoi,
    corners: Vec<[DVec2; 3]>,
    kinds: Vec<u16>,
    types: usize,
    half_blend: f64,
    /// For each face the borders within the blend's reach.
    borders: Vec<Vec<Border>>,
    /// Places blocked for cells, if any.
    bare: Option<Bare>,
}

/// Controls that block places for cells, and the surface of these places.
#[derive(Clone, Debug)]
struct Bare {
    surface: Arc<Surface>,
    controls: Vec<CylinderControl>,
}

impl TypeField {
    /// Cells at `sites` whose types (below `types`) are `kinds`, blended over `blend_mm` (0 for
    /// hard edges).
    ///
    /// The search is per face, so a mesh whose faces hold hundreds of cells should be subdivided
    /// first.
    ///
    /// # Panics
    ///
    /// If there are not as many kinds as sites, no site at all, or a kind is not below `types`.
    pub fn new(
        surface: &Surface,
        sites: &[SurfacePoint],
        kinds: &[u16],
        types: usize,
        blend_mm: f64,
    ) -> Self {
        assert!(!sites.is_empty(), "a mosaic has cells");
        assert_eq!(sites.len(), kinds.len(), "each cell has a kind");
        assert!(
            kinds.iter().all(|&kind| usize::from(kind) < types),
            "kinds count from 0"
        );
        let voronoi = Voronoi::new(surface, sites);
        Self::of_cells(surface, voronoi, kinds, types, blend_mm)
    }

    /// The cells of a mosaic of a plan with `types` types.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] if it takes minutes to find the borders that every face feels.
    ///
    /// # Panics
    ///
    /// If a cell's type is not below `types`.
    pub(crate) fn of_mosaic(
        mosaic: &Mosaic,
        types: usize,
        blend_mm: f64,
    ) -> Result<Self, NotGrown> {
        let sites: Vec<SurfacePoint> = mosaic.cells.iter().map(|cell| cell.at).collect();
        let kinds: Vec<u16> = mosaic.cells.iter().map(|cell| cell.kind).collect();
        let surface = &*mosaic.surface;
        let voronoi = Voronoi::new(surface, &sites);
        let field = Self::limited(surface, voronoi, &kinds, types, blend_mm, MOST_LAID_OUT);
        field.ok_or_else(|| {
            not_grown!(
                "types blend over {blend_mm} mm on a surface of {} faces, which takes more than \
                 two minutes: make `blend_mm` (of what is raised, `over_mm`) smaller, or the cells \
                 fewer",
                surface.faces().len()
            )
        })
    }

    /// The same from an existing tessellation.
    pub fn of_cells(
        surface: &Surface,
        voronoi: Voronoi,
        kinds: &[u16],
        types: usize,
        blend_mm: f64,
    ) -> Self {
        Self::limited(surface, voronoi, kinds, types, blend_mm, u64::MAX)
            .expect("no count is greater")
    }

    /// As [`TypeField::of_cells`]; `None` if more faces than `most` have to be laid out to find
    /// the borders that each face feels.
    fn limited(
        surface: &Surface,
        voronoi: Voronoi,
        kinds: &[u16],
        types: usize,
        blend_mm: f64,
        most: u64,
    ) -> Option<Self> {
        let count = surface.faces().len() as u32;
        let half_blend = 0.5 * blend_mm.max(0.0);
        let own: Vec<Vec<Border>> = (0..count)
            .map(|face| borders_in(&voronoi, kinds, face))
            .collect();
        let faces: Vec<u32> = (0..count).collect();
        let mut bordering: Vec<u16> = own.iter().flatten().flat_map(|own| own.kinds).collect();
        bordering.sort_unstable();
        bordering.dedup();
        // Cells of one type have no borders, however wide the blend: nothing is searched for them.
        let borders = if half_blend == 0.0 || bordering.is_empty() {
            vec![Vec::new(); faces.len()]
        } else {
            let spacing = (surface.total_area() / kinds.len() as f64).sqrt();
            let borders = Borders {
                surface,
                own: &own,
                bordering: &bordering,
                spacing,
                laid_out: AtomicU64::new(0),
                most,
            };
            let found: Option<Vec<Vec<Vec<Border>>>> = faces
                .par_chunks(CHUNK)
                .map(|chunk| {
                    let mut finder = PatchFinder::new(surface);
                    let felt = |&face: &u32| borders.felt(&mut finder, face, half_blend);
                    chunk.iter().map(felt).collect()
                })
                .collect();
            found?.into_iter().flatten().collect()
        };
        Some(Self {
            voronoi,
            corners: (0..count).map(|face| surface.corners(face)).collect(),
            kinds: kinds.to_vec(),
            types,
            half_blend,
            borders,
            bare: None,
        })
    }

    /// The same with controls applied: places that they block are bare.
    #[must_use]
    pub(crate) fn heeding(mut self, surface: Arc<Surface>, controls: &[CylinderControl]) -> Self {
        self.bare = Controls(controls).block().then(|| Bare {
            surface,
            controls: controls.to_vec(),
        });
        self
    }

    /// Whether any control may block places.
    pub(super) fn has_bare_places(&self) -> bool {
        self.bare.is_some()
    }

    /// Whether controls block a point. The tissue there is not part of the mosaic; the types
    /// reported for it are those of the nearest cells.
    pub fn is_bare(&self, point: &SurfacePoint) -> bool {
        self.bare.as_ref().is_some_and(|bare| {
            let at = bare.surface.position(point);
            Controls(&bare.controls).is_blocked(at)
        })
    }

    /// The tessellation.
    pub fn voronoi(&self) -> &Voronoi {
        &self.voronoi
    }

    /// Number of types.
    pub fn types(&self) -> usize {
        self.types
    }

    /// The type of the cell nearest to a point. On a part of the surface without any cell, type 0.
    pub fn kind(&self, point: &SurfacePoint) -> u16 {
        self.kind_at(point.face, self.flat(point))
    }

    fn kind_at(&self, face: u32, flat: DVec2) -> u16 {
        let cell = self.voronoi.nearest(face, flat);
        cell.map_or(0, |cell| self.kinds[cell as usize])
    }

    fn flat(&self, point: &SurfacePoint) -> DVec2 {
        let [a, b, c] = self.corners[point.face as usize];
        let [u, v, w] = point.barycentric;
        a * u + b * v + c * w
    }

    /// Weights of all types at a point, ≥ 0, sum 1, written to `weights` (one for each type).
    ///
    /// With `d` the distance to the nearest border of a type's patches and `b` the blend's width, a
    /// type beyond the border has `S(½ − d / b)` and the type of the place itself `S(½ + d / b)`,
    /// `S` the smooth step `3 t² − 2 t³`, clamped to 0 and 1. Where three types meet, weights are
    /// divided by their sum.
    ///
    /// # Panics
    ///
    /// If `weights` has another length than there are types.
    pub(crate) fn type_weights(&self, point: &SurfacePoint, weights: &mut [f64]) {
        assert_eq!(weights.len(), self.types, "a weight for each type");
        let flat = self.flat(point);
        let own = usize::from(self.kind_at(point.face, flat));
        let borders = &self.borders[point.face as usize];
        if borders.is_empty() {
            weights.fill(0.0);
            weights[own] = 1.0;
            return;
        }
        weights.fill(f64::INFINITY);
        for border in borders {
            let distance = Line::new([border.from, border.to]).distance(flat);
            for kind in border.kinds {
                let least = &mut weights[usize::from(kind)];
                *least = least.min(distance);
            }
        }
        weights[own] = f64::INFINITY;
        let depth = weights.iter().copied().fold(f64::INFINITY, f64::min);
        let blend = 2.0 * self.half_blend;
        let mut sum = 0.0;
        for (kind, weight) in weights.iter_mut().enumerate() {
            *weight = if kind == own {
                smooth_step(0.5 + depth / blend)
            } else {
                smooth_step(0.5 - *weight / blend)
            };
            sum += *weight;
        }
        for weight in weights {
            *weight /= sum;
        }
    }

    /// Contents of the tissue at a point, with the contents `of_types` of each type; `weights` is a
    /// buffer.
    ///
    /// # Panics
    ///
    /// If there are not as many contents and weights as types.
    pub fn contents(
        &self,
        point: &SurfacePoint,
        of_types: &[Contents],
        weights: &mut [f64],
    ) -> Contents {
        assert_eq!(of_types.len(), self.types, "contents for each type");
        self.type_weights(point, weights);
        let mut sum = PerConstituent::splat(0.0);
        for (contents, &weight) in of_types.iter().zip(&*weights) {
            if weight > 0.0 {
                sum = sum.zip_with(contents.0, |sum, value| sum + weight * value);
            }
        }
        Contents(sum)
    }

    /// Contents at many points at once, on all threads; `None` for `None` and for bare places.
    ///
    /// # Panics
    ///
    /// If there are not as many contents as types.
    pub fn paint(
        &self,
        points: impl IndexedParallelIterator<Item = Option<SurfacePoint>>,
        of_types: &[Contents],
    ) -> Vec<Option<Contents>> {
        points
            .map_init(
                || vec![0.0; self.types],
                |weights, point| {
                    let point = point.filter(|point| !self.is_bare(point));
                    point.map(|point| self.contents(&point, of_types, weights))
                },
            )
            .collect()
    }
}

/// The borders between cells of different types within a face.
fn borders_in(voronoi: &Voronoi, kinds: &[u16], face: u32) -> Vec<Border> {
    let mut borders = Vec::new();
    for piece in voronoi.pieces(face) {
        for (from, to, beside) in piece.edges() {
            // Each border is found from both sides; that of the lower cell is kept.
            if beside == FACE_EDGE || beside < piece.cell {
                continue;
            }
            let pair = [kinds[piece.cell as usize], kinds[beside as usize]];
            if pair[0] != pair[1] {
                borders.push(Border {
                    from,
                    to,
                    kinds: pair,
                });
            }
        }
    }
    borders
}

/// What the borders that faces feel are found in.
struct Borders<'a> {
    surface: &'a Surface,
    /// For each face the borders within it.
    own: &'a [Vec<Border>],
    /// The types that have borders.
    bordering: &'a [u16],
    /// Mean distance between cells, mm.
    spacing: f64,
    /// Faces laid out so far, and how many may be.
    laid_out: AtomicU64,
    most: u64,
}

impl Borders<'_> {
    /// The borders within `reach` of a face that may be the nearest of one of their types at a point
    /// of it; `None` if too many faces have been laid out.
    fn felt(&self, finder: &mut PatchFinder, face: u32, reach: f64) -> Option<Vec<Border>> {
        let corners = self.surface.corners(face);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let size = corners.map(|corner| corner.distance(centre));
        let size = size[0].max(size[1]).max(size[2]);
        let mut radius = reach.min(FIRST_RADIUS * self.spacing);
        loop {
            let patch = finder.patch(face, radius);
            let laid_out = patch.faces().len() as u64;
            if self.laid_out.fetch_add(laid_out, Ordering::Relaxed) + laid_out > self.most {
                return None;
            }
            let mut borders = Vec::new();
            let mut nearest = vec![f64::INFINITY; self.bordering.len()];
            let places = |kinds: [u16; 2]| {
                kinds.map(|kind| self.bordering.partition_point(|&other| other < kind))
            };
            for (other, unfold) in patch.faces() {
                for border in &self.own[*other as usize] {
                    let (from, to) = (unfold.apply(border.from), unfold.apply(border.to));
                    let distance = Line::new([from, to]).distance(centre);
                    if distance <= reach + size {
                        for place in places(border.kinds) {
                            nearest[place] = nearest[place].min(distance);
                        }
                        borders.push((
                            distance,
                            Border {
                                from,
                                to,
                                kinds: border.kinds,
                            },
                        ));
                    }
                }
            }
            // Seen from any point of the face, nothing beyond is nearer than what was found.
            let farthest = nearest.iter().copied().fold(0.0, f64::max) + 2.0 * size;
            if radius < reach && farthest > radius {
                radius = reach.min(2.0 * radius);
                continue;
            }
            borders.retain(|(distance, border)| {
                places(border.kinds)
                    .iter()
                    .any(|&place| *distance <= nearest[place] + 2.0 * size)
            });
            return Some(borders.into_iter().map(|(_, border)| border).collect());
        }
    }
}
