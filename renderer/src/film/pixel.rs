//! A pixel's sums, read.

use super::features::{Coverage, Words};
use super::moments::Moments;

/// Sums of one pixel.
#[derive(Clone, Copy, Debug)]
pub struct Pixel<'a> {
    pub(super) moments: &'a [Moments],
    pub(super) words: &'a Words,
    pub(super) wide: &'a [i64],
    pub(super) narrow: &'a [i32],
    pub(super) samples: u32,
}

impl Pixel<'_> {
    /// Samples that count: without those that were rejected.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Number of channels.
    pub fn channels(&self) -> usize {
        self.moments.len()
    }

    /// What is kept of a channel's samples.
    pub fn moments(&self, channel: usize) -> &Moments {
        &self.moments[channel]
    }

    /// Mean of a channel; 0 without samples.
    pub fn mean(&self, channel: usize) -> f64 {
        self.moments[channel].mean(self.samples)
    }

    /// Share of all samples that met something.
    pub fn alpha(&self) -> f64 {
        f64::from(Coverage::of(self.narrow).covered()) / f64::from(self.samples.max(1))
    }

    /// A feature by its number: the mean over the covered ones of the first
    /// [`super::FEATURE_SAMPLES`] samples, or what sample 0 met; none where none of these samples
    /// is covered.
    pub fn feature(&self, number: usize) -> Option<f64> {
        self.words.feature(number, self.wide, self.narrow)
    }
}
