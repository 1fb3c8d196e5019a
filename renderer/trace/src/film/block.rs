//! Blocks of pixels: a block is exposed by one thread at a time, and its pixels get the same number
//! of samples.

use std::collections::BTreeMap;

use super::batches::{BATCH, OpenBatches, Part, Squares, fixed, series_of, square_of_mean};
use super::features::Words;
use super::fixed::{LONGEST_RUN, MOST_OF_RUN, Run};
use super::halves::{Halves, Stretch, octave_of};
use super::moments::Moments;

/// Units of what is missing in 1.
pub(super) const MISSING_ONE: f64 = 16_777_216.0;

/// Pixels along a block's sides; blocks at the right and lower border may have fewer.
pub const BLOCK_SIDE: u32 = 8;

/// Counts of rejected samples, clamped values and cut paths. All are rare, so nothing is stored for
/// pixels without any.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Faults {
    /// Number of rejected samples by the place of their pixel in the film.
    pub(super) rejected: BTreeMap<usize, u32>,
    /// Number of clamped values.
    pub(super) clamped: u64,
    /// Number of cut paths.
    pub(super) cut: u64,
    /// The most that is missing in all samples because of them, in units of 2⁻²⁴.
    pub(super) missing: u64,
}

impl Faults {
    pub(super) fn merge(&mut self, other: &Self) {
        for (&place, count) in &other.rejected {
            *self.rejected.entry(place).or_default() += count;
        }
        self.clamped += other.clamped;
        self.cut += other.cut;
        self.missing = self.missing.saturating_add(other.missing);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rejected.is_empty() && self.clamped == 0 && self.cut == 0
    }
}

/// A block that is being exposed. All its pixels have the same number of samples.
#[derive(Debug)]
pub struct Block<'a> {
    /// Its number in the film, row by row from the top.
    pub(super) number: usize,
    /// Column of its first pixel.
    pub(super) x: u32,
    /// Row of its first pixel.
    pub(super) y: u32,
    /// Pixels across.
    pub(super) width: u32,
    /// Place of its first pixel in the film.
    pub(super) place: usize,
    /// Share of each channel in luminance.
    pub(super) luminance: &'a [f32],
    pub(super) drawn: &'a mut u32,
    pub(super) moments: &'a mut [Moments],
    /// By pixel, and within each by the numbers of which batches are kept.
    pub(super) squares: &'a mut [Squares],
    pub(super) words: &'a Words,
    pub(super) wide: &'a mut [i64],
    pub(super) narrow: &'a mut [i32],
    pub(super) open: &'a mut OpenBatches,
    pub(super) halves: &'a mut Halves,
    pub(super) faults: Faults,
}

impl Block<'_> {
    /// Its number in the film, row by row from the top.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Number of pixels.
    pub fn pixels(&self) -> u32 {
        (self.moments.len() / self.luminance.len()) as u32
    }

    /// Adds the next `samples` of every pixel: `expose` is called with column, row and the pixel's
    /// sums, to which it must add as many samples, of the same numbers in the same order for every
    /// pixel.
    pub fn expose(&mut self, samples: u32, mut expose: impl FnMut(u32, u32, &mut PixelSums<'_>)) {
        let words = self.words;
        let mut runs = vec![Run::default(); self.luminance.len()];
        let mut sums = vec![0; series_of(self.luminance.len())];
        let mut stretch_sums = vec![0; self.luminance.len()];
        let rows = (self.pixels() / self.width) as usize;
        let places = self
            .moments
            .chunks_exact_mut(self.luminance.len())
            .zip(self.narrow.chunks_exact_mut(words.narrow));
        for (within, (moments, narrow)) in (0_u32..).zip(places) {
            let mut pixel = PixelSums {
                luminance: self.luminance,
                moments,
                runs: &mut runs,
                run_length: 0,
                squares: &mut *self.squares,
                open: &mut *self.open,
                part: Part::default(),
                sums: &mut sums,
                halves: &mut *self.halves,
                stretch: Stretch::default(),
                stretch_sums: &mut stretch_sums,
                within: within as usize,
                row: (within / self.width) as usize,
                rows,
                words,
                wide: &mut self.wide[within as usize * words.wide..][..words.wide],
                narrow,
                rejected: 0,
                clamped: 0,
                cut: 0,
                missing: 0,
            };
            let (column, row) = (within % self.width, within / self.width);
            expose(self.x + column, self.y + row, &mut pixel);
            pixel.end_runs();
            pixel.end_part();
            pixel.end_stretch();
            self.faults.clamped += pixel.clamped;
            self.faults.cut += pixel.cut;
            self.faults.missing = self.faults.missing.saturating_add(pixel.missing);
            if pixel.rejected > 0 {
                let place = self.place + within as usize;
                *self.faults.rejected.entry(place).or_default() += pixel.rejected;
            }
        }
        self.open.close(self.squares);
        *self.drawn += samples;
    }
}

