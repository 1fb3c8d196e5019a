//! Leaves that turn in autumn: the contents of turned and of dead tissue.

use super::super::leaf_traits::coloured::{
    RED_MAPLE as RED_MAPLE_TRAITS, SUGAR_MAPLE as SUGAR_MAPLE_TRAITS,
};
use super::super::{architectures, as_grown, leaf_traits, specimens, trees, trees_contours};
use super::contours as own;
use super::numbers::{browned, days, fitted, last_carotenoids, last_chlorophyll, litter, red};
use super::{Age, ColouredLeaf, Holding};
use crate::blade::ageing::{Course, Delay};
use crate::blade::ageing_courses::{LITTER, YELLOW};
use crate::blade::senescence::{AgeSource, Senescence};
use crate::blade::weathering::Weathering;
use crate::leaf::LeafPlan;
use crate::optics::Constituent::{
    Anthocyanins, Brown, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
};
use crate::optics::VeinFactors;

/// Days over which living contents blend into dead ones.
const BLEND_DAYS: f64 = 5.0;

/// A delay that lets the leaf turn in patches from the margin.
const EDGE: Delay = Delay {
    margin_days: 26.0,
    margin_reach_mm: 6.0,
    noise_days: 16.0,
    noise_scale_mm: 5.0,
    ..YELLOW.death
};

const fn age(day: f64, half_days: f64, death_day: f64) -> Age {
    Age {
        day: days(day, [0.0, 120.0]),
        half_days: days(half_days, [3.0, 20.0]),
        death_day: days(death_day, [0.0, 60.0]),
    }
}

pub(super) const GINKGO: ColouredLeaf = ColouredLeaf {
    preset: "ginkgo-autumn",
    species: "Ginkgo biloba in autumn",
    green: &leaf_traits::GINKGO,
    tissues: &[Holding::new("turned")
        .chlorophyll(last_chlorophyll(0.8))
        .carotenoids(last_carotenoids(9.0))
        .anthocyanins(red(0.5, [0.0, 2.0]))
        .brown(browned(0.06))],
    age: Some(age(27.0, 8.0, 16.0)),
    plan: |leaf| {
        // The leaf turns evenly from the upper margin; its parallel veins stay greener than the
        // tissue between them, and hold more of everything, since they are dense with wood.
        let course = Course {
            onset: Delay {
                veins_days: 7.0,
                veins_reach_mm: 0.12,
                veins_order: 20,
                margin_days: 5.0,
                margin_reach_mm: 10.0,
                tip_days: 6.0,
                noise_days: 5.0,
                noise_scale_mm: 14.0,
                ..Delay::NONE
            },
            death: Delay {
                margin_days: 30.0,
                margin_reach_mm: 5.0,
                tip_days: 12.0,
                noise_days: 14.0,
                noise_scale_mm: 4.0,
                ..Delay::NONE
            },
            ..YELLOW
        };
        let mut plan = aged(leaf, as_grown::ginkgo(), &course);
        plan.tissue.vein_factors = VeinFactors::of(&[
            (Structure, 1.25),
            (Chlorophyll, 1.6),
            (Carotenoids, 1.2),
            (Brown, 3.0),
            (Water, 1.5),
            (DryMatter, 3.0),
        ]);
        plan
    },
};

pub(super) const BIRCH: ColouredLeaf = ColouredLeaf {
    preset: "birch-autumn",
    species: "Betula pendula in autumn",
    green: &leaf_traits::BIRCH,
    tissues: &[Holding::new("turned")
        .chlorophyll(last_chlorophyll(1.2))
        .carotenoids(fitted(5.2))
        .anthocyanins(red(0.5, [0.0, 2.0]))
        .brown(fitted(0.33))],
    age: Some(age(24.0, 9.0, 14.0)),
    plan: |leaf| {
        let course = Course {
            onset: Delay {
                veins_days: 6.0,
                veins_reach_mm: 0.9,
                margin_days: 4.0,
                margin_reach_mm: 5.0,
                noise_days: 7.0,
                noise_scale_mm: 7.0,
                ..YELLOW.onset
            },
            death: Delay {
                margin_days: 22.0,
                margin_reach_mm: 5.0,
                noise_days: 16.0,
                noise_scale_mm: 3.0,
                ..YELLOW.death
            },
            ..YELLOW
        };
        aged(leaf, trees::birch(), &course)
    },
};

