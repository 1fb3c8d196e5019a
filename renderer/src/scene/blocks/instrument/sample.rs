//! What is measured by `[instruments.NAME.sphere]` and `[instruments.NAME.gonio]`.

use glam::DVec2;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{Number, Numbers, Word};

use super::incidence;
use crate::scene::description::{Incidence, Sample, Spot, SpotMiddle};

/// Words for the faces that are lit.
pub(super) const FACES: [(&str, [bool; 2]); 3] = [
    ("both", [true, true]),
    ("adaxial", [true, false]),
    ("abaxial", [false, true]),
];

impl Sample {
    /// One with all defaults.
    pub(in crate::scene) fn usual() -> Self {
        Self {
            // Replaced when the key is read.
            object: usize::MAX,
            incidence: Incidence {
                angles: vec![0.0],
                diffuse: true,
                ..Incidence::default()
            },
            faces: [true, true],
            spot: None,
            constituents: false,
        }
    }

    /// The same, lit by parallel light alone unless asked for more.
    pub(super) fn beams_alone() -> Self {
        let usual = Self::usual();
        Self {
            incidence: Incidence {
                diffuse: false,
                ..usual.incidence
            },
            ..usual
        }
    }
}

impl Spot {
    fn usual() -> Self {
        Self {
            at: String::new(),
            diameter: 0.01,
            middle: SpotMiddle::Uv(DVec2::splat(0.5)),
        }
    }
}

/// The keys of the block.
pub(super) fn sample(sample: &mut Sample, keys: &mut Keys<'_>) {
    let kind = NameIn("objects", "the name of an object");
    let about = "The sample: an object in one place. The rest of the scene is not there.";
    keys.required("object", &mut sample.object, kind, about);
    let about = [
        "Angles of parallel light from the normal of the spot.",
        "Azimuth of that light, from the object's +x towards its +y.",
    ];
    incidence(&mut sample.incidence, keys, about);
    let about = "The faces that are lit, one after the other.";
    keys.key("faces", &mut sample.faces, Word(&FACES), about);
    let about = "A round spot that is lit, instead of the whole object.";
    keys.optional_block("spot", &mut sample.spot, Spot::usual, about, spot);
}

fn spot(spot: &mut Spot, keys: &mut Keys<'_>) {
    let mut diameter_mm = 1e3 * spot.diameter;
    let limits = Number(Limits::closed(1e-3, 1e6));
    keys.required("diameter_mm", &mut diameter_mm, limits, "Its diameter.");
    spot.diameter = 1e-3 * diameter_mm;
    let current = match spot.middle {
        SpotMiddle::Uv(_) => "at_uv",
        SpotMiddle::Point(_) => "at_mm",
    };
    for chosen in keys.one_of(&["at_mm", "at_uv"], Some(current)) {
        let mut place = [0.0; 2];
        if chosen == "at_mm" {
            let about = "x and y of its middle in the object's own frame: of a leaf from its base, \
                y along the midrib.";
            let limits = Numbers::<2>(Limits::closed(-1e6, 1e6));
            keys.needed("at_mm", &mut place, limits, about);
            spot.middle = SpotMiddle::Point(1e-3 * DVec2::from(place));
        } else {
            let about = "Its middle in texture coordinates.";
            let limits = Numbers::<2>(Limits::closed(-1e6, 1e6));
            keys.needed("at_uv", &mut place, limits, about);
            spot.middle = SpotMiddle::Uv(place.into());
        }
    }
    if let Some(block) = keys.reader() {
        spot.at = block.cx.shown(&block.at);
    }
}
