//! `detector` of `[instruments.NAME.gonio]` and `[instruments.NAME.canopy]`.

use std::f64::consts::TAU;

use leafmodel::document::declared::{Declared, Defaults, Words};
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::number_lists::Rising;
use leafmodel::document::value_kind::{Degrees, Number, Numbers, degrees};

use super::wavelengths::every;
use crate::scene::angle::{TURNS_DEG, azimuth_of_bearing};

/// Most angles of a list.
const MOST_ANGLES: usize = 721;
/// Most directions of a detector.
const MOST_DIRECTIONS: usize = 4096;
/// Angles as they may be written; what is not above the surface gets a message of its own.
const ZENITHS_DEG: Limits = Limits::closed(-180.0, 180.0);
const AZIMUTHS_DEG: Rising = Rising {
    limits: TURNS_DEG,
    most: MOST_ANGLES,
    wanted: "a list of 1 to 721 angles, rising",
};
const USUAL_RANGE_DEG: [f64; 2] = [-75.0, 75.0];
const USUAL_STEP_DEG: f64 = 5.0;

/// A detector far away, in several directions one after the other: all zeniths at all azimuths.
#[derive(Clone, Debug, Declared, Defaults, PartialEq)]
#[key(last = Self::check)]
pub struct Detector {
    /// Angles from the normal, rad, rising, each within (-π/2, π/2); a negative one lies on the other
    /// side of the normal.
    #[key(with = Self::declare_zeniths, default = in_radians(every(USUAL_RANGE_DEG, USUAL_STEP_DEG)))]
    pub zeniths: Vec<f64>,
    /// Azimuths from that of the light, rad; at 0 a positive zenith is on the side of the light.
    #[key(with = Self::declare_azimuths, default = vec![0.0])]
    pub azimuths: Vec<f64>,
    /// Half-angle of the cone about each direction over which figures are means, rad; 0 is the
    /// direction itself. The cone lies above the surface's plane.
    #[key(with = Self::declare_cone)]
    pub half_angle: f64,
    /// Whether figures come from what each scattering event sends towards the detector, or from light that is
    /// counted in its cone.
    #[key("estimator", word)]
    pub estimator: Estimator,
}

/// How a detector's figures are estimated; both are unbiased.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub enum Estimator {
    /// By what each scattering event sends towards the detector.
    #[word("next-event")]
    #[default]
    NextEvent,
    /// By counting light that leaves within the detector's cone.
    Count,
}

impl Detector {
    /// Whether it looks at each surface that scatters light, besides counting what arrives.
    pub fn has_next_events(&self) -> bool {
        self.estimator == Estimator::NextEvent
    }

    /// `zenith_deg`, or `range_deg` and `step_deg`.
    fn declare_zeniths(&mut self, keys: &mut Keys<'_>) {
        let mut range = USUAL_RANGE_DEG;
        let about =
            "First and last zenith angle; negative ones are on the other side of the normal.";
        keys.key("range_deg", &mut range, Numbers::<2>(ZENITHS_DEG), about);
        let mut step = USUAL_STEP_DEG;
        let limits = Number(Limits::closed(0.01, 90.0));
        keys.key("step_deg", &mut step, limits, "From one angle to the next.");
        let mut listed = None;
        let kind = Rising {
            limits: ZENITHS_DEG,
            most: MOST_ANGLES,
            wanted: "a list of 1 to 721 angles, rising",
        };
        let about = "The zenith angles one by one, instead of the two keys above.";
        keys.optional("zenith_deg", &mut listed, kind, about);
        keys.exclude("zenith_deg", "range_deg");
        keys.exclude("zenith_deg", "step_deg");
        if let Some(listed) = listed {
            self.zeniths = in_radians(listed);
            return;
        }
        if range[0] > range[1] {
            let problem = "the last angle is less than the first".to_owned();
            keys.refuse(&["range_deg"], problem, "write the lesser angle first");
            range.reverse();
        }
        if (range[1] - range[0]) / step >= MOST_ANGLES as f64 {
            let problem = format!("gives more than {MOST_ANGLES} zenith angles");
            keys.refuse(
                &["step_deg"],
                problem,
                "use longer steps or a narrower range",
            );
            step = range[1] - range[0];
        }
        self.zeniths = in_radians(every(range, step));
    }

