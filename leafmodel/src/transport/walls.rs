//! The cells of a given outline, and the edges between them that stay on the blade.

use glam::DVec2;

use super::cells::{Cell, CellIndex, NONE};
use super::contour::place;

/// Greatest number of columns and rows that an edge may span on a given blade.
pub(crate) const REACH: i32 = 2;

/// Side of the square of possible steps, the zero step included.
const SIDE: i32 = 2 * REACH + 1;

/// The allowed cells, and for each the steps along which an edge stays on the blade.
#[derive(Clone, Debug)]
pub(crate) struct Walls {
    index: CellIndex,
    /// For each cell a bit for every step of up to [`REACH`] columns and rows.
    open: Vec<u32>,
}

impl Walls {
    /// Walls for the given cells; `is_crossed` says whether the margin lies between two places.
    pub(crate) fn around(cells: &[Cell], is_crossed: impl Fn(DVec2, DVec2) -> bool) -> Self {
        let mut index = CellIndex::new();
        for (number, &cell) in (0..).zip(cells) {
            index.set(cell, number);
        }
        let mut open = vec![0; cells.len()];
        for (v, &cell) in cells.iter().enumerate() {
            for step in steps() {
                let other = index.get(cell + step);
                // Each pair is tested once and stored for both directions.
                if other == NONE || other <= v as u32 || is_crossed(place(cell), place(cell + step))
                {
                    continue;
                }
                open[v] |= bit(step);
                open[other as usize] |= bit(Cell::ROOT - step);
            }
        }
        Self { index, open }
    }

    /// Whether `cell` is allowed.
    pub(crate) fn hold(&self, cell: Cell) -> bool {
        self.index.get(cell) != NONE
    }

    /// Whether an edge from `u` to `v` is short enough and stays on the blade.
    pub(crate) fn allow(&self, u: Cell, v: Cell) -> bool {
        let step = v - u;
        if step.m.abs() > REACH || step.n.abs() > REACH {
            return false;
        }
        let number = self.index.get(u);
        number != NONE && self.open[number as usize] & bit(step) != 0
    }

    /// The cells that edges could lead to from the root, the root first.
    pub(crate) fn connected(&self, root: Cell) -> Vec<Cell> {
        let mut seen = vec![false; self.open.len()];
        let mut found = vec![root];
        let number = self.index.get(root);
        if number != NONE {
            seen[number as usize] = true;
        }
        let mut next = 0;
        while let Some(&cell) = found.get(next) {
            next += 1;
            for near in steps().map(|step| cell + step) {
                if self.allow(cell, near) {
                    let number = self.index.get(near) as usize;
                    if !std::mem::replace(&mut seen[number], true) {
                        found.push(near);
                    }
                }
            }
        }
        found
    }
}

fn steps() -> impl Iterator<Item = Cell> {
    let reach = -REACH..=REACH;
    let rows = reach.clone();
    rows.flat_map(move |n| reach.clone().map(move |m| Cell::new(m, n)))
        .filter(|&step| step != Cell::ROOT)
}

fn bit(step: Cell) -> u32 {
    1 << ((step.n + REACH) * SIDE + step.m + REACH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_stops_edges_both_ways_and_only_across_it() {
        let cells: Vec<Cell> = (0..4)
            .flat_map(|m| (0..4).map(move |n| Cell::new(m, n)))
            .collect();
        // A wall between columns 1 and 2, up to above row 2.
        let is_crossed = |a: DVec2, b: DVec2| {
            let at = a + (b - a) * ((1.5 - a.x) / (b.x - a.x));
            (a.x - 1.5) * (b.x - 1.5) < 0.0 && at.y < 2.5
        };
        let walls = Walls::around(&cells, is_crossed);
        let allow = |a: [i32; 2], b: [i32; 2]| {
            let [a, b] = [a, b].map(|[m, n]| Cell::new(m, n));
            assert_eq!(walls.allow(a, b), walls.allow(b, a));
            walls.allow(a, b)
        };
        assert!(!allow([1, 1], [2, 1]) && allow([1, 3], [2, 3]));
        assert!(allow([0, 0], [1, 2]) && !allow([0, 0], [0, 3]));
        assert!(!allow([3, 3], [4, 3]) && !walls.hold(Cell::new(4, 3)));
        assert_eq!(walls.connected(Cell::ROOT).len(), 16);
    }
}
