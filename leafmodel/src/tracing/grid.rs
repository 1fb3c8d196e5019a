//! Pixels in rows, and yes or no for each of them.

use glam::DVec2;
use rayon::prelude::*;

use super::error::TraceError;

/// Grey values of a picture, by row from the top; 0 is black and 1 white.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Raster {
    /// A picture of `width` × `height` values.
    ///
    /// # Errors
    ///
    /// [`TraceError::BadRaster`] unless there are 3 × 3 to 2²⁹ pixels, as many values, all finite.
    pub fn new(width: usize, height: usize, values: Vec<f32>) -> Result<Self, TraceError> {
        let bad = |what: String| Err(TraceError::BadRaster(what));
        let pixels = width.saturating_mul(height);
        if width < 3 || height < 3 || pixels > MOST_PIXELS {
            return bad(format!(
                "it has {width} × {height} pixels; allowed are 3 × 3 up to {MOST_PIXELS} in all"
            ));
        }
        if values.len() != pixels {
            let count = values.len();
            return bad(format!("{count} values for {width} × {height} pixels"));
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            let (x, y) = (at % width, at / width);
            return bad(format!("the value of pixel ({x}, {y}) is not finite"));
        }
        Ok(Self {
            width,
            height,
            values,
        })
    }

    /// Pixels across.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Values by row, from the top.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The same pixels with other values, each made from a row's number and its old values.
    pub(super) fn mapped(&self, row: impl Fn(usize, &[f32], &mut [f32]) + Sync) -> Self {
        let mut values = vec![0.0; self.values.len()];
        values
            .par_chunks_mut(self.width)
            .zip(self.values.par_chunks(self.width))
            .enumerate()
            .for_each(|(y, (to, from))| row(y, from, to));
        Self {
            width: self.width,
            height: self.height,
            values,
        }
    }

    /// The same pixels, each with the value made from its number and its old value.
    pub(super) fn each(&self, value: impl Fn(usize, f32) -> f32 + Sync) -> Self {
        self.mapped(|y, from, to| {
            for ((at, to), &from) in (y * self.width..).zip(to).zip(from) {
                *to = value(at, from);
            }
        })
    }

    /// The value at a place in pixels, between four pixel centres; the nearest outside of them.
    pub(super) fn at(&self, place: DVec2) -> f64 {
        let last = DVec2::new(self.width as f64 - 1.0, self.height as f64 - 1.0);
        let p = (place - 0.5).clamp(DVec2::ZERO, last);
        let low = p.floor().min((last - 1.0).max(DVec2::ZERO));
        let share = p - low;
        let at = low.y as usize * self.width + low.x as usize;
        let value = |offset: usize| f64::from(self.values[at + offset]);
        let upper = value(0) + share.x * (value(1) - value(0));
        let lower = value(self.width) + share.x * (value(self.width + 1) - value(self.width));
        upper + share.y * (lower - upper)
    }
}

/// Most pixels of a picture: numbers of pixels and squares of distances fit into 32 bits.
pub(super) const MOST_PIXELS: usize = 1 << 29;

/// A set of pixels of a picture. A frame of pixels that are never in it surrounds the picture, so
/// that every pixel of the picture has eight neighbours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mask {
    /// Pixels across, with the frame.
    pub(super) stride: usize,
    /// Pixels down, with the frame.
    pub(super) rows: usize,
    pub(super) cells: Vec<bool>,
}

impl Mask {
    /// The pixels (x, y) of a picture for which `is_in` holds.
    pub(super) fn new(
        width: usize,
        height: usize,
        is_in: impl Fn(usize, usize) -> bool + Sync,
    ) -> Self {
        let (stride, rows) = (width + 2, height + 2);
        let mut cells = vec![false; stride * rows];
        cells
            .par_chunks_mut(stride)
            .enumerate()
            .filter(|(row, _)| (1..=height).contains(row))
            .for_each(|(row, cells)| {
                for (x, cell) in cells[1..=width].iter_mut().enumerate() {
                    *cell = is_in(x, row - 1);
                }
            });
        Self {
            stride,
            rows,
            cells,
        }
    }

    /// A picture's pixel by its number in the mask.
    pub(super) fn pixel(&self, cell: usize) -> (usize, usize) {
        (cell % self.stride - 1, cell / self.stride - 1)
    }

    /// The cell of a picture's pixel.
    pub(super) fn cell(&self, x: usize, y: usize) -> usize {
        (y + 1) * self.stride + x + 1
    }

    /// The cell in which a place lies, or the nearest of the picture.
    pub(super) fn cell_at(&self, place: DVec2) -> usize {
        let last = DVec2::new(self.stride as f64 - 3.0, self.rows as f64 - 3.0);
        let p = place.floor().clamp(DVec2::ZERO, last);
        self.cell(p.x as usize, p.y as usize)
    }

    /// The centre of a cell in pixels of the picture, y down.
    pub(super) fn centre(&self, cell: usize) -> DVec2 {
        let (x, y) = (cell % self.stride, cell / self.stride);
        DVec2::new(x as f64 - 0.5, y as f64 - 0.5)
    }

    /// What leads to the eight neighbours of a cell, counter-clockwise from the right, y down.
    pub(super) fn steps(&self) -> [isize; 8] {
        let row = self.stride as isize;
        [1, 1 - row, -row, -1 - row, -1, row - 1, row, row + 1]
    }

    /// Number of pixels in it.
    pub(super) fn count(&self) -> usize {
        self.cells.par_iter().filter(|cell| **cell).count()
    }

    /// Whether a cell belongs to the frame around the picture.
    pub(super) fn is_frame(&self, cell: usize) -> bool {
        let (x, y) = (cell % self.stride, cell / self.stride);
        x == 0 || y == 0 || x + 1 == self.stride || y + 1 == self.rows
    }
}

/// The cell a step away.
pub(super) fn beside(cell: usize, step: isize) -> usize {
    cell.wrapping_add_signed(step)
}
