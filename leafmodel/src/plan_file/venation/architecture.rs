//! `architecture`: the coarse veins of a closed pattern, in the terms of the Manual of Leaf
//! Architecture.

use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Flag, Integer, ListOf, Number, Numbers, Word};
use crate::plan_file::venation::SHARE;
use crate::venation::architecture::{
    Agrophic, Architecture, ArchitectureError, Arrangement, Attachment, PrimaryPattern,
    QuaternaryCourse, SecondaryCourse, SecondaryEnding, SecondarySpacing, TertiaryCourse,
};

pub(super) fn architecture(plan: &mut Architecture, keys: &mut Keys<'_>) {
    let primaries = &mut plan.primaries;
    let words = [
        ("pinnate", PrimaryPattern::Pinnate),
        ("actinodromous", PrimaryPattern::Actinodromous),
        ("palinactinodromous", PrimaryPattern::Palinactinodromous),
        ("acrodromous", PrimaryPattern::Acrodromous),
        ("parallelodromous", PrimaryPattern::Parallelodromous),
        ("campylodromous", PrimaryPattern::Campylodromous),
        ("flabellate", PrimaryPattern::Flabellate),
    ];
    let about = "Primary veins: the midrib only (pinnate), several that diverge from one place \
        (actinodromous) or from the innermost lateral (palinactinodromous), several in arches that \
        converge towards the apex (acrodromous), many beside each other (parallelodromous) or in \
        wide arches that turn back at the base (campylodromous), or many that radiate and fork \
        (flabellate).";
    keys.required("primaries", &mut primaries.pattern, Word(&words), about);
    let angles = ListOf {
        of: Number(Limits::closed(5.0, 175.0)),
        least: 0,
        most: 6,
        wanted: "a list of at most 6 angles",
    };
    let about = "Angles between the midrib and the lateral primaries of one side, ascending; for \
        actinodromous, palinactinodromous and acrodromous leaves. Of flabellate ones the \
        veins at the base; the last bounds the fan.";
    keys.key(
        "lateral_primary_angles_deg",
        &mut primaries.lateral_angles_deg,
        angles,
        about,
    );
    let about = "Lateral primaries a side of parallelodromous and campylodromous leaves.";
    let count = Integer::within(0, 30);
    keys.key("lateral_primaries", &mut primaries.laterals, count, about);
    let limits = Number(Limits::closed(0.004, 0.2));
    let about = "Distance between the veins of flabellate leaves, share of the leaf's length; a vein \
        forks where it is twice that away from the next.";
    keys.key("fork_spacing", &mut primaries.fork_spacing, limits, about);
    let limits = Number(Limits::closed(0.0, 0.3));
    let about = "Where lateral primaries part from the midrib, share of its length: 0 is basal, \
        more suprabasal.";
    keys.key("part_at", &mut primaries.part_at, limits, about);
    let about = "How far chance moves places, angles and courses.";
    keys.key("irregularity", &mut plan.irregularity, SHARE, about);
    let about = "Whether a vein runs all along the margin.";
    keys.key("fimbrial", &mut plan.is_fimbrial, Flag, about);
    let about = "Secondary veins.";
    keys.required_block("secondaries", about, &[], |keys| {
        secondaries(&mut plan.secondaries, keys);
    });
    let about = "Tertiary veins.";
    keys.block("tertiaries", about, |keys| {
        tertiaries(&mut plan.tertiaries, keys);
    });
    let about = "Quaternary veins.";
    keys.block("quaternaries", about, |keys| {
        quaternaries(&mut plan.quaternaries, keys);
    });
}

