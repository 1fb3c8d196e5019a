//! The light of a clear day: the sun's disc and the sky, at any place and time.
//!
//! - **In**: an [`Atmosphere`] and where the sun stands ([`sun_position`] finds that for a place
//!   and time).
//! - **Out**: two lights, [`SunLight`] and [`SkyLight`], W m⁻² sr⁻¹ nm⁻¹.
//! - **Always true**: on a surface that faces it the sun gives the direct irradiance of
//!   [`spctrl2`], and the sky gives its diffuse irradiance on a horizontal surface, at every
//!   wavelength, both times [`Daylight::scale`], unless a forest stands before it.
//! - **Left out**: clouds, polarisation, and the aureole beyond what [`sky_shape`] has.

mod forest;
pub mod sky;
pub mod sky_shape;
pub mod spctrl2;
pub mod sun;
pub mod sun_position;

use glam::DVec3;

use crate::spectrum::Curve;
use sky::SkyLight;
use spctrl2::{Atmosphere, Irradiance};
use sun::SunLight;

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

impl Daylight {
    /// A usual day on open land with the sun half-way up, in the direction +x.
    pub fn usual() -> Self {
        Self {
            elevation: std::f64::consts::FRAC_PI_4,
            azimuth: 0.0,
            atmosphere: Atmosphere::default(),
            scale: 1.0,
            forest: None,
        }
    }

    /// The sun and the sky.
    pub fn lights(&self) -> (SunLight, SkyLight) {
        let mut irradiance = self.atmosphere.irradiance(self.elevation);
        for row in &mut irradiance {
            row.direct *= self.scale;
            row.diffuse *= self.scale;
        }
        let direct = curve(&irradiance, |row| row.direct);
        let sun = SunLight::new(self.towards_sun().as_vec3(), direct);
        (sun, SkyLight::new(self, &irradiance))
    }

    /// Unit vector towards the middle of the sun.
    pub fn towards_sun(&self) -> DVec3 {
        let (up, along) = libm::sincos(self.elevation);
        let (sin, cos) = libm::sincos(self.azimuth);
        DVec3::new(along * cos, along * sin, up)
    }
}

/// One of the quantities as a curve.
fn curve(irradiance: &[Irradiance], of: impl Fn(&Irradiance) -> f64) -> Curve {
    let points: Vec<_> = irradiance.iter().map(|row| (row.nm, of(row))).collect();
    Curve::from_points(&points)
}

#[cfg(test)]
mod tests;
