//! Pseudo-random bits and numbers from numbers, for what needs no even spread: `SplitMix64` (Steele et
//! al. 2014).

/// The golden ratio's fraction, in 64 bits: the step of the sequence.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// The finaliser: a bijection of 64-bit numbers that mixes all bits.
#[inline]
pub(crate) fn mixed(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// Step and finaliser.
#[inline]
pub(crate) fn scramble(number: u64) -> u64 {
    mixed(number.wrapping_add(STEP))
}

/// Bits from the place of a cell of a grid and another number.
#[inline]
pub(crate) fn of_cell([x, y]: [i32; 2], other: i32) -> u64 {
    let cell = u64::from(x as u32) << 32 | u64::from(y as u32);
    let other = u64::from(other as u32).wrapping_mul(0xd134_2543_de82_ef95);
    mixed((cell ^ other).wrapping_mul(STEP))
}

/// A number in [0, 1) from 64 bits.
#[inline]
pub(crate) fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// Number `number` of a sequence of random numbers in [0, 1).
pub(crate) fn random(seed: u64, number: u64) -> f64 {
    unit(scramble(scramble(seed) ^ number))
}

/// A number in [0, 1) for each use of each thing of a seed.
pub(crate) fn of_use(seed: u64, number: u64, what: u64) -> f64 {
    unit(scramble(scramble(seed ^ scramble(number)) ^ what))
}

/// The sequence of a seed.
#[derive(Clone, Debug)]
pub(crate) struct Sequence(pub(crate) u64);

impl Sequence {
    /// The next 64 bits.
    #[inline]
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(STEP);
        mixed(self.0)
    }
}
