//! Exponential and logarithm by polynomials, without branches or tables.
//!
//! Only +, −, ×, ÷ and bit operations: the same bits everywhere, whether run one by one or in vector
//! registers. Relative error about 1e-11, which leaves room below the 1e-7 that the optics promise.

/// Adding this rounds to a whole number (2^52 + 2^51: the unit of the last place is 1).
const ROUND: f64 = 6_755_399_441_055_744.0;

/// `e^x − 1` for `x ≤ 0`; −1 below −700. Relative error below 1e-11.
#[inline(always)]
#[allow(
    clippy::inline_always,
    reason = "only inside the loop over lanes can it be vectorised"
)]
pub(super) fn exp_minus_one(x: f64) -> f64 {
    let x = x.max(-700.0);
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let whole = shifted - ROUND;
    // ln 2 in two parts, so that the difference keeps its digits.
    let r = (x - whole * 6.931_471_803_691_238e-1) - whole * 1.908_214_929_270_587_7e-10;
    // Taylor's series to r^10 (|r| ≤ 0.35), summed in pairs to keep the chain of dependencies short.
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (1.0 + r * (1.0 / 2.0)) + r2 * (1.0 / 6.0 + r * (1.0 / 24.0));
    let mid = (1.0 / 120.0 + r * (1.0 / 720.0)) + r2 * (1.0 / 5040.0 + r * (1.0 / 40320.0));
    let high = 1.0 / 362_880.0 + r * (1.0 / 3_628_800.0);
    let p = r * (low + r4 * (mid + r4 * high));
    // The whole number sits in the lowest bits of `shifted`: up into the exponent with it.
    let scale = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    scale * p + (scale - 1.0)
}

/// `ln(1 + y)` for `y ≥ 0`. Relative error below 1e-11.
#[inline(always)]
#[allow(
    clippy::inline_always,
    reason = "only inside the loop over lanes can it be vectorised"
)]
pub(super) fn log_one_plus(y: f64) -> f64 {
    const ROOT_HALF_BITS: u64 = 0x3FE6_A09E_667F_3BCD;
    let u = 1.0 + y;
    // Exponent and mantissa in [√½, √2).
    let offset = u.to_bits().wrapping_sub(ROOT_HALF_BITS);
    let exponent_bits = offset & 0xFFF0_0000_0000_0000;
    let mantissa = f64::from_bits(u.to_bits().wrapping_sub(exponent_bits));
    // The exponent as a number, through the bits of 2^52 + exponent.
    let exponent = f64::from_bits((exponent_bits >> 52) | (1075 << 52)) - 4_503_599_627_370_496.0;
    // y itself while 1 + y is near 1: the sum has lost digits that y still has.
    let f = if exponent_bits == 0 {
        y
    } else {
        mantissa - 1.0
    };
    let z = f / (2.0 + f);
    let z2 = z * z;
    // 2 artanh z = ln((1 + z) / (1 − z)), to z^13 (|z| ≤ 0.172).
    let z4 = z2 * z2;
    let low = (1.0 + z2 * (1.0 / 3.0)) + z4 * (1.0 / 5.0 + z2 * (1.0 / 7.0));
    let high = (1.0 / 9.0 + z2 * (1.0 / 11.0)) + z4 * (1.0 / 13.0);
    let series = low + z4 * z4 * high;
    exponent * std::f64::consts::LN_2 + 2.0 * z * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_has_eleven_digits() {
        for step in 0..100_000 {
            let x = -10f64.powf(-15.0 + 17.8 * f64::from(step) / 100_000.0);
            let exact = libm::expm1(x);
            let error = (exp_minus_one(x) - exact).abs() / exact.abs();
            assert!(error < 1e-11, "x = {x}: {error}");
        }
        assert_eq!(exp_minus_one(0.0), 0.0);
        assert_eq!(exp_minus_one(f64::NEG_INFINITY), -1.0);
    }

    #[test]
    fn the_logarithm_has_ten_digits() {
        for step in 0..100_000 {
            let y = 10f64.powf(-18.0 + 318.0 * f64::from(step) / 100_000.0);
            let exact = libm::log1p(y);
            let error = (log_one_plus(y) - exact).abs() / exact;
            assert!(error < 1e-11, "y = {y}: {error}");
        }
        assert_eq!(log_one_plus(0.0), 0.0);
    }
}
