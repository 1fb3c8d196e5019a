//! `[instruments.NAME.canopy]`.

use glam::DVec2;
use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::Numbers;

use super::detector::detector;
use super::{Rising, incidence, rectangle};
use crate::scene::blocks::camera::COORDINATES_M;
use crate::scene::description::{Canopy, Detector, Incidence};

/// Most heights between layers.
const MOST_BORDERS: usize = 1000;

impl Canopy {
    /// One with all defaults.
    pub(super) fn usual() -> Self {
        Self {
            within: [DVec2::ZERO, DVec2::ONE],
            incidence: Incidence {
                angles: vec![0.0],
                ..Incidence::default()
            },
            soil: None,
            layers: Vec::new(),
            detector: None,
        }
    }
}

/// The keys of the block.
pub(super) fn canopy(canopy: &mut Canopy, keys: &mut Keys<'_>) {
    let mut within = [0.0, 0.0, 1.0, 1.0];
    let about = "The box that repeats itself: least x and y, greatest x and y.";
    let kind = Numbers::<4>(COORDINATES_M);
    keys.required("within_m", &mut within, kind, about);
    canopy.within = rectangle(within, "within_m", keys);
    let about = [
        "Angles of parallel light from +z, such as zenith angles of the sun.",
        "Azimuth from which that light comes, from +x towards +y.",
    ];
    incidence(&mut canopy.incidence, keys, about);
    let kind = NameIn("objects", "the name of an object");
    let about = "The object that is the soil, so that what arrives there is told.";
    keys.optional("soil", &mut canopy.soil, kind, about);
    let kind = Rising {
        limits: COORDINATES_M,
        most: MOST_BORDERS,
        what: "a list of 1 to 1000 heights, rising",
    };
    let about = "Heights between layers whose absorption is told one by one.";
    keys.key("layers_m", &mut canopy.layers, kind, about);
    let about = "Directions from which the canopy is seen, for its BRF.";
    keys.optional_block(
        "detector",
        &mut canopy.detector,
        Detector::usual,
        about,
        detector,
    );
}