pub(super) const POPLAR: ColouredLeaf = ColouredLeaf {
    preset: "poplar-autumn",
    species: "Populus deltoides in autumn",
    green: &leaf_traits::COTTONWOOD,
    tissues: &[Holding::new("turned")
        .chlorophyll(last_chlorophyll(1.5))
        .carotenoids(last_carotenoids(6.0))
        .anthocyanins(red(0.5, [0.0, 2.0]))
        .brown(browned(0.13))],
    age: Some(age(25.0, 9.0, 8.0)),
    plan: |leaf| {
        let course = Course {
            onset: Delay {
                noise_days: 8.0,
                noise_scale_mm: 10.0,
                ..YELLOW.onset
            },
            death: Delay {
                margin_days: 12.0,
                margin_reach_mm: 6.0,
                noise_days: 34.0,
                noise_scale_mm: 3.5,
                ..YELLOW.death
            },
            ..YELLOW
        };
        aged(leaf, trees::cottonwood(), &course)
    },
};

pub(super) const SUGAR_MAPLE: ColouredLeaf = ColouredLeaf {
    preset: "sugar-maple-autumn",
    species: "Acer saccharum in autumn",
    green: &SUGAR_MAPLE_TRAITS,
    tissues: &[Holding::new("turned")
        .chlorophyll(last_chlorophyll(2.0))
        .carotenoids(last_carotenoids(7.0))
        .anthocyanins(red(5.0, [2.0, 15.0]))
        .brown(browned(0.1))],
    age: Some(age(27.0, 8.0, 17.0)),
    plan: |leaf| {
        let course = Course {
            onset: Delay {
                veins_days: 5.0,
                veins_reach_mm: 1.6,
                margin_days: 6.0,
                margin_reach_mm: 9.0,
                noise_days: 15.0,
                noise_scale_mm: 20.0,
                ..YELLOW.onset
            },
            death: EDGE,
            anthocyanin_days: 6.0,
            ..YELLOW
        };
        let outline = specimens::maple(trees_contours::maple());
        let veins = trees::dense(leaf.green, architectures::maple(), 3.2);
        aged(leaf, trees::leaf(leaf.green, 5, outline, veins), &course)
    },
};

pub(super) const RED_MAPLE: ColouredLeaf = ColouredLeaf {
    preset: "red-maple-autumn",
    species: "Acer rubrum in autumn",
    green: &RED_MAPLE_TRAITS,
    tissues: &[Holding::new("turned")
        .chlorophyll(last_chlorophyll(3.0))
        .carotenoids(last_carotenoids(5.0))
        .anthocyanins(red(15.0, [5.0, 40.0]))
        .brown(browned(0.1))],
    age: Some(age(25.0, 8.0, 16.0)),
    plan: |leaf| {
        let course = Course {
            onset: Delay {
                veins_days: 4.0,
                veins_reach_mm: 0.9,
                noise_days: 10.0,
                noise_scale_mm: 13.0,
                ..YELLOW.onset
            },
            death: EDGE,
            ..YELLOW
        };
        let mut plan = aged(leaf, red_maple(leaf), &course);
        // Veins stay paler than the blade between them.
        plan.tissue.vein_factors[Anthocyanins] = 0.5;
        plan
    },
};

/// A red maple in summer.
pub(super) fn red_maple(leaf: &ColouredLeaf) -> LeafPlan {
    trees::leaf(
        leaf.green,
        3,
        specimens::serrate(own::red_maple()),
        trees::dense(leaf.green, architectures::red_maple(), 3.4),
    )
}

pub(super) const SWEETGUM: ColouredLeaf = ColouredLeaf {
    preset: "sweetgum-autumn",
    species: "Liquidambar styraciflua in autumn",
    green: &leaf_traits::SWEETGUM,
    tissues: &[Holding::new("turned")
        .chlorophyll(last_chlorophyll(8.0))
        .carotenoids(last_carotenoids(6.0))
        .anthocyanins(red(34.0, [5.0, 60.0]))
        .brown(browned(0.1))],
    age: Some(age(25.0, 8.0, 17.0)),
    plan: |leaf| {
        let course = Course {
            onset: Delay {
                veins_days: 3.0,
                veins_reach_mm: 1.2,
                margin_days: 5.0,
                margin_reach_mm: 10.0,
                noise_days: 10.0,
                noise_scale_mm: 16.0,
                ..YELLOW.onset
            },
            death: EDGE,
            ..YELLOW
        };
        let mut plan = aged(leaf, as_grown::sweetgum(), &course);
        plan.tissue.vein_factors[Anthocyanins] = 0.6;
        plan
    },
};

