//! Bits mixed well, for numbers drawn by a counter.

/// The step from one counter to the next.
pub const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// The mixer of the generator `SplitMix64` (Steele, Lea and Flood 2014).
pub fn mixed(counter: u64) -> u64 {
    let mut z = counter;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
