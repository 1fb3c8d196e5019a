//! Radiance in, means and variances out.
//!
//! - **In**: samples, each a value per channel, pixel by pixel.
//! - **Out**: mean and variance of the mean per pixel and channel.
//! - **Always true**: sums are integers, so they do not depend on the order or grouping in which samples arrive; a
//!   sample with a value that is not finite is rejected whole and counted, one beyond ±2³⁰ is clamped and counted.

pub mod accumulator;

use rayon::prelude::*;
use thiserror::Error;

pub use accumulator::Accumulator;

/// Most pixels of a film.
pub const MOST_PIXELS: u64 = 1 << 28;
/// Most memory of a film, bytes.
pub const MOST_BYTES: u64 = 8 << 30;

/// Why there is no such film.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum FilmError {
    /// Nothing to record on.
    #[error("a film of {width} × {height} pixels and {channels} channels is empty")]
    Empty {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Values a pixel.
        channels: usize,
    },
    /// It would not fit.
    #[error(
        "a film of {width} × {height} pixels and {channels} channels needs {bytes} bytes, more than {MOST_BYTES} \
         (or has more than {MOST_PIXELS} pixels)"
    )]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Values a pixel.
        channels: usize,
        /// What it would take.
        bytes: u64,
    },
}

/// Sums for every pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    width: u32,
    height: u32,
    channels: usize,
    pixels: Vec<Accumulator>,
}

impl Film {
    /// An empty film.
    ///
    /// # Errors
    ///
    /// [`FilmError`] if it has no pixels or channels, or would be too large.
    pub fn new(width: u32, height: u32, channels: usize) -> Result<Self, FilmError> {
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 || channels == 0 {
            return Err(FilmError::Empty {
                width,
                height,
                channels,
            });
        }
        let bytes = pixels.saturating_mul(Accumulator::bytes(channels) as u64);
        if pixels > MOST_PIXELS || bytes > MOST_BYTES {
            return Err(FilmError::TooLarge {
                width,
                height,
                channels,
                bytes,
            });
        }
        let pixels = vec![Accumulator::new(channels); pixels as usize];
        Ok(Self {
            width,
            height,
            channels,
            pixels,
        })
    }

    /// Pixels across.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Values a pixel.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// The pixels, row by row from the top.
    pub fn pixels(&self) -> &[Accumulator] {
        &self.pixels
    }

    /// Lets `expose` add samples to every pixel, spread over the current thread pool: it is called with column, row and
    /// the pixel's sums. Which thread exposes a pixel does not show.
    pub fn expose(&mut self, expose: impl Fn(u32, u32, &mut Accumulator) + Sync) {
        // Short runs of pixels: neighbours share what is in the cache, threads end together.
        const RUN: usize = 16;
        let width = self.width as usize;
        self.pixels
            .par_chunks_mut(RUN)
            .enumerate()
            .for_each(|(run, pixels)| {
                for (offset, pixel) in pixels.iter_mut().enumerate() {
                    let place = run * RUN + offset;
                    expose((place % width) as u32, (place / width) as u32, pixel);
                }
            });
    }

    /// Adds another film's samples.
    ///
    /// # Panics
    ///
    /// If the films have different sizes.
    pub fn merge(&mut self, other: &Self) {
        assert_eq!(
            (self.width, self.height, self.channels),
            (other.width, other.height, other.channels),
            "films of one size are merged"
        );
        for (own, others) in self.pixels.iter_mut().zip(&other.pixels) {
            own.merge(others);
        }
    }

    /// One channel's means, row by row from the top; 0 where no sample fell.
    pub fn mean(&self, channel: usize) -> Vec<f32> {
        self.pixels
            .iter()
            .map(|pixel| pixel.mean(channel) as f32)
            .collect()
    }

    /// One channel's variances of the mean, as if samples were independent; 0 below two samples.
    ///
    /// Low-discrepancy samples spread better than independent ones, so this is an upper estimate of the error.
    pub fn variance_of_mean(&self, channel: usize) -> Vec<f32> {
        self.pixels
            .iter()
            .map(|pixel| pixel.variance_of_mean(channel) as f32)
            .collect()
    }

    /// Samples that were rejected because a value was not finite.
    pub fn rejected(&self) -> u64 {
        self.pixels
            .iter()
            .map(|pixel| u64::from(pixel.rejected()))
            .sum()
    }

    /// Values that were clamped.
    pub fn clamped(&self) -> u64 {
        self.pixels
            .iter()
            .map(|pixel| u64::from(pixel.clamped()))
            .sum()
    }

    /// Samples that count.
    pub fn samples(&self) -> u64 {
        self.pixels
            .iter()
            .map(|pixel| u64::from(pixel.samples()))
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_that_would_not_fit_is_refused_with_its_size() {
        assert!(matches!(
            Film::new(1 << 20, 1 << 20, 3),
            Err(FilmError::TooLarge { .. })
        ));
        assert!(matches!(
            Film::new(u32::MAX, u32::MAX, 32),
            Err(FilmError::TooLarge { .. })
        ));
        assert!(matches!(Film::new(0, 5, 3), Err(FilmError::Empty { .. })));
    }

    #[test]
    fn every_pixel_is_exposed_once_at_its_own_place() {
        let mut film = Film::new(37, 23, 2).expect("a small film");
        film.expose(|x, y, pixel| pixel.add(&[x as f32, y as f32]));
        for (place, pixel) in film.pixels().iter().enumerate() {
            assert_eq!(pixel.mean(0), (place % 37) as f64);
            assert_eq!(pixel.mean(1), (place / 37) as f64);
            assert_eq!(pixel.samples(), 1);
        }
    }
}
