//! Single precision to fixed point, by shifts alone.
//!
//! - **In**: finite `f32`s, each a whole number of at most 24 bits times a power of two.
//! - **Out**: integers in units of a power of two; a shift gives each, so there is no rounding but the one stated.
//! - **Left out**: numbers that are not finite; whoever calls has sorted them out.

/// Bits behind the point of sums and of sums of squares. (With fewer, the variance of dim pixels would vanish.)
pub(super) const FRACTION_BITS: i32 = 64;
/// One in that fixed point.
pub(super) const ONE: f64 = 18_446_744_073_709_551_616.0;
/// Greatest value that is taken: 2³³ samples of it still fit into 128 bits.
pub(super) const MOST: f32 = 1_073_741_824.0;

/// A finite number as sign, whole part and power of two: `±mantissa · 2^exponent`.
fn parts(value: f32) -> (bool, u32, i32) {
    let bits = value.to_bits();
    let biased = (bits >> 23 & 0xff) as i32;
    let fraction = bits & 0x007f_ffff;
    // Subnormal numbers have the exponent of the smallest normal ones and no leading one.
    let mantissa = fraction | u32::from(biased != 0) << 23;
    (bits >> 31 != 0, mantissa, biased.max(1) - 150)
}

/// A value and its square in units of 2⁻⁶⁴, both cut off towards zero; |`value`| ≤ [`MOST`].
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

/// `whole · 2^shift`, cut off.
fn shifted(whole: u64, shift: i32) -> u128 {
    if shift >= 0 {
        // At most 48 bits of a square, shifted by 2 · 7 + 64 = 78.
        u128::from(whole) << shift
    } else {
        u128::from(whole >> shift.unsigned_abs().min(63))
    }
}

/// A value in units of 2^−`fraction_bits`, rounded to the nearest, halves away from zero, and kept within ±`most`.
///
/// `most` is at most 2⁶² and `fraction_bits` at most 24.
pub(super) fn nearest(value: f32, fraction_bits: i32, most: i64) -> i64 {
    let (negative, mantissa, exponent) = parts(value);
    let (mantissa, shift) = (i64::from(mantissa), exponent + fraction_bits);
    let magnitude = match shift {
        // 24 bits shifted by more than 38 are beyond 2⁶², or zero.
        39.. if mantissa != 0 => most,
        0.. => mantissa << shift.min(38),
        -25..0 => (mantissa + (1 << (-shift - 1))) >> -shift,
        _ => 0,
    };
    let magnitude = magnitude.min(most);
    if negative { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn value_and_square_are_those_of_arithmetic_in_double_precision(bits: u32) {
            let value = f32::from_bits(bits);
            prop_assume!(value.is_finite() && value.abs() <= MOST);
            // A product of two numbers of 24 bits is exact in 53, a power of two changes none; the cast cuts off.
            let wide = f64::from(value);
            let expected = ((wide * ONE) as i128, (wide * wide * ONE) as u128);
            prop_assert_eq!(value_and_square(value), expected);
        }

        #[test]
        fn rounding_is_that_of_double_precision(bits: u32, fraction_bits in 0_i32..=24) {
            let value = f32::from_bits(bits);
            prop_assume!(value.is_finite());
            let most = 1_i64 << 54;
            let scaled = f64::from(value) * f64::from(1 << fraction_bits);
            let expected = libm::round(scaled).clamp(-(most as f64), most as f64) as i64;
            prop_assert_eq!(nearest(value, fraction_bits, most), expected);
        }
    }

    #[test]
    fn the_extremes_are_exact() {
        assert_eq!(value_and_square(MOST), (1 << 94, 1 << 124));
        assert_eq!(value_and_square(-MOST), (-(1 << 94), 1 << 124));
        assert_eq!(value_and_square(f32::from_bits(1)), (0, 0));
        assert_eq!(value_and_square(-0.0), (0, 0));
        assert_eq!(nearest(f32::MAX, 24, 1 << 54), 1 << 54);
        assert_eq!(nearest(0.5, 0, 10), 1);
        assert_eq!(nearest(-0.5, 0, 10), -1);
        assert_eq!(nearest(0.499_999_97, 0, 10), 0);
    }
}
