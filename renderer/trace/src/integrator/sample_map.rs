//! Samples by a map: how many each block of pixels gets is known before the render.
//!
//! - **In**: numbers of samples by pixel, as a picture's layer `samples.Y` has them.
//! - **Out**: for each block the number of samples at which it stops: the most of its pixels.
//! - **Always true**: nothing that is rendered changes these numbers. So, other than with a target
//!   noise ([`crate::integrator::noise`]), they say nothing of how bright a block came out, if the
//!   map was made without its samples.

use std::sync::Arc;

use thiserror::Error;

use crate::film::{BLOCK_SIDE, MOST_SAMPLES};

/// Numbers of samples by block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SampleMap {
    /// In the film's order of blocks.
    of_block: Arc<[u32]>,
}

/// Why numbers are no map of samples.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "{value} at x = {x}, y = {y} is no number of samples: from 0 to {MOST_SAMPLES}, and at least 1 \
     in each block of 8 × 8 pixels"
)]
pub struct SampleMapError {
    /// Pixel from the left.
    pub x: u32,
    /// Pixel from the top.
    pub y: u32,
    /// What stands there; of a block without samples 0 at its first pixel.
    pub value: f32,
}

impl SampleMap {
    /// A map of `values` by row and column, of pictures with `width` pixels across; what is not
    /// whole is rounded up.
    ///
    /// # Errors
    ///
    /// [`SampleMapError`] with the first value that is no number of samples.
    pub fn new(width: u32, values: &[f32]) -> Result<Self, SampleMapError> {
        let across = width.div_ceil(BLOCK_SIDE) as usize;
        let height = values.len() / width as usize;
        let mut of_block = vec![0; across * height.div_ceil(BLOCK_SIDE as usize)];
        for (number, &value) in (0_u32..).zip(values) {
            let (x, y) = (number % width, number / width);
            if !(0.0..=MOST_SAMPLES as f32).contains(&value) {
                return Err(SampleMapError { x, y, value });
            }
            let block = (y / BLOCK_SIDE) as usize * across + (x / BLOCK_SIDE) as usize;
            of_block[block] = value.ceil().max(of_block[block] as f32) as u32;
        }
        if let Some(block) = of_block.iter().position(|&samples| samples == 0) {
            let [x, y] = [block % across, block / across].map(|at| at as u32 * BLOCK_SIDE);
            return Err(SampleMapError { x, y, value: 0.0 });
        }
        Ok(Self {
            of_block: of_block.into(),
        })
    }

    /// The most samples of any block.
    pub fn most(&self) -> u32 {
        self.of_block.iter().copied().max().unwrap_or(0)
    }

    /// Number of samples at which a block stops.
    pub fn goal(&self, block: usize) -> u32 {
        self.of_block[block]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map of three by two blocks, those at the right and below of fewer pixels.
    fn values() -> (u32, Vec<f32>) {
        (2 * BLOCK_SIDE + 3, vec![1.0; (2 * 8 + 3) * (8 + 2)])
    }

    #[test]
    fn a_block_gets_the_most_that_any_of_its_pixels_names() {
        let (width, mut values) = values();
        values[3] = 31.2;
        values[5] = 30.0;
        // The last pixel, in the smallest block.
        *values.last_mut().expect("there are some") = 7.0;
        let map = SampleMap::new(width, &values).expect("it is a map");
        let goals = [0, 1, 2, 3, 4, 5].map(|block| map.goal(block));
        assert_eq!((goals, map.most()), ([32, 1, 1, 1, 1, 7], 32));
    }

    #[test]
    fn what_is_no_number_of_samples_is_reported_by_its_place() {
        let (width, values) = values();
        for wrong in [-1.0, f32::NAN, f32::INFINITY, 1_048_577.0] {
            let mut values = values.clone();
            values[width as usize + 2] = wrong;
            let error = SampleMap::new(width, &values).expect_err("it is none");
            assert_eq!((error.x, error.y), (2, 1), "{error}");
        }
        let mut values = values;
        for y in 0..8 {
            values[(y * width + 8) as usize..(y * width + 16) as usize].fill(0.0);
        }
        let error = SampleMap::new(width, &values).expect_err("a block has no samples");
        assert_eq!((error.x, error.y, error.value), (8, 0, 0.0));
    }
}