/// Oak leaves on the ground, by eye.
const OAK_WEATHERING: Weathering = Weathering {
    leaves: 0.5,
    patches: 0.5,
    patch_scale_mm: 11.0,
    bleached: 0.2,
    spots_per_cm2: 1.5,
    spot_radius_mm: 0.6,
};

pub(super) const OAK_LITTER: ColouredLeaf = ColouredLeaf {
    preset: "oak-litter",
    species: "Quercus alba, fallen",
    green: &leaf_traits::WHITE_OAK,
    tissues: &[
        Holding::new("turned")
            .chlorophyll(last_chlorophyll(2.0))
            .carotenoids(fitted(4.8))
            .anthocyanins(red(0.5, [0.0, 5.0]))
            .brown(fitted(0.27)),
        Holding::new("dead")
            .structure(litter(2.2, [2.0, 2.4]))
            .chlorophyll(litter(0.3, [0.0, 0.5]))
            .carotenoids(litter(0.9, [0.0, 1.5]))
            .anthocyanins(litter(0.0, [0.0, 1.0]))
            .brown(litter(1.35, [0.8, 1.5]))
            .water(litter(0.001, [0.0005, 0.002]))
            .dry_matter(litter(0.007, [0.005, 0.009])),
    ],
    // On the last day all of it has died.
    age: Some(age(70.0, 9.0, 12.0)),
    plan: |leaf| {
        let course = Course {
            death: Delay {
                margin_days: 24.0,
                margin_reach_mm: 10.0,
                noise_days: 14.0,
                noise_scale_mm: 8.0,
                veins_days: 6.0,
                veins_reach_mm: 1.2,
                ..YELLOW.death
            },
            weathering: Some(OAK_WEATHERING),
            ..YELLOW
        };
        let mut plan = aged(leaf, trees::white_oak(), &course);
        // Dry leaves roll in; lighter veins stand out.
        plan.form.fold = 16.0_f64.to_radians();
        plan.form.curl = 48.0_f64.to_radians();
        plan.form.ruffle = 0.03;
        plan.tissue.vein_factors[Brown] = 0.75;
        plan
    },
};

/// The green leaf after ageing.
fn aged(leaf: &ColouredLeaf, green: LeafPlan, course: &Course) -> LeafPlan {
    let (turned, summer) = (leaf.of("turned"), green.tissue.lamina);
    let kept = turned[Carotenoids] / summer[Carotenoids];
    let age = leaf.age.expect("leaves that turn have an age");
    let course = Course {
        half_days: age.half_days.value,
        death_day: age.death_day.value,
        chlorophyll_rest: turned[Chlorophyll],
        labile_carotenoids: (1.0 - kept).max(0.0),
        anthocyanins: turned[Anthocyanins],
        brown: turned[Brown],
        ..*course
    };
    let dry = course.dry_matter_factor * summer[DryMatter];
    let contents = leaf
        .held("dead")
        .unwrap_or(LITTER.with(&[(DryMatter, dry)]));
    let source = AgeSource::Day {
        day: age.day.value,
        course,
    };
    LeafPlan {
        senescence: Some(Senescence {
            source,
            blend: BLEND_DAYS,
            contents,
        }),
        ..green
    }
}

#[cfg(test)]
mod tests {
    use crate::blade::senescence::AgeSource;
    use crate::species;

    #[test]
    fn no_tissue_of_oak_litter_is_left_alive() {
        let plan = species::find("oak-litter").expect("a preset").plan();
        let senescence = plan.senescence.expect("it has aged");
        let AgeSource::Day { day, .. } = senescence.source else {
            panic!("it ages by days");
        };
        let last = senescence.last_day().expect("it ages by days");
        assert!(last <= day, "the last tissue dies on day {last} of {day}");
    }
}
