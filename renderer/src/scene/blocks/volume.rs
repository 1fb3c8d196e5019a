//! `[objects.NAME.volume]`: leaves afloat in a box.

use glam::DVec3;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Integer, Number, Numbers, Word};

use super::camera::COORDINATES_M;
use crate::geometry::scatter::{Inclination, Volume};
use crate::scene::description::Object;

const INCLINATIONS: [(&str, Inclination); 6] = [
    ("spherical", Inclination::Spherical),
    ("uniform", Inclination::Uniform),
    ("planophile", Inclination::Planophile),
    ("erectophile", Inclination::Erectophile),
    ("plagiophile", Inclination::Plagiophile),
    ("extremophile", Inclination::Extremophile),
];

fn usual() -> Volume {
    Volume {
        within: [DVec3::ZERO, DVec3::ONE],
        lai: 1.0,
        inclination: Inclination::Spherical,
        seed: 0,
    }
}

/// The key `volume` of an object.
pub(super) fn volume(object: &mut Object, keys: &mut Keys<'_>) {
    for other in ["instances", "scatter", "plant"] {
        keys.exclude(other, "volume");
    }
    let mut volume = object.volume.take().map(|volume| *volume);
    let about = "A box in which copies of the object float, instead of its own place.";
    keys.optional_block("volume", &mut volume, usual, about, afloat);
    object.volume = volume.map(Box::new);
}

fn afloat(volume: &mut Volume, keys: &mut Keys<'_>) {
    let mut within = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    let kind = Numbers::<6>(COORDINATES_M);
    let about = "The box for their origins: least x, y and z, greatest x, y and z.";
    keys.required("within_m", &mut within, kind, about);
    let [x0, y0, z0, x1, y1, z1] = within;
    if x0 >= x1 || y0 >= y1 || z0 > z1 {
        let problem = "the box has no ground plan".to_owned();
        let help = "write the least x, y and z first: `within_m = [0, 0, 0, 1, 1, 0.5]`";
        keys.refuse(&["within_m"], problem, help);
    }
    volume.within = [DVec3::new(x0, y0, z0), DVec3::new(x1, y1, z1)];
    let about = "Leaf area index: area of all copies over the area of the box's ground plan.";
    let limits = Number(Limits::above(0.0, 1000.0));
    keys.required("lai", &mut volume.lai, limits, about);
    let about = "The distribution of the angle between their +z and the vertical, after de Wit.";
    keys.key(
        "inclination",
        &mut volume.inclination,
        Word(&INCLINATIONS),
        about,
    );
    let seed = Integer::within(0, u64::MAX);
    keys.key(
        "seed",
        &mut volume.seed,
        seed,
        "Same numbers and seed, same places.",
    );
}
