//! `[instruments.NAME.depth]`.

use glam::DVec2;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{Integer, Numbers, Word};

use super::incidence;
use super::sample::FACES;
use crate::scene::description::{DepthProfile, Incidence};

impl DepthProfile {
    /// One with all defaults.
    pub(super) fn usual() -> Self {
        Self {
            // Replaced when the key is read.
            object: usize::MAX,
            uv: None,
            incidence: Incidence {
                angles: vec![0.0],
                ..Incidence::default()
            },
            faces: [true, false],
            slices: 10,
        }
    }
}

/// The keys of the block.
pub(super) fn depth(depth: &mut DepthProfile, keys: &mut Keys<'_>) {
    let kind = NameIn("objects", "the name of an object");
    let about = "The object whose tissue's contents the leaf has.";
    keys.required("object", &mut depth.object, kind, about);
    let mut uv = depth.uv.map(|uv| uv.to_array());
    let about =
        "Texture coordinates of the place whose contents are taken; without them, the mean.";
    let limits = Numbers::<2>(Limits::closed(-1e6, 1e6));
    keys.optional("at_uv", &mut uv, limits, about);
    depth.uv = uv.map(DVec2::from);
    let about = [
        "Angles of parallel light from the normal of the leaf.",
        "Of no effect: layers have no direction.",
    ];
    incidence(&mut depth.incidence, keys, about);
    let about = "The faces that are lit, one after the other.";
    keys.key("faces", &mut depth.faces, Word(&FACES), about);
    let about = "Slices of equal thickness of each of the five layers.";
    let limits = Integer::within(1, 100);
    keys.key("slices", &mut depth.slices, limits, about);
}
