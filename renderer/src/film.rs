//! The film: sums of samples, from which means and variances are computed.
//!
//! - **In**: samples, block of pixels by block: each has a value per channel and, if the camera ray
//!   hit something, a number per feature.
//! - **Out**: mean and variance of the mean per pixel and channel, and of luminance; coverage, and
//!   means of features over covered samples.
//! - **Always true**: sums are integers, so they do not depend on the order or grouping in which
//!   samples arrive; a sample with a number that is not finite is rejected whole and counted, one
//!   beyond ±2³⁰ is clamped and counted, and so are paths that a limit cut. All pixels of a block have the same number of samples.
//! - **Memory**: per pixel 32 bytes for each channel, 7 for the error of each and of luminance, 4 for
//!   coverage, and 8 or 4 for each feature, depending on its [`Sum`].
//! - **Left out**: the meaning of channels and features, which the film's creator defines.
//!
//! ```
//! use renderer::film::Film;
//!
//! // One channel, which is luminance, no features: eight samples of each pixel, half of them 1,
//! // half 2.
//! let mut film = Film::new(16, 16, &[1.0], &[])?;
//! film.expose(|block| {
//!     block.expose(8, |_x, _y, pixel| {
//!         for number in 0..8 {
//!             let radiance = if number % 2 == 0 { 1.0 } else { 2.0 };
//!             pixel.add(number, &[radiance], None::<&[f32; 0]>);
//!         }
//!     });
//! });
//! assert_eq!(film.pixel(3, 4).mean(0), 1.5);
//! # Ok::<(), renderer::film::FilmError>(())
//! ```

mod batches;
mod block;
mod features;
mod fixed;
mod halves;
mod moments;
mod packed;
mod pixel;
#[cfg(test)]
mod tests;
mod variance;

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;
use thiserror::Error;

pub use batches::{BATCH, LEAST_LUMINANCE};
pub use block::{BLOCK_SIDE, Block, PixelSums};
pub use features::{FEATURE_SAMPLES, Sum};
pub use fixed::MOST as MOST_RADIANCE;
pub use moments::Moments;
pub use packed::{DamagedRow, RowSums};
pub use pixel::Pixel;
pub use variance::Series;

use batches::{OpenBatches, Squares, series_of};
use block::{Faults, MISSING_ONE};
use features::{Coverage, Words};
use halves::Halves;

/// Greatest number of pixels of a film.
pub const MOST_PIXELS: u64 = 1 << 28;
/// Most samples of a pixel.
pub const MOST_SAMPLES: u32 = 1_048_576;
/// Greatest memory of a film, bytes.
pub const MOST_BYTES: u64 = 8 << 30;

/// Why a film cannot be made.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum FilmError {
    /// It has no pixels or channels.
    #[error("a film of {width} × {height} pixels and {channels} channels is empty")]
    Empty {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Number of channels.
        channels: usize,
    },
    /// It would be too large.
    #[error(
        "a film of {width} × {height} pixels and {channels} channels needs {:.1} GiB, and a film may have {} GiB and \
         {MOST_PIXELS} pixels at most: make `size` smaller",
        *bytes as f64 / f64::from(1 << 30),
        MOST_BYTES >> 30
    )]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Number of channels.
        channels: usize,
        /// Memory that it would need.
        bytes: u64,
    },
}

/// Sums for every pixel.
///
/// Each kind of sum is one array in the order of blocks, within a block row by row, so that pixels
/// exposed together are contiguous.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    /// Share of each channel in luminance.
    luminance: Vec<f32>,
    /// For each block the number of samples of its pixels, rejected ones included.
    drawn: Vec<u32>,
    /// The moments, one per channel for each pixel.
    moments: Vec<Moments>,
    /// For each pixel the sums of the squares of the means of its batches, of luminance and of each
    /// channel.
    squares: Vec<Squares>,
    /// For each block the batches of which it has some samples but not all; mostly none.
    open: Vec<OpenBatches>,
    /// For each block the sums over both halves of its samples.
    halves: Vec<Halves>,
    /// Layout of the remaining words of each pixel.
    words: Words,
    wide: Vec<i64>,
    narrow: Vec<i32>,
    faults: Faults,
}

