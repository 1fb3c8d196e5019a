//! The light of a clear day: the sun's disc and the sky, at any place and time.
//!
//! - **In**: an [`Atmosphere`] and where the sun stands ([`sun_position`] finds that for a place
//!   and time).
//! - **Out**: two lights, [`SunLight`] and [`SkyLight`], W m⁻² sr⁻¹ nm⁻¹.
//! - **Always true**: on a surface that faces it the sun gives the direct irradiance of
//!   [`spctrl2`], and the sky gives its diffuse irradiance on a horizontal surface, at every
//!   wavelength.
//! - **Left out**: clouds, polarisation, and the aureole beyond what [`sky_shape`] has.

pub mod sky;
pub mod sky_shape;
pub mod spctrl2;
pub mod sun;
pub mod sun_position;

use glam::{DVec3, Vec3};

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
}

/// Elevations of the sun for which the models hold, degrees.
pub const ELEVATIONS_DEG: [f64; 2] = [1.0, 90.0];

impl Daylight {
    /// The sun and the sky.
    pub fn lights(&self) -> (SunLight, SkyLight) {
        let irradiance = self.atmosphere.irradiance(self.elevation);
        let direct = curve(&irradiance, |row| row.direct);
        let sun = SunLight::new(self.towards_sun(), direct);
        (sun, SkyLight::new(self, &irradiance))
    }

    fn towards_sun(&self) -> Vec3 {
        let (up, along) = libm::sincos(self.elevation);
        let (sin, cos) = libm::sincos(self.azimuth);
        DVec3::new(along * cos, along * sin, up).as_vec3()
    }
}

/// One of the quantities as a curve.
fn curve(irradiance: &[Irradiance], of: impl Fn(&Irradiance) -> f64) -> Curve {
    let points: Vec<_> = irradiance.iter().map(|row| (row.nm, of(row))).collect();
    Curve::from_points(&points)
}

#[cfg(test)]
mod tests;
