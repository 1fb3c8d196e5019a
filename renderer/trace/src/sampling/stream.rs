//! Owen-scrambled Sobol points, padded four dimensions at a time.

use std::cell::Cell;
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
pub struct Stream<'p> {
    pixel: u32,
    index: u32,
    set: u32,
    /// What is kept for this pixel.
    scrambles: Option<&'p Scrambles>,
}

/// Base-2 logarithm of the number of samples after which the underlying sequence is exhausted and
/// reseeded.
const PERIOD_BITS: u32 = 16;
/// The last index of that sequence.
const LAST_INDEX: u32 = (1 << PERIOD_BITS) - 1;

/// Number of sets whose scrambles are kept: those of the first seven vertices.
const KEPT: usize = 16;

/// Where the samples of one pixel come from: keeps what their random numbers share.
#[derive(Debug)]
pub struct Pixel {
    seed: u64,
    place: [u32; 2],
    /// Number of samples before this one, in whole periods.
    period: u32,
    hash: u32,
    scrambles: Scrambles,
}

impl Pixel {
    /// Pixel (`x`, `y`), of which samples from number `first` on are asked for.
    pub fn new(seed: u64, x: u32, y: u32, first: u32) -> Self {
        let period = first >> PERIOD_BITS;
        Self {
            seed,
            place: [x, y],
            period,
            hash: hash_of_pixel(seed, [x, y], period),
            scrambles: Scrambles::default(),
        }
    }

    /// The stream of sample number `sample`.
    #[inline]
    pub fn stream(&self, sample: u32) -> Stream<'_> {
        let [x, y] = self.place;
        if sample >> PERIOD_BITS != self.period {
            return Stream::new(self.seed, x, y, sample);
        }
        Stream {
            pixel: self.hash,
            index: sample & LAST_INDEX,
            set: 0,
            scrambles: Some(&self.scrambles),
        }
    }
}

/// The scrambles of the first sets of one pixel, each made when it is first asked for.
#[derive(Debug, Default)]
struct Scrambles {
    kept: [Cell<Scramble>; KEPT],
    /// A bit for each that was made.
    made: Cell<u32>,
}

impl Scrambles {
    #[inline]
    fn of(&self, pixel: u32, set: u32) -> Scramble {
        let Some(place) = self.kept.get(set as usize) else {
            return Scramble::new(pixel, set);
        };
        if self.made.get() >> set & 1 == 0 {
            place.set(Scramble::new(pixel, set));
            self.made.set(self.made.get() | 1 << set);
        }
        place.get()
    }
}

