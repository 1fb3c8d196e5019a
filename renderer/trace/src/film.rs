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
//! use trace::film::Film;
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
//! # Ok::<(), trace::film::FilmError>(())
//! ```

mod batches;
mod block;
mod features;
mod fixed;
mod halves;
mod moments;
mod packed;
mod pixel;
mod sums;
#[cfg(test)]
mod tests;
mod variance;

pub use self::batches::{BATCH, LEAST_LUMINANCE, Series};
pub use self::block::{BLOCK_SIDE, Block, PixelSums};
pub use self::features::{FEATURE_SAMPLES, Sum};
pub use self::fixed::MOST as MOST_RADIANCE;
pub use self::moments::Moments;
pub use self::packed::{DamagedRow, RowSums};
pub use self::pixel::Pixel;
pub use self::sums::{Film, FilmError, MOST_BYTES, MOST_PIXELS, MOST_SAMPLES};
