//! Crossings of two line segments in the plane, and the nearest place on a closed line of them.

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

/// A place on a closed line.
pub(crate) struct Place {
    /// The edge from this point of the line.
    pub(crate) edge: usize,
    /// Where on it, 0 to 1.
    pub(crate) along: f64,
    pub(crate) at: DVec2,
}

/// The place on a closed line that is nearest to `p`; the first of several.
pub(crate) fn nearest_on_closed(points: &[DVec2], p: DVec2) -> Place {
    let mut best = Place {
        edge: 0,
        along: 0.0,
        at: points.first().copied().unwrap_or(p),
    };
    for (edge, &start) in points.iter().enumerate() {
        let way = points[(edge + 1) % points.len()] - start;
        let along = ((p - start).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        let at = if along == 1.0 {
            start + way
        } else {
            start + way * along
        };
        if (at - p).length_squared() < (best.at - p).length_squared() {
            best = Place { edge, along, at };
        }
    }
    best
}
