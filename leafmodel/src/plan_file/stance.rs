//! `blade.margin_growth`, `blade.drying`, `blade.wilting`, `blade.rest`: what has happened to a
//! blade.

use crate::blade::stance::{Drying, MarginGrowth, Stance, Wilting};
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Degrees, Number, Word};

const SHARE: Number = Number(Limits::closed(0.0, 1.0));

/// The keys of a stance, in the block `blade`.
pub(super) fn stance(stance: &mut Stance, keys: &mut Keys<'_>) {
    let rest = [("held", false), ("ground", true)];
    let about = "Whether the leaf is held by its stalk, or lies on the ground, z = 0, under its \
        weight. A compound leaf lies on three points, its axes straight whatever its own `curl_deg`, \
        `fold_deg` and `tilt_deg`.";
    keys.key("rest", &mut stance.on_ground, Word(&rest), about);
    let usual = || MarginGrowth {
        excess: 0.1,
        width: 0.05,
    };
    let about = "Growth in excess at the margin, which then undulates.";
    keys.optional_block(
        "margin_growth",
        &mut stance.margin_growth,
        usual,
        about,
        margin_growth,
    );
    let about = "Dead tissue that has lost its water: it shrinks, curls and crumples.";
    keys.optional_block(
        "drying",
        &mut stance.drying,
        || Drying::USUAL,
        about,
        drying,
    );
    let usual = || Wilting {
        share: 1.0,
        pitch: 0.0,
    };
    let about = "A leaf without turgor, which its weight bends.";
    keys.optional_block("wilting", &mut stance.wilting, usual, about, wilting);
    if keys.is_sound() && stance.on_ground && stance.wilting.is_some_and(|w| w.pitch != 0.0) {
        let problem = "it says how a leaf that is held by its stalk rises, and this one lies on \
            the ground";
        let help = "leave out `pitch_deg`, or `rest`";
        keys.refuse(&["wilting", "pitch_deg"], problem.to_owned(), help);
    }
}

fn margin_growth(growth: &mut MarginGrowth, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(-0.3, 1.0));
    let about = "Excess of length at the margin; below 0 the blade becomes a bowl.";
    keys.required("excess", &mut growth.excess, limits, about);
    let limits = Number(Limits::closed(0.005, 1.0));
    let about = "Distance over which it falls to 1/e, over the leaf's length.";
    keys.key("width", &mut growth.width, limits, about);
}

fn drying(drying: &mut Drying, keys: &mut Keys<'_>) {
    keys.required("share", &mut drying.share, SHARE, "0 fresh, 1 air-dry.");
    let limits = Number(Limits::closed(0.0, 0.4));
    let about = "Linear shrinkage of air-dry tissue across veins.";
    keys.key("shrinkage", &mut drying.shrinkage, limits, about);
    let about = "Shrinkage along veins over that across.";
    keys.key("along", &mut drying.along, SHARE, about);
    let limits = Number(Limits::closed(-0.1, 0.1));
    let about = "Shrinkage of the adaxial face less that of the abaxial; above 0 the blade curls \
        upwards.";
    keys.key("faces", &mut drying.faces, limits, about);
    let about = "How much patches differ.";
    keys.key("unevenness", &mut drying.unevenness, SHARE, about);
    let limits = Degrees(Limits::closed(-170.0, 170.0));
    let about = "Angle through which drying bows the midrib, towards the adaxial side.";
    keys.key("bow_deg", &mut drying.bow, limits, about);
}

fn wilting(wilting: &mut Wilting, keys: &mut Keys<'_>) {
    keys.required(
        "share",
        &mut wilting.share,
        SHARE,
        "Share of turgor that is lost.",
    );
    let limits = Degrees(Limits::closed(-90.0, 90.0));
    let about = "Angle by which the leaf's axis rises above the horizontal.";
    keys.key("pitch_deg", &mut wilting.pitch, limits, about);
}
