//! Exponential and logarithm by polynomials, without branches or tables.
//!
//! Only +, −, ×, ÷ and bit operations: the same bits everywhere, whether run one by one or in
//! vector registers. Relative error below 3e-7.

/// Adding this rounds to a whole number (2²³ + 2²²: the unit of the last place is 1).
const ROUND: f32 = 12_582_912.0;

const MANTISSA_BITS: u32 = 23;
/// The bits of a mantissa.
const MANTISSA: u32 = (1 << MANTISSA_BITS) - 1;
/// The bits of 1.
const ONE: u32 = 127 << MANTISSA_BITS;

/// `e^x − 1` for `x ≤ 0`; −1 below −80. Relative error below 3e-7.
#[inline(always)]
pub(super) fn exp_minus_one(x: f32) -> f32 {
    let x = if x > -80.0 { x } else { -80.0 };
    let shifted = x * std::f32::consts::LOG2_E + ROUND;
    let whole = shifted - ROUND;
    // ln 2 in two parts, so that the difference keeps its digits.
    let r = (x - whole * 0.693_145_75) - whole * 1.428_606_8e-6;
    // Taylor's series to r^7 (|r| ≤ 0.35), summed in pairs to keep the chain of dependencies short.
    let r2 = r * r;
    let low = (1.0 + r * (1.0 / 2.0)) + r2 * (1.0 / 6.0 + r * (1.0 / 24.0));
    let high = (1.0 / 120.0 + r * (1.0 / 720.0)) + r2 * (1.0 / 5040.0);
    let p = r * (low + r2 * r2 * high);
    // The whole number sits in the lowest bits of `shifted`: up into the exponent with it.
    let scale = f32::from_bits(shifted.to_bits().wrapping_add(127) << 23);
    scale * p + (scale - 1.0)
}

/// `ln(1 + a / b)` for `a ≥ 0` and `b > 0`, with one division. Relative error below 3e-7.
#[inline(always)]
pub(super) fn log_one_plus_ratio(a: f32, b: f32) -> f32 {
    const HALF: u32 = 1 << (MANTISSA_BITS - 1);
    let sum = a + b;
    // The bits of a number are its logarithm to base 2 within 0.09: the power of 2 nearest to the ratio.
    let exponent_bits = (sum.to_bits().wrapping_sub(b.to_bits()).wrapping_add(HALF)) & !MANTISSA;
    let scaled = b * f32::from_bits(exponent_bits.wrapping_add(ONE));
    // `a` itself while the ratio is near 1: the sum has lost digits that `a` still has.
    let over = if exponent_bits == 0 { a } else { sum - scaled };
    let z = over / (sum + scaled);
    let z2 = z * z;
    // 2 artanh z = ln((1 + z) / (1 − z)), to z^9 (|z| ≤ 0.201).
    let z4 = z2 * z2;
    let series =
        (1.0 + z2 * (1.0 / 3.0)) + z4 * ((1.0 / 5.0 + z2 * (1.0 / 7.0)) + z4 * (1.0 / 9.0));
    let exponent = (exponent_bits >> MANTISSA_BITS) as i32 as f32;
    exponent * std::f32::consts::LN_2 + 2.0 * z * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_has_six_digits() {
        for step in 0..100_000 {
            let x = -10f64.powf(-15.0 + 16.9 * f64::from(step) / 100_000.0) as f32;
            let exact = libm::expm1(f64::from(x));
            let error = (f64::from(exp_minus_one(x)) - exact).abs() / exact.abs();
            assert!(error < 3e-7, "x = {x}: {error}");
        }
        assert_eq!(exp_minus_one(0.0), 0.0);
        assert_eq!(exp_minus_one(f32::NEG_INFINITY), -1.0);
    }

    #[test]
    fn the_logarithm_has_six_digits() {
        for step in 0..100_000 {
            let ratio = 10f64.powf(-18.0 + 34.0 * f64::from(step) / 100_000.0);
            let b = 10f64.powf(-15.0 + 15.0 * f64::from(step % 997) / 997.0) as f32;
            let a = (ratio * f64::from(b)) as f32;
            let exact = libm::log1p(f64::from(a) / f64::from(b));
            let error = (f64::from(log_one_plus_ratio(a, b)) - exact).abs() / exact;
            assert!(error < 3e-7, "{a} / {b}: {error}");
        }
        assert_eq!(log_one_plus_ratio(0.0, 0.5), 0.0);
    }
}
