//! Owen-scrambled Sobol points, padded four dimensions at a time.

/// The random numbers of one sample of one pixel.
///
/// Each call takes the next four dimensions: a Sobol set of its own scramble, well spread over the samples of the
/// pixel, independent of the other sets (padding; Burley, JCGT 9(4), 2020). After 65 536 samples the
/// scramble changes.
#[derive(Clone, Debug)]
pub struct Stream {
    pixel: u32,
    index: u32,
    set: u32,
}

/// Samples after which the underlying sequence is exhausted and reseeded.
const PERIOD_BITS: u32 = 16;

impl Stream {
    /// The stream of sample number `sample` of pixel (`x`, `y`).
    pub fn new(seed: u64, x: u32, y: u32, sample: u32) -> Self {
        let period = sample >> PERIOD_BITS;
        let mut pixel = mix(seed as u32 ^ 0x9e37_79b9);
        pixel = mix(pixel ^ (seed >> 32) as u32);
        for word in [x, y, period] {
            pixel = mix(pixel ^ word);
        }
        Self {
            pixel,
            index: sample & ((1 << PERIOD_BITS) - 1),
            set: 0,
        }
    }

    /// The next four numbers, each in [0, 1).
    pub fn next4(&mut self) -> [f32; 4] {
        let seed = mix(self.pixel ^ self.set.wrapping_mul(0x85eb_ca6b));
        self.set += 1;
        sobol_burley::sample_4d(self.index, 0, seed)
    }

    /// The stream of a path that goes on beside others from one vertex: the same as this one for the first, number 0, else with
    /// sets of its own.
    #[must_use]
    pub fn branch(&self, number: u32) -> Self {
        let pixel = if number == 0 {
            self.pixel
        } else {
            mix(self.pixel ^ number.wrapping_mul(0xc2b2_ae35))
        };
        Self { pixel, ..*self }
    }

    /// Goes to set number `set`, so that what one event leaves unused does not shift the next one's numbers.
    pub fn seek(&mut self, set: u32) {
        self.set = set;
    }
}

/// A bijective 32-bit mixer with good avalanche (constants of Wellons' hash prospector, "lowbias32").
fn mix(mut x: u32) -> u32 {
    x = x.wrapping_add(0x6a09_e667);
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_depends_on_seed_pixel_sample_and_dimension_alone() {
        let mut first = Stream::new(7, 3, 4, 5);
        first.next4();
        let second_set = first.next4();
        let mut again = Stream::new(7, 3, 4, 5);
        again.seek(1);
        assert_eq!(again.next4(), second_set);
        assert_ne!(
            Stream::new(8, 3, 4, 5).next4(),
            Stream::new(7, 3, 4, 5).next4()
        );
        assert_ne!(
            Stream::new(7, 4, 3, 5).next4(),
            Stream::new(7, 3, 4, 5).next4()
        );
        assert_ne!(
            Stream::new(7, 3, 4, 5 + 65_536).next4(),
            Stream::new(7, 3, 4, 5).next4()
        );
    }

    #[test]
    fn sixteen_samples_fall_into_sixteen_strata_of_every_dimension() {
        for set in 0..5 {
            for dimension in 0..4 {
                let mut strata = [0; 16];
                for sample in 0..16 {
                    let mut stream = Stream::new(1, 2, 3, sample);
                    stream.seek(set);
                    strata[(stream.next4()[dimension] * 16.0) as usize] += 1;
                }
                assert_eq!(strata, [1; 16], "set {set}, dimension {dimension}");
            }
        }
    }

    #[test]
    fn neighbouring_pixels_and_sets_are_uncorrelated() {
        let (mut pixels, mut sets) = (0.0, 0.0);
        let count = 20_000;
        for i in 0..count {
            let mut a = Stream::new(0, i, 0, 0);
            let mut b = Stream::new(0, i + 1, 0, 0);
            let (first, second) = (a.next4(), a.next4());
            pixels += f64::from((first[0] - 0.5) * (b.next4()[0] - 0.5));
            sets += f64::from((first[1] - 0.5) * (second[1] - 0.5));
        }
        // A product of two centred uniform numbers has standard deviation 1/12.
        let sigma = 1.0 / 12.0 / f64::from(count).sqrt();
        for sum in [pixels, sets] {
            let mean = sum / f64::from(count);
            assert!(mean.abs() < 4.0 * sigma, "{mean} is {} sigma", mean / sigma);
        }
    }
}
