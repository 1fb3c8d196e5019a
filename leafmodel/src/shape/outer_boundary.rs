//! The outer boundary of a curve that crosses itself, or of several curves that cross each other.
//!
//! Rows of unlike slope can pass over each other, and then the polyline of their ends crosses
//! itself. The blade is what the rows sweep over together, so its margin is the outer boundary of
//! that polyline: it is followed, and at every crossing the outermost branch is taken.

use glam::DVec2;

use crate::plane::segment::crossing;

/// The outer boundary of the closed polyline `points`, counter-clockwise, starting at `points[0]`.
///
/// `points[0]` and the last point must lie on the outer boundary, with the edge from the last to
/// the first on it as well (for half a leaf, that edge is the midrib). Holes between crossing
/// pieces are filled; loops connected to the rest by a single crossing point are cut off.
pub(crate) fn outer_boundary(points: &[DVec2]) -> Vec<DVec2> {
    let web = Web::new(&[points]);
    let (start, last) = (web.same[0], web.same[points.len() - 1]);
    let arrival = web.corners[start] - web.corners[last];
    web.walk(start, last, arrival, |here, _| here == last)
}

/// The outer boundary of the union of simple counter-clockwise polygons, restricted to the part
/// connected to the lowest point; what touches that part in a single point only is cut off. Holes
/// are filled. The boundary is counter-clockwise and starts at the lowest point.
///
/// Polygons may share corners. Edges must not overlap; if they do, the boundary may cross itself.
pub(crate) fn union_boundary(polygons: &[&[DVec2]]) -> Vec<DVec2> {
    let web = Web::new(polygons);
    let lower = |&p: &usize, &q: &usize| {
        let (p, q) = (web.corners[p], web.corners[q]);
        p.y.total_cmp(&q.y).then(p.x.total_cmp(&q.x))
    };
    let Some(start) = (0..web.corners.len())
        .filter(|&i| !web.neighbours[i].is_empty())
        .min_by(lower)
    else {
        return Vec::new();
    };
    // The direction of arrival is chosen so that the walk starts along the outside.
    web.walk(start, usize::MAX, DVec2::X, |_, next| next == start)
}

/// Closed polylines and their crossings as a plane graph.
struct Web {
    corners: Vec<DVec2>,
    /// Neighbours of each corner: two, or four at a crossing.
    neighbours: Vec<Vec<usize>>,
    /// For each corner the first one at the same place.
    same: Vec<usize>,
}

impl Web {
    fn new(rings: &[&[DVec2]]) -> Self {
        let mut corners = rings.concat();
        let mut edges: Vec<[usize; 2]> = Vec::with_capacity(corners.len());
        let mut first = 0;
        for ring in rings {
            let n = ring.len();
            edges.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
            first += n;
        }
        // For each edge the crossings on it, as (how far along, corner).
        let mut on_edge: Vec<Vec<(f64, usize)>> = vec![Vec::new(); edges.len()];
        for (i, j) in near_pairs(&corners, &edges) {
            let [a, b] = edges[i].map(|corner| corners[corner]);
            let [c, d] = edges[j].map(|corner| corners[corner]);
            if let Some((along_first, along_second)) = crossing(a, b, c, d) {
                let corner = corners.len();
                corners.push(a + (b - a) * along_first);
                on_edge[i].push((along_first, corner));
                on_edge[j].push((along_second, corner));
            }
        }
        let same = one_of_equals(&corners);
        let mut neighbours = vec![Vec::new(); corners.len()];
        for (&[from, end], crossings) in edges.iter().zip(&mut on_edge) {
            crossings.sort_by(|p, q| p.0.total_cmp(&q.0));
            let mut from = same[from];
            for to in crossings.iter().map(|c| c.1).chain([end]) {
                let to = same[to];
                if to != from {
                    neighbours[from].push(to);
                    neighbours[to].push(from);
                }
                from = to;
            }
        }
        Self {
            corners,
            neighbours,
            same,
        }
    }

    /// The walk along the outside from `start`, reached from `previous` in direction `arrival`,
    /// until `done(here, next)`.
    fn walk(
        &self,
        start: usize,
        mut previous: usize,
        mut arrival: DVec2,
        done: impl Fn(usize, usize) -> bool,
    ) -> Vec<DVec2> {
        let mut path: Vec<usize> = vec![start];
        // Every directed edge is walked at most once; the bound only guards against rounding.
        for _ in 0..2 * self.corners.len() + 2 {
            let here = path[path.len() - 1];
            let Some(next) = self.rightmost(here, previous, arrival) else {
                break;
            };
            if done(here, next) {
                break;
            }
            if let Some(at) = path.iter().position(|&corner| corner == next) {
                // The walk closed a loop at one point: drop the loop and go on from that point.
                path.truncate(at + 1);
            } else {
                path.push(next);
            }
            arrival = self.corners[next] - self.corners[here];
            previous = here;
        }
        path.into_iter()
            .map(|corner| self.corners[corner])
            .collect()
    }

    /// The rightmost edge that leaves `here`, when arriving in direction `arrival`.
    fn rightmost(&self, here: usize, previous: usize, arrival: DVec2) -> Option<usize> {
        let back = -arrival;
        // Angle from the backward direction, counter-clockwise: the smallest belongs to the
        // rightmost edge.
        let angle = |to: usize| {
            let way = self.corners[to] - self.corners[here];
            let angle = libm::atan2(back.perp_dot(way), back.dot(way));
            if angle <= 0.0 {
                angle + std::f64::consts::TAU
            } else {
                angle
            }
        };
        self.neighbours[here]
            .iter()
            .copied()
            .filter(|&to| to != previous && to != here)
            .min_by(|&p, &q| angle(p).total_cmp(&angle(q)))
    }
}

