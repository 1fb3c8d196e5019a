//! Cells of a square grid, and the index of those that a leaf has.
//!
//! Everything here is counted in cells: the cell `(m, n)` has its centre at `(m h, n h)`, the root
//! is `(0, 0)`.

use std::ops::{Add, Sub};

/// Stands for "no cell" and "no parent".
pub(crate) const NONE: u32 = u32::MAX;

/// A cell by its place in the grid (Eq. 2.1 of \[xia2007\]); also a step from one cell to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cell {
    /// Column; 0 holds the root, positive is to the right of the midrib.
    pub m: i32,
    /// Row; 0 holds the root, the leaf starts upwards.
    pub n: i32,
}

impl Cell {
    /// The root; as a step, the zero step.
    pub const ROOT: Self = Self::new(0, 0);

    /// The direction in which water leaves the root.
    pub const UP: Self = Self::new(0, 1);

    /// The cell of column `m` and row `n`.
    pub const fn new(m: i32, n: i32) -> Self {
        Self { m, n }
    }

    /// Squared distance from the root, or length of a step, in cells.
    pub fn squared(self) -> i64 {
        i64::from(self.m) * i64::from(self.m) + i64::from(self.n) * i64::from(self.n)
    }

    /// Distance from the root, or length of a step, in cells.
    pub fn length(self) -> f64 {
        (self.squared() as f64).sqrt()
    }

    /// Scalar product of two steps: positive if the angle between them is less than a right angle.
    pub fn dot(self, other: Self) -> i64 {
        i64::from(self.m) * i64::from(other.m) + i64::from(self.n) * i64::from(other.n)
    }

    /// The mirror image about the midrib.
    pub fn mirrored(self) -> Self {
        Self::new(-self.m, self.n)
    }

    /// The eight neighbours, in a fixed order.
    pub fn neighbours(self) -> impl Iterator<Item = Self> {
        AROUND.iter().map(move |&step| self + step)
    }
}

/// Steps to the eight neighbours: all non-zero steps shorter than two cells.
pub(crate) const AROUND: [Cell; 8] = [
    Cell::new(0, -1),
    Cell::new(-1, 0),
    Cell::new(1, 0),
    Cell::new(0, 1),
    Cell::new(-1, -1),
    Cell::new(1, -1),
    Cell::new(-1, 1),
    Cell::new(1, 1),
];

impl Add for Cell {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.m + other.m, self.n + other.n)
    }
}

impl Sub for Cell {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.m - other.m, self.n - other.n)
    }
}

/// The number of each cell of a rectangle of the grid. The rectangle grows with the leaf.
#[derive(Clone, Debug)]
pub(crate) struct CellIndex {
    low: Cell,
    width: i32,
    height: i32,
    numbers: Vec<u32>,
}

impl CellIndex {
    /// An index in which no cell has a number.
    pub(crate) fn new() -> Self {
        Self {
            low: Cell::new(-16, -16),
            width: 32,
            height: 32,
            numbers: vec![NONE; 32 * 32],
        }
    }

    /// The number of a cell, or [`NONE`].
    pub(crate) fn get(&self, cell: Cell) -> u32 {
        self.place(cell).map_or(NONE, |place| self.numbers[place])
    }

    /// Gives a cell a number.
    pub(crate) fn set(&mut self, cell: Cell, number: u32) {
        let place = self.place(cell).unwrap_or_else(|| {
            self.make_room(cell);
            self.place(cell).expect("room has just been made for it")
        });
        self.numbers[place] = number;
    }

    fn place(&self, cell: Cell) -> Option<usize> {
        let at = cell - self.low;
        let inside = at.m >= 0 && at.n >= 0 && at.m < self.width && at.n < self.height;
        inside.then(|| at.n as usize * self.width as usize + at.m as usize)
    }

    /// Enlarges the rectangle by half on every side beyond which `cell` lies.
    fn make_room(&mut self, cell: Cell) {
        let (mut low, mut high) = (self.low, self.low + Cell::new(self.width, self.height));
        if cell.m < low.m {
            low.m = cell.m - self.width / 2;
        }
        if cell.n < low.n {
            low.n = cell.n - self.height / 2;
        }
        if cell.m >= high.m {
            high.m = cell.m + 1 + self.width / 2;
        }
        if cell.n >= high.n {
            high.n = cell.n + 1 + self.height / 2;
        }
        let (width, height) = (high.m - low.m, high.n - low.n);
        let mut numbers = vec![NONE; width as usize * height as usize];
        for (row, old) in self.numbers.chunks_exact(self.width as usize).enumerate() {
            let at = self.low - low;
            let start = (row + at.n as usize) * width as usize + at.m as usize;
            numbers[start..start + old.len()].copy_from_slice(old);
        }
        *self = Self {
            low,
            width,
            height,
            numbers,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stay_with_their_cells_while_the_rectangle_grows() {
        let mut index = CellIndex::new();
        let cells: Vec<Cell> = (0..200)
            .map(|i: i32| Cell::new((i * 37) % 101 - 50, (i * 53) % 211 - 90))
            .collect();
        for (number, &cell) in cells.iter().enumerate() {
            index.set(cell, number as u32);
        }
        for (number, &cell) in cells.iter().enumerate() {
            let last = cells.iter().rposition(|&c| c == cell);
            assert_eq!(index.get(cell) as usize, last.unwrap_or(number));
        }
        assert_eq!(index.get(Cell::new(4000, 0)), NONE);
        assert_eq!(index.get(Cell::new(50, -91)), NONE);
    }

    #[test]
    fn neighbours_are_all_cells_nearer_than_two() {
        let near = |cell: &Cell| cell.squared() < 4 && cell.squared() > 0;
        let square = (-2..=2).flat_map(|m| (-2..=2).map(move |n| Cell::new(m, n)));
        let mut expected: Vec<Cell> = square.filter(near).collect();
        let mut found: Vec<Cell> = Cell::ROOT.neighbours().collect();
        expected.sort();
        found.sort();
        assert_eq!(found, expected);
    }
}
