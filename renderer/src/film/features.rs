//! What a pixel saw besides radiance: how much of it is covered, and by what.

use super::fixed::nearest;

/// Samples of a pixel, by number, that record position, normal and albedo. These converge fast, and a bound keeps their
/// sums small: 256 samples of ±2³⁰ m in units of 2⁻²⁴ m (60 nm) fit into 64 bits, of normals and albedos into 32.
pub const FEATURE_SAMPLES: u32 = 256;

const POSITION_BITS: i32 = 24;
const NORMAL_BITS: i32 = 22;
const ALBEDO_BITS: i32 = 20;
/// The most of one sample: ±2³⁰ m.
const MOST_POSITION: i64 = 1 << 54;
/// The most of one sample: a normal of length just below 2, an albedo just below 8.
const MOST_SMALL: i64 = (1 << 23) - 1;

/// What the camera ray of one sample met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feature {
    /// Point, world, m.
    pub position: [f32; 3],
    /// Unit normal on the side of the camera, world.
    pub normal: [f32; 3],
    /// Linear sRGB of the surface in white light; films without albedo pass over it.
    pub albedo: [f32; 3],
    /// Number of the object.
    pub object: u32,
}

impl Feature {
    /// Whether all of it is finite.
    pub(super) fn is_finite(&self) -> bool {
        let all = [self.position, self.normal, self.albedo];
        all.as_flattened().iter().all(|value| value.is_finite())
    }
}

/// Sum of points, in units of 2⁻²⁴ m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Positions([i64; 3]);

impl Positions {
    pub(super) fn add(&mut self, position: [f32; 3]) {
        for (sum, value) in self.0.iter_mut().zip(position) {
            *sum += nearest(value, POSITION_BITS, MOST_POSITION);
        }
    }

    pub(super) fn merge(&mut self, other: &Self) {
        for (sum, value) in self.0.iter_mut().zip(other.0) {
            *sum += value;
        }
    }

    pub(super) fn mean(&self, count: u32) -> [f64; 3] {
        let unit = f64::from(1 << POSITION_BITS) * f64::from(count);
        self.0.map(|sum| sum as f64 / unit)
    }
}

/// Sum of albedos, in units of 2⁻²⁰.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Albedos([i32; 3]);

impl Albedos {
    pub(super) fn add(&mut self, albedo: [f32; 3]) {
        add_small(&mut self.0, albedo, ALBEDO_BITS);
    }

    pub(super) fn merge(&mut self, other: &Self) {
        for (sum, value) in self.0.iter_mut().zip(other.0) {
            *sum += value;
        }
    }

    pub(super) fn mean(&self, count: u32) -> [f64; 3] {
        mean_small(self.0, count, ALBEDO_BITS)
    }
}

/// Sum of normals, coverage, and the object of the first sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Surface {
    normals: [i32; 3],
    coverage: Coverage,
    /// Number + 1 of the object that sample 0 met; 0 if it met none, or is not among the samples.
    object: u32,
}

impl Surface {
    /// Counts a covered sample; whether it is one that records features.
    pub(super) fn add(&mut self, number: u32, feature: &Feature) -> bool {
        let records = number < FEATURE_SAMPLES;
        self.coverage.add(records);
        if records {
            add_small(&mut self.normals, feature.normal, NORMAL_BITS);
        }
        if number == 0 {
            self.object = feature.object.saturating_add(1);
        }
        records
    }

    pub(super) fn merge(&mut self, other: &Self) {
        for (sum, value) in self.normals.iter_mut().zip(other.normals) {
            *sum += value;
        }
        self.coverage.0 += other.coverage.0;
        self.object = self.object.max(other.object);
    }

    pub(super) fn coverage(&self) -> Coverage {
        self.coverage
    }

    pub(super) fn object(&self) -> u32 {
        self.object
    }

    pub(super) fn mean_normal(&self) -> [f64; 3] {
        mean_small(self.normals, self.coverage.recorded(), NORMAL_BITS)
    }
}

/// Two counts in one word, so that coverage costs four bytes a pixel: all covered samples below, and those among the first
/// [`FEATURE_SAMPLES`] above. Sums of words are words of sums.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Coverage(u32);

impl Coverage {
    /// Enough for 2²¹ − 1 samples; the format allows 2²⁰.
    const BITS: u32 = 21;

    fn add(&mut self, records: bool) {
        self.0 += 1 + (u32::from(records) << Self::BITS);
    }

    /// Covered samples.
    pub(super) fn covered(self) -> u32 {
        self.0 & ((1 << Self::BITS) - 1)
    }

    /// Covered samples that recorded features.
    pub(super) fn recorded(self) -> u32 {
        self.0 >> Self::BITS
    }
}

fn add_small(sums: &mut [i32; 3], values: [f32; 3], fraction_bits: i32) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += nearest(value, fraction_bits, MOST_SMALL) as i32;
    }
}

fn mean_small(sums: [i32; 3], count: u32, fraction_bits: i32) -> [f64; 3] {
    let unit = f64::from(1 << fraction_bits) * f64::from(count);
    sums.map(|sum| f64::from(sum) / unit)
}
