//! What a layer lets through, `τ(K)`, and what it absorbs, `1 − τ(K)`, from a table of polynomials.
//!
//! Up to `K = 1` the table holds `g(K) = (1 − τ(K)) / K`, which falls from 2 (diffuse light without
//! absorption travels twice the thickness) and keeps the digits of what little is absorbed; above, it
//! holds `τ` itself. Both are smooth in `ln K`, so equal numbers of intervals go to each octave of
//! `K`: the upper bits of the floating-point number are the interval's index.

use std::sync::OnceLock;

use crate::plate::{layer_absorptance, layer_transmissivity};

/// Lowest exponent of the table: below 2^−26 `g` is within 3e-7 of its limit 2.
const FIRST_OCTAVE: i32 = -26;
/// First exponent from which the table holds what is let through.
const TURN: i32 = 0;
/// First exponent above the table: at 2^7 nothing measurable passes.
const END_OCTAVE: i32 = 7;
/// Intervals an octave, as a power of two.
const SPLIT_BITS: u32 = 3;
const SPLITS: usize = 1 << SPLIT_BITS;
const INTERVALS: usize = (END_OCTAVE - FIRST_OCTAVE) as usize * SPLITS;
const TERMS: usize = 4;

/// Coefficients of `g` or `τ` in rising powers of the place inside the interval, −1 to 1.
type Interval = [f32; TERMS];

/// `g` and `τ` by intervals of `K`.
pub(super) struct LayerTable([Interval; INTERVALS]);

/// The last number below 2⁷, the end of the table.
const LAST: f32 = f32::from_bits(((127 + END_OCTAVE) as u32) << MANTISSA_BITS).next_down();
const MANTISSA_BITS: u32 = 23;

impl LayerTable {
    /// The table, made when it is first asked for.
    #[inline]
    pub(super) fn get() -> &'static Self {
        static TABLE: OnceLock<Box<LayerTable>> = OnceLock::new();
        TABLE.get_or_init(|| Box::new(Self::new()))
    }

    fn new() -> Self {
        let mut table = [[0.0; TERMS]; INTERVALS];
        for (octave, intervals) in (FIRST_OCTAVE..END_OCTAVE).zip(table.chunks_exact_mut(SPLITS)) {
            let width = power_of_two(octave) / SPLITS as f64;
            for (split, interval) in intervals.iter_mut().enumerate() {
                let low = width * (SPLITS + split) as f64;
                let exact = fit(|x| tabulated(low + width * (x + 1.0) / 2.0));
                *interval = exact.map(|coefficient| coefficient as f32);
            }
        }
        Self(table)
    }

    /// `1 − τ(k)` and `τ(k)` for `k ≥ 0`, in [0, 1]; within 1e-6 of `1 − τ` and 3e-7 of 1.
    #[inline(always)]
    pub(super) fn absorbed_and_passed(&self, k: f32) -> (f32, f32) {
        const FIRST: f32 = power_of_two(FIRST_OCTAVE) as f32;
        const TURNS: f32 = power_of_two(TURN) as f32;
        let above = if k > FIRST { k } else { FIRST };
        let inside = if above < LAST { above } else { LAST };
        let bits = inside.to_bits();
        let shift = MANTISSA_BITS - SPLIT_BITS;
        let first = (((127 + FIRST_OCTAVE) as u32) << SPLIT_BITS) as usize;
        let index = ((bits >> shift) as usize - first).min(INTERVALS - 1);
        // The remaining bits of the mantissa, read as a number from 1 to 1 + 1/SPLITS.
        let rest = (bits & ((1 << shift) - 1)) | (127 << MANTISSA_BITS);
        let x = (f32::from_bits(rest) - 1.0) * (2 * SPLITS) as f32 - 1.0;
        let [a, b, c, d] = self.0[index];
        let held = (a + b * x) + x * x * (c + d * x);
        let one = if inside < TURNS { k * held } else { held };
        let one = if one > 0.0 { one } else { 0.0 };
        let other = 1.0 - one;
        if inside < TURNS {
            (one, other)
        } else {
            (other, one)
        }
    }
}

const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// What the table holds at `k`, exact.
fn tabulated(k: f64) -> f64 {
    if k < power_of_two(TURN) {
        layer_absorptance(k) / k
    } else {
        layer_transmissivity(k)
    }
}

/// The polynomial of degree 3 through `f` at the four Chebyshev points of [−1, 1].
fn fit(f: impl Fn(f64) -> f64) -> [f64; TERMS] {
    let nodes: [f64; TERMS] =
        std::array::from_fn(|j| libm::cos(std::f64::consts::PI * (j as f64 + 0.5) / TERMS as f64));
    // Newton's divided differences, then expanded into powers.
    let mut divided = nodes.map(f);
    for level in 1..TERMS {
        for j in (level..TERMS).rev() {
            divided[j] = (divided[j] - divided[j - 1]) / (nodes[j] - nodes[j - level]);
        }
    }
    let mut powers = [0.0; TERMS];
    for j in (0..TERMS).rev() {
        // powers ← powers · (x − node) + divided
        for p in (1..TERMS).rev() {
            powers[p] = powers[p - 1] - nodes[j] * powers[p];
        }
        powers[0] = divided[j] - nodes[j] * powers[0];
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_integral() {
        for step in 0..20_000 {
            let k = 10f64.powf(-9.0 + 11.0 * f64::from(step) / 20_000.0) as f32;
            let (absorbed, passed) = LayerTable::get().absorbed_and_passed(k);
            let exact = layer_absorptance(f64::from(k));
            let error = (f64::from(absorbed) - exact).abs() / exact;
            assert!(error < 1e-6, "1 − τ at K = {k}: relative error {error}");
            let error = (f64::from(passed) - layer_transmissivity(f64::from(k))).abs();
            assert!(error < 3e-7, "τ at K = {k}: {error}");
        }
    }

    #[test]
    fn the_ends_are_finite() {
        let table = LayerTable::get();
        assert_eq!(table.absorbed_and_passed(0.0), (0.0, 1.0));
        for k in [f32::MIN_POSITIVE, 1e-30] {
            let (absorbed, passed) = table.absorbed_and_passed(k);
            assert!((absorbed / k - 2.0).abs() < 1e-6, "K = {k}: {absorbed}");
            assert_eq!(passed, 1.0);
        }
        for k in [127.999, 128.0, 129.0, 1e30] {
            assert_eq!(table.absorbed_and_passed(k), (1.0, 0.0), "K = {k}");
        }
    }
}
