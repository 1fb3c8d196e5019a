//! Batches: aligned runs of a pixel's samples, whose means show the error of its luminance and of each
//! of its channels.
//!
//! Low-discrepancy samples fill the gaps between earlier ones, so they are no independent draws and
//! their own variance overestimates the error. Samples 16 k to 16 k + 15 are spread evenly among
//! themselves, and different k differ almost independently: means of batches show what the mean of
//! all still varies by. Luminance is added up sample by sample, so it also counts that errors of
//! channels partly cancel.
//!
//! - **In**: luminances of samples and their channels, by number, in any order and grouping.
//! - **Out**: the sum of the squares of the means of whole batches; sums of those that are not.
//! - **Always true**: only integers are stored, so parts merge to the same bits in any order.
//! - **Left out**: the mean itself, which follows from the channels.

use super::fixed::nearest;

/// Number of samples of a batch: enough for most of what low discrepancy gains, few enough that
/// a picture of some dozens of samples has several.
pub const BATCH: u32 = 16;

/// Fraction bits of the luminance of a sample, and of a sum of them.
const FRACTION_BITS: i32 = 32;
/// Units of a sample's luminance in 1.
const ONE: f64 = 4_294_967_296.0;
/// Greatest luminance of a sample in these units: ±2¹⁸.
const MOST: f64 = (1_i64 << 50) as f64;
/// Fraction bits of the sum of squares of means.
const SQUARE_BITS: i32 = 44;
/// Luminance below which the variance of a pixel is not known: the square of a mean is then less than
/// 2000 units, and what differs between batches of low noise is lost in their rounding.
pub const LEAST_LUMINANCE: f64 = 1e-5;

/// A sample's luminance in units of 2⁻³², rounded to the nearest and at most ±2¹⁸.
#[inline]
pub(super) fn fixed(luminance: f32) -> i64 {
    nearest(luminance, ONE, MOST)
}

/// Luminance of a sum of samples.
pub(super) fn sum_of(fixed: i64) -> f64 {
    fixed as f64 / ONE
}

/// Numbers of a sample of which batches are kept: its luminance, then its channels; a single channel
/// is luminance.
pub(super) const fn series_of(channels: usize) -> usize {
    if channels == 1 { 1 } else { 1 + channels }
}

/// A sum of squares of means, in units of 2⁻⁴⁴. It saturates just below 2¹².
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Squares([u8; 7]);

impl Squares {
    const MOST: u64 = (1 << 56) - 1;

    /// The sum in its units.
    pub(super) fn bits(self) -> u64 {
        let [a, b, c, d, e, f, g] = self.0;
        u64::from_le_bytes([a, b, c, d, e, f, g, 0])
    }

    pub(super) fn add(&mut self, bits: u64) {
        let sum = self.bits().saturating_add(bits).min(Self::MOST);
        let [bytes @ .., _] = sum.to_le_bytes();
        self.0 = bytes;
    }

    /// The sum; `None` if it is beyond what is stored.
    pub(super) fn sum(self) -> Option<f64> {
        let bits = self.bits();
        (bits < Self::MOST).then(|| bits as f64 / (1_u64 << SQUARE_BITS) as f64)
    }
}

/// The square of the mean of a whole batch with this sum, in units of 2⁻⁴⁴, rounded.
pub(super) fn square_of_mean(sum: i64) -> u64 {
    const BELOW: i32 = 2 * (FRACTION_BITS + BATCH.trailing_zeros() as i32) - SQUARE_BITS;
    let sum = u128::from(sum.unsigned_abs());
    let square = (sum * sum + (1 << (BELOW - 1))) >> BELOW;
    square.min(u128::from(u64::MAX)) as u64
}

/// A batch of which a block's pixels have some samples, but not all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Open {
    /// Its number.
    pub(super) number: u32,
    /// Number of samples that a pixel has of it, 1 to 15, rejected ones included.
    pub(super) count: u32,
    /// The sums of these samples' numbers for each pixel of the block.
    pub(super) sums: Vec<i64>,
}

/// The open batches of a block, by number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct OpenBatches(Vec<Open>);

impl OpenBatches {
    pub(super) fn iter(&self) -> impl ExactSizeIterator<Item = &Open> {
        self.0.iter()
    }

    /// Number of samples of a pixel in open batches.
    pub(super) fn samples(&self) -> u32 {
        self.0.iter().map(|open| open.count).sum()
    }

    /// Sum of a number of a pixel in open batches, by its place in the block.
    pub(super) fn sum(&self, place: usize) -> f64 {
        let sums = self.0.iter().map(|open| sum_of(open.sums[place]));
        sums.sum()
    }

