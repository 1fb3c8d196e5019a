//! Teeth that are found, and architectures that do not fit.

use proptest::prelude::*;

use super::margin::Margin;
use super::*;
use crate::shape::outline::Outline;
use crate::species;
use crate::venation::areole::areoles;
use crate::venation::plan::{AuxinPlan, Growth};
use crate::venation::{check, grow};
use properties::fixed;

fn outline(name: &str) -> Outline {
    let plan = species::find(name).expect("a preset").plan();
    plan.outline.grow(100.0, 1).expect("a good outline")
}

/// What is said of an architecture on a preset's outline.
fn said(name: &str, change: impl Fn(&mut AuxinPlan, &mut Architecture)) -> String {
    let mut architecture = Architecture::default();
    let mut plan = AuxinPlan {
        final_length: 600.0,
        growth: Growth::Isogonic {
            initial_length: 300.0,
            length_step: 2.5,
        },
        ..AuxinPlan::default()
    };
    change(&mut plan, &mut architecture);
    plan.architecture = Some(architecture);
    match check(&outline(name), &plan) {
        Ok(()) => "fits".to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn lobes_and_teeth_are_found_and_both_sides_have_as_many() {
    // A round end may pass for a lobe. Four lobes and the shoulder of the uppermost; four lobes and two teeth.
    for (name, count) in [
        ("white-oak", 4..=5),
        ("red-oak", 6..=6),
        ("magnolia", 0..=2),
    ] {
        let [right, left] = Margin::new(&outline(name)).tips_a_side();
        assert!(
            count.contains(&right) && count.contains(&left),
            "{name}: {right} {left}"
        );
    }
    let cottonwood = Margin::new(&outline("cottonwood"));
    // The outline has 24 teeth a side, which differ and fade out towards base and apex, and
    // corners. Each tooth bears a gland, which may count as one more.
    for count in cottonwood.tips_a_side() {
        assert!((15..=60).contains(&count), "{count}");
    }
}

#[test]
fn what_fits_fits() {
    assert_eq!(said("magnolia", |_, _| {}), "fits");
    let anisotropic_or_none = said("magnolia", |plan, _| plan.growth = Growth::None);
    assert_eq!(anisotropic_or_none, "fits");
}

#[test]
fn teeth_that_are_not_there_are_missed() {
    let said = said("magnolia", |_, veins| {
        veins.secondaries.ending = SecondaryEnding::Craspedodromous;
    });
    let start = "craspedodromous secondaries end in teeth or lobes: 8 pairs need as many a side, \
        and the outline has ";
    assert!(said.starts_with(start), "{said}");
}

#[test]
fn sinuses_that_are_not_there_are_missed() {
    let said = said("magnolia", |_, veins| {
        veins.secondaries.ending = SecondaryEnding::Sinus;
    });
    assert_eq!(
        said,
        "sinus secondaries end between teeth or lobes: 8 pairs need as many sinuses a side, and \
         the outline has 0 on the right and 0 on the left"
    );
}

#[test]
fn a_lobed_leaf_has_a_sinus_below_each_lobe_but_the_lowest() {
    let blade = outline("white-oak");
    let margin = Margin::new(&blade);
    let [right, left] = margin.sinuses_a_side();
    assert!(
        (4..=5).contains(&right) && (4..=5).contains(&left),
        "{right} {left}"
    );
    // Those between lobes are deep; one below a shoulder is not.
    let deep: Vec<_> = margin
        .sinuses()
        .into_iter()
        .filter(|sinus| sinus.height > 5.0)
        .collect();
    assert!(deep.len() >= 6, "{}", deep.len());
    for sinus in deep {
        let beside = [-0.02, 0.02].map(|away| margin.at(sinus.at + away).x.abs());
        assert!(
            beside.iter().all(|&x| x > sinus.place.x.abs()),
            "{} beside {beside:?}",
            sinus.place
        );
    }
}

#[test]
fn agrophic_veins_need_pinnate_secondaries_that_bear_them() {
    let palmate = said("magnolia", |_, veins| {
        veins.primaries.pattern = PrimaryPattern::Actinodromous;
        veins.primaries.lateral_angles_deg = vec![40.0];
        veins.secondaries.agrophic = Agrophic::Simple;
    });
    assert_eq!(
        palmate,
        "simple agrophic veins leave the lowest pair of secondaries of pinnate venation; \
         actinodromous venation has lateral primaries, whose outer secondaries they are"
    );
    let few = said("magnolia", |_, veins| {
        veins.secondaries.pairs = 1;
        veins.secondaries.agrophic = Agrophic::Compound;
    });
    assert_eq!(
        few,
        "compound agrophic veins leave the two lowest pairs of secondaries of pinnate venation; \
         1 pairs are asked for"
    );
    // A red oak has a tooth to each secondary at its base and none for a comb.
    let toothless = said("red-oak", |_, veins| {
        let oak = species::find("red-oak").expect("a preset").plan();
        let own = oak
            .venation
            .auxin()
            .and_then(|plan| plan.architecture.clone());
        veins.secondaries = own.expect("it has one").secondaries;
        veins.secondaries.agrophic = Agrophic::Simple;
    });
    assert!(
        toothless.starts_with("a comb of agrophic veins has 2 or more; ")
            && toothless.ends_with(
                "of one craspedodromous comb find a way to a tooth outside its secondary"
            ),
        "{toothless}"
    );
}

#[test]
fn quaternaries_need_percurrent_tertiaries_with_room_between_them() {
    let net = said("magnolia", |_, veins| {
        veins.tertiaries.course = TertiaryCourse::Reticulate;
        veins.quaternaries.course = QuaternaryCourse::OppositePercurrent;
    });
    assert_eq!(
        net,
        "quaternaries that are laid out lie between percurrent tertiaries, and the tertiaries are \
         reticulate"
    );
    let narrow = said("magnolia", |_, veins| {
        veins.tertiaries.spacing = 0.01;
        veins.quaternaries.course = QuaternaryCourse::FreelyRamified;
    });
    assert_eq!(
        narrow,
        "tertiaries 3.00 segments of the young leaf apart leave quaternaries no room, which takes \
         5; a spacing of 0.0167 or more does"
    );
    let close = said("magnolia", |_, veins| {
        veins.quaternaries.course = QuaternaryCourse::AlternatePercurrent;
        veins.quaternaries.spacing = 0.005;
    });
    assert_eq!(
        close,
        "quaternaries 1.50 segments of the young leaf apart, less than 2.5, cannot be told from \
         each other; a spacing of 0.0083 or more can"
    );
}

#[test]
fn more_pairs_than_the_young_leaf_has_room_for_are_reported_with_how_many_fit() {
    let said = said("magnolia", |plan, veins| {
        plan.growth = Growth::Isogonic {
            initial_length: 60.0,
            length_step: 2.5,
        };
        veins.secondaries.pairs = 20;
        veins.tertiaries.course = TertiaryCourse::Reticulate;
    });
    assert_eq!(
        said,
        "20 pairs of secondaries lie 2.4 segments apart in the young leaf, less than 4; 11 pairs fit"
    );
}

#[test]
fn tertiaries_too_close_are_reported_with_the_least_spacing() {
    let said = said("magnolia", |_, veins| veins.tertiaries.spacing = 0.005);
    assert_eq!(
        said,
        "tertiaries 1.50 segments of the young leaf apart, less than 2.5, cannot be told from each \
         other; a spacing of 0.0083 or more can"
    );
}

#[test]
fn secondaries_behind_lateral_primaries_have_no_way_to_the_margin() {
    let said = said("magnolia", |_, veins| {
        veins.primaries.pattern = PrimaryPattern::Actinodromous;
        veins.primaries.lateral_angles_deg = vec![25.0];
    });
    let start = "of 8 pairs of secondaries only ";
    assert!(said.starts_with(start), "{said}");
    assert!(
        said.ends_with(" on one side of the midrib have a way to the margin"),
        "{said}"
    );
}

#[test]
fn patterns_and_lateral_primaries_have_to_go_together() {
    assert_eq!(
        said("magnolia", |_, veins| veins.primaries.lateral_angles_deg =
            vec![40.0]),
        "pinnate venation has no lateral primaries a side; lateral_primary_angles_deg names 1"
    );
    assert_eq!(
        said("magnolia", |_, veins| veins.primaries.pattern =
            PrimaryPattern::Acrodromous),
        "acrodromous venation has 1 to 3 lateral primaries a side; lateral_primary_angles_deg names 0"
    );
    let descending = said("magnolia", |_, veins| {
        veins.primaries.pattern = PrimaryPattern::Actinodromous;
        veins.primaries.lateral_angles_deg = vec![60.0, 40.0];
    });
    assert_eq!(
        descending,
        "lateral_primary_angles_deg does not ascend: 60 is followed by 40"
    );
    let turned = said("magnolia", |_, veins| veins.secondaries.span = [0.8, 0.2]);
    assert_eq!(turned, "span does not ascend: 0.8 is followed by 0.2");
}

#[test]
fn lateral_primaries_have_to_point_into_the_blade() {
    let said = said("willow", |_, veins| {
        veins.primaries.pattern = PrimaryPattern::Actinodromous;
        veins.primaries.lateral_angles_deg = vec![110.0];
    });
    assert_eq!(
        said,
        "of 2 lateral primaries only 0 point into the blade where they part from the midrib"
    );
}

#[test]
fn an_architecture_does_not_go_with_margins_that_grow_alone() {
    let said = said("magnolia", |plan, _| {
        plan.growth = Growth::Marginal {
            initial_length: 100.0,
            length_step: 2.5,
        };
    });
    assert_eq!(
        said,
        "architecture does not go together with marginal growth"
    );
}

proptest! {
    #![proptest_config(fixed(10))]

    #[test]
    fn what_is_laid_out_is_sound_crosses_nothing_and_has_a_straight_midrib(
        pairs in 2_u32..9, angle in 35.0..75.0, irregularity in 0.0..1.0,
        ending in prop_oneof![
            Just(SecondaryEnding::Brochidodromous), Just(SecondaryEnding::Eucamptodromous),
        ],
        tertiary in prop_oneof![
            Just(TertiaryCourse::Reticulate), Just(TertiaryCourse::OppositePercurrent),
            Just(TertiaryCourse::AlternatePercurrent), Just(TertiaryCourse::SinuousPercurrent),
        ],
        seed in 0_u64..1000,
    ) {
        let mut architecture = Architecture { irregularity, ..Architecture::default() };
        architecture.secondaries.pairs = pairs;
        architecture.secondaries.angles_deg = [angle; 3];
        architecture.secondaries.ending = ending;
        architecture.tertiaries.course = tertiary;
        let plan = AuxinPlan {
            final_length: 260.0,
            kill_distance: 0.93,
            darts_per_area: 0.0005,
            growth: Growth::Isogonic { initial_length: 200.0, length_step: 2.5 },
            architecture: Some(architecture),
            ..AuxinPlan::default()
        };
        let blade = outline("magnolia");
        let veins = grow(&blade, &plan, seed).expect("it fits");
        prop_assert_eq!(veins.validate(), Ok(()));
        prop_assert_eq!(areoles(&veins).graph().crossings(), 0);
        for edge in veins.edges().iter().filter(|edge| edge.order == 1) {
            let place = veins.nodes()[edge.to as usize].position;
            prop_assert!(place.x.abs() < 1.5, "{} is off the midrib", place);
        }
        let again = grow(&blade, &plan, seed).expect("it fits");
        prop_assert!(again == veins);
    }
}
