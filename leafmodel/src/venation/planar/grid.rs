//! A grid of square cells over the leaf, and the edges that pass through each.

use glam::DVec2;
use rayon::prelude::*;

use crate::buckets::Buckets;
use crate::plane::{Lattice, bounds, segment};
use crate::venation::network::VeinEdge;

/// Cells over all points: about two per point if the points fill the rectangle, at most about four
/// per point, and with sides no smaller than `least`.
pub(super) fn cells_around(
    points: impl Iterator<Item = DVec2>,
    count: usize,
    least: f64,
) -> Lattice {
    let (low, high) = bounds(points);
    if count == 0 {
        return Lattice::new(DVec2::ZERO, DVec2::ZERO, 1.0);
    }
    let size = high - low;
    let n = count as f64;
    let cell = (size.x * size.y / (2.0 * n)).sqrt();
    let cell = cell.max(size.max_element() / n).max(least);
    Lattice::new(low, size, if cell > 0.0 { cell } else { 1.0 })
}

/// Visits every cell through which the segment from `a` to `b` passes, and sometimes a neighbouring
/// cell.
fn cells_along(cells: &Lattice, a: DVec2, b: DVec2, mut visit: impl FnMut(usize)) {
    let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
    let (first, last) = (cells.row(a.y), cells.row(b.y));
    for row in first..=last {
        // The part of the segment in this row, widened by far more than rounding.
        let slack = 1e-6 * cells.cell;
        let floor = cells.low.y + row as f64 * cells.cell - slack;
        let ceiling = floor + cells.cell + 2.0 * slack;
        let slope = (b.x - a.x) / (b.y - a.y);
        let at = |y: f64| a.x + (y - a.y) * slope;
        let enter = if row == first || floor <= a.y {
            a.x
        } else {
            at(floor)
        };
        let leave = if row == last || ceiling >= b.y {
            b.x
        } else {
            at(ceiling)
        };
        let (left, right) = (enter.min(leave), enter.max(leave));
        for column in cells.column(left - slack)..=cells.column(right + slack) {
            visit(row * cells.columns + column);
        }
    }
}

/// Edges by cell.
#[derive(Clone, Debug)]
pub(crate) struct EdgeGrid {
    lattice: Lattice,
    edges: Buckets,
}

impl EdgeGrid {
    /// Sorts edges into cells; `mean_length` is the mean length of the edges.
    pub(crate) fn new(nodes: &[DVec2], edges: &[VeinEdge], mean_length: f64) -> Self {
        let ends = |edge: &VeinEdge| (nodes[edge.from as usize], nodes[edge.to as usize]);
        let points = edges.iter().flat_map(|edge| <[DVec2; 2]>::from(ends(edge)));
        let lattice = cells_around(points, edges.len(), mean_length);
        let mut listed: Vec<(u32, u32)> = Vec::with_capacity(2 * edges.len());
        for (number, edge) in (0..).zip(edges) {
            let (a, b) = ends(edge);
            cells_along(&lattice, a, b, |cell| listed.push((cell as u32, number)));
        }
        let listed = listed.iter().map(|&(cell, number)| (cell as usize, number));
        Self {
            edges: Buckets::new(lattice.cells(), listed),
            lattice,
        }
    }

    /// The edges of each cell in turn, ascending.
    pub(crate) fn lists(&self) -> impl Iterator<Item = &[u32]> {
        self.edges.lists()
    }

    /// As [`EdgeGrid::lists`], on all threads.
    pub(crate) fn lists_at_once(&self) -> impl IndexedParallelIterator<Item = &[u32]> {
        let cells = (0..self.edges.count()).into_par_iter();
        cells.map(|cell| self.edges.list(cell))
    }

    fn list(&self, column: usize, row: usize) -> &[u32] {
        self.edges.list(row * self.lattice.columns + column)
    }

