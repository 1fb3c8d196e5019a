//! Geometry of the plane: segments, polylines, polygons and their indices.
//!
//! - **In**: points; a polygon is a list of corners, whose last is joined to the first.
//! - **Always true**: a degenerate segment, without length, acts as a point.
//! - **Left out**: surfaces in space, and trees over points that grow (`venation`).
//!
//! Where two formulas for one thing stay beside each other, they differ in the last bit, and grown
//! leaves depend on it.

pub mod distances;
mod first_crossing;
mod interior_grid;
mod lattice;
pub mod polygon;
pub mod polyline;
pub mod segment;
mod slabs;

use glam::DVec2;

pub use self::first_crossing::first_crossing;
pub use self::interior_grid::InteriorGrid;
pub use self::lattice::Lattice;
pub use self::slabs::Slabs;

/// Twice the signed area of a triangle: positive if it is counter-clockwise.
#[inline]
pub fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Lower left and upper right corner of the smallest upright rectangle around points; infinite and
/// the wrong way round without any.
#[inline]
pub fn bounds(points: impl IntoIterator<Item = DVec2>) -> (DVec2, DVec2) {
    let nothing = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let grown = |(low, high): (DVec2, DVec2), p| (low.min(p), high.max(p));
    points.into_iter().fold(nothing, grown)
}

/// Squared distance from `p` to the upright rectangle between these corners, 0 inside.
#[inline]
pub fn rectangle_distance_squared(low: DVec2, high: DVec2, p: DVec2) -> f64 {
    (low - p).max(p - high).max(DVec2::ZERO).length_squared()
}
