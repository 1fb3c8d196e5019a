//! Random numbers and what is drawn with them.
//!
//! A random number is a function of (seed, pixel, sample, dimension): no generator's state passes from
//! one sample to the next, so pictures do not depend on threads, tiles or interruptions.

pub mod distribution;
pub mod stream;
pub mod warp;
