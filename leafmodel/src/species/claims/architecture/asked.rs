//! What no preset asks for, key by key: found as it was asked for.

use crate::measure::description::{
    Areolation, Description, MarginalVenation, Net, Veinlets, describe,
};
use crate::species::claims::{AuxinPlan, Grown};
use crate::venation::architecture::{
    Agrophic, Architecture, Attachment, PrimaryPattern, QuaternaryCourse, SecondaryEnding,
    SecondarySpacing, TertiaryCourse,
};

/// A small leaf of a preset, for what no preset has.
fn small(name: &str, change: impl Fn(&mut Architecture)) -> (Architecture, Description) {
    let mut plan = crate::species::find(name).expect("a preset").plan();
    let mut asked = Architecture::default();
    if let crate::leaf::venation_plan::VenationPlan::Auxin(auxin) = &mut plan.venation {
        asked = auxin.architecture.clone().expect("it has one");
        change(&mut asked);
        auxin.architecture = Some(asked.clone());
        auxin.final_length = 400.0;
        auxin.growth = crate::venation::plan::Growth::Isogonic {
            initial_length: 300.0,
            length_step: 2.5,
        };
    }
    let leaf = Grown::of(plan);
    (asked, describe(&leaf.outline, &leaf.network))
}

#[test]
fn endings_and_spacings_are_found_as_they_were_asked_for() {
    for (name, ending) in [
        ("birch", SecondaryEnding::Craspedodromous),
        ("birch", SecondaryEnding::Semicraspedodromous),
        ("magnolia", SecondaryEnding::Eucamptodromous),
        ("magnolia", SecondaryEnding::Brochidodromous),
    ] {
        let (_, found) = small(name, |asked| {
            asked.secondaries.ending = ending;
            asked.tertiaries.course = TertiaryCourse::Reticulate;
        });
        assert_eq!(found.ending, Some(ending));
    }
    for spacing in [
        SecondarySpacing::Regular,
        SecondarySpacing::IncreasingProximally,
        SecondarySpacing::DecreasingProximally,
    ] {
        let (asked, found) = small("magnolia", |asked| {
            asked.irregularity = 0.1;
            asked.secondaries.spacing = spacing;
            asked.secondaries.ending = SecondaryEnding::Brochidodromous;
        });
        assert_eq!(found.spacing, Some(spacing));
        assert_eq!(found.secondaries, [asked.secondaries.pairs as usize; 2]);
    }
}

#[test]
fn acrodromous_primaries_run_in_arches_towards_the_apex() {
    let (_, found) = small("magnolia", |asked| {
        asked.primaries.pattern = PrimaryPattern::Acrodromous;
        asked.primaries.lateral_angles_deg = vec![50.0];
        asked.secondaries.ending = SecondaryEnding::Eucamptodromous;
        asked.secondaries.pairs = 1;
        asked.secondaries.span = [0.9, 0.95];
    });
    assert_eq!(found.primaries, Some(PrimaryPattern::Acrodromous));
    assert_eq!(found.lateral_primaries, 2);
}

#[test]
fn patterns_with_many_primaries_are_found_as_they_were_asked_for() {
    for (name, pattern, laterals, angles) in [
        ("magnolia", PrimaryPattern::Parallelodromous, 4, vec![]),
        ("alchemilla-leaf", PrimaryPattern::Campylodromous, 3, vec![]),
        (
            "ginkgo-leaf",
            PrimaryPattern::Flabellate,
            0,
            vec![15.0, 30.0, 45.0],
        ),
        (
            "maple",
            PrimaryPattern::Palinactinodromous,
            0,
            vec![53.0, 110.0],
        ),
    ] {
        let (_, found) = small(name, |asked| {
            asked.primaries.pattern = pattern;
            asked.primaries.laterals = laterals;
            asked.primaries.lateral_angles_deg.clone_from(&angles);
            asked.primaries.fork_spacing = 0.05;
            asked.secondaries.ending = SecondaryEnding::Eucamptodromous;
            asked.secondaries.pairs = if pattern == PrimaryPattern::Palinactinodromous {
                3
            } else {
                0
            };
            asked.tertiaries.course = TertiaryCourse::Reticulate;
        });
        assert_eq!(found.primaries, Some(pattern), "{name}");
    }
}

#[test]
fn loops_outside_arches_are_found() {
    let (_, found) = small("magnolia", |asked| {
        asked.secondaries.ending = SecondaryEnding::Festooned;
        asked.secondaries.inset = 0.05;
        asked.tertiaries.course = TertiaryCourse::Reticulate;
    });
    assert_eq!(found.ending, Some(SecondaryEnding::Festooned));
}

#[test]
fn decurrent_secondaries_are_distinguished_from_excurrent_ones() {
    for attachment in [Attachment::Excurrent, Attachment::Decurrent] {
        for name in ["magnolia", "willow", "croton"] {
            let (asked, found) = small(name, |asked| {
                asked.secondaries.attachment = attachment;
                asked.secondaries.pairs = 7;
                asked.tertiaries.course = TertiaryCourse::Reticulate;
            });
            assert_eq!(found.attachment, Some(attachment), "{name}");
            if name != "magnolia" {
                continue;
            }
            // The uppermost may be too short to be told from the net.
            let counts = found.secondaries;
            assert!(counts.iter().all(|n| (6..=7).contains(n)), "{counts:?}");
            // The angle is that at which a vein goes on once it has left the midrib.
            let angle = found.angles_deg[1].expect("there are some in the middle");
            let wanted = asked.secondaries.angles_deg[1];
            assert!((angle - wanted).abs() < 10.0, "{angle}, not {wanted}");
        }
    }
}

