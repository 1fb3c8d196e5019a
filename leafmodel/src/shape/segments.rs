//! Crossings of two line segments in the plane.

use glam::DVec2;

/// Twice the signed area of a triangle: positive if it is counter-clockwise.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Where the segments a–b and c–d cross in their interiors, as a share of each; `None` if they do
/// not.
pub(crate) fn crossing(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> Option<(f64, f64)> {
    let opposite = |p: f64, q: f64| (p > 0.0 && q < 0.0) || (p < 0.0 && q > 0.0);
    let (abc, abd) = (turn(a, b, c), turn(a, b, d));
    if !opposite(abc, abd) {
        return None;
    }
    let (cda, cdb) = (turn(c, d, a), turn(c, d, b));
    opposite(cda, cdb).then(|| (cda / (cda - cdb), abc / (abc - abd)))
}
