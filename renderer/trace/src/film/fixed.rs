//! Single precision to fixed point.
//!
//! - **In**: finite `f32`s, each a whole number of at most 24 bits times a power of two.
//! - **Out**: integers in units of a power of two, computed by exact products, so that only the stated
//!   rounding occurs.
//! - **Left out**: numbers that are not finite, which the caller must reject.

/// One in the fixed point of sums and of sums of squares, 2⁻⁶⁴. (With fewer fraction bits, the
/// variance of dim pixels would vanish.)
pub(super) const ONE: f64 = 18_446_744_073_709_551_616.0;
/// Greatest value that is taken: 2³³ samples of it still fit into 128 bits.
pub const MOST: f32 = 1_073_741_824.0;

/// A value and its square in units of 2⁻⁶⁴, both rounded to the nearest, halves to even; |`value`| ≤
/// [`MOST`].
#[inline]
pub(super) fn value_and_square(value: f32) -> (i128, u128) {
    debug_assert!(value.abs() <= MOST, "clamped beforehand");
    // The square of 24 bits is exact in 53, and so are products with powers of two.
    let wide = f64::from(value);
    let units = |number: f64| (number * ONE).round_ties_even();
    (units(wide) as i128, units(wide * wide) as u128)
}

/// Greatest value that a [`Run`] takes.
pub(super) const MOST_OF_RUN: f32 = 524_288.0;

/// Fraction bits of the coarse part of a [`Run`]: the square of [`MOST_OF_RUN`] in these units, and
/// what is left of it in units of 2⁻⁶⁴, both are below 2⁵¹.
const COARSE_BITS: u32 = 12;
const COARSE: f64 = (1_u64 << COARSE_BITS) as f64;
const FINE_BITS: u32 = 64 - COARSE_BITS;
const FINE: f64 = (1_u64 << FINE_BITS) as f64;

/// Most values that a [`Run`] takes: so many numbers of 51 bits are below 2⁶³.
pub(super) const LONGEST_RUN: u32 = 2048;

/// Sums of at most [`LONGEST_RUN`] values and of their squares, each as a number of units of 2⁻¹² and
/// one of units of 2⁻⁶⁴: the same as sums of what [`value_and_square`] gives, and quicker to add to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Run {
    /// Of values and of squares.
    coarse: [i64; 2],
    fine: [i64; 2],
}

impl Run {
    /// Adds a value within ±[`MOST_OF_RUN`].
    #[inline]
    pub(super) fn add(&mut self, value: f32) {
        let wide = f64::from(value);
        let sums = self.coarse.iter_mut().zip(&mut self.fine);
        for (number, (coarse, fine)) in [wide, wide * wide].into_iter().zip(sums) {
            // Products and the difference are exact, so that the last line alone rounds.
            let scaled = number * COARSE;
            let whole = scaled + WHOLE;
            let rest = scaled - (whole - WHOLE);
            *coarse += whole_of(whole);
            *fine += whole_of(rest * FINE + WHOLE);
        }
    }

    /// The sums in units of 2⁻⁶⁴.
    pub(super) fn sums(&self) -> (i128, u128) {
        let [sum, squares] = [0, 1].map(|place| {
            (i128::from(self.coarse[place]) << FINE_BITS) + i128::from(self.fine[place])
        });
        (sum, squares as u128)
    }
}

/// Added to a number below 2⁵¹ it leaves a whole number in the last bits: 1.5 · 2⁵².
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// A value times `scale`, rounded to the nearest, halves to even, and kept within ±`most`.
///
/// `scale` is a power of two from 1 to 2³², `most` a whole number of at most 2⁵⁰. There
/// is no branch: a conversion of a number to an integer would look for what does not fit.
#[inline]
pub(super) fn nearest(value: f32, scale: f64, most: f64) -> i64 {
    // The product is exact.
    let scaled = f64::from(value) * scale;
    let kept = if scaled < most { scaled } else { most };
    let kept = if kept > -most { kept } else { -most };
    whole_of(kept + WHOLE)
}

