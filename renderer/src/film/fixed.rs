//! Single precision to fixed point.
//!
//! - **In**: finite `f32`s, each a whole number of at most 24 bits times a power of two.
//! - **Out**: integers in units of a power of two, computed by a shift or an exact product, so that
//!   only the stated rounding occurs.
//! - **Left out**: numbers that are not finite, which the caller must reject.

/// Number of fraction bits of sums and of sums of squares. (With fewer, the variance of dim pixels
/// would vanish.)
pub(super) const FRACTION_BITS: i32 = 64;
/// One in that fixed point.
pub(super) const ONE: f64 = 18_446_744_073_709_551_616.0;
/// Greatest value that is taken: 2³³ samples of it still fit into 128 bits.
pub(super) const MOST: f32 = 1_073_741_824.0;

/// A finite number as sign, integer and power of two: `±mantissa · 2^exponent`.
#[inline]
fn parts(value: f32) -> (bool, u32, i32) {
    let bits = value.to_bits();
    let biased = (bits >> 23 & 0xff) as i32;
    let fraction = bits & 0x007f_ffff;
    // Subnormal numbers have the exponent of the smallest normal ones and no leading one.
    let mantissa = fraction | u32::from(biased != 0) << 23;
    (bits >> 31 != 0, mantissa, biased.max(1) - 150)
}

/// A value and its square in units of 2⁻⁶⁴, both truncated towards zero; |`value`| ≤ [`MOST`].
#[inline]
pub(super) fn value_and_square(value: f32) -> (i128, u128) {
    debug_assert!(value.abs() <= MOST, "clamped beforehand");
    let (negative, mantissa, exponent) = parts(value);
    let magnitude = shifted(u64::from(mantissa), exponent + FRACTION_BITS) as i128;
    let square = u64::from(mantissa) * u64::from(mantissa);
    (
        if negative { -magnitude } else { magnitude },
        shifted(square, 2 * exponent + FRACTION_BITS),
    )
}

/// `whole · 2^shift`, truncated.
#[inline]
fn shifted(whole: u64, shift: i32) -> u128 {
    if shift >= 0 {
        // A square has at most 48 bits and is shifted by at most 2 · 7 + 64 = 78.
        u128::from(whole) << shift
    } else {
        u128::from(whole >> shift.unsigned_abs().min(63))
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
    ((kept + WHOLE).to_bits() as i64).wrapping_sub(WHOLE.to_bits() as i64)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::testing::fixed;

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn value_and_square_are_those_of_arithmetic_in_double_precision(bits: u32) {
            let value = f32::from_bits(bits);
            prop_assume!(value.is_finite() && value.abs() <= MOST);
            // A product of two numbers of 24 bits is exact in 53, a power of two changes none; the
            // cast cuts off.
            let wide = f64::from(value);
            let expected = ((wide * ONE) as i128, (wide * wide * ONE) as u128);
            prop_assert_eq!(value_and_square(value), expected);
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
