//! Reading access to a pixel's sums.

use super::batches::{BATCH, OpenBatches, Series, Squares, variance_of_mean};
use super::features::{Coverage, Words};
use super::moments::Moments;

/// Sums of one pixel.
#[derive(Clone, Copy, Debug)]
pub struct Pixel<'a> {
    pub(super) luminance: &'a [f32],
    pub(super) moments: &'a [Moments],
    /// The sums of squares of the means of its batches, of luminance and of each channel.
    pub(super) squares: &'a [Squares],
    /// The open batches of its block, and its place there.
    pub(super) open: &'a OpenBatches,
    pub(super) within: usize,
    pub(super) words: &'a Words,
    pub(super) wide: &'a [i64],
    pub(super) narrow: &'a [i32],
    /// Number of samples, rejected ones included.
    pub(super) drawn: u32,
    /// Number without them.
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

    /// Mean of luminance; 0 without samples.
    pub fn luminance(&self) -> f64 {
        let shares = self.moments.iter().zip(self.luminance);
        let shares = shares.map(|(moments, &share)| moments.mean(self.samples) * f64::from(share));
        shares.sum()
    }

    /// Mean of a number; 0 without samples.
    pub(super) fn mean_of(&self, series: Series) -> f64 {
        match series {
            Series::Luminance => self.luminance(),
            Series::Channel(channel) => self.mean(channel),
        }
    }

    /// Variance of the mean of a number by this pixel alone: that of means of batches, which counts what
    /// low discrepancy gains within them and, in luminance, how errors of channels cancel.
    ///
    /// Below two whole batches, and where it is too great to be stored, it is an upper bound: that of
    /// single samples, in luminance with all channels' errors alike. 0 below two samples.
    pub(super) fn variance(&self, series: Series) -> f64 {
        match series {
            Series::Luminance => {
                let sum = self.luminance() * f64::from(self.samples);
                self.variance_of_batches(0, sum)
                    .unwrap_or_else(|| self.greatest_variance_of_luminance())
            }
            Series::Channel(channel) => {
                let moments = &self.moments[channel];
                let scale = series.scale(self.luminance);
                let number = if self.squares.len() == 1 {
                    0
                } else {
                    1 + channel
                };
                self.variance_of_batches(number, scale * moments.sum())
                    .filter(|_| scale > 0.0)
                    .map_or_else(
                        || moments.variance_of_mean(self.samples),
                        |variance| variance / (scale * scale),
                    )
            }
        }
    }

    /// Variance of the mean of a number of which batches are kept, whose sum over all samples is
    /// `sum`.
    fn variance_of_batches(&self, number: usize, sum: f64) -> Option<f64> {
        let in_batches = self.drawn - self.open.samples();
        let open = self.open.sum(self.within * self.squares.len() + number);
        let mean = (sum - open) / f64::from(in_batches);
        let squares = self.squares[number].sum()?;
        variance_of_mean(squares, in_batches / BATCH, mean, self.samples)
    }

    fn greatest_variance_of_luminance(&self) -> f64 {
        let shares = self.moments.iter().zip(self.luminance);
        let deviation: f64 = shares
            .map(|(moments, &share)| {
                f64::from(share) * moments.variance_of_mean(self.samples).sqrt()
            })
            .sum();
        deviation * deviation
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
