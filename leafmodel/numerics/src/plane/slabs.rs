//! Edges of a polygon by height: the index behind an outline's queries.
//!
//! The polygon's extent in y is cut into equal slabs, and each slab lists the edges that reach
//! into it. About `4 √n` slabs for `n` edges keep the lists short for ordinary margins (some
//! `√n / 4` edges) and the memory at `O(n √n)` even for a comb of long teeth.

use glam::DVec2;

use super::{polygon, segment};
use crate::buckets::Buckets;

/// For each horizontal slab of a closed polygon the edges that reach into it.
#[derive(Clone, Debug, PartialEq)]
pub struct Slabs {
    low: f64,
    per_height: f64,
    edges: Buckets,
}

impl Slabs {
    /// Sorts the edges of `points` (edge `i` from point `i` to the next) into slabs.
    #[inline]
    pub fn new(points: &[DVec2]) -> Self {
        let n = points.len();
        let (low, high) = points
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                (low.min(p.y), high.max(p.y))
            });
        let count = ((4.0 * (n as f64).sqrt()) as usize).clamp(1, 4096);
        let per_height = if high > low {
            count as f64 / (high - low)
        } else {
            0.0
        };
        let mut slabs = Self {
            low,
            per_height,
            edges: Buckets::new(count, std::iter::empty()),
        };
        let reached = (0..n).flat_map(|i| {
            let (a, b) = (slabs.at(points[i].y), slabs.at(points[(i + 1) % n].y));
            (a.min(b)..=a.max(b)).map(move |slab| (slab, i as u32))
        });
        slabs.edges = Buckets::new(count, reached);
        slabs
    }

    /// Number of slabs, ≥ 1.
    #[inline]
    pub fn count(&self) -> usize {
        self.edges.count()
    }

    /// The edges that reach into a slab, ascending.
    #[inline]
    pub fn edges(&self, slab: usize) -> &[u32] {
        self.edges.list(slab)
    }

    /// The slab of a height; heights outside the polygon give the first or last one. The map is
    /// monotone, so rounding cannot put a point and an edge at its height into different slabs.
    fn at(&self, y: f64) -> usize {
        let slab = (y - self.low) * self.per_height;
        // A float-to-integer cast saturates, so negative heights give 0.
        (slab as usize).min(self.count() - 1)
    }

    /// Even–odd rule along the ray from `p` towards +x.
    #[inline]
    pub fn contains(&self, points: &[DVec2], p: DVec2) -> bool {
        let sides = self.edges(self.at(p.y)).iter().map(|&i| ends(points, i));
        sides.filter(|&side| polygon::is_right_of(side, p)).count() % 2 == 1
    }

    /// Whether the segment from `a` to `b` crosses an edge, both in their interiors.
    #[inline]
    pub fn is_crossed_by(&self, points: &[DVec2], a: DVec2, b: DVec2) -> bool {
        let (one, other) = (self.at(a.y), self.at(b.y));
        self.edges
            .lists_of(one.min(other), one.max(other))
            .iter()
            .any(|&i| {
                let (c, d) = ends(points, i);
                segment::cross(a, b, c, d)
            })
    }

    /// Squared distance from `p` to the nearest edge.
    #[inline]
    pub fn distance_squared(&self, points: &[DVec2], p: DVec2) -> f64 {
        let home = self.at(p.y);
        let mut best = f64::INFINITY;
        for step in 0..self.count() {
            let (below, above) = (home.checked_sub(step), home + step);
            let mut open = false;
            for (slab, side) in [(below, -1.0), (Some(above), 1.0)] {
                let Some(slab) = slab.filter(|&slab| slab < self.count()) else {
                    continue;
                };
                if step == 0 && side > 0.0 {
                    continue;
                }
                if step > 0 && self.gap_squared(slab, side, p.y) >= best {
                    continue;
                }
                open = true;
                for &i in self.edges(slab) {
                    let (a, b) = ends(points, i);
                    best = best.min(segment::distance_squared(a, b, p));
                }
            }
            if !open {
                break;
            }
        }
        best
    }

    /// A lower bound of the squared distance from height `y` to a slab that lies below (`side` < 0)
    /// or above it. The bound is lowered by 10⁻⁹ of a slab's height, so that rounding never hides
    /// an edge.
    fn gap_squared(&self, slab: usize, side: f64, y: f64) -> f64 {
        if self.per_height == 0.0 {
            return 0.0;
        }
        let face = if side < 0.0 { slab + 1 } else { slab };
        let gap = (self.low + face as f64 / self.per_height - y) * side - 1e-9 / self.per_height;
        let gap = gap.max(0.0);
        gap * gap
    }
}

/// Both ends of edge `i` of a closed polygon.
fn ends(points: &[DVec2], i: u32) -> (DVec2, DVec2) {
    let i = i as usize;
    let next = if i + 1 == points.len() { 0 } else { i + 1 };
    (points[i], points[next])
}
