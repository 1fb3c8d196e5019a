//! What is measured by `[instruments.NAME.sphere]` and `[instruments.NAME.gonio]`.

use glam::DVec2;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{Numbers, Word};

use super::detector::Detector;
use super::incidence::{FACES, Incidence};

/// One object, and how it is lit.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Sample {
    /// The sample: an object in one place. The rest of the scene is not there.
    ///
    /// Index into [`Description::objects`](super::super::Description::objects); the default is replaced
    /// when the key is read.
    #[key(
        "object",
        required,
        NameIn("objects", "the name of an object"),
        default = usize::MAX
    )]
    pub object: usize,
    /// The light; angles from the normal of the spot, or of the object's xy plane.
    #[key(
        with = Self::declare_incidence,
        default = Incidence { diffuse: true, ..Incidence::beam() }
    )]
    pub incidence: Incidence,
    /// The faces that are lit, one after the other.
    ///
    /// Whether the adaxial and the abaxial face are; one at least.
    #[key("faces", Word(&FACES), default = [true, true])]
    pub faces: [bool; 2],
    /// A round spot that is lit, instead of the whole object.
    #[key("spot", block)]
    pub spot: Option<Spot>,
    /// Whether absorption is reported by constituents of tissue.
    #[key(default = false)]
    pub constituents: bool,
}

impl Sample {
    fn declare_incidence(&mut self, keys: &mut Keys<'_>) {
        let about = [
            "Angles of parallel light from the normal of the spot.",
            "Azimuth of that light, from the object's +x towards its +y.",
        ];
        self.incidence.declare_from(about, keys);
    }
}

/// A goniometer, which looks at one object from many directions.
#[derive(Clone, Debug, Declared)]
pub struct Gonio {
    /// The object and its light.
    #[key(flat)]
    pub sample: Sample,
    /// Directions from which it is seen, before and behind.
    ///
    /// Those behind the sample are counted from its other normal.
    #[key("detector", block)]
    pub detector: Detector,
}

impl Default for Gonio {
    /// Lit by parallel light alone.
    fn default() -> Self {
        let incidence = Incidence::beam();
        Self {
            sample: Sample {
                incidence,
                ..Sample::default()
            },
            detector: Detector::default(),
        }
    }
}

/// A round spot on a surface.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Spot {
    /// Where the block stands, as `file:line:column`.
    #[key(with = Self::find_place, default = String::new())]
    pub at: String,
    /// Its diameter.
    ///
    /// In m.
    #[key("diameter_mm", required, milli(1e-3..=1e6), default = 0.01)]
    pub diameter: f64,
    /// Its middle.
    #[key(
        with = Self::declare_middle,
        default = SpotMiddle::Uv(DVec2::splat(0.5))
    )]
    pub middle: SpotMiddle,
}

/// The middle of a spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpotMiddle {
    /// Texture coordinates.
    Uv(DVec2),
    /// x and y in the object's own frame, m; the point of its surface that is seen from +z.
    Point(DVec2),
}

impl Spot {
    fn find_place(&mut self, keys: &mut Keys<'_>) {
        if let Some(block) = keys.reader() {
            self.at = block.cx.shown(&block.at);
        }
    }

    fn declare_middle(&mut self, keys: &mut Keys<'_>) {
        let current = match self.middle {
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
                self.middle = SpotMiddle::Point(1e-3 * DVec2::from(place));
            } else {
                let about = "Its middle in texture coordinates.";
                let limits = Numbers::<2>(Limits::closed(-1e6, 1e6));
                keys.needed("at_uv", &mut place, limits, about);
                self.middle = SpotMiddle::Uv(place.into());
            }
        }
    }
}