    /// Distance from `p` to the nearest edge; `None` without edges.
    pub(crate) fn distance(&self, nodes: &[DVec2], edges: &[VeinEdge], p: DVec2) -> Option<f64> {
        let lattice = &self.lattice;
        let (column, row) = (lattice.column(p.x), lattice.row(p.y));
        let mut nearest = f64::INFINITY;
        for ring in 0..=lattice.columns.max(lattice.rows) {
            let left = column.saturating_sub(ring);
            let right = (column + ring).min(lattice.columns - 1);
            let floor = row.saturating_sub(ring);
            let ceiling = (row + ring).min(lattice.rows - 1);
            let mut look = |column: usize, row: usize| {
                for &edge in self.list(column, row) {
                    let edge = &edges[edge as usize];
                    let (a, b) = (nodes[edge.from as usize], nodes[edge.to as usize]);
                    nearest = nearest.min(segment::distance_squared(a, b, p));
                }
            };
            for r in floor..=ceiling {
                if r.abs_diff(row) == ring {
                    (left..=right).for_each(|c| look(c, r));
                } else {
                    if column >= ring {
                        look(left, r);
                    }
                    if column + ring < lattice.columns && ring > 0 {
                        look(right, r);
                    }
                }
            }
            // Edges not yet examined lie beyond those sides of this box that are not sides of the
            // grid. Edges that reach beyond a cell are listed in the next cell too.
            let low = lattice.low + DVec2::new(left as f64, floor as f64) * lattice.cell;
            let high =
                lattice.low + DVec2::new(right as f64 + 1.0, ceiling as f64 + 1.0) * lattice.cell;
            let mut safe = f64::INFINITY;
            if left > 0 {
                safe = safe.min(p.x - low.x);
            }
            if right + 1 < lattice.columns {
                safe = safe.min(high.x - p.x);
            }
            if floor > 0 {
                safe = safe.min(p.y - low.y);
            }
            if ceiling + 1 < lattice.rows {
                safe = safe.min(high.y - p.y);
            }
            if safe == f64::INFINITY || (safe > 0.0 && nearest <= safe * safe) {
                break;
            }
        }
        (nearest < f64::INFINITY).then(|| nearest.sqrt())
    }

    /// The first edge that a ray from `p` towards −x meets and for which `wanted` is true. A node
    /// at the height of `p` counts as below the ray.
    pub(crate) fn first_to_the_left(
        &self,
        nodes: &[DVec2],
        edges: &[VeinEdge],
        p: DVec2,
        wanted: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let row = self.lattice.row(p.y);
        for column in (0..=self.lattice.column(p.x)).rev() {
            let hit = self
                .list(column, row)
                .iter()
                .filter_map(|&number| {
                    let edge = &edges[number as usize];
                    let (a, b) = (nodes[edge.from as usize], nodes[edge.to as usize]);
                    if (a.y > p.y) == (b.y > p.y) || !wanted(number) {
                        return None;
                    }
                    let slope = (b.x - a.x) / (b.y - a.y);
                    let x = a.x + (p.y - a.y) * slope;
                    // Of edges that meet at the height of `p`, the one farther right just above it
                    // comes first.
                    (x <= p.x).then_some((number, x, slope))
                })
                .max_by(|a, b| a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2)));
            if let Some((number, x, _)) = hit {
                // An edge listed in this cell may be met to the left of the cell, behind an edge of
                // another cell.
                let start = self.lattice.low.x + column as f64 * self.lattice.cell;
                if column == 0 || x >= start {
                    return Some(number);
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    fn edge(from: u32, to: u32) -> VeinEdge {
        VeinEdge {
            from,
            to,
            radius_from: 1.0,
            radius_to: 1.0,
            order: 1,
        }
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn the_grid_answers_as_all_edges_do(
            places in prop::collection::vec((0.0..10.0_f64, 0.0..4.0_f64), 2..60),
            x in -3.0..13.0_f64, y in -3.0..7.0_f64,
        ) {
            let nodes: Vec<DVec2> = places.into_iter().map(DVec2::from).collect();
            let edges: Vec<VeinEdge> = (1..nodes.len() as u32).map(|to| edge(to / 2, to)).collect();
            let grid = EdgeGrid::new(&nodes, &edges, 5.0);
            let p = DVec2::new(x, y);
            let ends = |e: &VeinEdge| (nodes[e.from as usize], nodes[e.to as usize]);
            let nearest = edges.iter().map(|e| segment::distance_squared(ends(e).0, ends(e).1, p)).fold(f64::INFINITY, f64::min);
            let found = grid.distance(&nodes, &edges, p).expect("there are edges");
            prop_assert!((found - nearest.sqrt()).abs() <= 1e-12);
            let left = edges
                .iter()
                .enumerate()
                .filter(|(number, e)| number % 3 > 0 && (ends(e).0.y > y) != (ends(e).1.y > y))
                .map(|(number, e)| {
                    let (a, b) = ends(e);
                    (number as u32, a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
                })
                .filter(|&(_, at)| at <= x)
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .map(|(number, _)| number);
            prop_assert_eq!(grid.first_to_the_left(&nodes, &edges, p, |number| number % 3 > 0), left);
        }
    }
}
