//! `senescence`: how far a leaf has aged.

use super::contents::contents;
use crate::blade::ageing::{Course, Delay};
use crate::blade::ageing_courses::{COURSES, LITTER, YELLOW};
use crate::blade::senescence::{AgeSource, Senescence};
use crate::blade::weathering::Weathering;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Integer, Number, Word};

/// Days for which a leaf may have aged.
pub const DAYS: Limits = Limits::closed(0.0, Senescence::LATEST_DAY);

/// Width of the transition from living to dead where nothing is said.
const BLEND: f64 = 0.08;
/// Days from living to dead where nothing is said.
const BLEND_DAYS: f64 = 4.0;

/// Ageing of which nothing is said.
pub(super) fn usual() -> Senescence {
    Senescence {
        source: AgeSource::Day {
            day: 0.0,
            course: YELLOW,
        },
        blend: BLEND_DAYS,
        contents: LITTER,
    }
}

/// The keys of `senescence`.
pub(super) fn senescence(value: &mut Senescence, keys: &mut Keys<'_>) {
    let current = match value.source {
        AgeSource::Day { .. } => "day",
        AgeSource::Revenue { .. } => "revenue_share",
    };
    let has_base = keys.base().is_some();
    let chosen = keys.one_of(&["day", "revenue_share"], Some(current));
    // With none, or both, the other keys may still be wrong.
    let chosen = match (chosen.is_empty(), has_base) {
        (false, _) => chosen,
        (true, true) => vec![current],
        (true, false) => vec![""],
    };
    for name in chosen {
        if name == "revenue_share" {
            by_revenue(value, keys);
        } else {
            by_days(value, keys, name == "day");
        }
    }
}

fn by_revenue(value: &mut Senescence, keys: &mut Keys<'_>) {
    let mut share = match value.source {
        AgeSource::Revenue { share } => share,
        AgeSource::Day { .. } => {
            value.blend = BLEND;
            1.0
        }
    };
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "What cells earn now as a share of what they earned when full-grown: 1 is \
        summer, 0 all are dead. Cells whose supply no longer pays die, tips first. Needs \
        `outline.transport` or `venation.transport`; with both, the cells of the venation \
        decide.";
    keys.required("revenue_share", &mut share, limits, about);
    let limits = Number(Limits::closed(0.001, 1.0));
    let about = "Width of the transition from living to dead in that share.";
    keys.key("blend", &mut value.blend, limits, about);
    let held = &mut value.contents;
    let about = "What dead tissue holds.";
    keys.required_block("contents", about, &[], |keys| contents(held, keys));
    value.source = AgeSource::Revenue { share };
}

fn by_days(value: &mut Senescence, keys: &mut Keys<'_>, has_day: bool) {
    let (mut day, mut course) = match value.source {
        AgeSource::Day { day, course } => (day, course),
        AgeSource::Revenue { .. } => {
            value.blend = BLEND_DAYS;
            value.contents = LITTER;
            (0.0, YELLOW)
        }
    };
    if has_day {
        let limits = Number(DAYS);
        let about = "Since the leaf began to age where it does first; at 0 it has not.";
        keys.required("day", &mut day, limits, about);
    }
    let limits = Number(Limits::closed(0.001, 1e3));
    let about = "From living to dead.";
    keys.key("blend_days", &mut value.blend, limits, about);
    let mut named = None;
    let about = "Whence the numbers below are taken where they are left out; the defaults here \
        are those of yellow.";
    keys.optional("course", &mut named, Word(&COURSES), about);
    course = named.unwrap_or(course);
    for (key, value, least, most, about) in numbers(&mut course) {
        keys.key(key, value, Number(Limits::closed(least, most)), about);
    }
    let about = "When tissue begins to age: days by which places differ.";
    keys.block("onset", about, |keys| delay(&mut course.onset, keys));
    let about = "When tissue dies: days by which places differ.";
    keys.block("death", about, |keys| delay(&mut course.death, keys));
    let about = "How dead tissue differs from leaf to leaf and from place to place; left out, it \
        does not.";
    let own = &mut course.weathering;
    keys.optional_block("weathering", own, || Weathering::LITTER, about, weathering);
    let mut held = (value.contents != LITTER).then_some(value.contents);
    let about = "What dead tissue holds; left out, litter.";
    keys.optional_block("contents", &mut held, || LITTER, about, contents);
    value.contents = held.unwrap_or(LITTER);
    value.source = AgeSource::Day { day, course };
}

