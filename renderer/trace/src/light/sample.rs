//! What all lights share: the point that is lit, and the light that is drawn for it.

use glam::{DVec3, Vec3};

use crate::sampling::distribution::Piecewise2d;
use crate::spectrum::Lanes;

/// An illuminated point.
#[derive(Clone, Copy, Debug)]
pub struct Receiver {
    /// Position, world, m.
    pub position: Vec3,
    /// Unit normal, world. Light is weighted by the absolute value of its cosine, from either side,
    /// since a leaf transmits. Zero in a medium, where light is weighted by no cosine.
    pub normal: Vec3,
}

/// A light sample: light that may arrive at a point.
#[derive(Clone, Copy, Debug)]
pub struct LightSample<const N: usize> {
    /// Unit direction from the point to the light, world.
    pub wi: Vec3,
    /// Point on the light, or `None` at infinity.
    pub point: Option<Vec3>,
    /// Radiance if the way is free, W m⁻² sr⁻¹ nm⁻¹; for a light without extent the irradiance on a
    /// surface that faces it, W m⁻² nm⁻¹.
    pub radiance: Lanes<N>,
    /// Density over solid angle, sr⁻¹; 1 for a light without extent.
    pub pdf: f32,
    /// Whether the light has no extent, so that no bounce ever finds it.
    pub is_point: bool,
}

/// Mean square of radiance over all directions, relative to the square of the mean, of a light whose
/// directions are drawn by `distribution`: in proportion to radiance, columns by azimuth, rows from
/// the zenith to the nadir.
pub(super) fn unevenness(distribution: &Piecewise2d) -> f64 {
    let [width, height] = distribution.size();
    let from_zenith = |row: usize| std::f64::consts::PI * row as f64 / height as f64;
    let of_row = |row: usize| {
        let [upper, lower] = [row, row + 1].map(|row| libm::cos(from_zenith(row)));
        let share_of_sphere = 0.5 * (upper - lower) / width as f64;
        let squares = (0..width).map(|column| {
            let probability = f64::from(distribution.probability(column, row));
            probability * probability / share_of_sphere
        });
        squares.sum::<f64>()
    };
    (0..height).map(of_row).sum()
}

/// Angle between unit vectors, rad, accurate for small angles too.
pub(super) fn angle(a: Vec3, b: Vec3) -> f32 {
    2.0 * libm::atan2f((a - b).length(), (a + b).length())
}

/// The point `a` relative to `from`, without the rounding of a difference in single precision.
pub(super) fn offset(a: Vec3, from: Vec3) -> DVec3 {
    a.as_dvec3() - from.as_dvec3()
}
