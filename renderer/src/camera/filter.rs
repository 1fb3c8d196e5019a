//! The reconstruction filter, by importance sampling of the offset of samples within a pixel.

use glam::Vec2;

use crate::sampling::distribution::Piecewise1d;

/// A separable filter. All samples have equal weight, so that pixels stay independent of each
/// other.
#[derive(Clone, Debug)]
pub struct PixelFilter {
    radius: f32,
    /// `None` for the box of one pixel.
    gaussian: Option<Piecewise1d>,
}

const STEPS: usize = 256;
/// The Gaussian is cut off at this many standard deviations.
const CUT: f32 = 3.0;

impl PixelFilter {
    /// A Gaussian cut off at `radius` pixels (three standard deviations), or a box of one pixel for
    /// 0.
    pub fn new(radius: f32) -> Self {
        let density = |i: usize| {
            let x = CUT * (2.0 * (i as f32 + 0.5) / STEPS as f32 - 1.0);
            libm::expf(-0.5 * x * x)
        };
        let weights: Vec<f32> = (0..STEPS).map(density).collect();
        Self {
            radius,
            gaussian: (radius > 0.0).then(|| Piecewise1d::new(&weights)),
        }
    }

    /// Offset from the pixel's upper left corner, in pixels.
    pub fn sample(&self, u: Vec2) -> Vec2 {
        let Some(gaussian) = &self.gaussian else {
            return u;
        };
        let along = |u: f32| {
            let (step, within) = gaussian.sample(u);
            self.radius * (2.0 * (step as f32 + within) / STEPS as f32 - 1.0)
        };
        Vec2::new(0.5 + along(u.x), 0.5 + along(u.y))
    }
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