/// The whole number to which [`WHOLE`] has been added.
#[inline]
fn whole_of(sum: f64) -> i64 {
    (sum.to_bits() as i64).wrapping_sub(WHOLE.to_bits() as i64)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn value_and_square_are_those_of_integers(whole in -8_388_608_i32..=8_388_608, bits in 0_u32..=24) {
            // A number of 24 bits with as many fraction bits, its square with twice as many.
            let value = whole as f32 / (1 << bits) as f32;
            let sum = i128::from(whole) << (64 - bits);
            let square = u128::from(whole.unsigned_abs()).pow(2) << (64 - 2 * bits);
            prop_assert_eq!(value_and_square(value), (sum, square));
        }

        #[test]
        fn a_run_adds_up_what_each_value_is(bits in proptest::collection::vec(any::<u32>(), 16)) {
            let mut run = Run::default();
            let (mut sum, mut squares) = (0, 0);
            for bits in bits {
                // Most exponents are of numbers that a run does not take: take those that it does.
                let value = f32::from_bits((bits % MOST_OF_RUN.to_bits()) | (bits & 0x8000_0000));
                run.add(value);
                let (one, square) = value_and_square(value);
                sum += one;
                squares += square;
            }
            prop_assert_eq!(run.sums(), (sum, squares));
        }

        #[test]
        fn rounding_is_that_of_double_precision(bits: u32, fraction_bits in 0_i32..=24) {
            let value = f32::from_bits(bits);
            prop_assume!(value.is_finite());
            let scale = f64::from(1 << fraction_bits);
            for most in [1_i64 << 50, (1 << 23) - 1] {
                let most = most as f64;
                let expected = libm::rint(f64::from(value) * scale).clamp(-most, most) as i64;
                prop_assert_eq!(nearest(value, scale, most), expected);
            }
        }

        #[test]
        fn halves_are_rounded_to_even(whole in -8_388_608_i32..8_388_608, fraction_bits in 0_i32..=24) {
            // Every number of 24 bits and a half of one, and its neighbours.
            let half = (whole as f32 + 0.5) / (1 << fraction_bits) as f32;
            let scale = f64::from(1 << fraction_bits);
            for value in [half.next_down(), half, half.next_up()] {
                let expected = libm::rint(f64::from(value) * scale) as i64;
                prop_assert_eq!(nearest(value, scale, 1e9), expected);
            }
        }
    }

    #[test]
    fn the_extremes_are_exact() {
        assert_eq!(value_and_square(MOST), (1 << 94, 1 << 124));
        assert_eq!(value_and_square(-MOST), (-(1 << 94), 1 << 124));
        assert_eq!(value_and_square(f32::from_bits(1)), (0, 0));
        assert_eq!(value_and_square(-0.0), (0, 0));
        // Halves of a unit go to the even one: 2⁻⁶⁵ and 3 · 2⁻⁶⁵.
        let half = f32::from_bits((127 - 65) << 23);
        assert_eq!(value_and_square(half).0, 0);
        assert_eq!(value_and_square(-3.0 * half).0, -2);
        let mut run = Run::default();
        for value in [MOST_OF_RUN, -MOST_OF_RUN, MOST_OF_RUN, half, -3.0 * half] {
            run.add(value);
        }
        assert_eq!(run.sums(), ((1 << 83) - 2, 3 << 102));
        for _ in 5..LONGEST_RUN {
            run.add(MOST_OF_RUN);
        }
        let sum = i128::from(LONGEST_RUN - 4) << 83;
        assert_eq!(run.sums(), (sum - 2, u128::from(LONGEST_RUN - 2) << 102));
        let of = |value| nearest(value, 1.0, 10.0);
        assert_eq!(
            nearest(f32::MAX, 16_777_216.0, 1_125_899_906_842_624.0),
            1 << 50
        );
        assert_eq!([0.5, -0.5, 1.5, 2.5, -0.0].map(of), [0, 0, 2, 2, 0]);
        assert_eq!(
            [0.499_999_97, -0.499_999_97, f32::from_bits(1), -1e30].map(of),
            [0, 0, 0, -10]
        );
    }
}
