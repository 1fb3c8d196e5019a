//! Rotations in space with `libm`'s sine and cosine, so that they have the same bits everywhere.

use glam::{DMat3, DQuat, DVec3};

/// The right-handed rotation about a unit vector, by an angle in radians.
#[inline]
pub fn about(axis: DVec3, angle: f64) -> DMat3 {
    let (sin, cos) = (libm::sin(0.5 * angle), libm::cos(0.5 * angle));
    DMat3::from_quat(DQuat::from_xyzw(
        axis.x * sin,
        axis.y * sin,
        axis.z * sin,
        cos,
    ))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let turned = about(DVec3::Z, FRAC_PI_2) * DVec3::X;
        assert!(turned.distance(DVec3::Y) < 1e-15, "{turned}");
    }
}
