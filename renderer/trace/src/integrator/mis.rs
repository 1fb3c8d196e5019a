//! Multiple importance sampling: weights for light that two techniques can find.

/// The power heuristic (exponent 2): weight of a technique with density `own` where another one has
/// `other`.
///
/// Both densities are over the same measure. An infinite density (a mirror) gets weight 1.
pub fn power(own: f32, other: f32) -> f32 {
    if own.is_infinite() {
        return 1.0;
    }
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}

/// [`power`] over `own`, with a division less.
pub(crate) fn power_over_own(own: f32, other: f32) -> f32 {
    let ratio = other / own;
    1.0 / ((1.0 + ratio * ratio) * own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_of_both_techniques_add_up_to_one() {
        for (a, b) in [(1.0, 2.0), (1e-20, 1e20), (3.0, 0.0), (1e30, 1e-30)] {
            assert!((power(a, b) + power(b, a) - 1.0).abs() < 1e-6, "{a} {b}");
            let over = power(a, b) / a;
            assert!(
                (power_over_own(a, b) - over).abs() <= 1e-6 * over,
                "{a} {b}"
            );
        }
    }
}
