//! `[picture]`.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Flag, Number, Word};

use crate::scene::description::{Depth, Picture, Tone};

/// The keys of `[picture]`.
pub(super) fn picture(picture: &mut Picture, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(-30.0, 30.0));
    let about = "Radiance is multiplied by 2 to this power.";
    keys.key("exposure_ev", &mut picture.exposure_ev, limits, about);
    let words = [
        ("agx", Tone::Agx),
        ("standard", Tone::Standard),
        ("filmic", Tone::Filmic),
        ("none", Tone::Linear),
        ("linear", Tone::Linear),
    ];
    let about = "How light becomes what a display shows: a photograph's curve that keeps hues; no \
        curve, with colours that no display has brought among those that it has; each channel \
        rolled off as on film; or neither, each channel clipped (`linear` is its older name), so \
        that colours can be measured in the picture.";
    keys.key("tone", &mut picture.tone, Word(&words), about);
    let mut is_deep = picture.depth == Depth::Sixteen;
    let about = "Whether the PNG has 16 bits a channel instead of 8; a JPEG has 8.";
    keys.key("sixteen_bits", &mut is_deep, Flag, about);
    picture.depth = if is_deep {
        Depth::Sixteen
    } else {
        Depth::Eight
    };
    let about = "Whether the PNG has an alpha channel: the share of a pixel that something \
        covers, with colours from which what lies behind everything is taken out.";
    keys.key("alpha", &mut picture.alpha, Flag, about);
}
