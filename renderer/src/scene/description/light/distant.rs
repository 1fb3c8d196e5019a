//! A disc at infinity.

use std::f64::consts::PI;

use glam::DVec3;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Number, Vector};

use crate::geometry::instance::COORDINATES_M;
use crate::light::distant::DistantLight;
use crate::plugin::emitter::{Emitter, area};
use crate::plugin::spectra::Spectra;
use crate::scene::angle::{TURNS_DEG, declare_compass, sin_cos_deg};
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// A disc at infinity.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Distant {
    /// On a surface that faces the light; the sun at the ground has about 1.5 at 560 nm.
    ///
    /// W m⁻² nm⁻¹.
    #[key("irradiance_w_m2_nm", required, SpectrumOf::Emission)]
    pub irradiance: Spectrum,
    /// Angle that the disc fills; the default is the sun's. Larger gives softer shadows.
    #[key("angular_diameter_deg", degrees(0.01..=90.0), default = 0.53_f64.to_radians())]
    pub angular_diameter: f64,
    /// Unit vector towards its middle.
    #[key(with = direction, default = DVec3::Z)]
    pub towards: DVec3,
}

impl Distant {
    pub(super) fn built(&self) -> DistantLight {
        let irradiance = Curve::from_description(&self.irradiance);
        DistantLight::new(self.towards.as_vec3(), self.angular_diameter, irradiance)
    }

    pub(super) fn emitter(&self, spectra: &mut Spectra) -> Emitter<'_> {
        let half = 0.5 * self.angular_diameter;
        let sin = libm::sin(half);
        let radiance = spectra.element("radiance", &self.irradiance, 1.0 / (PI * sin * sin));
        Emitter::Disc {
            towards: self.towards,
            half,
            emitter: area(radiance),
        }
    }
}

/// `towards`, or `elevation_deg` and `azimuth_deg`.
fn direction(light: &mut Distant, keys: &mut Keys<'_>) {
    let mut vector = None;
    let about = "Direction towards the light, of any length, instead of the two angles.";
    keys.optional("towards", &mut vector, Vector(COORDINATES_M), about);
    keys.exclude("towards", "elevation_deg");
    keys.exclude("towards", "azimuth_deg");
    keys.exclude("towards", "compass_deg");
    if keys.reader().is_some() && keys.has("towards") {
        match vector.map(DVec3::try_normalize) {
            Some(Some(direction)) => light.towards = direction,
            Some(None) => {
                let error = DocumentError::BadView {
                    problem: "`towards` is zero, so the light comes from nowhere",
                    help: "write a direction, for example `towards = [0, 0, 1]`",
                };
                keys.report(&["towards"], error);
            }
            None => {}
        }
        return;
    }
    let (mut elevation, mut azimuth) = (90.0, 0.0);
    let limits = Number(Limits::closed(-90.0, 90.0));
    let about = "Height above the horizon.";
    keys.needed("elevation_deg", &mut elevation, limits, about);
    let about = "Direction along the ground, from +x towards +y.";
    keys.key("azimuth_deg", &mut azimuth, Number(TURNS_DEG), about);
    azimuth = declare_compass(keys).unwrap_or(azimuth);
    keys.group(&["towards", "elevation_deg"]);
    let (up, along) = sin_cos_deg(elevation);
    let (sin, cos) = sin_cos_deg(azimuth);
    light.towards = DVec3::new(along * cos, along * sin, up);
}
