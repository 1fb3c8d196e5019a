//! Closed polygons: sides, areas, what lies inside, and convex hulls.

use glam::DVec2;

use super::points::turn;
use super::segment;

/// The sides of a closed polygon, from each corner to the next.
#[inline]
pub fn sides(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + Clone + '_ {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| (*a, *b))
}

/// Area, positive when the corners run counter-clockwise (shoelace formula about the first).
#[inline]
pub fn signed_area(corners: &[DVec2]) -> f64 {
    let doubled: f64 = corners
        .windows(2)
        .map(|side| turn(corners[0], side[0], side[1]))
        .sum();
    0.5 * doubled
}

/// Length around.
#[inline]
pub fn perimeter(corners: &[DVec2]) -> f64 {
    sides(corners).map(|(a, b)| a.distance(b)).sum()
}

/// Whether `p` lies inside, by the even–odd rule along the ray towards +x.
#[inline]
pub fn contains(corners: &[DVec2], p: DVec2) -> bool {
    sides(corners).filter(|&side| is_right_of(side, p)).count() % 2 == 1
}

/// Whether the ray from `p` towards +x meets a side. A side holds its lower end and not its upper.
pub(super) fn is_right_of((a, b): (DVec2, DVec2), p: DVec2) -> bool {
    (a.y > p.y) != (b.y > p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x
}

/// Whether the segment from `from` to `to` crosses a side, both in their interiors.
#[inline]
pub fn is_crossed_by(corners: &[DVec2], from: DVec2, to: DVec2) -> bool {
    sides(corners).any(|(a, b)| segment::cross(a, b, from, to))
}

/// A place on a polygon.
pub struct Place {
    /// The side from this corner.
    pub edge: usize,
    /// Where on it, 0 to 1.
    pub along: f64,
    /// Where it is.
    pub at: DVec2,
}

/// The place on a polygon that is nearest to `p`; the first of several.
#[inline]
pub fn nearest(corners: &[DVec2], p: DVec2) -> Place {
    let mut best = Place {
        edge: 0,
        along: 0.0,
        at: corners.first().copied().unwrap_or(p),
    };
    for (edge, (a, b)) in sides(corners).enumerate() {
        let along = segment::share(a, b, p);
        let at = a + (b - a) * along;
        if at.distance_squared(p) < best.at.distance_squared(p) {
            best = Place { edge, along, at };
        }
    }
    best
}

/// The smallest convex polygon around points, counter-clockwise (monotone chains).
#[inline]
pub fn hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    let mut hull = chain(sorted.iter().copied());
    hull.extend(chain(sorted.iter().rev().copied()));
    hull
}

/// Half of the hull of points sorted in one direction, without its last point, which starts the
/// other half.
fn chain(points: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut hull: Vec<DVec2> = Vec::new();
    for p in points {
        while let [.., a, b] = hull[..] {
            if turn(a, b, p) > 0.0 {
                break;
            }
            hull.pop();
        }
        hull.push(p);
    }
    hull.pop();
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points<const N: usize>(points: [(f64, f64); N]) -> [DVec2; N] {
        points.map(DVec2::from)
    }

    #[test]
    fn an_angle_has_its_area_its_inside_and_its_hull() {
        let angle = points([
            (0.0, 0.0),
            (3.0, 0.0),
            (3.0, 1.0),
            (1.0, 1.0),
            (1.0, 3.0),
            (0.0, 3.0),
        ]);
        assert_eq!(signed_area(&angle), 5.0);
        assert_eq!(perimeter(&angle), 12.0);
        assert!(contains(&angle, DVec2::new(0.5, 2.0)));
        assert!(!contains(&angle, DVec2::new(2.0, 2.0)));
        assert!(is_crossed_by(
            &angle,
            DVec2::new(0.5, 2.0),
            DVec2::splat(2.0)
        ));
        let corners = points([(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 3.0), (0.0, 3.0)]);
        assert_eq!(hull(&angle), corners);
        let place = nearest(&angle, DVec2::new(2.0, 1.5));
        assert_eq!(
            (place.edge, place.along, place.at),
            (2, 0.5, DVec2::new(2.0, 1.0))
        );
    }
}
