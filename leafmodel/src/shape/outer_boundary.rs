//! The outside of a curve that crosses itself.
//!
//! Rows of unlike slope can pass over each other, and then the polyline of their ends crosses
//! itself. The blade is what the rows sweep over together, so its margin is the outer boundary of
//! that polyline: follow it, and wherever another piece crosses, take the outermost way on.

use glam::DVec2;

use super::crossing::crossing;

/// The outer boundary of the closed polyline `points`, counter-clockwise, starting at `points[0]`.
///
/// `points[0]` and the last point must lie on the outer boundary, with the edge from the last to
/// the first on it as well (the midrib of a half leaf is). Holes between crossing pieces are
/// filled; loops that hang on to the rest by a single crossing point are cut off.
pub(crate) fn outer_boundary(points: &[DVec2]) -> Vec<DVec2> {
    let web = Web::new(points);
    let (start, last) = (0, points.len() - 1);
    let mut path: Vec<usize> = vec![start];
    let mut arrival = web.corners[start] - web.corners[last];
    let mut previous = last;
    // Every directed edge is walked at most once; the bound only guards against rounding.
    for _ in 0..2 * web.corners.len() + 2 {
        let here = path[path.len() - 1];
        if here == last {
            break;
        }
        let Some(next) = web.rightmost(here, previous, arrival) else {
            break;
        };
        if let Some(at) = path.iter().position(|&corner| corner == next) {
            // A loop closed at one point: leave it out and go on from there, as if just arrived.
            path.truncate(at + 1);
        } else {
            path.push(next);
        }
        arrival = web.corners[next] - web.corners[here];
        previous = here;
    }
    path.into_iter().map(|corner| web.corners[corner]).collect()
}

/// A polyline and its crossings as a plane graph.
struct Web {
    corners: Vec<DVec2>,
    /// Neighbours of each corner: two, or four at a crossing.
    neighbours: Vec<Vec<usize>>,
}

impl Web {
    fn new(points: &[DVec2]) -> Self {
        let n = points.len();
        let mut corners = points.to_vec();
        // For each edge the crossings on it, as (how far along, corner).
        let mut on_edge: Vec<Vec<(f64, usize)>> = vec![Vec::new(); n];
        for i in 0..n {
            for j in i + 2..n {
                if i == 0 && j == n - 1 {
                    continue;
                }
                let (a, b) = (points[i], points[i + 1]);
                let (c, d) = (points[j], points[(j + 1) % n]);
                if let Some((along_first, along_second)) = crossing(a, b, c, d) {
                    let corner = corners.len();
                    corners.push(a + (b - a) * along_first);
                    on_edge[i].push((along_first, corner));
                    on_edge[j].push((along_second, corner));
                }
            }
        }
        let mut neighbours = vec![Vec::new(); corners.len()];
        for (i, crossings) in on_edge.iter_mut().enumerate() {
            crossings.sort_by(|p, q| p.0.total_cmp(&q.0));
            let mut from = i;
            for to in crossings.iter().map(|c| c.1).chain([(i + 1) % n]) {
                neighbours[from].push(to);
                neighbours[to].push(from);
                from = to;
            }
        }
        Self {
            corners,
            neighbours,
        }
    }

    /// Of the ways on from `here`, reached in direction `arrival`, the one farthest to the right.
    fn rightmost(&self, here: usize, previous: usize, arrival: DVec2) -> Option<usize> {
        let back = -arrival;
        // Angle from the way back, counter-clockwise: the smallest is the rightmost way on.
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
        // Up to (4, 2), where the way out to (6, 2) crosses; that loop only hangs on there.
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
