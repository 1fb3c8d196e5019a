//! Rotations and scales of objects.

use glam::{DMat3, DVec3};
use leafmodel::document::limits::Limits;

use crate::scene::angle::sin_cos_deg;

/// Range of angles of rotation, degrees.
pub(super) const ANGLES_DEG: Limits = Limits::closed(-3600.0, 3600.0);
/// Range of scale factors.
pub(super) const SCALES: Limits = Limits::above(0.0, 1e6);

/// The rotation about x, then y, then z, by angles in degrees.
pub(super) fn turn([x, y, z]: [f64; 3]) -> DMat3 {
    turn_about_z(z) * turn_about_y(y) * turn_about_x(x)
}

fn turn_about_x(deg: f64) -> DMat3 {
    let (sin, cos) = sin_cos_deg(deg);
    DMat3::from_cols(
        DVec3::X,
        DVec3::new(0.0, cos, sin),
        DVec3::new(0.0, -sin, cos),
    )
}

fn turn_about_y(deg: f64) -> DMat3 {
    let (sin, cos) = sin_cos_deg(deg);
    DMat3::from_cols(
        DVec3::new(cos, 0.0, -sin),
        DVec3::Y,
        DVec3::new(sin, 0.0, cos),
    )
}

fn turn_about_z(deg: f64) -> DMat3 {
    let (sin, cos) = sin_cos_deg(deg);
    DMat3::from_cols(
        DVec3::new(cos, sin, 0.0),
        DVec3::new(-sin, cos, 0.0),
        DVec3::Z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_right_handed() {
        assert_eq!(turn_about_x(90.0) * DVec3::Y, DVec3::Z);
        assert_eq!(turn_about_y(90.0) * DVec3::Z, DVec3::X);
        assert_eq!(turn_about_z(90.0) * DVec3::X, DVec3::Y);
    }
}
