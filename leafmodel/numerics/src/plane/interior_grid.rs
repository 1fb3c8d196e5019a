//! The inside of an outline in coarse cells: answers most point queries by one look-up.
//!
//! A cell through which the margin passes leaves the answer to the edges. All other cells lie
//! wholly inside or wholly outside. An inside cell stores its distance, in cells, from the nearest
//! cell that is not inside.

use glam::DVec2;

use super::points::bounds;
use super::polygon;
use super::slabs::Slabs;

/// Cells along the longer side of the bounding rectangle.
const CELLS: f64 = 48.0;

/// A cell through which the margin passes.
const MARGIN: u8 = 0;

/// A cell outside.
const OUTSIDE: u8 = u8::MAX;

/// A cell inside whose steps are not yet counted; step counts are always smaller.
const INSIDE: u8 = u8::MAX - 1;

/// Cells over the bounding rectangle of a polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct InteriorGrid {
    low: DVec2,
    cell: f64,
    columns: usize,
    /// Marks or step counts of the cells, row by row.
    steps: Vec<u8>,
}

impl InteriorGrid {
    /// The cells of a simple polygon; `slabs` indexes its edges.
    #[inline]
    pub fn new(points: &[DVec2], slabs: &Slabs) -> Self {
        let (low, high) = bounds(points.iter().copied());
        let cell = (high - low).max_element() / CELLS;
        let count = |extent: f64| (extent / cell).floor() as usize + 1;
        let (columns, rows) = (count(high.x - low.x), count(high.y - low.y));
        let mut grid = Self {
            low,
            cell,
            columns,
            steps: vec![INSIDE; columns * rows],
        };
        for (a, b) in polygon::sides(points) {
            grid.mark_edge((a - low) / cell, (b - low) / cell);
        }
        grid.mark_sides(points, slabs);
        grid.count_steps();
        grid
    }

    /// Whether `p` is inside; `None` if its cell lies on the margin.
    #[inline]
    pub fn contains(&self, p: DVec2) -> Option<bool> {
        match self.steps_at(p) {
            MARGIN => None,
            OUTSIDE => Some(false),
            _ => Some(true),
        }
    }

    /// Whether the cells prove that the segment from `a` to `b` stays clear of the margin.
    #[inline]
    pub fn is_clear(&self, a: DVec2, b: DVec2) -> bool {
        let steps = self.steps_at(a);
        // Between a cell and one `steps` away lie `steps − 1` whole cells.
        let way = f64::from(steps.saturating_sub(1)) * self.cell;
        steps != OUTSIDE && (b - a).length_squared() < way * way * (1.0 - 1e-9)
    }

    fn steps_at(&self, p: DVec2) -> u8 {
        let q = (p - self.low) / self.cell;
        let (column, row) = (q.x as usize, q.y as usize);
        if q.x < 0.0 || q.y < 0.0 || column >= self.columns {
            return OUTSIDE;
        }
        let at = row.saturating_mul(self.columns).saturating_add(column);
        self.steps.get(at).copied().unwrap_or(OUTSIDE)
    }

    /// Marks the cells through which an edge passes; its ends are given in cells from the grid's
    /// corner.
    fn mark_edge(&mut self, a: DVec2, b: DVec2) {
        // Much greater than rounding errors, much smaller than a cell.
        let slack = 1e-6;
        let rows = self.steps.len() / self.columns;
        let (first, last) = (a.y.min(b.y) - slack, a.y.max(b.y) + slack);
        for row in first as usize..=(last as usize).min(rows - 1) {
            // Where the edge enters and leaves the row.
            let at = |y: f64| {
                let along = ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
                a.x + (b.x - a.x) * along
            };
            let (below, above) = (row as f64 - slack, row as f64 + 1.0 + slack);
            let (one, other) = if (b.y - a.y).abs() > slack {
                (at(below), at(above))
            } else {
                (a.x, b.x)
            };
            let (from, to) = (one.min(other) - slack, one.max(other) + slack);
            let end = (to as usize).min(self.columns - 1);
            let start = row * self.columns;
            self.steps[start + from as usize..=start + end].fill(MARGIN);
        }
    }

