//! Reading access to a pixel's sums.

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
    /// Number of samples without rejected ones.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Number of channels.
    pub fn channels(&self) -> usize {
        self.moments.len()
    }

    /// The moments of a channel.
    pub fn moments(&self, channel: usize) -> &Moments {
        &self.moments[channel]
    }

    /// Mean of a channel; 0 without samples.
    pub fn mean(&self, channel: usize) -> f64 {
        self.moments[channel].mean(self.samples)
    }

    /// Share of samples that hit something.
    pub fn alpha(&self) -> f64 {
        f64::from(Coverage::of(self.narrow).covered()) / f64::from(self.samples.max(1))
    }

    /// A feature by its number: the mean over the covered ones of the first
    /// [`super::FEATURE_SAMPLES`] samples, or the number of sample 0; `None` if none of these
    /// samples is covered.
    pub fn feature(&self, number: usize) -> Option<f64> {
        self.words.feature(number, self.wide, self.narrow)
    }
}
