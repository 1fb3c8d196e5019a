//! The sums of a film.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;
use thiserror::Error;

use super::batches::{OpenBatches, Squares, series_of};
use super::block::{BLOCK_SIDE, Block, Faults, MISSING_ONE};
use super::features::{Coverage, Sum, Words};
use super::halves::{self, Halves};
use super::moments::Moments;
use super::pixel::Pixel;

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
    pub(super) width: u32,
    pub(super) height: u32,
    /// Share of each channel in luminance.
    pub(super) luminance: Vec<f32>,
    /// For each block the number of samples of its pixels, rejected ones included.
    pub(super) drawn: Vec<u32>,
    /// The moments, one per channel for each pixel.
    pub(super) moments: Vec<Moments>,
    /// For each pixel the sums of the squares of the means of its batches, of luminance and of each
    /// channel.
    pub(super) squares: Vec<Squares>,
    /// For each block the batches of which it has some samples but not all; mostly none.
    pub(super) open: Vec<OpenBatches>,
    /// For each block the sums over both halves of its samples.
    pub(super) halves: Vec<Halves>,
    /// Layout of the remaining words of each pixel.
    pub(super) words: Words,
    pub(super) wide: Vec<i64>,
    pub(super) narrow: Vec<i32>,
    pub(super) faults: Faults,
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
        let bytes = pixels.saturating_mul(Self::bytes_per_pixel(channels, sums) as u64);
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
    pub fn bytes_per_pixel(channels: usize, sums: &[Sum]) -> usize {
        let features: usize = sums.iter().map(|sum| sum.bytes()).sum();
        channels * size_of::<Moments>()
            + series_of(channels) * size_of::<Squares>()
            + channels * (halves::BYTES / BLOCK_SIDE as usize)
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

    pub(super) fn blocks_across(&self) -> usize {
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
    pub(crate) fn pixels_of(&self, block: usize) -> u32 {
        let corner = [block % self.blocks_across(), block / self.blocks_across()]
            .map(|place| place as u32 * BLOCK_SIDE);
        BLOCK_SIDE.min(self.width - corner[0]) * BLOCK_SIDE.min(self.height - corner[1])
    }
}

/// The `count` entries of the pixel at a place.
fn of_place<T>(all: &[T], place: usize, count: usize) -> &[T] {
    &all[place * count..][..count]
}

/// The list in chunks of `size`; for an empty list `count` empty chunks.
pub(super) fn chunks_or_nothing<T>(all: &mut [T], size: usize, count: usize) -> Vec<&mut [T]> {
    let mut chunks: Vec<&mut [T]> = all.chunks_mut(size.max(1)).collect();
    chunks.resize_with(count, Default::default);
    chunks
}
