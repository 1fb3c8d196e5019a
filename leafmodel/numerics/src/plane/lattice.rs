//! Square cells over a rectangle.

use glam::DVec2;

/// Square cells, numbered row by row from the lower left.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// Lower left corner.
    pub low: DVec2,
    /// Side of a cell.
    pub cell: f64,
    /// How many cells lie side by side.
    pub columns: usize,
    /// How many rows of them there are.
    pub rows: usize,
}

impl Lattice {
    /// As many cells with this side as a rectangle of this size needs.
    #[inline]
    pub fn new(low: DVec2, size: DVec2, cell: f64) -> Self {
        Self {
            low,
            cell,
            columns: (size.x / cell) as usize + 1,
            rows: (size.y / cell) as usize + 1,
        }
    }

    /// Number of cells.
    #[inline]
    pub fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// Number of the cell in which a point lies; for points outside the rectangle, of the nearest
    /// cell.
    #[inline]
    pub fn cell(&self, p: DVec2) -> usize {
        self.row(p.y) * self.columns + self.column(p.x)
    }

    // Casts from float to int saturate, so points below the rectangle fall into its first row.
    /// The column of a place, the nearest one if it lies outside.
    #[inline]
    pub fn column(&self, x: f64) -> usize {
        (((x - self.low.x) / self.cell) as usize).min(self.columns - 1)
    }

    /// The row of a place, the nearest one if it lies outside.
    #[inline]
    pub fn row(&self, y: f64) -> usize {
        (((y - self.low.y) / self.cell) as usize).min(self.rows - 1)
    }

    /// As [`Lattice::cell`]; `None` for points outside the cells.
    #[inline]
    pub fn cell_with(&self, p: DVec2) -> Option<usize> {
        let place = (p - self.low) / self.cell;
        let is_inside = place.cmpge(DVec2::ZERO).all()
            && place.x < self.columns as f64
            && place.y < self.rows as f64;
        is_inside.then(|| place.y as usize * self.columns + place.x as usize)
    }

    /// The middle of a cell.
    #[inline]
    pub fn middle(&self, cell: usize) -> DVec2 {
        let (column, row) = (cell % self.columns, cell / self.columns);
        self.low + (DVec2::new(column as f64, row as f64) + 0.5) * self.cell
    }

    /// Numbers of the cells into which a rectangle reaches, ascending.
    #[inline]
    pub fn cells_between(
        &self,
        low: DVec2,
        high: DVec2,
    ) -> impl Iterator<Item = usize> + Clone + use<> {
        let (left, right, columns) = (self.column(low.x), self.column(high.x), self.columns);
        (self.row(low.y)..=self.row(high.y))
            .flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }
}
