//! From uniform numbers to directions and points.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

/// A point of the unit disc, uniform over its area (Shirley and Chiu's concentric map).
pub fn disc(u: Vec2) -> Vec2 {
    let offset = u * 2.0 - Vec2::ONE;
    if offset == Vec2::ZERO {
        return Vec2::ZERO;
    }
    let (radius, angle) = if offset.x.abs() > offset.y.abs() {
        (offset.x, PI / 4.0 * (offset.y / offset.x))
    } else {
        (offset.y, PI / 2.0 - PI / 4.0 * (offset.x / offset.y))
    };
    let (sin, cos) = libm::sincosf(angle);
    Vec2::new(radius * cos, radius * sin)
}

/// A direction of the upper hemisphere with density cos θ / π.
pub fn cosine_hemisphere(u: Vec2) -> Vec3 {
    let point = disc(u);
    point.extend((1.0 - point.length_squared()).max(0.0).sqrt())
}

/// A direction within the cone of half angle `acos(cos_max)` around +z, uniform over solid angle.
///
/// Takes `1 − cos_max` because cos of a small angle, such as the sun's, loses its digits in `f32`.
pub fn cone(u: Vec2, one_minus_cos_max: f32) -> Vec3 {
    let one_minus_cos = u.x * one_minus_cos_max;
    let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
    let (sin_phi, cos_phi) = libm::sincosf(2.0 * PI * u.y);
    Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - one_minus_cos)
}

/// Barycentric coordinates of the second and third vertex, uniform over a triangle.
pub fn triangle(u: Vec2) -> Vec2 {
    let root = u.x.sqrt();
    Vec2::new(root * (1.0 - u.y), root * u.y)
}
