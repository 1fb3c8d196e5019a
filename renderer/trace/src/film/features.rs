//! Data of a pixel besides radiance: coverage, and features, which are numbers that describe what
//! its camera rays hit.
//!
//! - **In**: for each sample that hit something, a number per feature.
//! - **Out**: means over the covered samples among a pixel's first [`FEATURE_SAMPLES`], or the
//!   number of sample 0.
//! - **Always true**: only integers are stored, so films merge by addition alone.
//! - **Left out**: the meaning of the features. The film's creator says how each is kept.

use super::fixed::nearest;

/// Number of samples of a pixel, from the first, that record features. Features converge fast, and
/// the bound keeps their sums small: 256 samples of 50 bits fit into 64 bits, of 23 bits into 32.
pub const FEATURE_SAMPLES: u32 = 256;

/// Greatest contribution of one sample to a wide sum, in its units.
const MOST_WIDE: f64 = (1_i64 << 50) as f64;
/// Greatest contribution of one sample to a narrow sum, in its units.
const MOST_NARROW: f64 = ((1_i64 << 23) - 1) as f64;
/// Greatest number of fraction bits.
const MOST_FRACTION_BITS: i32 = 24;

/// How a feature is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sum {
    /// As a sum of 64 bits in units of 2^−`fraction_bits`, each number rounded to the nearest and
    /// at most ±2⁵⁰ units: with 24 bits up to ±2²⁶.
    Wide {
        /// Number of fraction bits, 0 to 24.
        fraction_bits: i32,
    },
    /// As a sum of 32 bits in units of 2^−`fraction_bits`, each number rounded to the nearest and
    /// less than ±2²³ units: with 22 bits up to ±2, with 20 up to ±8.
    Narrow {
        /// Number of fraction bits, 0 to 24.
        fraction_bits: i32,
    },
    /// As the number of sample 0, an integer ≥ 0 of 32 bits; 0 if that sample hit nothing or is not
    /// among the samples.
    First,
}

impl Sum {
    /// Memory per pixel, bytes.
    pub const fn bytes(self) -> usize {
        match self {
            Self::Wide { .. } => size_of::<i64>(),
            Self::Narrow { .. } | Self::First => size_of::<i32>(),
        }
    }

    fn fraction_bits(self) -> i32 {
        match self {
            Self::Wide { fraction_bits } | Self::Narrow { fraction_bits } => fraction_bits,
            Self::First => 0,
        }
    }

    /// Number of units in 1.
    fn scale(self) -> f64 {
        f64::from(1 << self.fraction_bits())
    }
}

/// Where a pixel keeps each feature: a pixel has words of two widths, and its first narrow one
/// counts coverage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Words {
    /// Runs of equally kept features, in the order of features.
    runs: Vec<Run>,
    /// Number of words of 64 bits.
    pub(super) wide: usize,
    /// Number of words of 32 bits.
    pub(super) narrow: usize,
}

/// Features that follow one another and are kept in the same way, so that it is looked up once for
/// all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Run {
    sum: Sum,
    /// Number of features.
    count: usize,
    /// The first one's word among those of its width.
    place: usize,
}

impl Words {
    pub(super) fn new(sums: &[Sum]) -> Self {
        let (mut wide, mut narrow) = (0, 1);
        let run = |same: &[Sum]| {
            let (sum, count) = (same[0], same.len());
            assert!(
                (0..=MOST_FRACTION_BITS).contains(&sum.fraction_bits()),
                "a sum has 0 to {MOST_FRACTION_BITS} bits behind the point"
            );
            let next = match sum {
                Sum::Wide { .. } => &mut wide,
                Sum::Narrow { .. } | Sum::First => &mut narrow,
            };
            let place = *next;
            *next += count;
            Run { sum, count, place }
        };
        let runs = sums.chunk_by(PartialEq::eq).map(run).collect();
        Self { runs, wide, narrow }
    }

    /// Number of features.
    pub(super) fn features(&self) -> usize {
        self.wide + self.narrow - 1
    }

    /// Adds a covered sample's features to a pixel's words.
    #[inline]
    pub(super) fn add(&self, number: u32, features: &[f32], wide: &mut [i64], narrow: &mut [i32]) {
        let records = number < FEATURE_SAMPLES;
        narrow[0] += Coverage::of_sample(records);
        if !records {
            return;
        }
        let mut rest = features;
        for run in &self.runs {
            let (place, scale) = (run.place, run.sum.scale());
            let values;
            (values, rest) = rest.split_at(run.count);
            match run.sum {
                Sum::Wide { .. } => {
                    for (sum, &value) in wide[place..].iter_mut().zip(values) {
                        *sum += nearest(value, scale, MOST_WIDE);
                    }
                }
                Sum::Narrow { .. } => {
                    for (sum, &value) in narrow[place..].iter_mut().zip(values) {
                        *sum += nearest(value, scale, MOST_NARROW) as i32;
                    }
                }
                Sum::First if number == 0 => {
                    for (sum, &value) in narrow[place..].iter_mut().zip(values) {
                        *sum += value as i32;
                    }
                }
                Sum::First => {}
            }
        }
    }

    /// A feature of a pixel with these words; `None` if no sample recorded any.
    pub(super) fn feature(&self, number: usize, wide: &[i64], narrow: &[i32]) -> Option<f64> {
        let (run, place) = self.place_of(number);
        let count = Coverage::of(narrow).recorded();
        let unit = run.sum.scale() * f64::from(count);
        (count > 0).then(|| match run.sum {
            Sum::Wide { .. } => wide[place] as f64 / unit,
            Sum::Narrow { .. } => f64::from(narrow[place]) / unit,
            Sum::First => f64::from(narrow[place]),
        })
    }

    /// The run of a feature, and its word among those of its width.
    fn place_of(&self, number: usize) -> (&Run, usize) {
        let mut within = number;
        for run in &self.runs {
            if within < run.count {
                return (run, run.place + within);
            }
            within -= run.count;
        }
        panic!("the film has no feature {number}")
    }
}

/// Two counts in one word, so that coverage costs four bytes a pixel: all covered samples below,
/// and those among the first [`FEATURE_SAMPLES`] above. Sums of words are words of sums.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coverage(i32);

impl Coverage {
    /// Memory per pixel, bytes.
    pub(super) const BYTES: usize = size_of::<i32>();
    /// Number of bits of the lower count: enough for 2²¹ − 1 samples; the scene format allows 2²⁰.
    const BITS: u32 = 21;

    /// The increment for a covered sample.
    fn of_sample(records: bool) -> i32 {
        1 + (i32::from(records) << Self::BITS)
    }

    /// The coverage of a pixel with these narrow words.
    pub(super) fn of(narrow: &[i32]) -> Self {
        Self(narrow[0])
    }

    /// Number of covered samples.
    pub(super) fn covered(self) -> u32 {
        self.0 as u32 & ((1 << Self::BITS) - 1)
    }

    /// Number of covered samples that recorded features.
    fn recorded(self) -> u32 {
        self.0 as u32 >> Self::BITS
    }
}