impl Stream<'_> {
    /// The stream of sample number `sample` of pixel (`x`, `y`).
    pub fn new(seed: u64, x: u32, y: u32, sample: u32) -> Self {
        Self {
            pixel: hash_of_pixel(seed, [x, y], sample >> PERIOD_BITS),
            index: sample & LAST_INDEX,
            set: 0,
            scrambles: None,
        }
    }

    /// The next four numbers, each in [0, 1).
    pub fn next4(&mut self) -> [f32; 4] {
        let scramble = match self.scrambles {
            Some(scrambles) => scrambles.of(self.pixel, self.set),
            None => Scramble::new(self.pixel, self.set),
        };
        self.set += 1;
        scramble.four(self.index)
    }

    /// Stream number `number` of `of` streams that replace this one. The streams of all samples of
    /// a pixel together are as evenly spread as those of `of` times as many samples.
    #[must_use]
    pub fn part(&self, number: u32, of: u32) -> Self {
        let index = self.index * of + number;
        let period = index >> PERIOD_BITS;
        let (pixel, scrambles) = if period == 0 {
            (self.pixel, self.scrambles)
        } else {
            (mix(self.pixel ^ period.wrapping_mul(0xc2b2_ae35)), None)
        };
        Self {
            pixel,
            index: index & LAST_INDEX,
            set: self.set,
            scrambles,
        }
    }

    /// The stream of walk number `number` that begins within this one: all its sets are others.
    #[must_use]
    pub fn nested(&self, number: u32) -> Self {
        let own = number.wrapping_add(1).wrapping_mul(0x27d4_eb2f);
        Self {
            pixel: mix(self.pixel.rotate_left(16) ^ own),
            index: self.index,
            set: 0,
            scrambles: None,
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

fn hash_of_pixel(seed: u64, [x, y]: [u32; 2], period: u32) -> u32 {
    let mut pixel = mix(seed as u32 ^ 0x9e37_79b9);
    pixel = mix(pixel ^ (seed >> 32) as u32);
    for word in [x, y, period] {
        pixel = mix(pixel ^ word);
    }
    pixel
}

/// How one set of four dimensions of a pixel is scrambled.
#[derive(Clone, Copy, Debug, Default)]
struct Scramble {
    /// Of the order of the points.
    order: u32,
    /// Of each dimension.
    values: [u32; 4],
}

impl Scramble {
    fn new(pixel: u32, set: u32) -> Self {
        Self::of_seed(mix(pixel ^ set.wrapping_mul(0x85eb_ca6b)))
    }

    /// That of `sobol_burley::sample_4d` with this seed.
    fn of_seed(seed: u32) -> Self {
        let values = Int4::from([0x912f_69ba, 0x174f_18ab, 0x691e_72ca, 0xb40c_c1b8])
            ^ Int4::from([seed.wrapping_mul(0x9c8f_2d3b); 4]);
        Self {
            order: hash(seed ^ 0x79c6_8e4a),
            values: hash_int4(values).into(),
        }
    }

    /// The numbers of `sobol_burley::sample_4d(index, 0, seed)`, whose loop over the bits of the
    /// index is replaced by two look-ups: a Sobol point is linear in them.
    #[inline]
    fn four(&self, index: u32) -> [f32; 4] {
        let shuffled = owen_scramble_rev(index.reverse_bits(), self.order);
        let [first, second] = &*SOBOL;
        let [high, low, ..] = shuffled.to_be_bytes();
        let point = Int4::from(first[usize::from(high)]) ^ Int4::from(second[usize::from(low)]);
        owen_scramble_int4_rev(point, Int4::from(self.values))
            .reverse_bits()
            .to_f32_norm()
    }
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
    fn a_pixel_gives_the_streams_of_its_samples() {
        for (first, sample) in [
            (0, 0),
            (0, 5),
            (0, LAST_INDEX + 3),
            (70_000, 70_001),
            (70_000, 2),
        ] {
            let pixel = Pixel::new(7, 3, 4, first);
            let mut kept = pixel.stream(sample);
            let mut made = Stream::new(7, 3, 4, sample);
            for set in 0..2 * KEPT as u32 {
                kept.seek(set);
                made.seek(set);
                assert_eq!(
                    kept.next4(),
                    made.clone().next4(),
                    "sample {sample}, set {set}"
                );
                let part = |stream: &Stream<'_>| stream.part(2, 3).next4();
                assert_eq!(part(&kept), {
                    made.next4();
                    part(&made)
                });
            }
        }
    }

    #[test]
    fn points_are_those_of_the_library() {
        for index in (0..1 << PERIOD_BITS).step_by(7) {
            let seed = mix(index);
            assert_eq!(
                Scramble::of_seed(seed).four(index),
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
    fn neighbouring_pixels_sets_and_walks_within_walks_are_uncorrelated() {
        let (mut pixels, mut sets, mut walks) = (0.0, 0.0, [0.0; 2]);
        let count = 20_000;
        for i in 0..count {
            let mut a = Stream::new(0, i, 0, 0);
            let mut b = Stream::new(0, i + 1, 0, 0);
            let [mut inner, mut other] = [0, 1].map(|number| a.nested(number));
            let (first, second) = (a.next4(), a.next4());
            pixels += f64::from((first[0] - 0.5) * (b.next4()[0] - 0.5));
            sets += f64::from((first[1] - 0.5) * (second[1] - 0.5));
            let inner = inner.next4();
            walks[0] += f64::from((first[0] - 0.5) * (inner[0] - 0.5));
            walks[1] += f64::from((inner[0] - 0.5) * (other.next4()[0] - 0.5));
        }
        // A product of two centred uniform numbers has standard deviation 1/12.
        let sigma = 1.0 / 12.0 / f64::from(count).sqrt();
        for sum in [pixels, sets, walks[0], walks[1]] {
            let mean = sum / f64::from(count);
            assert!(mean.abs() < 4.0 * sigma, "{mean} is {} sigma", mean / sigma);
        }
    }
}
