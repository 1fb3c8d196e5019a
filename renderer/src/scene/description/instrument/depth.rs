//! `[instruments.NAME.depth]`.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::Word;

use super::incidence::{FACES, Incidence};

/// Light by depth within a leaf of layers that has the contents of an object's tissue.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct DepthProfile {
    /// The object whose tissue's contents the leaf has.
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
    /// Texture coordinates of the place whose contents are taken; without them, the mean.
    #[key("at_uv", -1e6..=1e6)]
    pub uv: Option<[f64; 2]>,
    /// The light; angles from the normal of the leaf.
    #[key(with = Self::declare_incidence, default = Incidence::beam())]
    pub incidence: Incidence,
    /// The faces that are lit, one after the other.
    ///
    /// Whether the adaxial and the abaxial face are; one at least.
    #[key("faces", Word(&FACES), default = [true, false])]
    pub faces: [bool; 2],
    /// Slices of equal thickness of each of the five layers.
    #[key("slices", 1..=100, default = 10)]
    pub slices: usize,
}

impl DepthProfile {
    fn declare_incidence(&mut self, keys: &mut Keys<'_>) {
        let about = [
            "Angles of parallel light from the normal of the leaf.",
            "Of no effect: layers have no direction.",
        ];
        self.incidence.declare_from(about, keys);
    }
}
