//! `pigments`: which substances the pigments are, in place of PROSPECT-D's columns.

use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Number, Word};
use crate::document::values::rounded;
use crate::optics::Pigments;
use crate::optics::betalains::{Betacyanin, Betaxanthin};
use crate::optics::pigments::{
    Aglycone, AnthocyaninMix, Carotenoid, CarotenoidMix, ChlorophyllMix,
};

/// Rounding that a sum of shares may show.
const ROUNDING: f64 = 1e-6;
/// Shares of anthocyanins where nothing is said: cyanidin, that of most leaves.
const CYANIDIN: [f64; 6] = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
const SHARE: Number = Number(Limits::closed(0.0, 1.0));
const SHIFT_PER_CM: Number = Number(Limits::closed(-3000.0, 3000.0));
const PACKAGING: Number = Number(Limits::above(0.0, 1.0));
const PACKAGING_ABOUT: &str = "Absorptivity in the leaf over that in solution.";

/// The keys of `pigments`, each class in a block of its own.
pub fn pigments(value: &mut Pigments, keys: &mut Keys<'_>) {
    let usual = Pigments::default();
    let mut chlorophyll = (value.chlorophyll != usual.chlorophyll).then_some(value.chlorophyll);
    keys.optional_block(
        "chlorophyll",
        &mut chlorophyll,
        || ChlorophyllMix::Apportioned {
            a_to_b: ChlorophyllMix::A_TO_B,
        },
        "Chlorophyll a and b apart.",
        chlorophylls,
    );
    value.chlorophyll = chlorophyll.unwrap_or(usual.chlorophyll);
    let mut carotenoids = (value.carotenoids != usual.carotenoids).then_some(value.carotenoids);
    keys.optional_block(
        "carotenoids",
        &mut carotenoids,
        || CarotenoidMix::Bands {
            shares: [0.0; 5],
            shift_per_cm: CarotenoidMix::SHIFT_PER_CM,
            packaging: CarotenoidMix::PACKAGING,
        },
        "Named carotenoids.",
        |mix, keys| {
            if let CarotenoidMix::Bands {
                shares: of,
                shift_per_cm,
                packaging,
            } = mix
            {
                let about = "Shift of the bands from solution to leaf.";
                keys.key("shift_per_cm", shift_per_cm, SHIFT_PER_CM, about);
                keys.key("packaging", packaging, PACKAGING, PACKAGING_ABOUT);
                let names = Carotenoid::ALL.map(Carotenoid::name);
                keys.required_block("shares", "Shares by mass.", &[], |keys| {
                    shares(of, names, "carotenoids", keys);
                });
            }
        },
    );
    value.carotenoids = carotenoids.unwrap_or(usual.carotenoids);
    let mut anthocyanins = (value.anthocyanins != usual.anthocyanins).then_some(value.anthocyanins);
    keys.optional_block(
        "anthocyanins",
        &mut anthocyanins,
        || AnthocyaninMix::Aglycones {
            shares: CYANIDIN,
            shift_nm: 0.0,
            blue_fraction: 0.0,
        },
        "Named aglycones; cyanidin where none is named.",
        aglycones,
    );
    value.anthocyanins = anthocyanins.unwrap_or(usual.anthocyanins);
    keys.block("betalains", "Which betalains there are.", |keys| {
        let words = Betacyanin::ALL.map(|one| (one.name(), one));
        let about = "That of beet, or of amaranths.";
        keys.key("betacyanin", &mut value.betacyanins, Word(&words), about);
        let words = Betaxanthin::ALL.map(|one| (one.name(), one));
        let about = "That of cacti, or of beet.";
        keys.key("betaxanthin", &mut value.betaxanthins, Word(&words), about);
        let packaging = &mut value.betalain_packaging;
        keys.key("packaging", packaging, PACKAGING, PACKAGING_ABOUT);
    });
}

