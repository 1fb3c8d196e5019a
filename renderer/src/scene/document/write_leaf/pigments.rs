//! Pigments as a block of a file: the mirror image of `document/pigments.rs`.

use leafmodel::optics::Pigments;
use leafmodel::optics::pigments::{
    Aglycone, AnthocyaninMix, Carotenoid, CarotenoidMix, ChlorophyllMix,
};

use super::Keys;
use crate::scene::document::pigments::CYANIDIN;
use crate::scene::document::tree::Value;

/// The block `pigments`, empty if all are PROSPECT-D's.
pub(in super::super) fn pigments(pigments: &Pigments) -> Keys {
    let mut keys = Keys::default();
    let mut block = Keys::default();
    match pigments.chlorophyll {
        ChlorophyllMix::Prospect => {}
        ChlorophyllMix::Apportioned { a_to_b } => block.number("a_to_b", a_to_b),
        ChlorophyllMix::Bands {
            a_to_b,
            shift_per_cm,
            packaging,
        } => {
            block.number("a_to_b", a_to_b);
            block.value("bands", Value::Text("solution".to_owned()));
            block.number_unless("shift_per_cm", shift_per_cm, ChlorophyllMix::SHIFT_PER_CM);
            block.number_unless("packaging", packaging, ChlorophyllMix::PACKAGING);
        }
    }
    keys.block_if_any("chlorophyll", block);
    if let CarotenoidMix::Bands {
        shares: of,
        shift_per_cm,
        packaging,
    } = pigments.carotenoids
    {
        let mut block = Keys::default();
        block.number_unless("shift_per_cm", shift_per_cm, CarotenoidMix::SHIFT_PER_CM);
        block.number_unless("packaging", packaging, CarotenoidMix::PACKAGING);
        block.block("shares", shares(Carotenoid::ALL.map(Carotenoid::name), of));
        keys.block("carotenoids", block);
    }
    if let AnthocyaninMix::Aglycones {
        shares: of,
        shift_nm,
        blue_fraction,
    } = pigments.anthocyanins
    {
        let mut block = Keys::default();
        block.number_unless("shift_nm", shift_nm, 0.0);
        block.number_unless("blue_fraction", blue_fraction, 0.0);
        if of != CYANIDIN {
            block.block("shares", shares(Aglycone::ALL.map(Aglycone::name), of));
        }
        keys.block("anthocyanins", block);
    }
    let usual = Pigments::default();
    let mut block = Keys::default();
    for (key, name, usual) in [
        (
            "betacyanin",
            pigments.betacyanins.name(),
            usual.betacyanins.name(),
        ),
        (
            "betaxanthin",
            pigments.betaxanthins.name(),
            usual.betaxanthins.name(),
        ),
    ] {
        if name != usual {
            block.value(key, Value::Text(name.to_owned()));
        }
    }
    let packaging = pigments.betalain_packaging;
    block.number_unless("packaging", packaging, usual.betalain_packaging);
    keys.block_if_any("betalains", block);
    keys
}

fn shares<const N: usize>(names: [&'static str; N], shares: [f64; N]) -> Keys {
    let mut keys = Keys::default();
    for (name, share) in names.into_iter().zip(shares) {
        keys.number_unless(name, share, 0.0);
    }
    keys
}
