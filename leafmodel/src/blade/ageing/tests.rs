//! Properties of ageing by days, tested on every course.

use super::super::ageing_courses::{COURSES, LITTER, RED};
use super::*;
use crate::blade::ageing::leaf::AgeingLeaf;
use crate::optics::Constituent::{
    Anthocyanins, Brown, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
};
use crate::optics::Contents;

const FRAME: UvFrame = UvFrame {
    min: DVec2::new(-20.0, 0.0),
    size: DVec2::new(40.0, 60.0),
};
const MARGIN: [DVec2; 4] = [
    DVec2::new(-20.0, 0.0),
    DVec2::new(20.0, 0.0),
    DVec2::new(20.0, 60.0),
    DVec2::new(-20.0, 60.0),
];
const GREEN: Contents = Contents::of(&[
    (Structure, 1.5),
    (Chlorophyll, 40.0),
    (Carotenoids, 9.0),
    (Anthocyanins, 0.5),
    (Brown, 0.01),
    (Water, 0.01),
    (DryMatter, 0.005),
]);

fn leaf(course: &Course, day: f64) -> AgeingLeaf {
    let vein = VeinSegment {
        from: DVec2::ZERO,
        to: DVec2::new(0.0, 60.0),
        radius_from: 0.4,
        radius_to: 0.1,
        order: 1,
    };
    let veins = [vein];
    let place = Place {
        frame: &FRAME,
        margin: &MARGIN,
        veins: &veins,
        base: DVec2::ZERO,
        apex: DVec2::new(0.0, 60.0),
    };
    AgeingLeaf::new(course, day, (4.0, LITTER), &place, None, 5)
}

fn points() -> impl Iterator<Item = DVec2> {
    (-9..=9).flat_map(|x| {
        (0..=12).map(move |y| DVec2::new(f64::from(x) * 2.2, 0.3 + f64::from(y) * 4.9))
    })
}

#[test]
fn at_day_0_there_is_the_living_leaf_to_the_bit() {
    for (_, course) in COURSES {
        let leaf = leaf(&course, 0.0);
        assert!(points().all(|p| leaf.contents(GREEN, p) == GREEN));
    }
}

#[test]
fn chlorophyll_never_rises_brown_never_falls_and_carotenoids_outlast_chlorophyll() {
    for (name, course) in COURSES {
        let days: Vec<AgeingLeaf> = (0..=80).map(|day| leaf(&course, f64::from(day))).collect();
        for p in points() {
            let mut before = GREEN;
            for leaf in &days {
                let now = leaf.contents(GREEN, p);
                let slack = 1e-12;
                assert!(
                    now[Chlorophyll] <= before[Chlorophyll] + slack,
                    "{name} {p}"
                );
                assert!(
                    now[Carotenoids] <= before[Carotenoids] + slack,
                    "{name} {p}"
                );
                assert!(now[Brown] >= before[Brown] - slack, "{name} {p}");
                assert!(now[Water] <= before[Water] + slack, "{name} {p}");
                if leaf.dead_share(p) == 0.0 {
                    // Only the chlorophyll above the remaining rest decays.
                    let rest = course.chlorophyll_rest;
                    let left = (now[Chlorophyll] - rest) / (GREEN[Chlorophyll] - rest);
                    let share = now[Carotenoids] / GREEN[Carotenoids];
                    assert!(share >= left - slack, "{name} {p}: {share} of {left}");
                }
                before = now;
            }
            assert_eq!(before[Brown], LITTER[Brown], "{name}: litter in the end");
        }
    }
}

#[test]
fn no_anthocyanin_is_made_before_chlorophyll_is_below_20_and_then_up_to_its_most() {
    for (name, course) in COURSES {
        for tenth in 0..1000 {
            let now = course.senescent(GREEN, f64::from(tenth) * 0.1);
            let made = now[Anthocyanins] > GREEN[Anthocyanins];
            let may = course.anthocyanins > 0.0;
            // At the threshold itself rounding decides.
            if (now[Chlorophyll] - ANTHOCYANIN_BELOW).abs() > 1e-9 {
                assert_eq!(made, may && now[Chlorophyll] < ANTHOCYANIN_BELOW, "{name}");
            }
        }
        let end = course.senescent(GREEN, 100.0)[Anthocyanins];
        let most = course.anthocyanins.max(GREEN[Anthocyanins]);
        assert!((end - most).abs() < 1e-3 * most, "{name}: {end}");
    }
}

#[test]
fn a_leaf_that_never_falls_below_20_makes_no_anthocyanin() {
    let green_for_ever = Course {
        chlorophyll_rest: 25.0,
        ..RED
    };
    let end = green_for_ever.senescent(GREEN, 500.0);
    assert_eq!(end[Anthocyanins], GREEN[Anthocyanins]);
}

#[test]
fn death_begins_at_the_margin() {
    let even = Delay {
        noise_days: 0.0,
        ..RED.death
    };
    let course = Course { death: even, ..RED };
    for day in [28.0, 32.0, 36.0] {
        let leaf = leaf(&course, day);
        let shares: Vec<f64> = (0..=18)
            .map(|i| leaf.dead_share(DVec2::new(20.0 - f64::from(i), 30.0)))
            .collect();
        assert!(
            shares.windows(2).all(|pair| pair[1] <= pair[0]),
            "{shares:?}"
        );
    }
    let leaf = leaf(&course, 31.0);
    assert_eq!(leaf.dead_share(DVec2::new(20.0, 30.0)), 1.0);
    assert_eq!(leaf.dead_share(DVec2::new(5.0, 30.0)), 0.0);
}

#[test]
fn tissue_near_veins_stays_green_longest_or_goes_first() {
    let at_vein = |veins_days: f64| {
        let onset = Delay {
            veins_days,
            ..Delay::NONE
        };
        let leaf = leaf(&Course { onset, ..RED }, 10.0);
        let chlorophyll = |x| leaf.contents(GREEN, DVec2::new(x, 30.0))[Chlorophyll];
        chlorophyll(0.0) - chlorophyll(10.0)
    };
    assert!(at_vein(6.0) > 5.0);
    assert!(at_vein(-6.0) < -5.0);
    assert_eq!(at_vein(0.0), 0.0);
}

#[test]
fn contents_are_smooth_in_time() {
    // There is no jump: over a hundredth of a day nothing changes by more than its steepest slope
    // allows.
    let p = DVec2::new(9.0, 22.0);
    let mut before = GREEN;
    for i in 1..8000 {
        let now = leaf(&RED, f64::from(i) * 0.01).contents(GREEN, p);
        for (constituent, b) in *before {
            let a = now[constituent];
            assert!((a - b).abs() < 0.1, "{constituent:?}: {a} after {b}");
        }
        before = now;
    }
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    assert_eq!(RED.in_range(), Ok(()));
    let field = |course: Course| course.in_range().expect_err("out of range").path;
    assert_eq!(
        field(Course {
            half_days: 0.0,
            ..RED
        }),
        "half_days"
    );
    assert_eq!(
        field(Course {
            persistence: 0.9,
            ..RED
        }),
        "persistence"
    );
    let onset = Delay {
        margin_days: -1.0,
        ..RED.onset
    };
    assert_eq!(field(Course { onset, ..RED }), "onset.margin_days");
}