impl Film {
    /// An empty film with a channel for each number of `luminance`, its share in luminance; `sums`
    /// says how each feature is kept.
    ///
    /// # Errors
    ///
    /// [`FilmError`] if it has no pixels or channels, or would be too large.
    pub fn new(
        width: u32,
        height: u32,
        luminance: &[f32],
        sums: &[Sum],
    ) -> Result<Self, FilmError> {
        let channels = luminance.len();
        Self::bytes(width, height, channels, sums)?;
        let pixels = width as usize * height as usize;
        let words = Words::new(sums);
        let blocks = width.div_ceil(BLOCK_SIDE) as usize * height.div_ceil(BLOCK_SIDE) as usize;
        Ok(Self {
            width,
            height,
            luminance: luminance.to_vec(),
            drawn: vec![0; blocks],
            moments: vec![Moments::default(); pixels * channels],
            squares: vec![Squares::default(); pixels * series_of(channels)],
            open: vec![OpenBatches::default(); blocks],
            halves: vec![Halves::default(); blocks],
            wide: vec![0; pixels * words.wide],
            narrow: vec![0; pixels * words.narrow],
            words,
            faults: Faults::default(),
        })
    }

    /// Memory of a film, bytes.
    ///
    /// # Errors
    ///
    /// As [`Film::new`].
    pub fn bytes(width: u32, height: u32, channels: usize, sums: &[Sum]) -> Result<u64, FilmError> {
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 || channels == 0 {
            return Err(FilmError::Empty {
                width,
                height,
                channels,
            });
        }
        let bytes = pixels.saturating_mul(Self::bytes_a_pixel(channels, sums) as u64);
        if pixels > MOST_PIXELS || bytes > MOST_BYTES {
            return Err(FilmError::TooLarge {
                width,
                height,
                channels,
                bytes,
            });
        }
        Ok(bytes)
    }

    /// Memory of a pixel, bytes; each block needs 68 more, and for each open batch eight per pixel for
    /// luminance and for each channel.
    pub fn bytes_a_pixel(channels: usize, sums: &[Sum]) -> usize {
        let features: usize = sums.iter().map(|sum| sum.bytes()).sum();
        channels * size_of::<Moments>()
            + series_of(channels) * size_of::<Squares>()
            + channels * halves::BYTES
            + Coverage::BYTES
            + features
    }

    /// Pixels across.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Number of channels.
    pub fn channels(&self) -> usize {
        self.luminance.len()
    }

