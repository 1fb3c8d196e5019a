//! Patterns from thresholded gradient noise, to which clonal mosaics are compared.
//!
//! These patterns do not grow: a pattern of greater scale is a different pattern, whose patches
//! need not contain those of the smaller one.
//!
//! # Source
//!
//! \[perlin2002\]: gradients towards the middles of a cube's edges, the fade of fifth degree; sum
//! of octaves after \[perlin1985\]. Departure: gradients are drawn by hashing the lattice point
//! with the seed, not from a table of 256, so that the noise does not repeat every 256 cells.

use glam::DVec3;

use crate::numeric::between;
use crate::random::{self, Use};

/// Noise and the share of the surface that it marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoisePattern {
    /// Distance between lattice points of the first octave, mm, > 0.
    pub scale_mm: f64,
    /// Octaves, each at twice the frequency of the one before, 1 to 16.
    pub octaves: u32,
    /// Amplitude of an octave over that of the one before, 0 to 1.
    pub gain: f64,
    /// Share of places that are marked, 0 to 1.
    pub share: f64,
}

impl NoisePattern {
    /// The noise at a point in space (mm), within about −1 to 1, 0 on average.
    pub fn value(&self, p: DVec3, seed: u64) -> f64 {
        let mut sum = 0.0;
        let mut amplitude = 1.0;
        let mut at = p / self.scale_mm;
        for octave in 0..self.octaves {
            let key = random::bits(seed, Use::NoiseGradient, u64::from(octave));
            sum += amplitude * gradient_noise(at, key);
            amplitude *= self.gain;
            at *= 2.0;
        }
        sum
    }

    /// Kind 1 for the share of places with the highest values, kind 0 for the others.
    ///
    /// The threshold is the quantile over these places, so the share is exact up to one place. Ties
    /// are marked in the order of the places.
    pub fn kinds(&self, places: &[DVec3], seed: u64) -> Vec<u16> {
        let values: Vec<f64> = places.iter().map(|&p| self.value(p, seed)).collect();
        let mut order: Vec<usize> = (0..places.len()).collect();
        order.sort_by(|&a, &b| values[b].total_cmp(&values[a]).then(a.cmp(&b)));
        let marked = (self.share.clamp(0.0, 1.0) * places.len() as f64).round() as usize;
        let mut kinds = vec![0; places.len()];
        for &place in &order[..marked] {
            kinds[place] = 1;
        }
        kinds
    }
}

/// One octave of gradient noise with lattice points at whole numbers.
fn gradient_noise(p: DVec3, key: u64) -> f64 {
    let cell = p.floor();
    let inside = p - cell;
    let fade = inside * inside * inside * (inside * (inside * 6.0 - 15.0) + 10.0);
    let corner = |dx: f64, dy: f64, dz: f64| {
        let step = DVec3::new(dx, dy, dz);
        gradient(cell + step, key).dot(inside - step)
    };
    let along_x = |dy, dz| between(corner(0.0, dy, dz), corner(1.0, dy, dz), fade.x);
    let along_y = |dz| between(along_x(0.0, dz), along_x(1.0, dz), fade.y);
    between(along_y(0.0), along_y(1.0), fade.z)
}

/// One of the twelve directions from the middle of a cube to the middles of its edges.
fn gradient(lattice: DVec3, key: u64) -> DVec3 {
    // Coordinates wrap at 2^21, far beyond the extent of any plant over any scale.
    let part = |x: f64| (x as i64 as u64) & 0x1f_ffff;
    let counter = part(lattice.x) | part(lattice.y) << 21 | part(lattice.z) << 42;
    let draw = (random::uniform(key, Use::NoiseGradient, counter) * 12.0) as u32;
    let (a, b) = (
        if draw & 1 == 0 { 1.0 } else { -1.0 },
        if draw & 2 == 0 { 1.0 } else { -1.0 },
    );
    match draw / 4 {
        0 => DVec3::new(a, b, 0.0),
        1 => DVec3::new(b, 0.0, a),
        _ => DVec3::new(0.0, a, b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATTERN: NoisePattern = NoisePattern {
        scale_mm: 4.0,
        octaves: 3,
        gain: 0.5,
        share: 0.3,
    };

    fn places() -> Vec<DVec3> {
        let place = |i: u64, k| 100.0 * random::uniform(3, Use::NoiseGradient, 3 * i + k);
        (0..4000)
            .map(|i| DVec3::new(place(i, 0), place(i, 1), place(i, 2)))
            .collect()
    }

    #[test]
    fn noise_is_zero_at_lattice_points_and_centred() {
        let one = NoisePattern {
            octaves: 1,
            ..PATTERN
        };
        assert_eq!(one.value(DVec3::new(8.0, -4.0, 12.0), 5), 0.0);
        let values: Vec<f64> = places().iter().map(|&p| PATTERN.value(p, 5)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let spread = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
        // Places further apart than the scale are independent: standard error √(spread / 4000).
        assert!(mean.abs() < 4.0 * (spread / 4000.0).sqrt(), "mean {mean}");
        assert!(
            spread > 0.02 && values.iter().all(|v| v.abs() < 1.8),
            "{spread}"
        );
    }

    #[test]
    fn noise_is_smooth_over_lattice_planes() {
        for i in 0..200 {
            let p = DVec3::new(
                4.0 * f64::from(i % 7),
                0.37 * f64::from(i),
                0.71 * f64::from(i),
            );
            let step = DVec3::X * 1e-6;
            let before = PATTERN.value(p, 5) - PATTERN.value(p - step, 5);
            let after = PATTERN.value(p + step, 5) - PATTERN.value(p, 5);
            // Both differences are the same slope times the step, but for the curvature and
            // rounding.
            assert!((before - after).abs() < 1e-10, "{before} {after}");
        }
    }

    #[test]
    fn the_marked_share_is_kept_and_seeds_differ() {
        let first = PATTERN.kinds(&places(), 1);
        let second = PATTERN.kinds(&places(), 2);
        for kinds in [&first, &second] {
            assert_eq!(kinds.iter().filter(|&&kind| kind == 1).count(), 1200);
        }
        let same = first.iter().zip(&second).filter(|(a, b)| a == b).count();
        // Independent patterns agree on 0.3² + 0.7² = 0.58 of the places.
        assert!((same as f64 / 4000.0 - 0.58).abs() < 0.06, "{same}");
    }
}
