//! Numbers made integers.
#![allow(unsafe_code, reason = "a conversion that checks no range")]

/// The whole part of a number between 0 and `last` (at most 2²⁴): 0 for what lies below, and for NaN;
/// `last` for what lies above.
///
/// In contrast to `as`, several are converted side by side.
#[inline(always)]
pub(crate) fn whole(number: f32, last: u32) -> u32 {
    let held = number.max(0.0).min(last.min(1 << 24) as f32);
    // SAFETY: `held` is a number of 0 to 2²⁴: `max` and `min` give the other where one is NaN.
    unsafe { held.to_int_unchecked::<i32>() as u32 }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    proptest! {
        #![proptest_config(fixed(2048))]

        #[test]
        fn it_is_what_as_gives(bits: u32, last in 0_u32..=1 << 24) {
            let number = f32::from_bits(bits);
            prop_assert_eq!(whole(number, last), (number as u32).min(last));
        }
    }

    #[test]
    fn the_borders_are_kept() {
        for (number, expected) in [(f32::NAN, 0), (-0.5, 0), (6.99, 6), (7.0, 7), (7.5, 7)] {
            assert_eq!(whole(number, 7), expected, "{number}");
        }
        assert_eq!(whole(f32::INFINITY, u32::MAX), 1 << 24);
    }
}
