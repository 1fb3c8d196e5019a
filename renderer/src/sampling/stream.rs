//! Owen-scrambled Sobol points, padded four dimensions at a time.

use std::sync::LazyLock;

use sobol_burley::parts::{
    Int4, hash, hash_int4, owen_scramble_int4_rev, owen_scramble_rev, sobol_int4_rev,
};

/// The random numbers of one sample of one pixel.
///
/// Each call takes the next four dimensions: a Sobol set with its own scramble, evenly spread over
/// the samples of the pixel and independent of the other sets (padding; Burley, JCGT 9(4), 2020).
/// After 65 536 samples the scramble changes.
#[derive(Clone, Debug)]
pub struct Stream {
    pixel: u32,
    index: u32,
    set: u32,
}

/// Base-2 logarithm of the number of samples after which the underlying sequence is exhausted and
/// reseeded.
const PERIOD_BITS: u32 = 16;
/// The last index of that sequence.
const LAST_INDEX: u32 = (1 << PERIOD_BITS) - 1;

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
            index: sample & LAST_INDEX,
            set: 0,
        }
    }

    /// The next four numbers, each in [0, 1).
    pub fn next4(&mut self) -> [f32; 4] {
        let seed = mix(self.pixel ^ self.set.wrapping_mul(0x85eb_ca6b));
        self.set += 1;
        four(self.index, seed)
    }

    /// Stream number `number` of `of` streams that replace this one. The streams of all samples of
    /// a pixel together are as evenly spread as those of `of` times as many samples.
    #[must_use]
    pub fn part(&self, number: u32, of: u32) -> Self {
        let index = self.index * of + number;
        let period = index >> PERIOD_BITS;
        let pixel = if period == 0 {
            self.pixel
        } else {
            mix(self.pixel ^ period.wrapping_mul(0xc2b2_ae35))
        };
        Self {
            pixel,
            index: index & LAST_INDEX,
            set: self.set,
        }
    }

    /// Jumps to set number `set`, so that numbers left unused by one event do not shift those of
    /// the next.
    pub fn seek(&mut self, set: u32) {
        self.set = set;
    }
}

/// Sobol's first four dimensions, bits reversed, for indices with bits in their first byte only and
/// in their second byte only.
static SOBOL: LazyLock<[[[u32; 4]; 256]; 2]> = LazyLock::new(|| {
    let of = |byte: u32, shift: u32| sobol_int4_rev(byte << shift, 0).into();
    [24, 16].map(|shift| std::array::from_fn(|byte| of(byte as u32, shift)))
});

/// The numbers of `sobol_burley::sample_4d(index, 0, seed)`, whose loop over the bits of the index
/// is replaced by two look-ups: a Sobol point is linear in them.
fn four(index: u32, seed: u32) -> [f32; 4] {
    let shuffled = owen_scramble_rev(index.reverse_bits(), hash(seed ^ 0x79c6_8e4a));
    let [first, second] = &*SOBOL;
    let [high, low, ..] = shuffled.to_be_bytes();
    let point = Int4::from(first[usize::from(high)]) ^ Int4::from(second[usize::from(low)]);
    let scrambles = Int4::from([0x912f_69ba, 0x174f_18ab, 0x691e_72ca, 0xb40c_c1b8])
        ^ Int4::from([seed.wrapping_mul(0x9c8f_2d3b); 4]);
    owen_scramble_int4_rev(point, hash_int4(scrambles))
        .reverse_bits()
        .to_f32_norm()
}

/// A bijective 32-bit mixer with good avalanche (constants of Wellons' hash prospector,
/// "lowbias32").
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
    fn points_are_those_of_the_library() {
        for index in (0..1 << PERIOD_BITS).step_by(7) {
            let seed = mix(index);
            assert_eq!(
                four(index, seed),
                sobol_burley::sample_4d(index, 0, seed),
                "point {index}, seed {seed}"
            );
        }
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
    fn four_parts_of_sixteen_samples_fall_into_sixty_four_strata() {
        for dimension in 0..4 {
            let mut strata = [0; 64];
            for (sample, number) in
                (0..16).flat_map(|sample| (0..4).map(move |part| (sample, part)))
            {
                let mut stream = Stream::new(1, 2, 3, sample).part(number, 4);
                strata[(stream.next4()[dimension] * 64.0) as usize] += 1;
            }
            assert_eq!(strata, [1; 64], "dimension {dimension}");
        }
    }

    #[test]
    fn the_only_part_is_the_stream_and_parts_beyond_the_period_are_new() {
        let whole = Stream::new(1, 2, 3, LAST_INDEX);
        assert_eq!(whole.part(0, 1).next4(), whole.clone().next4());
        let first = Stream::new(1, 2, 3, 0).part(0, 2).next4();
        let beyond = Stream::new(1, 2, 3, 1 << (PERIOD_BITS - 1))
            .part(0, 2)
            .next4();
        assert_ne!(first, beyond);
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