fn chlorophylls(mix: &mut ChlorophyllMix, keys: &mut Keys<'_>) {
    let (mut a_to_b, mut in_solution) = (ChlorophyllMix::A_TO_B, false);
    let mut shift_per_cm = ChlorophyllMix::SHIFT_PER_CM;
    let mut packaging = ChlorophyllMix::PACKAGING;
    match *mix {
        ChlorophyllMix::Prospect => {}
        ChlorophyllMix::Apportioned { a_to_b: ratio } => a_to_b = ratio,
        ChlorophyllMix::Bands {
            a_to_b: ratio,
            shift_per_cm: shift,
            packaging: packed,
        } => {
            (a_to_b, in_solution, shift_per_cm, packaging) = (ratio, true, shift, packed);
        }
    }
    let ratio = Number(Limits::closed(0.0, 1e6));
    keys.required(
        "a_to_b",
        &mut a_to_b,
        ratio,
        "Mass of a over mass of b; the median of the leaves of ANGERS is 3.1.",
    );
    let words = Word(&[("leaf", false), ("solution", true)]);
    let about = "`\"leaf\"`: PROSPECT-D's column times what the ratio changes, as wide as in \
        leaves; at 3.1 it is PROSPECT-D's to the bit. `\"solution\"`: the bands in diethyl ether \
        alone, which are narrower: with 45 µg cm⁻² a sun leaf turns from green `#485f33` to \
        olive `#77732e`.";
    keys.key("bands", &mut in_solution, words, about);
    let about = "Shift of the bands from solution to leaf.";
    let sound = keys.is_sound();
    if in_solution || keys.is_description() || !sound {
        keys.key("shift_per_cm", &mut shift_per_cm, SHIFT_PER_CM, about);
        keys.key("packaging", &mut packaging, PACKAGING, PACKAGING_ABOUT);
    } else {
        for key in ["shift_per_cm", "packaging"] {
            if keys.has(key) {
                let problem =
                    "only bands in solution are shifted and packed; those of leaves are so already";
                let help = "write bands = \"solution\" beside it, or leave it out";
                keys.refuse(&[key], problem.to_owned(), help);
            }
        }
    }
    *mix = if in_solution {
        ChlorophyllMix::Bands {
            a_to_b,
            shift_per_cm,
            packaging,
        }
    } else {
        ChlorophyllMix::Apportioned { a_to_b }
    };
}

fn aglycones(mix: &mut AnthocyaninMix, keys: &mut Keys<'_>) {
    let AnthocyaninMix::Aglycones {
        shares: of,
        shift_nm,
        blue_fraction,
    } = mix
    else {
        return;
    };
    let shift = Number(Limits::closed(0.0, 45.0));
    keys.key(
        "shift_nm",
        shift_nm,
        shift,
        "How far stacking and co-pigments move the peaks towards the red.",
    );
    let about = "Share in the blue form with its peak at 585 nm; its height is assumed to be the \
        red form's.";
    keys.key("blue_fraction", blue_fraction, SHARE, about);
    let mut named = (*of != CYANIDIN).then_some(*of);
    let names = Aglycone::ALL.map(Aglycone::name);
    keys.optional_block(
        "shares",
        &mut named,
        || [0.0; 6],
        "Shares by mass.",
        |of, keys| shares(of, names, "anthocyanins", keys),
    );
    *of = named.unwrap_or(CYANIDIN);
}

/// Shares by mass under the substances' names.
fn shares<const N: usize>(
    shares: &mut [f64; N],
    names: [&'static str; N],
    class: &str,
    keys: &mut Keys<'_>,
) {
    if keys.reader().is_some() {
        // Those of a preset do not add up with others.
        *shares = [0.0; N];
    }
    for (name, share) in names.into_iter().zip(shares.iter_mut()) {
        keys.key(name, share, SHARE, "Its share, 0 where it is left out.");
    }
    let sum: f64 = shares.iter().sum();
    if keys.has_only(&names) && keys.is_sound() && (sum - 1.0).abs() > ROUNDING {
        let error = crate::document::error::DocumentError::Impossible {
            key: "shares".to_owned(),
            problem: format!(
                "the shares of the {class} sum to {}, not to 1",
                rounded(sum)
            ),
            help: "change them so that they sum to 1; what is left out has a share of 0".to_owned(),
        };
        keys.report(&[], error);
    }
}