fn secondaries(plan: &mut crate::venation::architecture::Secondaries, keys: &mut Keys<'_>) {
    let about = "How many a side of the midrib; lateral primaries bear as many as their length \
        allows at the same spacing. None where primaries run beside each other or fork.";
    keys.required("pairs", &mut plan.pairs, Integer::within(0, 40), about);
    let limits = Limits::closed(10.0, 120.0);
    let about = "Angle to the midrib in its lower, middle and upper third.";
    keys.required(
        "angles_deg",
        &mut plan.angles_deg,
        Numbers::<3>(limits),
        about,
    );
    let words = [
        ("craspedodromous", SecondaryEnding::Craspedodromous),
        ("sinus", SecondaryEnding::Sinus),
        ("semicraspedodromous", SecondaryEnding::Semicraspedodromous),
        ("eucamptodromous", SecondaryEnding::Eucamptodromous),
        ("brochidodromous", SecondaryEnding::Brochidodromous),
        ("festooned", SecondaryEnding::Festooned),
    ];
    let about = "Where they end: in teeth or lobes (craspedodromous), in the sinuses between them \
        (sinus), joined in arches with \
        branches into teeth (semicraspedodromous), upturned inside the margin (eucamptodromous), \
        joined in arches (brochidodromous), the same with a second row of loops (festooned).";
    keys.required("ending", &mut plan.ending, Word(&words), about);
    let words = [
        ("excurrent", Attachment::Excurrent),
        ("decurrent", Attachment::Decurrent),
    ];
    let about = "How they leave the primary: at their angle, or beside it at first (decurrent).";
    keys.key("attachment", &mut plan.attachment, Word(&words), about);
    let words = [
        ("straight", SecondaryCourse::Straight),
        ("arching", SecondaryCourse::Arching),
        ("upturned", SecondaryCourse::Upturned),
    ];
    let about = "How they run; upturned ones bend near the margin.";
    keys.key("course", &mut plan.course, Word(&words), about);
    let words = [
        ("regular", SecondarySpacing::Regular),
        (
            "increasing_proximally",
            SecondarySpacing::IncreasingProximally,
        ),
        (
            "decreasing_proximally",
            SecondarySpacing::DecreasingProximally,
        ),
    ];
    let about = "How they follow one another; proximally is towards the base.";
    keys.key("spacing", &mut plan.spacing, Word(&words), about);
    let words = [
        ("opposite", Arrangement::Opposite),
        ("alternate", Arrangement::Alternate),
    ];
    let about = "How both sides stand to each other.";
    keys.key("arrangement", &mut plan.arrangement, Word(&words), about);
    let about = "Where the lowest and the highest leave the midrib, shares of its length.";
    keys.key(
        "span",
        &mut plan.span,
        Numbers::<2>(Limits::closed(0.0, 1.0)),
        about,
    );
    let limits = Number(Limits::closed(0.005, 0.2));
    let about = "Distance of arches and of ends without a tooth from the margin, share of the \
        leaf's length.";
    keys.key("inset", &mut plan.inset, limits, about);
    let limits = Number(Limits::closed(0.0, 3.0));
    let about = "Shorter veins between two secondaries, on average.";
    keys.key(
        "intersecondaries",
        &mut plan.intersecondaries,
        limits,
        about,
    );
    let words = [
        ("absent", Agrophic::Absent),
        ("simple", Agrophic::Simple),
        ("compound", Agrophic::Compound),
    ];
    let about = "Agrophic veins, combs of two or more veins on the outer side of the lowest \
        secondary (simple) or of the two lowest (compound) of each side; they end as the \
        secondaries do. Pinnate leaves only: elsewhere the outer secondaries of lateral primaries \
        are such veins.";
    keys.key("agrophic", &mut plan.agrophic, Word(&words), about);
}

fn tertiaries(plan: &mut crate::venation::architecture::Tertiaries, keys: &mut Keys<'_>) {
    let words = [
        ("reticulate", TertiaryCourse::Reticulate),
        ("opposite_percurrent", TertiaryCourse::OppositePercurrent),
        ("alternate_percurrent", TertiaryCourse::AlternatePercurrent),
        ("sinuous_percurrent", TertiaryCourse::SinuousPercurrent),
        ("chevron_percurrent", TertiaryCourse::ChevronPercurrent),
    ];
    let about = "How they run: in a net (reticulate), or across from secondary to secondary, \
        straight (opposite), with an offset (alternate), in a wave (sinuous) or with a sharp bend \
        (chevron).";
    keys.key("course", &mut plan.course, Word(&words), about);
    let limits = Number(Limits::closed(0.004, 0.2));
    let about = "Percurrent only: distance between neighbours, share of the leaf's length.";
    keys.key("spacing", &mut plan.spacing, limits, about);
    let limits = Number(Limits::closed(40.0, 140.0));
    let about = "Percurrent only: angle to the secondary that they leave.";
    keys.key("angle_deg", &mut plan.angle_deg, limits, about);
}

