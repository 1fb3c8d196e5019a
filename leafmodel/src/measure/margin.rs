//! Extents of the blade along and across its midrib, and its convex hull.

use glam::DVec2;

use crate::plane::polygon;
use crate::shape::outline::Outline;

/// Widths that differ by less than this share, which is rounding, count as equal.
const EQUALLY_WIDE: f64 = 1e-9;

/// Extents of a margin in the frame of its midrib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    /// Lowest and highest point of the margin along the midrib, mm from the base.
    pub(super) along: (f64, f64),
    /// Greatest width: the largest distance across the midrib between two points of the margin at
    /// the same height, mm.
    pub(super) width: f64,
    /// Height of the greatest width, mm from the base; of several, the middle between the lowest
    /// and the highest.
    pub(super) widest: f64,
}

/// Measures a margin across and along its midrib. Between two corners neighbouring in height both
/// edges of the blade are straight, so that it is widest at the height of a corner.
pub(super) fn extent(outline: &Outline) -> Extent {
    let midrib = (outline.apex() - outline.base()) / outline.length();
    let in_frame = |p: &DVec2| {
        let p = *p - outline.base();
        DVec2::new(-midrib.perp_dot(p), midrib.dot(p))
    };
    let points: Vec<DVec2> = outline.points().iter().map(in_frame).collect();
    let mut edges: Vec<(DVec2, DVec2)> = polygon::sides(&points)
        .map(|(a, b)| if a.y <= b.y { (a, b) } else { (b, a) })
        .collect();
    edges.sort_by(|p, q| p.0.y.total_cmp(&q.0.y));
    let mut heights: Vec<f64> = points.iter().map(|p| p.y).collect();
    heights.sort_by(f64::total_cmp);
    let (mut open, mut next) = (Vec::new(), 0);
    let mut widths: Vec<(f64, f64)> = Vec::with_capacity(heights.len());
    for &height in &heights {
        while let Some(&edge) = edges.get(next).filter(|edge| edge.0.y <= height) {
            open.push(edge);
            next += 1;
        }
        open.retain(|edge| edge.1.y >= height);
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        for (low, high) in &open {
            if low.y < high.y {
                let x = low.x + (high.x - low.x) * ((height - low.y) / (high.y - low.y));
                (left, right) = (left.min(x), right.max(x));
            } else {
                (left, right) = (left.min(low.x).min(high.x), right.max(low.x).max(high.x));
            }
        }
        widths.push((height, right - left));
    }
    let width = widths.iter().map(|w| w.1).fold(0.0, f64::max);
    let mut widest = widths
        .iter()
        .filter(|w| w.1 >= width * (1.0 - EQUALLY_WIDE))
        .map(|w| w.0);
    let lowest = widest.next().unwrap_or(0.0);
    Extent {
        along: (heights[0], heights[heights.len() - 1]),
        width,
        widest: 0.5 * (lowest + widest.next_back().unwrap_or(lowest)),
    }
}

/// Area of the smallest convex polygon around the margin, mm², > 0.
pub(super) fn hull_area(outline: &Outline) -> f64 {
    polygon::signed_area(&polygon::hull(outline.points()))
}

/// Length around the smallest convex polygon around the margin, mm, > 0.
pub(super) fn hull_perimeter(outline: &Outline) -> f64 {
    polygon::perimeter(&polygon::hull(outline.points()))
}
