//! Triangles that pass through each other.

use glam::DVec3;

/// Pairs of triangles that cross and share no vertex, each ascending, in ascending order.
///
/// Boxes around the triangles, in the order in which they begin along x, say which pairs are near.
#[cfg(test)]
pub(crate) fn crossings(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let corners = |t: u32| triangles[t as usize].map(|v| positions[v as usize]);
    let mut boxes: Vec<(Extent, u32)> = (0..triangles.len() as u32)
        .map(|t| (Extent::of(&corners(t)), t))
        .collect();
    sweep(&mut boxes);
    let mut found = Vec::new();
    each_near(&boxes, |a, b| {
        let shared = triangles[a as usize]
            .iter()
            .any(|v| triangles[b as usize].contains(v));
        if !shared && cross(&corners(a), &corners(b)) {
            found.push([a.min(b), a.max(b)]);
        }
    });
    found.sort_unstable();
    found
}

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Extent {
    pub(crate) fn of(points: &[DVec3]) -> Self {
        let from = Self {
            low: DVec3::INFINITY,
            high: DVec3::NEG_INFINITY,
        };
        points.iter().fold(from, |extent, &p| Self {
            low: extent.low.min(p),
            high: extent.high.max(p),
        })
    }

    pub(crate) fn widened(self, by: f64) -> Self {
        Self {
            low: self.low - by,
            high: self.high + by,
        }
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Brings boxes into the order that [`each_near`] needs.
pub(crate) fn sweep(boxes: &mut [(Extent, u32)]) {
    boxes.sort_unstable_by(|(a, i), (b, j)| a.low.x.total_cmp(&b.low.x).then(i.cmp(j)));
}

/// Calls `act` with the numbers of each two boxes that meet.
pub(crate) fn each_near(boxes: &[(Extent, u32)], mut act: impl FnMut(u32, u32)) {
    for (i, (one, a)) in boxes.iter().enumerate() {
        for (other, b) in &boxes[i + 1..] {
            if other.low.x > one.high.x {
                break;
            }
            if one.meets(other) {
                act(*a, *b);
            }
        }
    }
}

/// Whether a side of one triangle passes through the inside of the other. Triangles of one plane
/// do not cross.
pub(crate) fn cross(a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    let pierced = |by: &[DVec3; 3], face: &[DVec3; 3]| {
        let sides = by.map(|p| volume(face, p));
        // A triangle on one side of the other's plane has no part beyond it.
        if sides.iter().all(|&v| v > 0.0) || sides.iter().all(|&v| v < 0.0) {
            return None;
        }
        Some((0..3).any(|i| {
            let j = (i + 1) % 3;
            sides[i] * sides[j] < 0.0 && runs_through(by[i], by[j], face)
        }))
    };
    match pierced(a, b) {
        None => false,
        Some(true) => true,
        Some(false) => pierced(b, a) == Some(true),
    }
}

/// Six times the volume of the tetrahedron of a triangle and a point.
fn volume([a, b, c]: &[DVec3; 3], p: DVec3) -> f64 {
    (*b - *a).cross(*c - *a).dot(p - *a)
}

/// Whether the line through `p` and `q` runs through the inside of a triangle.
fn runs_through(p: DVec3, q: DVec3, &[a, b, c]: &[DVec3; 3]) -> bool {
    let way = q - p;
    let side = |from: DVec3, to: DVec3| way.cross(from - p).dot(to - p);
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f64; 3]; 3]) -> [DVec3; 3] {
        corners.map(DVec3::from_array)
    }

    #[test]
    fn a_triangle_that_pierces_another_crosses_it_and_one_beside_it_does_not() {
        let flat = triangle([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
        let upright = triangle([[1.0, 1.0, -1.0], [1.2, 1.0, 1.0], [1.0, 1.4, 1.0]]);
        assert!(cross(&flat, &upright) && cross(&upright, &flat));
        for away in [
            DVec3::new(0.0, 0.0, 1.1),
            DVec3::new(3.0, 3.0, 0.0),
            DVec3::new(-2.0, 0.0, 0.0),
        ] {
            let aside = upright.map(|p| p + away);
            assert!(!cross(&flat, &aside) && !cross(&aside, &flat), "{away}");
        }
    }

    #[test]
    fn every_pair_is_found_as_by_trying_all() {
        // A crumpled sheet: a plane whose heights follow waves that fold over.
        let (count, mut positions, mut triangles) = (18_u32, Vec::new(), Vec::new());
        for i in 0..count * count {
            let (u, v) = (f64::from(i % count), f64::from(i / count));
            let fold = DVec3::new(
                u + 2.2 * libm::sin(0.9 * u + 0.3 * v),
                v + 1.7 * libm::sin(1.1 * v - 0.2 * u),
                1.5 * libm::cos(0.9 * u) + libm::cos(1.3 * v + 0.1 * u),
            );
            positions.push(fold);
            if i % count + 1 < count && i / count + 1 < count {
                triangles.push([i, i + 1, i + count]);
                triangles.push([i + 1, i + count + 1, i + count]);
            }
        }
        let found = crossings(&positions, &triangles);
        let mut all = Vec::new();
        for a in 0..triangles.len() {
            for b in a + 1..triangles.len() {
                let [one, other] = [a, b].map(|t| triangles[t].map(|v| positions[v as usize]));
                let shared = triangles[a].iter().any(|v| triangles[b].contains(v));
                if !shared && cross(&one, &other) {
                    all.push([a as u32, b as u32]);
                }
            }
        }
        assert!(all.len() > 20, "{}", all.len());
        assert_eq!(found, all);
    }
}
