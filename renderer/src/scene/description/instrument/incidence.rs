//! The directions from which the light of an instrument comes.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::number_lists::Rising;
use leafmodel::document::value_kind::{Degrees, Flag, degrees};

use crate::scene::angle::TURNS_DEG;

/// Words for the faces that are lit.
pub(super) const FACES: [(&str, [bool; 2]); 3] = [
    ("both", [true, true]),
    ("adaxial", [true, false]),
    ("abaxial", [false, true]),
];

const ANGLES_DEG: Rising = Rising {
    limits: Limits::below(0.0, 90.0),
    most: 90,
    wanted: "a list of 1 to 90 angles, rising",
};

/// The directions from which light comes, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Incidence {
    /// Angles of parallel beams from the instrument's normal, rad, each in [0, π/2).
    pub angles: Vec<f64>,
    /// Azimuth of these beams, rad.
    pub azimuth: f64,
    /// Whether even light from the whole hemisphere is measured too.
    pub diffuse: bool,
}

impl Incidence {
    /// A beam along the normal.
    pub(super) fn beam() -> Self {
        Self {
            angles: vec![0.0],
            azimuth: 0.0,
            diffuse: false,
        }
    }

    /// Its keys; `from` says from what the angles are counted, and `about` is of the azimuth.
    pub(super) fn declare_from(&mut self, [from, about]: [&'static str; 2], keys: &mut Keys<'_>) {
        let mut angles_deg: Vec<f64> = self.angles.iter().copied().map(degrees).collect();
        keys.key("incidence_deg", &mut angles_deg, ANGLES_DEG, from);
        self.angles = angles_deg.into_iter().map(f64::to_radians).collect();
        keys.key("azimuth_deg", &mut self.azimuth, Degrees(TURNS_DEG), about);
        let about = "Whether even light from the whole hemisphere is measured too.";
        keys.key("diffuse", &mut self.diffuse, Flag, about);
    }
}
