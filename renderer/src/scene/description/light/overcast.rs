//! A sky that is covered with cloud.

use leafmodel::document::declared::{Declared, Defaults};

use crate::light::daylight::sky::SkyLight;
use crate::light::daylight::spctrl2::Atmosphere;
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// A sky that is covered with cloud.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Overcast {
    /// On a horizontal surface; a grey day gives some 0.1 to 0.4 at 560 nm.
    ///
    /// W m⁻² nm⁻¹.
    #[key("irradiance_w_m2_nm", required, SpectrumOf::Emission)]
    pub irradiance: Spectrum,
    /// Share of light that the ground far around reflects, with which the directions below the horizon shine.
    #[key("ground_albedo", 0.0..=1.0, default = Atmosphere::default().ground_albedo)]
    pub ground_albedo: f64,
}

impl Overcast {
    pub(super) fn built(&self) -> SkyLight {
        let irradiance = Curve::from_description(&self.irradiance);
        SkyLight::overcast(&irradiance, self.ground_albedo)
    }
}
