//! Formulas of a few points.

use glam::DVec2;

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