    /// All keys, and bearings in the world instead of azimuths from that of the light, which is given.
    pub(super) fn declare_by_compass(&mut self, light: f64, keys: &mut Keys<'_>) {
        self.declare(keys);
        let mut bearings = None;
        let about = "Compass bearings of the azimuths instead: clockwise from north, which is +y. A positive zenith angle \
        is on that side.";
        keys.optional("compass_deg", &mut bearings, AZIMUTHS_DEG, about);
        keys.exclude("compass_deg", "relative_azimuth_deg");
        if let Some(bearings) = bearings {
            let from_light = |bearing: f64| {
                let turn = (azimuth_of_bearing(bearing) - degrees(light)).rem_euclid(360.0);
                if turn > 180.0 { turn - 360.0 } else { turn }
            };
            self.azimuths = in_radians(bearings.into_iter().map(from_light).collect());
            self.check_count("compass_deg", keys);
        }
    }

    fn declare_azimuths(&mut self, keys: &mut Keys<'_>) {
        let mut degrees = vec![0.0];
        let about = "Azimuths from that of the light: at 0 a positive zenith angle is on the light's \
        side, where the hot spot is. Each goes with all zenith angles.";
        keys.key("relative_azimuth_deg", &mut degrees, AZIMUTHS_DEG, about);
        self.azimuths = in_radians(degrees);
    }

    /// `half_angle_deg`, or `solid_angle_sr`.
    fn declare_cone(&mut self, keys: &mut Keys<'_>) {
        let about = "Half-angle of the cone about each direction over which figures are means; 0 is the \
        direction itself.";
        let limits = Degrees(Limits::below(0.0, 90.0));
        keys.key("half_angle_deg", &mut self.half_angle, limits, about);
        let mut solid_angle = None;
        let about = "The cone by its solid angle, instead of `half_angle_deg`.";
        let limits = Number(Limits::open(0.0, TAU));
        keys.optional("solid_angle_sr", &mut solid_angle, limits, about);
        keys.exclude("solid_angle_sr", "half_angle_deg");
        if let Some(solid_angle) = solid_angle {
            // Ω = 2π (1 − cos α).
            self.half_angle = libm::acos(1.0 - solid_angle / TAU);
        }
    }

    /// Reports directions under the ground, and cones that count nothing.
    fn check(&mut self, keys: &mut Keys<'_>) {
        let listed = keys.has("zenith_deg");
        let key = if listed { "zenith_deg" } else { "range_deg" };
        let half_angle_deg = self.half_angle.to_degrees();
        let zeniths_deg = self.zeniths.iter().map(|&zenith| degrees(zenith));
        let outermost = zeniths_deg.map(f64::abs).fold(0.0, f64::max);
        if outermost + half_angle_deg >= 90.0 {
            let problem = if outermost >= 90.0 {
                format!("a detector at {outermost}° is under the ground, or in its plane")
            } else {
                format!(
                    "the cone of {half_angle_deg:.6}° about {outermost}° reaches under the ground"
                )
            };
            let help = "keep zenith angles and half-angle together below 90: they count from the normal \
            of the surface that is seen";
            keys.refuse(&[key], problem, help);
        }
        if self.estimator == Estimator::Count && self.half_angle == 0.0 {
            let problem = "light is counted in a cone, and there is none".to_owned();
            let help = "add `half_angle_deg`, or leave out `estimator`";
            keys.refuse(&["estimator"], problem, help);
        }
        self.check_count(key, keys);
    }

    fn check_count(&self, key: &str, keys: &Keys<'_>) {
        let count = self.zeniths.len() * self.azimuths.len();
        if count > MOST_DIRECTIONS {
            let problem = format!("{count} directions are more than {MOST_DIRECTIONS}");
            keys.refuse(&[key], problem, "use fewer zenith angles or azimuths");
        }
    }
}

fn in_radians(degrees: Vec<f64>) -> Vec<f64> {
    degrees.into_iter().map(f64::to_radians).collect()
}
