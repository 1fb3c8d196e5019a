//! Line segments: nearest points, distances and crossings.

use glam::DVec2;

use super::points::turn;

/// How far from `a` to `b` the point nearest to `p` lies, 0 to 1.
#[inline]
pub fn share(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let way = b - a;
    let squared = way.length_squared();
    if squared > 0.0 {
        ((p - a).dot(way) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// The point nearest to `p` on the segment from `a` to `b`.
#[inline]
pub fn nearest(a: DVec2, b: DVec2, p: DVec2) -> DVec2 {
    a + (b - a) * share(a, b, p)
}

/// Squared distance from `p` to the segment from `a` to `b`.
#[inline]
pub fn distance_squared(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    nearest(a, b, p).distance_squared(p)
}

/// Distance from `p` to the segment from `a` to `b`.
#[inline]
pub fn distance(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    distance_squared(a, b, p).sqrt()
}

/// A segment with what its distance to many points needs. Distances are those from its first end,
/// and may differ in the last bit from [`distance`].
#[derive(Clone, Copy, Debug)]
pub struct Line {
    from: DVec2,
    along: DVec2,
    length_squared: f64,
}

impl Line {
    /// The segment between two points.
    #[inline]
    pub fn new([from, to]: [DVec2; 2]) -> Self {
        let along = to - from;
        Self {
            from,
            along,
            length_squared: along.length_squared(),
        }
    }

    /// Squared distance of a point.
    #[inline]
    pub fn distance_squared(&self, p: DVec2) -> f64 {
        let offset = p - self.from;
        let share = if self.length_squared > 0.0 {
            (offset.dot(self.along) / self.length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (offset - share * self.along).length_squared()
    }

    /// Distance of a point.
    #[inline]
    pub fn distance(&self, p: DVec2) -> f64 {
        self.distance_squared(p).sqrt()
    }
}

/// Where the segments a–b and c–d cross in their interiors, as a share of each; `None` if they do
/// not.
#[inline]
pub fn crossing(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> Option<(f64, f64)> {
    let opposite = |p: f64, q: f64| (p > 0.0 && q < 0.0) || (p < 0.0 && q > 0.0);
    let (abc, abd) = (turn(a, b, c), turn(a, b, d));
    if !opposite(abc, abd) {
        return None;
    }
    let (cda, cdb) = (turn(c, d, a), turn(c, d, b));
    opposite(cda, cdb).then(|| (cda / (cda - cdb), abc / (abc - abd)))
}

/// Whether the segments a–b and c–d cross in their interiors.
#[inline]
pub fn cross(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    crossing(a, b, c, d).is_some()
}

/// Where the line from `start` along `way` meets that through `a` and `b`: as a multiple of `way`, and
/// as a share of the way from `a` to `b`. Not finite for parallel lines.
#[inline]
pub fn meeting(start: DVec2, way: DVec2, a: DVec2, b: DVec2) -> (f64, f64) {
    let side = b - a;
    let across = way.perp_dot(side);
    (
        (a - start).perp_dot(side) / across,
        (a - start).perp_dot(way) / across,
    )
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn no_point_of_a_segment_is_nearer_than_the_nearest(
            [ax, ay, bx, by, px, py] in prop::array::uniform6(-5.0..5.0_f64),
            share in 0.0..=1.0_f64,
        ) {
            let [a, b, p] = [(ax, ay), (bx, by), (px, py)].map(DVec2::from);
            let found = distance(a, b, p);
            prop_assert!(found <= a.lerp(b, share).distance(p) + 1e-12);
            prop_assert!((found - Line::new([a, b]).distance(p)).abs() < 1e-12);
        }

        #[test]
        fn segments_meet_where_they_cross(
            [ax, ay, bx, by] in prop::array::uniform4(-5.0..5.0_f64),
            [cx, cy, dx, dy] in prop::array::uniform4(-5.0..5.0_f64),
        ) {
            let [a, b, c, d] = [(ax, ay), (bx, by), (cx, cy), (dx, dy)].map(DVec2::from);
            let (first, second) = meeting(a, b - a, c, d);
            let inner = |share: f64| share > 0.0 && share < 1.0;
            prop_assert_eq!(cross(a, b, c, d), inner(first) && inner(second));
            if let Some((on_first, on_second)) = crossing(a, b, c, d) {
                let places = [a.lerp(b, on_first), c.lerp(d, on_second), a.lerp(b, first)];
                prop_assert!(places.iter().all(|place| place.distance(places[0]) < 1e-6));
            }
        }
    }

    #[test]
    fn a_segment_without_length_is_a_point() {
        let (a, p) = (DVec2::new(1.0, 2.0), DVec2::new(4.0, 6.0));
        assert_eq!(distance(a, a, p), 5.0);
        assert_eq!(Line::new([a, a]).distance(p), 5.0);
        assert!(!cross(a, a, p, DVec2::ZERO));
    }
}
