//! Sum and sum of squares of one channel of one pixel.

use super::fixed::{MOST, ONE, Run, value_and_square};

/// First two moments of a channel's samples, in units of 2⁻⁶⁴.
///
/// Integer addition is associative, so parts of a picture merge to the same bits in any order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moments {
    /// Sum of the samples.
    sum: i128,
    /// Sum of their squares; saturates if, for example, values beyond 2²⁷ occur a thousand times.
    squares: u128,
}

impl Moments {
    /// Adds a finite value; returns whether it had to be clamped to ±2³⁰.
    #[inline]
    pub fn add(&mut self, value: f32) -> bool {
        let taken = value.clamp(-MOST, MOST);
        let (sum, square) = value_and_square(taken);
        self.sum += sum;
        self.squares = self.squares.saturating_add(square);
        taken != value
    }

    /// Adds the values of a run.
    #[inline]
    pub(super) fn add_run(&mut self, run: &Run) {
        let (sum, squares) = run.sums();
        self.sum += sum;
        self.squares = self.squares.saturating_add(squares);
    }

    /// The bits of both sums, as they are stored.
    pub(super) fn bits(&self) -> [i128; 2] {
        [self.sum, self.squares as i128]
    }

    /// Adds one of the [bits](Self::bits) of another: sum 0 or 1.
    #[inline]
    pub(super) fn add_bits(&mut self, number: usize, bits: i128) {
        if number == 0 {
            // Bytes from a file may hold anything.
            self.sum = self.sum.wrapping_add(bits);
        } else {
            self.squares = self.squares.saturating_add(bits as u128);
        }
    }

    /// Whether the squares did not fit.
    pub(super) fn overflows(&self) -> bool {
        self.squares == u128::MAX
    }

    /// Sum of the samples.
    pub fn sum(&self) -> f64 {
        self.sum as f64 / ONE
    }

    /// Mean over `samples` samples; 0 without any.
    pub fn mean(&self, samples: u32) -> f64 {
        if samples == 0 {
            0.0
        } else {
            self.sum() / f64::from(samples)
        }
    }

    /// Unbiased sample variance over `samples`, the number of samples; 0 below two, infinite if the
    /// squares did not fit.
    ///
    /// Low-discrepancy samples are spread more evenly than independent ones, so this overestimates
    /// the error: batches know better.
    pub fn variance_of_mean(&self, samples: u32) -> f64 {
        if samples < 2 {
            return 0.0;
        }
        if self.overflows() {
            return f64::INFINITY;
        }
        let count = f64::from(samples);
        let mean = self.mean(samples);
        let square = self.squares as f64 / ONE / count;
        (square - mean * mean).max(0.0) / (count - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_variance_are_those_of_the_samples() {
        let (mut rising, mut constant) = (Moments::default(), Moments::default());
        for i in 0..100 {
            rising.add(i as f32);
            constant.add(0.25);
        }
        assert!((rising.mean(100) - 49.5).abs() < 1e-12);
        // Variance of 0 … 99 with n − 1 is 841.666…; of the mean a hundredth of that.
        assert!((rising.variance_of_mean(100) - 8.416_666_666).abs() < 1e-6);
        assert_eq!(constant.mean(100), 0.25);
        assert_eq!(constant.variance_of_mean(100), 0.0);
    }

    #[test]
    fn a_huge_value_is_clamped_and_says_so() {
        let mut moments = Moments::default();
        assert!(moments.add(1e30));
        assert!(!moments.add(3.0));
        assert_eq!(moments.sum(), f64::from(MOST) + 3.0);
    }

    #[test]
    fn squares_that_no_longer_fit_stay_at_the_most() {
        let mut moments = Moments::default();
        for _ in 0..100 {
            moments.add(MOST);
        }
        assert_eq!(moments.squares, u128::MAX);
        assert!(moments.overflows() && moments.variance_of_mean(100).is_infinite());
        assert_eq!(moments.mean(100), f64::from(MOST));
    }
}