/// The sums of a pixel, to which samples are added.
#[derive(Debug)]
pub struct PixelSums<'a> {
    luminance: &'a [f32],
    moments: &'a mut [Moments],
    /// The last ordinary values of each channel, not yet in its moments.
    runs: &'a mut [Run],
    /// Number of values in each of them.
    run_length: u32,
    /// Those of the whole block.
    squares: &'a mut [Squares],
    open: &'a mut OpenBatches,
    /// The samples of the present batch, and their sums.
    part: Part,
    sums: &'a mut [i64],
    halves: &'a mut Halves,
    /// The samples of the present octave, and their sums.
    stretch: Stretch,
    stretch_sums: &'a mut [i64],
    /// The pixel's place in the block, its row, and the number of rows.
    within: usize,
    row: usize,
    rows: usize,
    words: &'a Words,
    wide: &'a mut [i64],
    narrow: &'a mut [i32],
    rejected: u32,
    clamped: u64,
    cut: u64,
    missing: u64,
}

impl PixelSums<'_> {
    /// Adds sample number `number`: a value for each channel, and the features of the camera ray's
    /// hit, if there is one; numbers beyond the film's features are ignored.
    ///
    /// A sample with a number that is not finite is rejected whole and counted; a channel's value
    /// beyond ±2³⁰ is clamped and counted.
    #[inline]
    pub fn add<const F: usize>(
        &mut self,
        number: u32,
        values: &[f32],
        features: Option<&[f32; F]>,
    ) {
        debug_assert_eq!(values.len(), self.moments.len(), "a value a channel");
        // Whether all numbers are what they should be is computed without a branch for each.
        let ordinary = (values.iter()).fold(true, |all, value| all & (value.abs() <= MOST_OF_RUN));
        let finite = (ordinary || values.iter().all(|value| value.is_finite()))
            && features.is_none_or(|features| {
                (features.iter()).fold(true, |all, number| all & number.is_finite())
            });
        let batch = number / BATCH;
        if batch != self.part.number {
            self.end_part();
            self.part.number = batch;
        }
        self.part.count += 1;
        let octave = octave_of(number);
        if octave != self.stretch.octave {
            self.end_stretch();
            self.stretch.octave = octave;
        }
        self.stretch.count += 1;
        if !finite {
            self.rejected += 1;
            return;
        }
        let shares = values.iter().zip(self.luminance);
        if let Some((luminance, channels)) = self.sums.split_first_mut() {
            let of_sample = fixed(shares.map(|(value, share)| value * share).sum());
            *luminance += of_sample;
            if channels.is_empty() {
                self.stretch_sums[0] = self.stretch_sums[0].wrapping_add(of_sample);
            }
            let sums = channels.iter_mut().zip(&mut *self.stretch_sums);
            for ((sum, of_stretch), &value) in sums.zip(values) {
                let value = fixed(value);
                *sum += value;
                *of_stretch = of_stretch.wrapping_add(value);
            }
        }
        if ordinary {
            if self.run_length == LONGEST_RUN {
                self.end_runs();
            }
            self.run_length += 1;
            for (run, &value) in self.runs.iter_mut().zip(values) {
                run.add(value);
            }
        } else {
            for (moments, &value) in self.moments.iter_mut().zip(values) {
                self.clamped += u64::from(moments.add(value));
            }
        }
        if let Some(features) = features {
            debug_assert!(self.words.features() <= F, "a number for each feature");
            self.words.add(number, features, self.wide, self.narrow);
        }
    }

    /// Counts paths of a sample that were cut, without which it misses at most this much of a channel.
    #[cold]
    pub(crate) fn add_cut(&mut self, paths: u32, missing: f64) {
        self.cut += u64::from(paths);
        // Rounded up, and the greatest number if it does not fit.
        let units = (missing * MISSING_ONE).ceil() as u64;
        self.missing = self.missing.saturating_add(units);
    }

    /// Adds the last ordinary values to the moments.
    fn end_runs(&mut self) {
        for (moments, run) in self.moments.iter_mut().zip(&mut *self.runs) {
            moments.add_run(&std::mem::take(run));
        }
        self.run_length = 0;
    }

    /// Adds the samples of the present batch to what the block has of it.
    fn end_part(&mut self) {
        let part = std::mem::take(&mut self.part);
        if part.count == BATCH {
            let squares = &mut self.squares[self.within * self.sums.len()..];
            for (square, &sum) in squares.iter_mut().zip(&*self.sums) {
                square.add(square_of_mean(sum));
            }
        } else if part.count > 0 {
            let count = self.squares.len();
            self.open.add(part, self.sums, self.within, count);
        }
        self.sums.fill(0);
    }

    /// Adds the samples of the present octave to the block's halves.
    fn end_stretch(&mut self) {
        let stretch = std::mem::take(&mut self.stretch);
        if stretch.count > 0 {
            let (place, count) = ((self.within, self.row), self.rows * self.stretch_sums.len());
            self.halves.add(stretch, self.stretch_sums, place, count);
            self.stretch_sums.fill(0);
        }
    }
}
