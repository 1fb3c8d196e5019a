//! The light of a clear day: the sun's disc and the sky, at any place and time.
//!
//! - **In**: an [`Atmosphere`](spctrl2::Atmosphere) and where the sun stands ([`sun_position`] finds that for a place
//!   and time).
//! - **Out**: two lights, [`SunLight`] and [`SkyLight`], W m⁻² sr⁻¹ nm⁻¹.
//! - **Always true**: on a surface that faces it the sun gives the direct irradiance of
//!   [`spctrl2`], and the sky gives its diffuse irradiance on a horizontal surface, at every
//!   wavelength, both times [`Daylight::scale`], unless a forest stands before it.
//! - **Left out**: clouds, polarisation, and the aureole beyond what [`sky_shape`] has.

mod day;
mod forest;
pub mod sky;
pub mod sky_shape;
pub mod spctrl2;
pub mod sun;
pub mod sun_position;

use self::day::curve;
pub use self::day::{Daylight, ELEVATIONS_DEG};
use self::sky::SkyLight;
use self::sun::SunLight;

impl Daylight {
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
}

#[cfg(test)]
mod tests;
