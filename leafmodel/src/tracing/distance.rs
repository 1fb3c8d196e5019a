//! The exact Euclidean distance from every pixel of a set to the nearest pixel outside of it.
//!
//! # Source
//!
//! \[felzenszwalb2012\]: lower envelopes of parabolas along rows. Distances along columns are
//! counted.

use rayon::prelude::*;

use super::grid::Mask;

/// The square of the distance between the centres of each cell and the nearest cell outside of the
/// set, in pixels; 0 outside. The frame is outside.
pub(super) fn squared_distances(set: &Mask) -> Vec<u32> {
    let stride = set.stride;
    // Down and up each column, a row at a time.
    let mut squares: Vec<u32> = vec![0; set.cells.len()];
    for row in 1..set.rows {
        let (before, here) = squares.split_at_mut(row * stride);
        let before = &before[(row - 1) * stride..];
        let cells = &set.cells[row * stride..];
        for ((here, before), cell) in here[..stride].iter_mut().zip(before).zip(cells) {
            *here = if *cell { before + 1 } else { 0 };
        }
    }
    for row in (0..set.rows - 1).rev() {
        let (here, after) = squares.split_at_mut((row + 1) * stride);
        let here = &mut here[row * stride..];
        for (here, after) in here.iter_mut().zip(&after[..stride]) {
            *here = (*here).min(after + 1);
        }
    }
    squares
        .par_chunks_mut(stride)
        .for_each_init(Envelope::default, |envelope, row| {
            envelope.transform(row);
        });
    squares
}

/// The lower envelope of parabolas over a row.
#[derive(Default)]
struct Envelope {
    /// Columns of the parabolas that take part, and their heights.
    roots: Vec<(usize, f64)>,
    /// From where on each is the lowest.
    starts: Vec<f64>,
}

impl Envelope {
    /// Turns distances along columns into squares of distances in the plane.
    fn transform(&mut self, row: &mut [u32]) {
        self.roots.clear();
        self.starts.clear();
        for (column, &height) in row.iter().enumerate() {
            let height = f64::from(height) * f64::from(height);
            let mut start = f64::NEG_INFINITY;
            while let Some(&(root, of_root)) = self.roots.last() {
                let (a, b) = (column as f64, root as f64);
                start = ((height + a * a) - (of_root + b * b)) / (2.0 * (a - b));
                if self.starts.last().is_some_and(|last| start > *last) {
                    break;
                }
                self.roots.pop();
                self.starts.pop();
                start = f64::NEG_INFINITY;
            }
            self.roots.push((column, height));
            self.starts.push(start);
        }
        let mut number = 0;
        for (column, square) in row.iter_mut().enumerate() {
            while self
                .starts
                .get(number + 1)
                .is_some_and(|start| *start < column as f64)
            {
                number += 1;
            }
            let (root, height) = self.roots[number];
            let aside = column as f64 - root as f64;
            *square = (aside * aside + height) as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(properties::fixed(64))]
        #[test]
        fn distances_are_those_of_a_search_through_all_pixels(
            bits in proptest::collection::vec(0_u8..8, 17 * 23),
        ) {
            let set = Mask::new(17, 23, |x, y| bits[17 * y + x] > 0);
            let found = squared_distances(&set);
            for (cell, &square) in found.iter().enumerate() {
                let place = |of: usize| ((of % set.stride) as i64, (of / set.stride) as i64);
                let (x, y) = place(cell);
                let outside = (0..set.cells.len()).filter(|&other| !set.cells[other]);
                let nearest = outside.map(place).map(|(a, b)| (a - x).pow(2) + (b - y).pow(2));
                prop_assert_eq!(i64::from(square), nearest.min().expect("the frame is outside"));
            }
        }
    }
}
