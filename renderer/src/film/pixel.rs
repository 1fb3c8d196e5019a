//! A pixel's sums, read.

use super::features::{Albedos, Positions, Surface};
use super::moments::Moments;

/// Sums of one pixel. Features are means over the covered ones of its first [`super::FEATURE_SAMPLES`] samples, and 0
/// where none is covered.
#[derive(Clone, Copy, Debug)]
pub struct Pixel<'a> {
    pub(super) moments: &'a [Moments],
    pub(super) position: &'a Positions,
    pub(super) surface: &'a Surface,
    pub(super) albedo: Option<&'a Albedos>,
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

    /// Mean of a channel; 0 without samples.
    pub fn mean(&self, channel: usize) -> f64 {
        self.moments[channel].mean(self.samples)
    }

    /// Unbiased sample variance of a channel over the number of samples; 0 below two samples.
    pub fn variance_of_mean(&self, channel: usize) -> f64 {
        self.moments[channel].variance_of_mean(self.samples)
    }

    /// Share of all samples that met something.
    pub fn alpha(&self) -> f64 {
        f64::from(self.surface.coverage().covered()) / f64::from(self.samples.max(1))
    }

    /// Mean point, world, m; none where nothing is covered.
    pub fn position(&self) -> Option<[f64; 3]> {
        let recorded = self.surface.coverage().recorded();
        (recorded > 0).then(|| self.position.mean(recorded))
    }

    /// Mean normal, world; shorter than 1 where normals differ.
    pub fn normal(&self) -> [f64; 3] {
        self.over_recorded(|_| self.surface.mean_normal())
    }

    /// Mean albedo, linear sRGB; 0 on films without.
    pub fn albedo(&self) -> [f64; 3] {
        self.over_recorded(|count| self.albedo.map_or([0.0; 3], |albedo| albedo.mean(count)))
    }

    /// Number + 1 of the object that the pixel's first sample met, 0 for none.
    pub fn object(&self) -> u32 {
        self.surface.object()
    }

    fn over_recorded(&self, mean: impl Fn(u32) -> [f64; 3]) -> [f64; 3] {
        match self.surface.coverage().recorded() {
            0 => [0.0; 3],
            count => mean(count),
        }
    }
}
