//! What cells and stomata share: slopes as roughness, and the grids on which they lie.

/// By how much the square of a GGX roughness grows with the variance of slopes.
///
/// For Beckmann's distribution it is 2. GGX has a sharper core and an infinite variance: the peak of
/// its convolution with normally distributed slopes asks for 4 where these are small beside the
/// coat's own and for 2.9 at `σ² = α²/2`.
pub(super) const SPREAD: f32 = 3.0;

/// 0 below 0, 1 above 1, `3x² − 2x³` between.
pub(super) fn smooth(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}
