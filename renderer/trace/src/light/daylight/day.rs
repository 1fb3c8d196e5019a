//! A clear day: where the sun is, and the air.

use glam::DVec3;

use super::spctrl2::{Atmosphere, Irradiance};
use crate::spectrum::Curve;

/// A clear day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Elevation of the sun above the horizon, rad, in [`ELEVATIONS_DEG`].
    pub elevation: f64,
    /// Direction of the sun along the ground, rad, from +x towards +y.
    pub azimuth: f64,
    /// What lies between the sun and the ground.
    pub atmosphere: Atmosphere,
    /// Factor on sun and sky.
    pub scale: f64,
    /// Azimuth of the middle of a forest, rad, at whose edge the scene lies; `None` is open land.
    pub forest: Option<f64>,
}

/// Elevations of the sun for which the models hold, degrees.
pub const ELEVATIONS_DEG: [f64; 2] = [1.0, 90.0];

impl Default for Daylight {
    /// A clear day on open land with the sun half-way up, in the direction +x.
    fn default() -> Self {
        Self {
            elevation: std::f64::consts::FRAC_PI_4,
            azimuth: 0.0,
            atmosphere: Atmosphere::default(),
            scale: 1.0,
            forest: None,
        }
    }
}

impl Daylight {
    /// Unit vector towards the middle of the sun.
    pub fn towards_sun(&self) -> DVec3 {
        let (up, along) = libm::sincos(self.elevation);
        let (sin, cos) = libm::sincos(self.azimuth);
        DVec3::new(along * cos, along * sin, up)
    }
}

/// One of the quantities as a curve.
pub(super) fn curve(irradiance: &[Irradiance], of: impl Fn(&Irradiance) -> f64) -> Curve {
    let points: Vec<_> = irradiance.iter().map(|row| (row.nm, of(row))).collect();
    Curve::from_points(&points)
}