fn quaternaries(plan: &mut crate::venation::architecture::Quaternaries, keys: &mut Keys<'_>) {
    let words = [
        ("reticulate", QuaternaryCourse::Reticulate),
        ("opposite_percurrent", QuaternaryCourse::OppositePercurrent),
        (
            "alternate_percurrent",
            QuaternaryCourse::AlternatePercurrent,
        ),
        ("freely_ramified", QuaternaryCourse::FreelyRamified),
    ];
    let about = "How they run: in a net, as chance has it (reticulate), or between percurrent \
        tertiaries: across from one to the next, straight (opposite) or with an offset \
        (alternate), or branched and ending between them (freely ramified).";
    keys.key("course", &mut plan.course, Word(&words), about);
    let limits = Number(Limits::closed(0.002, 0.1));
    let about = "Unless reticulate: distance between neighbours, share of the leaf's length.";
    keys.key("spacing", &mut plan.spacing, limits, about);
}

/// The key to change, and what to write instead.
pub(super) fn remedy(error: &ArchitectureError) -> (&'static [&'static str], &'static str) {
    match error {
        ArchitectureError::OutOfRange { .. } => (&["architecture"], "use a number in range"),
        ArchitectureError::LateralPrimaries { .. } => (
            &["architecture", "lateral_primary_angles_deg"],
            "name an angle for each lateral primary of one side, or choose another pattern",
        ),
        ArchitectureError::LateralCount { .. } => (
            &["architecture", "lateral_primaries"],
            "only parallelodromous and campylodromous leaves have a number of them",
        ),
        ArchitectureError::NoSecondaries { .. } => (
            &["architecture", "secondaries", "pairs"],
            "use 0, or choose another pattern",
        ),
        ArchitectureError::PrimariesTooClose { .. } => (
            &["architecture"],
            "use fewer primaries or a wider fork_spacing, or a longer young leaf: \
             initial_length_segments",
        ),
        ArchitectureError::NotAscending { key: "span", .. } => (
            &["architecture", "secondaries", "span"],
            "write the lower place first",
        ),
        ArchitectureError::NotAscending { .. } => (
            &["architecture", "lateral_primary_angles_deg"],
            "begin with the angle nearest to the midrib",
        ),
        ArchitectureError::TooFewTeeth { .. } => (
            &["architecture", "secondaries", "ending"],
            "give the outline teeth, use fewer pairs, or let the secondaries end inside the \
             margin: eucamptodromous or brochidodromous",
        ),
        ArchitectureError::TooFewSinuses { .. } => (
            &["architecture", "secondaries", "ending"],
            "give the outline lobes or teeth, use fewer pairs, or let the secondaries end inside \
             the margin: eucamptodromous or brochidodromous",
        ),
        ArchitectureError::NoBearers { .. } => (
            &["architecture", "secondaries", "agrophic"],
            "use \"absent\", or pinnate primaries with as many pairs",
        ),
        ArchitectureError::NoComb { .. } => (
            &["architecture", "secondaries", "agrophic"],
            "use \"absent\", a span that starts higher, or an outline that is wider or has more \
             teeth near its base",
        ),
        ArchitectureError::NoTertiaries => (
            &["architecture", "quaternaries", "course"],
            "use \"reticulate\", or percurrent tertiaries",
        ),
        ArchitectureError::QuaternariesTooClose { .. } => (
            &["architecture", "quaternaries", "spacing"],
            "use a wider spacing, or a longer young leaf: initial_length_segments",
        ),
        ArchitectureError::TooManyPairs { .. } => (
            &["architecture", "secondaries", "pairs"],
            "use fewer pairs, a wider span, or a longer young leaf: initial_length_segments",
        ),
        ArchitectureError::NoWay { .. } => (
            &["architecture", "secondaries", "pairs"],
            "use fewer pairs, or a span that starts above the lateral primaries",
        ),
        ArchitectureError::TertiariesTooClose { .. }
        | ArchitectureError::NoRoomForQuaternaries { .. } => (
            &["architecture", "tertiaries", "spacing"],
            "use a wider spacing, or a longer young leaf: initial_length_segments",
        ),
        ArchitectureError::PrimariesOffBlade { .. } => (
            &["architecture", "lateral_primary_angles_deg"],
            "use smaller angles, or a greater part_at: higher up the blade is wider",
        ),
        ArchitectureError::MidribOffBlade => (
            &["architecture"],
            "leave the architecture out, or draw an outline that holds its midrib",
        ),
    }
}
