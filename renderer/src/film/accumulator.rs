//! One pixel's sums.

/// Fixed point of sums and of sums of squares: 2⁶⁴ to one. (With less, the variance of dim pixels would vanish; squares
/// saturate where a value beyond 2²⁷ comes a thousand times.)
const SCALE: f64 = 18_446_744_073_709_551_616.0;
/// Values beyond this are clamped: 2³³ samples of it still fit.
const MOST: f32 = 1_073_741_824.0;

/// Sums and sums of squares of a pixel's samples, as 128-bit integers.
///
/// Integer addition is associative, so parts of a picture merge to the same bits in any order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Accumulator {
    /// Per channel the sum and the sum of squares.
    sums: Box<[[i128; 2]]>,
    samples: u32,
    rejected: u32,
    clamped: u32,
}

impl Accumulator {
    /// Without samples.
    pub fn new(channels: usize) -> Self {
        Self {
            sums: vec![[0; 2]; channels].into(),
            samples: 0,
            rejected: 0,
            clamped: 0,
        }
    }

    /// Memory of one, bytes.
    pub fn bytes(channels: usize) -> usize {
        size_of::<Self>() + channels * size_of::<[i128; 2]>()
    }

    /// Adds a sample, a value for each channel.
    pub fn add(&mut self, values: &[f32]) {
        debug_assert_eq!(
            values.len(),
            self.sums.len(),
            "a sample has a value for each channel"
        );
        if !values.iter().all(|value| value.is_finite()) {
            self.rejected += 1;
            return;
        }
        self.samples += 1;
        for (sums, &value) in self.sums.iter_mut().zip(values) {
            let clamped = value.clamp(-MOST, MOST);
            self.clamped += u32::from(clamped != value);
            let value = f64::from(clamped);
            sums[0] += (value * SCALE) as i128;
            sums[1] = sums[1].saturating_add((value * value * SCALE) as i128);
        }
    }

    /// Adds another one's samples.
    pub fn merge(&mut self, other: &Self) {
        for (own, others) in self.sums.iter_mut().zip(&other.sums) {
            own[0] += others[0];
            own[1] = own[1].saturating_add(others[1]);
        }
        self.samples += other.samples;
        self.rejected += other.rejected;
        self.clamped += other.clamped;
    }

    /// Samples that count.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Samples with a value that was not finite.
    pub fn rejected(&self) -> u32 {
        self.rejected
    }

    /// Values that were clamped.
    pub fn clamped(&self) -> u32 {
        self.clamped
    }

    /// Sum of a channel.
    pub fn sum(&self, channel: usize) -> f64 {
        self.sums[channel][0] as f64 / SCALE
    }

    /// Mean of a channel; 0 without samples.
    pub fn mean(&self, channel: usize) -> f64 {
        if self.samples == 0 {
            0.0
        } else {
            self.sum(channel) / f64::from(self.samples)
        }
    }

    /// Unbiased sample variance over the number of samples; 0 below two samples.
    pub fn variance_of_mean(&self, channel: usize) -> f64 {
        if self.samples < 2 {
            return 0.0;
        }
        let count = f64::from(self.samples);
        let mean = self.mean(channel);
        let square = self.sums[channel][1] as f64 / SCALE / count;
        (square - mean * mean).max(0.0) / (count - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn samples_in_any_order_and_grouping_give_the_same_bits(
            values in prop::collection::vec(-1e4_f32..1e6, 2..60),
            cut in 0_usize..60,
        ) {
            let mut whole = Accumulator::new(1);
            let (mut first, mut second) = (Accumulator::new(1), Accumulator::new(1));
            for (i, value) in values.iter().enumerate() {
                whole.add(&[*value]);
                if i < cut { first.add(&[*value]) } else { second.add(&[*value]) }
            }
            second.merge(&first);
            prop_assert_eq!(&whole, &second);
            let mut backwards = Accumulator::new(1);
            values.iter().rev().for_each(|value| backwards.add(&[*value]));
            prop_assert_eq!(&whole, &backwards);
        }
    }

    #[test]
    fn mean_and_variance_are_those_of_the_samples() {
        let mut sums = Accumulator::new(2);
        for i in 0..100 {
            sums.add(&[i as f32, 0.25]);
        }
        assert!((sums.mean(0) - 49.5).abs() < 1e-12);
        // Variance of 0 … 99 with n − 1 is 841.666…; of the mean a hundredth of that.
        assert!((sums.variance_of_mean(0) - 8.416_666_666).abs() < 1e-6);
        assert_eq!(sums.mean(1), 0.25);
        assert_eq!(sums.variance_of_mean(1), 0.0);
    }

    #[test]
    fn a_sample_that_is_not_finite_is_rejected_whole_and_a_huge_one_clamped() {
        let mut sums = Accumulator::new(2);
        sums.add(&[1.0, f32::NAN]);
        sums.add(&[f32::INFINITY, 1.0]);
        sums.add(&[3.0, 1e30]);
        assert_eq!((sums.samples(), sums.rejected(), sums.clamped()), (1, 2, 1));
        assert_eq!(sums.mean(0), 3.0);
        assert_eq!(sums.mean(1), f64::from(MOST));
    }
}