    /// The batch of this number in a block of so many sums.
    fn of(&mut self, number: u32, count: usize) -> &mut Open {
        let found = self.0.binary_search_by_key(&number, |open| open.number);
        let place = found.unwrap_or_else(|place| {
            let open = Open {
                number,
                count: 0,
                sums: vec![0; count],
            };
            self.0.insert(place, open);
            place
        });
        &mut self.0[place]
    }

    /// Adds one pixel's part of a batch to a block of so many sums. Samples are counted once for all
    /// pixels of a block, by the first one.
    pub(super) fn add(&mut self, part: Part, sums: &[i64], within: usize, count: usize) {
        let open = self.of(part.number, count);
        let own = &mut open.sums[within * sums.len()..][..sums.len()];
        for (own, sum) in own.iter_mut().zip(sums) {
            *own += sum;
        }
        if within == 0 {
            open.count += part.count;
        }
    }

    /// Adds a part of a batch that all pixels of a block have.
    pub(super) fn add_all(&mut self, number: u32, count: u32, sums: &[i64]) {
        let open = self.of(number, sums.len());
        open.count = open.count.saturating_add(count);
        for (own, other) in open.sums.iter_mut().zip(sums) {
            // Bytes from a file may hold anything.
            *own = own.saturating_add(*other);
        }
    }

    /// Turns batches that are whole now into squares of their means.
    pub(super) fn close(&mut self, squares: &mut [Squares]) {
        self.0.retain(|open| {
            if open.count < BATCH {
                return true;
            }
            for (square, &sum) in squares.iter_mut().zip(&open.sums) {
                square.add(square_of_mean(sum));
            }
            false
        });
    }
}

/// A pixel's samples of one batch.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Part {
    pub(super) number: u32,
    /// Number of samples, rejected ones included.
    pub(super) count: u32,
}

/// Variance of the mean of a number over `samples` samples of a pixel, from the sum of the squares of
/// the means of `batches` whole batches and the mean over these; `None` if there are fewer than
/// two, or no samples.
pub(super) fn variance_of_mean(squares: f64, batches: u32, mean: f64, samples: u32) -> Option<f64> {
    if batches < 2 || samples == 0 {
        return None;
    }
    let count = f64::from(batches);
    let of_batch = (squares - count * mean * mean).max(0.0) / (count - 1.0);
    Some(of_batch * f64::from(BATCH) / f64::from(samples))
}

/// A number whose mean and variance a film knows for each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Series {
    /// The sum of the channels by their shares.
    Luminance,
    /// A channel.
    Channel(usize),
}

impl Series {
    /// What sums of batches and halves hold of 1 of it: a single channel is kept as luminance.
    pub(super) fn scale(self, luminance: &[f32]) -> f64 {
        match (self, luminance) {
            (Self::Channel(_), [share]) => f64::from(*share),
            (Self::Channel(_) | Self::Luminance, _) => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square_of(sum: i64) -> Option<f64> {
        let mut squares = Squares::default();
        squares.add(square_of_mean(sum));
        squares.sum()
    }

    #[test]
    fn squares_are_those_of_double_precision() {
        for luminance in [0.0, 1e-4, 0.25, -0.25, 3.0, 17.5, 60.0] {
            let sum = i64::from(BATCH) * fixed(luminance);
            let expected = f64::from(luminance) * f64::from(luminance);
            let found = square_of(sum).expect("it is small");
            let rounding = 1e-15 + expected * 1e-5 * f64::from(luminance.abs() < 1e-3);
            assert!(
                (found - expected).abs() <= rounding + expected * 1e-9,
                "{luminance}: {found}, not {expected}"
            );
        }
    }

    #[test]
    fn what_is_too_bright_is_not_reported() {
        for luminance in [300.0, 1e9, -1e30] {
            let sum = i64::from(BATCH) * fixed(luminance);
            assert_eq!(square_of(sum), None, "{luminance}");
        }
    }

    #[test]
    fn variance_is_that_of_the_batches() {
        // Means 1, 2, 3, 4: variance 5/3 with n − 1, of the mean a quarter of that.
        let found = variance_of_mean(30.0, 4, 2.5, 64).expect("there are four");
        assert!((found - 5.0 / 12.0).abs() < 1e-15, "{found}");
        // A few more samples that are no whole batch make the mean better by their share.
        let found = variance_of_mean(30.0, 4, 2.5, 72).expect("there are four");
        assert!((found - 5.0 / 12.0 * 64.0 / 72.0).abs() < 1e-15, "{found}");
        assert_eq!(variance_of_mean(1.0, 1, 1.0, 16), None);
    }
}