/// Pairs of edges, smaller number first, in rising order, whose bounding boxes overlap and that
/// share no corner.
fn near_pairs(corners: &[DVec2], edges: &[[usize; 2]]) -> Vec<(usize, usize)> {
    let mut boxes: Vec<(DVec2, DVec2, usize)> = edges
        .iter()
        .enumerate()
        .map(|(i, edge)| {
            let [a, b] = edge.map(|corner| corners[corner]);
            (a.min(b), a.max(b), i)
        })
        .collect();
    boxes.sort_by(|p, q| p.0.y.total_cmp(&q.0.y).then(p.2.cmp(&q.2)));
    let mut pairs = Vec::new();
    for (k, &(low, high, i)) in boxes.iter().enumerate() {
        for &(other_low, other_high, j) in &boxes[k + 1..] {
            if other_low.y > high.y {
                break;
            }
            let joined = edges[i].iter().any(|corner| edges[j].contains(corner));
            if other_low.x <= high.x && low.x <= other_high.x && !joined {
                pairs.push((i.min(j), i.max(j)));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// For each corner the first one at the same place.
fn one_of_equals(corners: &[DVec2]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..corners.len()).collect();
    // Adding 0 turns −0 into 0.
    let key = |i: usize| corners[i] + DVec2::ZERO;
    order.sort_by(|&p, &q| {
        let (a, b) = (key(p), key(q));
        a.x.total_cmp(&b.x)
            .then(a.y.total_cmp(&b.y))
            .then(p.cmp(&q))
    });
    let mut first: Vec<usize> = (0..corners.len()).collect();
    for pair in order.windows(2) {
        if key(pair[0]) == key(pair[1]) {
            first[pair[1]] = first[pair[0]];
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<DVec2> {
        list.iter().copied().map(DVec2::from).collect()
    }

    #[test]
    fn a_simple_curve_is_its_own_boundary() {
        let curve = points(&[(0.0, 0.0), (2.0, 0.5), (1.0, 1.0), (2.0, 2.0), (0.0, 3.0)]);
        assert_eq!(outer_boundary(&curve), curve);
    }

    #[test]
    fn the_union_of_two_squares_is_walked_around() {
        let square =
            |x: f64, y: f64| points(&[(x, y), (x + 2.0, y), (x + 2.0, y + 2.0), (x, y + 2.0)]);
        let (one, other) = (square(0.0, 0.0), square(1.0, 1.0));
        let expected = points(&[
            (0.0, 0.0),
            (2.0, 0.0),
            (2.0, 1.0),
            (3.0, 1.0),
            (3.0, 3.0),
            (1.0, 3.0),
            (1.0, 2.0),
            (0.0, 2.0),
        ]);
        assert_eq!(union_boundary(&[&one, &other]), expected);
        assert_eq!(union_boundary(&[&other, &one]), expected);
        let inside = points(&[(0.5, 0.5), (1.5, 0.5), (1.0, 1.5)]);
        assert_eq!(union_boundary(&[&inside, &one]), one);
    }

    #[test]
    fn lobes_that_share_a_corner_are_walked_around_through_it() {
        // Two triangles that overlap above, and meet in the origin.
        let (one, other) = (
            points(&[(0.0, 0.0), (3.0, 2.0), (-1.0, 2.0)]),
            points(&[(0.0, 0.0), (1.0, 2.5), (-3.0, 2.5)]),
        );
        let boundary = union_boundary(&[&one, &other]);
        assert_eq!(boundary[0], DVec2::ZERO);
        assert!(boundary.contains(&DVec2::new(3.0, 2.0)));
        assert!(boundary.contains(&DVec2::new(-3.0, 2.5)));
        assert_eq!(boundary.iter().filter(|p| **p == DVec2::ZERO).count(), 1);
    }

    #[test]
    fn a_swallowtail_is_cut_at_its_crossing() {
        // The margin runs right along y = 1, turns back above itself and crosses its way up.
        let curve = points(&[
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (6.0, 2.0),
            (2.0, 2.0),
            (3.0, 6.0),
            (0.0, 6.0),
        ]);
        let boundary = outer_boundary(&curve);
        // Up to (4, 2), where the way out to (6, 2) crosses; that loop is connected to the rest
        // only there.
        assert!(boundary.contains(&DVec2::new(4.0, 2.0)));
        assert_eq!(boundary.first(), curve.first());
        assert_eq!(boundary.last(), curve.last());
        let pieces = boundary.len();
        let crossed = (0..pieces).any(|i| {
            (i + 2..pieces).any(|j| {
                crossing(
                    boundary[i],
                    boundary[i + 1],
                    boundary[j],
                    boundary[(j + 1) % pieces],
                )
                .is_some()
            })
        });
        assert!(!crossed, "{boundary:?}");
    }

    #[test]
    fn the_hole_between_two_overlapping_lobes_is_filled() {
        // The upper lobe bends down over the lower one and crosses it twice.
        let curve = points(&[
            (0.0, 0.0),
            (5.0, 0.0),
            (5.0, 1.0),
            (1.0, 1.0),
            (1.0, 3.0),
            (3.0, 3.0),
            (3.0, 0.5),
            (4.0, 0.5),
            (4.0, 4.0),
            (0.0, 4.0),
        ]);
        let boundary = outer_boundary(&curve);
        assert_eq!(
            boundary,
            points(&[
                (0.0, 0.0),
                (5.0, 0.0),
                (5.0, 1.0),
                (4.0, 1.0),
                (4.0, 4.0),
                (0.0, 4.0)
            ])
        );
    }
}
