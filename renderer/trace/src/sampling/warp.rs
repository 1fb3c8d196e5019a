//! From uniform numbers to directions and points.

use std::f32::consts::PI;

use glam::{BVec2, Vec2, Vec2Swizzles, Vec3};

/// A point of the unit disc, uniform over its area (Shirley and Chiu's concentric map).
pub fn disc(u: Vec2) -> Vec2 {
    let offset = u * 2.0 - Vec2::ONE;
    if offset == Vec2::ZERO {
        return Vec2::ZERO;
    }
    // The angle from the nearer axis, at most 45°. Without a branch, which could not be predicted.
    let x_is_nearer = BVec2::splat(offset.x.abs() > offset.y.abs());
    let turned = offset.yx();
    let Vec2 { x: far, y: side } = Vec2::select(x_is_nearer, offset, turned);
    let (sin, cos) = sin_cos_quarter(side / far);
    let point = Vec2::new(cos, sin) * far;
    Vec2::select(x_is_nearer, point, point.yx())
}

/// Sine and cosine of `x · π/4` for |x| ≤ 1, by Taylor's series; errors below 2e-7.
#[inline]
fn sin_cos_quarter(x: f32) -> (f32, f32) {
    let angle = x * (PI / 4.0);
    let a2 = angle * angle;
    let a4 = a2 * a2;
    let sin = (1.0 - a2 * (1.0 / 6.0))
        + a4 * ((1.0 / 120.0 - a2 * (1.0 / 5040.0)) + a4 * (1.0 / 362_880.0));
    let cos = (1.0 - a2 * 0.5) + a4 * ((1.0 / 24.0 - a2 * (1.0 / 720.0)) + a4 * (1.0 / 40320.0));
    (angle * sin, cos)
}

/// A direction of the upper hemisphere with density cos θ / π.
pub fn cosine_hemisphere(u: Vec2) -> Vec3 {
    let point = disc(u);
    point.extend((1.0 - point.length_squared()).max(0.0).sqrt())
}

/// A direction within the cone of half angle `acos(cos_max)` around +z, uniform over solid angle.
///
/// Takes `1 − cos_max`, because the cosine of a small angle, such as the sun's, is inaccurate in
/// `f32`.
pub fn cone(u: Vec2, one_minus_cos_max: f32) -> Vec3 {
    // The share of the solid angle within a circle is the square of its radius on the disc.
    let point = disc(u);
    let one_minus_cos = point.length_squared() * one_minus_cos_max;
    // sin² = (1 − cos) (1 + cos); only what does not depend on the point takes a square root where
    // the cone is narrow.
    let sin_over_radius = (2.0 * one_minus_cos_max).sqrt() * root_of_one_less(0.5 * one_minus_cos);
    (point * sin_over_radius).extend(1.0 - one_minus_cos)
}

/// √(1 − x) for x ≤ 1, near 0 by Taylor's series, with an error below 1e-8.
#[inline]
fn root_of_one_less(x: f32) -> f32 {
    if x < 0.01 {
        1.0 - x * (0.5 + x * (0.125 + x * 0.0625))
    } else {
        (1.0 - x).max(0.0).sqrt()
    }
}

/// Barycentric coordinates of the second and third vertex, uniform over a triangle.
pub fn triangle(u: Vec2) -> Vec2 {
    let root = u.x.sqrt();
    Vec2::new(root * (1.0 - u.y), root * u.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_of_an_eighth_of_a_turn_are_right_to_single_precision() {
        for step in -1000..=1000 {
            let x = step as f32 / 1000.0;
            let (sin, cos) = sin_cos_quarter(x);
            let (exact_sin, exact_cos) = libm::sincos(f64::from(x) * std::f64::consts::FRAC_PI_4);
            assert!((f64::from(sin) - exact_sin).abs() < 2e-7, "sin at {x}");
            assert!((f64::from(cos) - exact_cos).abs() < 2e-7, "cos at {x}");
        }
    }

    #[test]
    fn the_disc_is_covered_evenly() {
        // Shares of points within a radius and within an angle are those of area.
        let side = 512;
        let (mut within, mut sector) = (0, 0);
        for i in 0..side * side {
            let u = Vec2::new((i % side) as f32 + 0.5, (i / side) as f32 + 0.5) / side as f32;
            let point = disc(u);
            assert!(point.length() <= 1.0 + 1e-6);
            within += u32::from(point.length_squared() < 0.3);
            sector += u32::from(point.y > 0.0 && point.y < point.x * 0.577_350_3);
        }
        let share = |count: u32| f64::from(count) / f64::from(side * side);
        assert!((share(within) - 0.3).abs() < 3e-3, "{}", share(within));
        assert!(
            (share(sector) - 1.0 / 12.0).abs() < 3e-3,
            "{}",
            share(sector)
        );
    }
}
