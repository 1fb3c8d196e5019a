//! `[picture]`.

use leafmodel::document::context::Context;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::schema::Type;
use leafmodel::document::tree::{Node, Value};
use leafmodel::document::value_kind::{Flag, Kind, Number, Text, Word};
use leafmodel::document::values::wrong_type;

use crate::scene::description::{Depth, Picture, Tone, White};

/// The name is looked up when the whole scene has been read: a picture that is shown again brings
/// the names of its objects with it.
const OBJECT: Text = Text("the name of an object in the picture");

const LIGHT: Text = Text("the name of a light");

/// A word or a temperature.
struct WhiteKind;

const WORDS: [(&str, White); 1] = [("d65", White::D65)];
const WANTED: &str = "\"d65\", or a number: the colour temperature in K";
const KELVIN: Limits = Limits::closed(White::LEAST, White::MOST);

impl Kind for WhiteKind {
    type Of = White;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<White> {
        match &node.value {
            Value::Integer(_) | Value::Number(_) => {
                Number(KELVIN).read(cx, node, key).map(White::Kelvin)
            }
            Value::Text(text) if text == "d65" => Some(White::D65),
            Value::Text(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::List(_)
            | Value::Table(_) => {
                wrong_type(cx, node, key, WANTED);
                None
            }
        }
    }

    fn write(&self, value: &White) -> Value {
        match value {
            White::D65 => Word(&WORDS).write(value),
            White::Kelvin(kelvin) => Number(KELVIN).write(kelvin),
        }
    }

    fn describe(&self) -> Type {
        let types = vec![Word(&WORDS).describe(), Number(KELVIN).describe()];
        Type::AnyOf(types, WANTED)
    }
}

/// The keys of `[picture]`.
pub(super) fn picture(picture: &mut Picture, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(-30.0, 30.0));
    let about = "Radiance is multiplied by 2 to this power.";
    keys.key("exposure_ev", &mut picture.exposure_ev, limits, about);
    let about = "Whether light is brought to middle grey (0.18) first, by the mean logarithm of \
        the picture's luminance; `exposure_ev` is then more or less than that.";
    keys.key("auto_exposure", &mut picture.auto_exposure, Flag, about);
    let about = "An object that is brought to middle grey (0.18) first, such as a grey card, instead \
        of the whole picture; `exposure_ev` is then more or less than that.";
    keys.optional("grey_object", &mut picture.grey_object, OBJECT, about);
    let other = ("auto_exposure", picture.auto_exposure);
    one_alone(&mut picture.grey_object, "grey_object", other, keys);
    let about = "The light that comes out white: `\"d65\"`, in which colours are as the film has \
        them, or a colour temperature in K (daylight from 4000 on, a black body below).";
    keys.key("white", &mut picture.white, WhiteKind, about);
    let about = "An object that comes out without colour, such as a grey card, instead of `white`.";
    keys.optional("white_object", &mut picture.white_object, OBJECT, about);
    let other = ("white", picture.white != White::D65);
    one_alone(&mut picture.white_object, "white_object", other, keys);
    let about = "A light whose spectrum comes out white, instead of `white`: the mean of all that \
        it sends out. Of `daylight` it is sun and sky on level ground; `NAME.sun` and `NAME.sky` \
        are one of them.";
    keys.optional("white_light", &mut picture.white_light, LIGHT, about);
    for other in [
        ("white", picture.white != White::D65),
        ("white_object", picture.white_object.is_some()),
    ] {
        one_alone(&mut picture.white_light, "white_light", other, keys);
    }
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
    let [least, most] = Tone::CONTRASTS;
    let about = "Slope of `agx` at middle grey over its usual one, which is low. It has no effect on \
        the other tones.";
    let limits = Number(Limits::closed(least, most));
    keys.key("contrast", &mut picture.contrast, limits, about);
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

/// An empty name is none, so that a flag can take away what the scene said; with a name the other
/// key has no effect, if it is set.
fn one_alone(
    name: &mut Option<String>,
    key: &'static str,
    (other, is_set): (&'static str, bool),
    keys: &Keys<'_>,
) {
    if name.as_ref().is_some_and(String::is_empty) {
        *name = None;
    }
    if name.is_some() && is_set && keys.reader().is_some() {
        let problem = format!("`{other}` has no effect beside `{key}`");
        keys.refuse(&[other], problem, "leave one of them out");
    }
}