/// The keys of `weathering`.
fn weathering(value: &mut Weathering, keys: &mut Keys<'_>) {
    for (key, value, least, most, about) in [
        (
            "leaves",
            &mut value.leaves,
            0.0,
            3.0,
            "Leaves hold up to e to the power of this more or less brown.",
        ),
        (
            "patches",
            &mut value.patches,
            0.0,
            3.0,
            "The same for patches within a leaf.",
        ),
        (
            "patch_scale_mm",
            &mut value.patch_scale_mm,
            0.01,
            1e3,
            "Size of patches.",
        ),
        (
            "bleached",
            &mut value.bleached,
            0.0,
            1.0,
            "About the share of dead tissue that rain and sun have bleached.",
        ),
        (
            "spots_per_cm2",
            &mut value.spots_per_cm2,
            0.0,
            1e3,
            "Dark spots of fungi.",
        ),
        (
            "spot_radius_mm",
            &mut value.spot_radius_mm,
            0.01,
            100.0,
            "Their mean radius.",
        ),
    ] {
        keys.key(key, value, Number(Limits::closed(least, most)), about);
    }
}

/// The numbers of a course with their keys, ranges and meanings.
fn numbers(course: &mut Course) -> [(&'static str, &mut f64, f64, f64, &'static str); 12] {
    [
        (
            "half_days",
            &mut course.half_days,
            0.1,
            1e3,
            "After which half of the chlorophyll is gone.",
        ),
        (
            "steepness",
            &mut course.steepness,
            0.1,
            50.0,
            "How abruptly; small is nearly first-order decay.",
        ),
        (
            "chlorophyll_rest_ug_per_cm2",
            &mut course.chlorophyll_rest,
            0.0,
            1e3,
            "Chlorophyll that stays.",
        ),
        (
            "labile_carotenoids",
            &mut course.labile_carotenoids,
            0.0,
            1.0,
            "Share of carotenoids that goes with chlorophyll.",
        ),
        (
            "persistence",
            &mut course.persistence,
            1.0,
            100.0,
            "How many times longer the others last.",
        ),
        (
            "anthocyanins_ug_per_cm2",
            &mut course.anthocyanins,
            0.0,
            1e3,
            "Made where less than 20 µg cm⁻² of chlorophyll is left.",
        ),
        (
            "anthocyanin_days",
            &mut course.anthocyanin_days,
            0.1,
            1e3,
            "In which all but 1/e of them is made.",
        ),
        (
            "brown",
            &mut course.brown,
            0.0,
            100.0,
            "Brown pigments of tissue without chlorophyll that is still alive.",
        ),
        (
            "structure_factor",
            &mut course.structure_factor,
            1.0,
            10.0,
            "What structure is multiplied by in the end.",
        ),
        (
            "water_factor",
            &mut course.water_factor,
            0.0,
            1.0,
            "What water is multiplied by in the end.",
        ),
        (
            "dry_matter_factor",
            &mut course.dry_matter_factor,
            0.0,
            1.0,
            "What dry matter is multiplied by in the end.",
        ),
        (
            "death_day",
            &mut course.death_day,
            0.0,
            1e4,
            "When the first tissue dies.",
        ),
    ]
}

/// The keys of a delay.
fn delay(delay: &mut Delay, keys: &mut Keys<'_>) {
    let order = Integer::within(1, 20);
    let about = "Highest order of veins that count.";
    keys.key("veins_order", &mut delay.veins_order, order, about);
    for (key, value, least, most, about) in [
        (
            "veins_days",
            &mut delay.veins_days,
            -1e3,
            1e3,
            "Days by which tissue at veins comes later.",
        ),
        (
            "veins_reach_mm",
            &mut delay.veins_reach_mm,
            0.01,
            1e3,
            "Distance over which that falls to 1/e.",
        ),
        (
            "margin_days",
            &mut delay.margin_days,
            0.0,
            1e3,
            "Days by which the inside comes after the margin.",
        ),
        (
            "margin_reach_mm",
            &mut delay.margin_reach_mm,
            0.01,
            1e3,
            "Distance over which that rises to 1 − 1/e.",
        ),
        (
            "tip_days",
            &mut delay.tip_days,
            -1e3,
            1e3,
            "The base comes later than the apex; negative: earlier.",
        ),
        (
            "noise_days",
            &mut delay.noise_days,
            0.0,
            1e3,
            "Days by which patches differ at most.",
        ),
        (
            "noise_scale_mm",
            &mut delay.noise_scale_mm,
            0.01,
            1e3,
            "Size of those patches.",
        ),
        (
            "deaths_days",
            &mut delay.deaths_days,
            0.0,
            1e3,
            "Cells of a transport leaf come in the order in which they would die for lack of \
                revenue; needs one.",
        ),
    ] {
        keys.key(key, value, Number(Limits::closed(least, most)), about);
    }
}