#[test]
fn chevrons_are_distinguished_from_other_percurrent_tertiaries() {
    for course in [
        TertiaryCourse::OppositePercurrent,
        TertiaryCourse::AlternatePercurrent,
        TertiaryCourse::SinuousPercurrent,
        TertiaryCourse::ChevronPercurrent,
    ] {
        let (_, found) = small("magnolia", |asked| {
            asked.secondaries.pairs = 6;
            asked.tertiaries.course = course;
            asked.tertiaries.spacing = 0.035;
        });
        assert_eq!(found.tertiaries.is_percurrent(), Some(true), "{course:?}");
        let wanted = course == TertiaryCourse::ChevronPercurrent;
        let share = found.tertiaries.chevrons;
        assert_eq!(
            found.tertiaries.are_chevrons(),
            wanted,
            "{course:?}: {share:?}"
        );
    }
}

#[test]
fn a_vein_along_the_margin_is_found_where_it_was_asked_for() {
    for name in ["magnolia", "croton", "birch"] {
        for is_fimbrial in [false, true] {
            let (_, found) = small(name, |asked| {
                asked.is_fimbrial = is_fimbrial;
                asked.tertiaries.course = TertiaryCourse::Reticulate;
            });
            let share = found.accompanied_margin;
            let is_found = found.marginal == Some(MarginalVenation::Fimbrial);
            assert_eq!(is_found, is_fimbrial, "{name}: {share}");
        }
    }
    // Veins that fork and never meet end freely at the margin.
    let ginkgo = Grown::preset("ginkgo-leaf");
    let found = describe(&ginkgo.outline, &ginkgo.network);
    assert_eq!(found.marginal, Some(MarginalVenation::Incomplete));
    assert_eq!(found.net.areolation(), Areolation::Lacking);
}

#[test]
fn veinlets_are_found_where_free_endings_were_asked_for() {
    let magnolia = Grown::preset("magnolia");
    let with = describe(&magnolia.outline, &magnolia.network).net;
    let bare = magnolia.with_veins(AuxinPlan {
        free_endings: None,
        ..magnolia.auxin().clone()
    });
    let without = describe(&bare.outline, &bare.network).net;
    assert_ne!(with.veinlets(), Veinlets::Absent);
    let count = |net: &Net| net.veinlets_per_areole.unwrap_or(0.0);
    assert!(
        count(&with) > 2.0 * count(&without),
        "{} {}",
        count(&with),
        count(&without)
    );
}

#[test]
fn secondaries_run_into_sinuses_where_they_were_asked_to() {
    for (name, pairs) in [("red-oak", 3), ("white-oak", 3)] {
        let (_, found) = small(name, |asked| {
            asked.secondaries.ending = SecondaryEnding::Sinus;
            asked.secondaries.pairs = pairs;
            asked.tertiaries.course = TertiaryCourse::Reticulate;
        });
        assert_eq!(found.ending, Some(SecondaryEnding::Sinus), "{name}");
        assert_eq!(found.secondaries, [pairs as usize; 2], "{name}");
    }
}

#[test]
fn combs_of_agrophic_veins_are_found_as_they_were_asked_for() {
    for (name, ending) in [
        ("birch", SecondaryEnding::Craspedodromous),
        ("magnolia", SecondaryEnding::Eucamptodromous),
        ("magnolia", SecondaryEnding::Brochidodromous),
    ] {
        for agrophic in [Agrophic::Absent, Agrophic::Simple, Agrophic::Compound] {
            if name == "birch" && agrophic == Agrophic::Compound {
                // It has no teeth for a second comb.
                continue;
            }
            let (asked, found) = small(name, |asked| {
                asked.secondaries.agrophic = agrophic;
                asked.secondaries.ending = ending;
                asked.secondaries.pairs = 5;
                asked.secondaries.angles_deg = [42.0; 3];
                asked.tertiaries.course = TertiaryCourse::Reticulate;
            });
            assert_eq!(found.agrophic, agrophic, "{name} {ending:?}");
            assert_eq!(
                found.secondaries, [asked.secondaries.pairs as usize; 2],
                "{name}"
            );
            assert_eq!(found.ending, Some(ending), "{name}");
        }
    }
}

#[test]
fn quaternaries_are_found_as_they_were_asked_for() {
    for course in [
        QuaternaryCourse::Reticulate,
        QuaternaryCourse::OppositePercurrent,
        QuaternaryCourse::AlternatePercurrent,
        QuaternaryCourse::FreelyRamified,
    ] {
        let (_, found) = small("magnolia", |asked| {
            asked.secondaries.pairs = 6;
            asked.tertiaries.course = TertiaryCourse::OppositePercurrent;
            asked.tertiaries.spacing = 0.05;
            asked.quaternaries.course = course;
            asked.quaternaries.spacing = 0.014;
        });
        let quaternaries = &found.quaternaries;
        assert_eq!(
            quaternaries.quaternary_course(),
            Some(course),
            "{quaternaries:?}"
        );
        assert_eq!(found.tertiaries.is_percurrent(), Some(true), "{course:?}");
    }
}
