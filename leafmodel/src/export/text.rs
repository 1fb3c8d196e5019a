//! What texts of all formats have: who wrote them, and how numbers are rounded.

/// What has written a file.
pub(super) const SOFTWARE: &str = concat!("Lamina ", env!("CARGO_PKG_VERSION"));

/// A coordinate rounded to 10⁻⁴ mm, without trailing zeros.
pub(super) fn rounded(value: f64) -> f64 {
    // Adding 0 turns −0 into 0.
    (value * 1e4).round() / 1e4 + 0.0
}
