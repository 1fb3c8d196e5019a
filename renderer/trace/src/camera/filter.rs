//! The reconstruction filter, by importance sampling of the offset of samples within a pixel.

use glam::Vec2;
use numerics::numeric::bisect;

/// A separable filter. All samples have equal weight, so that pixels stay independent of each
/// other.
#[derive(Clone, Debug)]
pub struct PixelFilter {
    /// Distances from the middle of the pixel, in pixels, that divide the Gaussian into equal
    /// shares; `None` for the box of one pixel.
    gaussian: Option<Box<[f32; STEPS + 1]>>,
}

/// Number of shares, within each of which the density is even.
const STEPS: usize = 1024;
/// The Gaussian is cut off at this many standard deviations.
const CUT: f64 = 3.0;

impl PixelFilter {
    /// A Gaussian cut off at `radius` pixels (three standard deviations), or a box of one pixel for
    /// 0.
    pub fn new(radius: f32) -> Self {
        let border = |i: usize| {
            let share = 2.0 * i as f64 / STEPS as f64 - 1.0;
            (f64::from(radius) / CUT * deviations(share)) as f32
        };
        Self {
            gaussian: (radius > 0.0).then(|| Box::new(std::array::from_fn(border))),
        }
    }

    /// Offset from the pixel's upper left corner, in pixels.
    pub fn sample(&self, u: Vec2) -> Vec2 {
        let Some(gaussian) = &self.gaussian else {
            return u;
        };
        let along = |u: f32| {
            let place = u * STEPS as f32;
            let step = (place as usize).min(STEPS - 1);
            let [low, high] = [gaussian[step], gaussian[step + 1]];
            low + (high - low) * (place - step as f32)
        };
        Vec2::new(0.5 + along(u.x), 0.5 + along(u.y))
    }
}

/// The number of standard deviations on both sides of the middle that hold a share, −1 to 1, of the
/// Gaussian that is cut off at [`CUT`]; negative for a negative share.
fn deviations(share: f64) -> f64 {
    let held = |x: f64| libm::erf(x * std::f64::consts::FRAC_1_SQRT_2);
    let of = share * held(CUT);
    // By halving, as often as there are digits.
    let (low, high) = bisect(-CUT, CUT, 60, |x| held(x) < of);
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_are_centred_and_spread_as_the_gaussian() {
        let filter = PixelFilter::new(1.5);
        let (mut mean, mut square) = (0.0, 0.0);
        let count = 10_000;
        for i in 0..count {
            let x = filter
                .sample(Vec2::new((i as f32 + 0.5) / count as f32, 0.5))
                .x
                - 0.5;
            mean += x / count as f32;
            square += x * x / count as f32;
            assert!(x.abs() <= 1.5);
        }
        // Standard deviation 0.5, less what is cut off beyond three of them (variance × 0.9733).
        assert!(
            mean.abs() < 1e-4 && (square - 0.25 * 0.9733).abs() < 1e-3,
            "{mean} {square}"
        );
    }
}
