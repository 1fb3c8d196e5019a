//! `pigments`: which substances the pigments of a leaf are, in place of PROSPECT-D's columns.

use leafmodel::optics::Pigments;
use leafmodel::optics::betalains::{Betacyanin, Betaxanthin};
use leafmodel::optics::pigments::{
    Aglycone, AnthocyaninMix, Carotenoid, CarotenoidMix, ChlorophyllMix,
};

use super::limits::Limits;
use super::reader::Block;
use super::values::rounded;
use crate::scene::error::SceneError;

/// Rounding that a sum of shares may show.
const ROUNDING: f64 = 1e-6;
/// Shares of anthocyanins where nothing is said: cyanidin, that of most leaves.
pub(super) const CYANIDIN: [f64; 6] = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
const SHARE: Limits = Limits::closed(0.0, 1.0);
const A_TO_B: Limits = Limits::closed(0.0, 1e6);
const SHIFT_PER_CM: Limits = Limits::closed(-3000.0, 3000.0);
const SHIFT_NM: Limits = Limits::closed(0.0, 45.0);
const PACKAGING: Limits = Limits::above(0.0, 1.0);

/// Reads `pigments`, which may be left out; `None` if it has an error.
pub(super) fn read_pigments(owner: &Block<'_>) -> Option<Pigments> {
    let mut pigments = Pigments::default();
    let Some(block) = owner.optional_block("pigments") else {
        return owner.entry("pigments").is_none().then_some(pigments);
    };
    let errors = block.cx.error_count();
    if let Some(inner) = block.optional_block("chlorophyll") {
        pigments.chlorophyll = read_chlorophyll(&inner);
    }
    if let Some(inner) = block.optional_block("carotenoids") {
        let shares = inner.block("shares", &[]).and_then(|table| {
            read_shares(&table, "carotenoids", Carotenoid::ALL.map(Carotenoid::name))
        });
        let shift_per_cm =
            inner.number_or("shift_per_cm", SHIFT_PER_CM, CarotenoidMix::SHIFT_PER_CM);
        let packaging = inner.number_or("packaging", PACKAGING, CarotenoidMix::PACKAGING);
        inner.finish();
        pigments.carotenoids = CarotenoidMix::Bands {
            shares: shares.unwrap_or_default(),
            shift_per_cm,
            packaging,
        };
    }
    if let Some(inner) = block.optional_block("anthocyanins") {
        let shares = inner.optional_block("shares").and_then(|table| {
            read_shares(&table, "anthocyanins", Aglycone::ALL.map(Aglycone::name))
        });
        let shift_nm = inner.number_or("shift_nm", SHIFT_NM, 0.0);
        let blue_fraction = inner.number_or("blue_fraction", SHARE, 0.0);
        inner.finish();
        pigments.anthocyanins = AnthocyaninMix::Aglycones {
            shares: shares.unwrap_or(CYANIDIN),
            shift_nm,
            blue_fraction,
        };
    }
    if let Some(inner) = block.optional_block("betalains") {
        let named = inner.word("betacyanin", &Betacyanin::ALL.map(Betacyanin::name));
        let betacyanin = Betacyanin::ALL
            .into_iter()
            .find(|one| Some(one.name()) == named);
        let named = inner.word("betaxanthin", &Betaxanthin::ALL.map(Betaxanthin::name));
        let betaxanthin = Betaxanthin::ALL
            .into_iter()
            .find(|one| Some(one.name()) == named);
        pigments.betacyanins = betacyanin.unwrap_or(pigments.betacyanins);
        pigments.betaxanthins = betaxanthin.unwrap_or(pigments.betaxanthins);
        pigments.betalain_packaging =
            inner.number_or("packaging", PACKAGING, pigments.betalain_packaging);
        inner.finish();
    }
    block.finish();
    (block.cx.error_count() == errors).then_some(pigments)
}

/// Chlorophyll a and b; where there is an error it is noted, and what comes back does not matter.
fn read_chlorophyll(block: &Block<'_>) -> ChlorophyllMix {
    let a_to_b = block.number("a_to_b", A_TO_B);
    let a_to_b = a_to_b.unwrap_or(ChlorophyllMix::A_TO_B);
    let bands = block.word("bands", &["leaf", "solution"]);
    let shift_per_cm = block.number_or("shift_per_cm", SHIFT_PER_CM, ChlorophyllMix::SHIFT_PER_CM);
    let packaging = block.number_or("packaging", PACKAGING, ChlorophyllMix::PACKAGING);
    block.finish();
    if bands == Some("solution") {
        return ChlorophyllMix::Bands {
            a_to_b,
            shift_per_cm,
            packaging,
        };
    }
    // Another word is told already.
    let misspelt = block.table.get("bands").is_some() && bands.is_none();
    for key in ["shift_per_cm", "packaging"] {
        if let (Some(entry), false) = (block.table.get(key), misspelt) {
            let error = SceneError::Impossible {
                key: key.to_owned(),
                problem:
                    "only bands in solution are shifted and packed; those of leaves are so already"
                        .to_owned(),
                help: "write bands = \"solution\" beside it, or leave it out".to_owned(),
            };
            block.cx.error(&entry.key_at, error);
        }
    }
    ChlorophyllMix::Apportioned { a_to_b }
}

/// Shares by mass, by the substances' names; what is not named has none.
fn read_shares<const N: usize>(
    block: &Block<'_>,
    class: &str,
    names: [&'static str; N],
) -> Option<[f64; N]> {
    let errors = block.cx.error_count();
    let shares = names.map(|name| block.number_or(name, SHARE, 0.0));
    block.finish();
    // A share that is wrong, or under another name, would be missing from the sum.
    if block.cx.error_count() > errors {
        return None;
    }
    let sum: f64 = shares.iter().sum();
    if (sum - 1.0).abs() <= ROUNDING {
        return Some(shares);
    }
    let error = SceneError::Impossible {
        key: "shares".to_owned(),
        problem: format!(
            "the shares of the {class} sum to {}, not to 1",
            rounded(sum)
        ),
        help: "change them so that they sum to 1; what is left out has a share of 0".to_owned(),
    };
    block.cx.error(&block.at, error);
    None
}
