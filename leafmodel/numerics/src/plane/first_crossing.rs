//! Where edges of a polygon cross or touch.

use glam::DVec2;

use super::points::turn;
use super::slabs::Slabs;

/// Two edges of the closed polygon that cross, or touch elsewhere than at the corner that
/// neighbours share. `None` for a simple polygon. Only edges in a common slab whose x-ranges
/// overlap are compared: `O(n √n)` for a comb, about `n log n` for ordinary margins.
#[inline]
pub fn first_crossing(points: &[DVec2], slabs: &Slabs) -> Option<(usize, usize)> {
    let n = points.len();
    let ends = |i: usize| (points[i], points[(i + 1) % n]);
    let mut by_left: Vec<(f64, f64, usize)> = Vec::new();
    for slab in 0..slabs.count() {
        by_left.clear();
        by_left.extend(slabs.edges(slab).iter().map(|&i| {
            let (a, b) = ends(i as usize);
            (a.x.min(b.x), a.x.max(b.x), i as usize)
        }));
        by_left.sort_unstable_by(|p, q| p.0.total_cmp(&q.0).then(p.2.cmp(&q.2)));
        for (k, &(_, right, i)) in by_left.iter().enumerate() {
            for &(left, _, j) in &by_left[k + 1..] {
                if left > right {
                    break;
                }
                let (first, second) = (i.min(j), i.max(j));
                let wrong = if second == first + 1 {
                    folds_back(points[first], points[second], points[(second + 1) % n])
                } else if first == 0 && second == n - 1 {
                    folds_back(points[second], points[0], points[1])
                } else {
                    meet(ends(first), ends(second))
                };
                if wrong {
                    return Some((first, second));
                }
            }
        }
    }
    None
}

/// Whether the path a → b → c folds back on itself at b.
fn folds_back(a: DVec2, b: DVec2, c: DVec2) -> bool {
    turn(a, b, c) == 0.0 && (b - a).dot(c - b) < 0.0
}

/// Whether two closed segments have a point in common.
fn meet((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    let (abc, abd) = (turn(a, b, c), turn(a, b, d));
    let (cda, cdb) = (turn(c, d, a), turn(c, d, b));
    let apart = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    if apart(abc, abd) || apart(cda, cdb) {
        return false;
    }
    if abc == 0.0 && abd == 0.0 && cda == 0.0 && cdb == 0.0 {
        // Collinear segments meet if their bounding boxes do.
        let (low, high) = (a.min(b), a.max(b));
        let (other_low, other_high) = (c.min(d), c.max(d));
        return low.cmple(other_high).all() && other_low.cmple(high).all();
    }
    true
}