    /// The sums of a pixel.
    ///
    /// # Panics
    ///
    /// If it is outside the film.
    pub fn pixel(&self, x: u32, y: u32) -> Pixel<'_> {
        assert!(
            x < self.width && y < self.height,
            "the pixel is on the film"
        );
        let (column, row) = (x / BLOCK_SIDE, y / BLOCK_SIDE);
        let block = row as usize * self.blocks_across() + column as usize;
        let width = BLOCK_SIDE.min(self.width - column * BLOCK_SIDE) as usize;
        let within = (y % BLOCK_SIDE) as usize * width + (x % BLOCK_SIDE) as usize;
        let place = self.first_of(block) + within;
        let rejected = self.faults.rejected.get(&place).copied().unwrap_or(0);
        Pixel {
            luminance: &self.luminance,
            moments: of_place(&self.moments, place, self.channels()),
            squares: of_place(&self.squares, place, series_of(self.channels())),
            open: &self.open[block],
            within,
            words: &self.words,
            wide: of_place(&self.wide, place, self.words.wide),
            narrow: of_place(&self.narrow, place, self.words.narrow),
            drawn: self.drawn[block],
            samples: self.drawn[block] - rejected,
        }
    }

    /// Applies `of` to every pixel, row by row from the top, on the current thread pool.
    pub fn map<T: Send>(&self, of: impl Fn(&Pixel<'_>) -> T + Sync) -> Vec<T> {
        let width = self.width as usize;
        (0..width * self.height as usize)
            .into_par_iter()
            .with_min_len(width)
            .map(|place| of(&self.pixel((place % width) as u32, (place / width) as u32)))
            .collect()
    }

    /// One channel's means; 0 where no sample fell.
    pub fn mean(&self, channel: usize) -> Vec<f32> {
        self.map(|pixel| pixel.mean(channel) as f32)
    }

    /// Lets `expose` add samples to every block, on the current thread pool. The result does not
    /// depend on which thread exposes a block.
    pub fn expose(&mut self, expose: impl Fn(&mut Block<'_>) + Sync) {
        let (width, height, channels) = (self.width, self.height, self.channels());
        let (across, words, luminance) = (self.blocks_across(), &self.words, &self.luminance[..]);
        let series = series_of(channels);
        let row_pixels = (BLOCK_SIDE * width) as usize;
        let rows = self.drawn.len() / across;
        let faults = Mutex::new(Faults::default());
        let rows = self
            .drawn
            .par_chunks_mut(across)
            .zip(self.open.par_chunks_mut(across))
            .zip(self.halves.par_chunks_mut(across))
            .zip(self.moments.par_chunks_mut(row_pixels * channels))
            .zip(self.squares.par_chunks_mut(row_pixels * series))
            .zip(chunks_or_nothing(
                &mut self.wide,
                row_pixels * words.wide,
                rows,
            ))
            .zip(self.narrow.par_chunks_mut(row_pixels * words.narrow));
        rows.enumerate().for_each(
            |(row, ((((((drawn, open), halves), moments), squares), wide), narrow))| {
                let y = row as u32 * BLOCK_SIDE;
                let pixels = (BLOCK_SIDE * BLOCK_SIDE.min(height - y)) as usize;
                let blocks = drawn
                    .par_iter_mut()
                    .zip(open)
                    .zip(halves)
                    .zip(moments.par_chunks_mut(pixels * channels))
                    .zip(squares.par_chunks_mut(pixels * series))
                    .zip(chunks_or_nothing(wide, pixels * words.wide, across))
                    .zip(narrow.par_chunks_mut(pixels * words.narrow));
                blocks.enumerate().for_each(
                    |(column, ((((((drawn, open), halves), moments), squares), wide), narrow))| {
                        let x = column as u32 * BLOCK_SIDE;
                        let mut block = Block {
                            number: row * across + column,
                            x,
                            y,
                            width: BLOCK_SIDE.min(width - x),
                            place: row * row_pixels + column * pixels,
                            luminance,
                            drawn,
                            moments,
                            squares,
                            words,
                            wide,
                            narrow,
                            open,
                            halves,
                            faults: Faults::default(),
                        };
                        expose(&mut block);
                        if !block.faults.is_empty() {
                            let mut all = faults.lock().unwrap_or_else(PoisonError::into_inner);
                            all.merge(&block.faults);
                        }
                    },
                );
            },
        );
        let found = faults.into_inner().unwrap_or_else(PoisonError::into_inner);
        self.faults.merge(&found);
    }

    /// Adds another film's samples. Sums add up exactly. The films should have no sample in common.
    ///
    /// # Panics
    ///
    /// If the films have different sizes, or features that are kept differently.
    pub fn merge(&mut self, other: &Self) {
        let size = |film: &Self| (film.width, film.height, film.channels());
        assert_eq!(size(self), size(other), "films of one size are merged");
        assert_eq!(
            self.words, other.words,
            "films of the same features are merged"
        );
        merge_each(&mut self.drawn, &other.drawn, |own, other| *own += other);
        merge_each(&mut self.moments, &other.moments, Moments::merge);
        merge_each(&mut self.squares, &other.squares, |own, other| {
            own.add(other.bits());
        });
        merge_each(&mut self.halves, &other.halves, Halves::merge);
        merge_each(&mut self.wide, &other.wide, |own, other| *own += other);
        merge_each(&mut self.narrow, &other.narrow, |own, other| *own += other);
        for block in 0..self.open.len() {
            self.open[block].merge(&other.open[block]);
            let series = series_of(self.channels());
            let (first, pixels) = (self.first_of(block), self.pixels_of(block) as usize);
            self.open[block].close(&mut self.squares[first * series..][..pixels * series]);
        }
        self.faults.merge(&other.faults);
    }

    /// Number of samples that were rejected because a value was not finite.
    pub fn rejected(&self) -> u64 {
        let counts = self.faults.rejected.values();
        counts.map(|&count| u64::from(count)).sum()
    }

    /// Number of values that were clamped.
    pub fn clamped(&self) -> u64 {
        self.faults.clamped
    }

    /// Number of paths that a limit cut.
    pub fn cut(&self) -> u64 {
        self.faults.cut
    }

    /// The most that a channel misses because of them, on average over all samples; infinite if that
    /// is more than can be stored.
    pub fn missing(&self) -> f64 {
        if self.faults.missing == u64::MAX {
            return f64::INFINITY;
        }
        self.faults.missing as f64 / MISSING_ONE / self.drawn().max(1) as f64
    }

    /// Number of a pixel's channels whose values are so great that the sum of their squares is not
    /// known, and neither is their variance.
    pub fn overflowed(&self) -> u64 {
        let overflowed = self.moments.par_iter().filter(|one| one.overflows());
        overflowed.count() as u64
    }

    /// Number of samples drawn, rejected ones included.
    pub fn drawn(&self) -> u64 {
        let blocks = (0..).zip(&self.drawn);
        blocks
            .map(|(block, &drawn)| u64::from(drawn) * u64::from(self.pixels_of(block)))
            .sum()
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.drawn.len()
    }

    /// Number of samples of each pixel of a block, rejected ones included.
    ///
    /// # Panics
    ///
    /// If there is no such block.
    pub fn drawn_of(&self, block: usize) -> u32 {
        self.drawn[block]
    }

    /// Fewest and most samples of a pixel, rejected ones included.
    pub fn drawn_range(&self) -> [u32; 2] {
        let fewest = self.drawn.iter().copied().min();
        let most = self.drawn.iter().copied().max();
        [fewest, most].map(|count| count.expect("a film has a pixel"))
    }

    fn blocks_across(&self) -> usize {
        self.width.div_ceil(BLOCK_SIDE) as usize
    }

    /// Place of a block's first pixel.
    fn first_of(&self, block: usize) -> usize {
        let (column, row) = (block % self.blocks_across(), block / self.blocks_across());
        let side = BLOCK_SIDE as usize;
        let height = side.min(self.height as usize - row * side);
        row * side * self.width as usize + column * side * height
    }

    /// Number of pixels of a block; blocks are counted row by row from the top.
    pub fn pixels_of(&self, block: usize) -> u32 {
        let corner = [block % self.blocks_across(), block / self.blocks_across()]
            .map(|place| place as u32 * BLOCK_SIDE);
        BLOCK_SIDE.min(self.width - corner[0]) * BLOCK_SIDE.min(self.height - corner[1])
    }
}

/// The `count` entries of the pixel at a place.
fn of_place<T>(all: &[T], place: usize, count: usize) -> &[T] {
    &all[place * count..][..count]
}

/// Adds to each entry of `own` the entry of `others` at the same place.
fn merge_each<T: Send + Sync>(own: &mut [T], others: &[T], add: impl Fn(&mut T, &T) + Sync) {
    own.par_iter_mut()
        .zip(others)
        .with_min_len(4096)
        .for_each(|(own, other)| add(own, other));
}

/// The list in chunks of `size`; for an empty list `count` empty chunks.
fn chunks_or_nothing<T>(all: &mut [T], size: usize, count: usize) -> Vec<&mut [T]> {
    let mut chunks: Vec<&mut [T]> = all.chunks_mut(size.max(1)).collect();
    chunks.resize_with(count, Default::default);
    chunks
}
