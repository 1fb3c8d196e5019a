//! A point that shines into a cone.

use glam::DVec3;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;

use crate::geometry::instance::COORDINATES_M;
use crate::light::spot::SpotLight;
use crate::plugin::element::Element;
use crate::plugin::spectra::Spectra;
use crate::plugin::{UNITS_PER_METRE, look_at};
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// A point that shines into a cone.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = check_cone)]
pub struct Spotlight {
    /// Radiant intensity on the axis: at 1 m, the irradiance on a surface that faces the light.
    ///
    /// W sr⁻¹ nm⁻¹.
    #[key("intensity_w_sr_nm", required, SpectrumOf::Emission)]
    pub intensity: Spectrum,
    /// Where it is.
    #[key("position_m", required, within(COORDINATES_M))]
    pub position: DVec3,
    /// Point that it aims at; not where it is.
    #[key("look_at_m", required, within(COORDINATES_M), default = DVec3::NEG_Z)]
    pub look_at: DVec3,
    /// Half angle of the cone, outside of which there is no light; 180 is a point that shines everywhere.
    #[key("cone_angle_deg", degrees(0.1..=180.0), default = 20.0_f64.to_radians())]
    pub cone_angle: f64,
    /// Width of the edge inside the cone, over which the light fades out; 0 is sharp. At most `cone_angle_deg`.
    ///
    /// Intensity falls to 0 linearly in the angle.
    #[key("penumbra_angle_deg", degrees(0.0..=180.0))]
    pub penumbra_angle: f64,
}

impl Spotlight {
    pub(super) fn built(&self, origin: DVec3) -> SpotLight {
        SpotLight::new(
            (self.position - origin).as_vec3(),
            (self.look_at - self.position).normalize().as_vec3(),
            self.cone_angle,
            self.penumbra_angle,
            Curve::from_description(&self.intensity),
        )
    }

    pub(super) fn emitter(&self, spectra: &mut Spectra) -> Element {
        let places = [self.position, self.look_at];
        let [origin, target] = places.map(|place| place * UNITS_PER_METRE);
        let up = (target - origin).normalize().any_orthonormal_vector();
        let beam = self.cone_angle - self.penumbra_angle;
        // Intensity over the square of a distance in Mitsuba's units must equal irradiance in ours.
        let factor = UNITS_PER_METRE * UNITS_PER_METRE;
        Element::plugin("emitter", "spot")
            .placed([look_at(origin, target, up)])
            .float("cutoff_angle", self.cone_angle.to_degrees())
            .float("beam_width", beam.max(0.0).to_degrees())
            .holding(spectra.element("intensity", &self.intensity, factor))
    }
}

/// Reports a cone without a direction, or an edge wider than its cone.
fn check_cone(spot: &mut Spotlight, keys: &mut Keys<'_>) {
    if !keys.is_sound() {
        return;
    }
    let (position, look_at) = (spot.position, spot.look_at);
    // Closer than this the direction would be dominated by rounding errors.
    if (look_at - position).length() <= 1e-9 * position.length().max(1e-3) {
        let error = DocumentError::BadView {
            problem: "the light shines at the point where it stands",
            help: "move `position_m` or `look_at_m`",
        };
        keys.report(&["look_at_m"], error);
    }
    if spot.penumbra_angle > spot.cone_angle {
        let problem = "the edge of the light is wider than its cone".to_owned();
        let help = "write at most the value of `cone_angle_deg`, 20 if that is left out";
        keys.refuse(&["penumbra_angle_deg"], problem, help);
    }
}