    /// Decides which cells are inside. Neighbours in a row with no margin between them share the
    /// answer.
    fn mark_sides(&mut self, points: &[DVec2], slabs: &Slabs) {
        for (row, cells) in self.steps.chunks_mut(self.columns).enumerate() {
            let mut before = MARGIN;
            for (column, steps) in cells.iter_mut().enumerate() {
                if *steps != MARGIN {
                    *steps = if before == MARGIN {
                        let middle = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                        let inside = slabs.contains(points, self.low + middle * self.cell);
                        if inside { INSIDE } else { OUTSIDE }
                    } else {
                        before
                    };
                }
                before = *steps;
            }
        }
    }

    /// Counts the steps, diagonal ones included, from each inside cell to the nearest other cell.
    fn count_steps(&mut self) {
        let (count, columns) = (self.steps.len(), self.columns);
        for at in 0..count {
            self.relax(at, |i| {
                [i - 1, i - columns - 1, i - columns, i - columns + 1]
            });
        }
        for at in (0..count).rev() {
            self.relax(at, |i| {
                [i + 1, i + columns - 1, i + columns, i + columns + 1]
            });
        }
    }

    /// Lowers a cell's count to one more than the least of some neighbours'. The neighbours exist,
    /// since the margin lies between inside cells and the border of the grid.
    fn relax(&mut self, at: usize, neighbours: impl Fn(usize) -> [usize; 4]) {
        let steps = self.steps[at];
        if steps != MARGIN && steps != OUTSIDE {
            // Cells outside or on the margin count as 0 steps.
            let nearest = neighbours(at).map(|i| match self.steps[i] {
                OUTSIDE => MARGIN,
                steps => steps,
            });
            let nearest = nearest.into_iter().fold(INSIDE, u8::min);
            self.steps[at] = steps.min(nearest + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    /// A star-shaped polygon of `radii`, as wide as high or long and narrow.
    fn star(radii: &[f64], width: f64) -> Vec<DVec2> {
        let turn = std::f64::consts::TAU / radii.len() as f64;
        radii
            .iter()
            .enumerate()
            .map(|(i, radius)| {
                let angle = turn * i as f64;
                DVec2::new(width * libm::cos(angle), libm::sin(angle)) * *radius
            })
            .collect()
    }

    proptest! {
        #![proptest_config(fixed(400))]

        #[test]
        fn cells_say_nothing_that_the_edges_deny(
            radii in proptest::collection::vec(0.5..6.0_f64, 3..80), width in 0.02..1.0_f64,
            places in proptest::collection::vec((-7.0..7.0_f64, -7.0..7.0_f64), 200),
        ) {
            let points = star(&radii, width);
            let slabs = Slabs::new(&points);
            let grid = InteriorGrid::new(&points, &slabs);
            let scale = DVec2::new(width, 1.0);
            let mut before = DVec2::ZERO;
            for place in places {
                let p = DVec2::from(place) * scale;
                if let Some(inside) = grid.contains(p) {
                    prop_assert_eq!(inside, slabs.contains(&points, p), "{}", p);
                }
                // Segments of all lengths, many of them close to the longest that is clear.
                for share in [0.01, 0.1, 0.3, 1.0] {
                    let to = p + (before - p) * share;
                    prop_assert!(!grid.is_clear(p, to) || !slabs.is_crossed_by(&points, p, to), "{}–{}", p, to);
                }
                before = p;
            }
        }
    }

    #[test]
    fn cells_classify_nearly_all_of_a_disc() {
        let points = star(&[5.0; 300], 1.0);
        let grid = InteriorGrid::new(&points, &Slabs::new(&points));
        let told = |radius: f64| {
            (0..1000)
                .filter(|i| {
                    let angle = std::f64::consts::TAU * f64::from(*i) / 1000.0;
                    let p = DVec2::new(libm::cos(angle), libm::sin(angle)) * radius;
                    grid.contains(p) == Some(radius < 5.0)
                })
                .count()
        };
        assert_eq!([0.0, 2.0, 4.7, 5.3, 9.0].map(told), [1000; 5]);
        // Cells are 0.21 wide. A diagonal step counts as one, so only 3.5 of the 5 to the margin
        // are known to be clear.
        assert!(grid.is_clear(DVec2::ZERO, DVec2::new(3.0, 0.0)));
        assert!(!grid.is_clear(DVec2::new(4.0, 0.0), DVec2::new(4.99, 0.0)));
    }
}
