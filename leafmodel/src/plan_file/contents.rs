//! `contents`: what tissue holds per area.

use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::Number;
use crate::optics::Contents;

/// Code of the warning of pigments that never occur together.
pub(super) const NEVER_TOGETHER: &str = "scene::betalains_and_anthocyanins";

/// A content: its key, its range, whether it must be said, and what it is.
pub(super) struct Content {
    pub(super) key: &'static str,
    pub(super) limits: Limits,
    required: bool,
    pub(super) about: &'static str,
}

const PIGMENT: Limits = Limits::closed(0.0, 1000.0);

const fn content(
    key: &'static str,
    limits: Limits,
    required: bool,
    about: &'static str,
) -> Content {
    Content {
        key,
        limits,
        required,
        about,
    }
}

/// All contents, in the order of [`Contents::to_array`].
pub(super) const CONTENTS: [Content; Contents::COUNT] = [
    content(
        "structure",
        Limits::closed(1.0, 10.0),
        true,
        "N, number of plates, a real number; 1.05 to 2.7 in the leaves of the ANGERS data.",
    ),
    content(
        "chlorophyll_ug_per_cm2",
        PIGMENT,
        true,
        "Chlorophyll a + b; 1 to 107 in ANGERS.",
    ),
    content(
        "carotenoids_ug_per_cm2",
        PIGMENT,
        true,
        "0 to 25 in ANGERS.",
    ),
    content(
        "anthocyanins_ug_per_cm2",
        PIGMENT,
        false,
        "Red leaves: 5 to 30.",
    ),
    content(
        "betacyanins_ug_per_cm2",
        PIGMENT,
        false,
        "Leaves of the amaranth family: 1.2 to 34 (from 0.08 to 1.36 mg per g fresh weight, Cai \
            et al. 2001).",
    ),
    content(
        "betaxanthins_ug_per_cm2",
        PIGMENT,
        false,
        "Yellow betalains.",
    ),
    content(
        "brown",
        Limits::closed(0.0, 100.0),
        false,
        "Brown pigments of dead tissue.",
    ),
    content(
        "water_cm",
        Limits::closed(0.0, 1.0),
        true,
        "0.004 to 0.034 in ANGERS.",
    ),
    content(
        "dry_matter_g_per_cm2",
        Limits::closed(0.0, 1.0),
        true,
        "0.002 to 0.033 in ANGERS.",
    ),
];

/// The keys of contents. Those that most leaves have must be said.
pub fn contents(value: &mut Contents, keys: &mut Keys<'_>) {
    let mut all = value.to_array();
    for (content, value) in CONTENTS.iter().zip(&mut all) {
        let number = Number(content.limits);
        if content.required {
            keys.required(content.key, value, number, content.about);
        } else {
            keys.key(content.key, value, number, content.about);
        }
    }
    *value = Contents::from_array(all);
    warn_of_mixture(value, keys, "this leaf holds");
}

/// The keys of contents of which none must be said: what is not there stays as it is.
pub fn changed_contents(value: &mut Contents, keys: &mut Keys<'_>) {
    let mut all = value.to_array();
    for (content, value) in CONTENTS.iter().zip(&mut all) {
        keys.key(content.key, value, Number(content.limits), content.about);
    }
    *value = Contents::from_array(all);
}

/// Warns of betalains beside anthocyanins; `what` begins the sentence.
pub(super) fn warn_of_mixture(contents: &Contents, keys: &Keys<'_>, what: &str) {
    if contents.mixes_betalains_and_anthocyanins() {
        let message =
            format!("{what} betalains and anthocyanins, which never occur in the same plant");
        keys.warn(NEVER_TOGETHER, message, Contents::NEVER_TOGETHER);
    }
}

/// Tissue that holds nothing.
pub const NOTHING: Contents = Contents {
    structure: 1.0,
    chlorophyll: 0.0,
    carotenoids: 0.0,
    anthocyanins: 0.0,
    betacyanins: 0.0,
    betaxanthins: 0.0,
    brown: 0.0,
    water: 0.0,
    dry_matter: 0.0,
};
