//! Boughs: places of leaves, closed axes, refusals.

mod whole;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DMat3;

use super::*;
use crate::species;

/// A sessile leaf.
const SESSILE: Foot = Foot {
    at: DVec3::ZERO,
    frame: DMat3::IDENTITY,
    length_mm: 60.0,
    blade: Vec::new(),
};

/// An upright straight shoot whose leaves stand out level and do not turn.
fn shoot(phyllotaxis: Phyllotaxis) -> PlantPlan {
    let mut plan = PlantPlan::usual();
    plan.axis.phyllotaxis = phyllotaxis;
    plan.axis.stray = 0.0;
    plan.posture.angle = [FRAC_PI_2; 2];
    plan.posture.to_light = 0.0;
    plan.posture.stray = 0.0;
    plan.posture.size = [1.0; 3];
    plan
}

fn grown(plan: &PlantPlan) -> Plant {
    let feet = vec![vec![SESSILE; plan.individuals as usize]];
    Plant::grow(plan, &feet, None).expect("a good plan")
}

/// The angle about the axis at which a leaf stands.
fn azimuth(leaf: &BorneLeaf) -> f64 {
    let midrib = leaf.to_plant.matrix3.y_axis;
    libm::atan2(midrib.y, midrib.x)
}

#[test]
fn leaves_follow_one_another_by_their_divergence() {
    for phyllotaxis in [
        Phyllotaxis::DISTICHOUS,
        Phyllotaxis::SPIRAL,
        Phyllotaxis::DECUSSATE,
        Phyllotaxis::WHORLED,
    ] {
        let plant = grown(&shoot(phyllotaxis));
        let around = phyllotaxis.per_node as usize;
        assert_eq!(plant.leaves.len(), 12 * around);
        for pair in plant.leaves.windows(around + 1) {
            let turned = azimuth(&pair[around]) - azimuth(&pair[0]) - phyllotaxis.divergence;
            let off = turned - TAU * (turned / TAU).round();
            assert!(off.abs() < 1e-9, "{off}");
        }
        for node in plant.leaves.chunks(around) {
            for leaf in node {
                assert!((leaf.node.z - node[0].node.z).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn the_golden_angle_is_that_of_the_golden_section() {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let angle = TAU / (golden + 1.0);
    assert!((Phyllotaxis::SPIRAL.divergence - angle).abs() < 1e-12);
}

#[test]
fn internodes_shorten_as_asked_and_fill_the_axis() {
    let mut plan = shoot(Phyllotaxis::DISTICHOUS);
    plan.axis.shortening = 0.8;
    plan.axis.bare = 0.25;
    let plant = grown(&plan);
    let heights: Vec<f64> = plant.leaves.iter().map(|leaf| leaf.node.z).collect();
    assert!((heights[0] - 75.0).abs() < 1e-9, "{}", heights[0]);
    assert!((heights[11] - 300.0).abs() < 1e-9);
    for three in heights.windows(3) {
        let ratio = (three[2] - three[1]) / (three[1] - three[0]);
        assert!((ratio - 0.8).abs() < 1e-9, "{ratio}");
    }
}

#[test]
fn feet_of_petioles_stand_within_the_axis_whatever_the_leaf() {
    for preset in presets::PRESETS {
        let mut plan = preset.plan();
        plan.individuals = 3;
        for leaf in ["maple", "birch", "ginkgo", "aspen"] {
            let leaf = species::find(leaf).expect("a preset").plan();
            let feet = (0..3_u64).map(|number| Foot::of(&leaf.individual(None, number + 1)));
            let feet: Vec<Foot> = feet.collect::<Result<_, _>>().expect("they are borne");
            // A flower has sepals and petals besides.
            let kinds = if plan.flower.is_some() { 3 } else { 1 };
            let plant = Plant::grow(&plan, &vec![feet.clone(); kinds], None).expect("a good plan");
            assert_eq!(plant.axes.validate(), Ok(()), "{}", preset.name);
            assert!(plant.leaves.len() >= 9, "{}", preset.name);
            for leaf in &plant.leaves {
                let foot = feet[leaf.individual as usize].at;
                let off = leaf.to_plant.transform_point3(foot).distance(leaf.node);
                assert!(off < 1e-9, "{off}");
                // A rotation with one factor, without a reflection.
                let linear = leaf.to_plant.matrix3;
                let size = linear.determinant().cbrt();
                assert!((0.02..=2.0).contains(&size));
                let rest = linear.transpose() * linear - DMat3::IDENTITY * (size * size);
                assert!(rest.to_cols_array().iter().all(|one| one.abs() < 1e-9));
            }
        }
    }
}

#[test]
fn blades_turn_to_the_light_as_far_as_they_may() {
    // The cosines between blades and light: their mean, and how many are 1.
    let facing = |share: f64, light: DVec3| {
        let mut plan = presets::find("maple-bough").expect("a preset").plan();
        plan.posture.to_light = share;
        plan.posture.light = light;
        plan.posture.stray = 0.0;
        plan.evasions = 0;
        let leaf = species::find("maple").expect("a preset").plan();
        let feet = vec![Foot::of(&leaf).expect("it is borne"); 2];
        let plant = Plant::grow(&plan, &[feet], None).expect("a good plan");
        let cosines = plant
            .leaves
            .iter()
            .map(|leaf| leaf.to_plant.matrix3.z_axis.normalize().dot(light));
        let cosines: Vec<f64> = cosines.collect();
        let count = cosines.len() as f64;
        let whole = cosines
            .iter()
            .filter(|cosine| **cosine > 1.0 - 1e-9)
            .count();
        [cosines.iter().sum::<f64>() / count, whole as f64 / count]
    };
    for light in [DVec3::Z, DVec3::new(0.6, 0.0, 0.8)] {
        let [none, half, full] = [0.0, 0.5, 1.0].map(|share| facing(share, light));
        // The others would bend into their axis.
        assert!(
            none[0] < half[0] && half[0] < full[0] && full[1] > 0.5,
            "{none:?} {half:?} {full:?}"
        );
        assert_eq!(half[1], 0.0);
    }
}

#[test]
fn an_axis_turns_upwards_or_droops() {
    let tip = |upward: f64| {
        let mut plan = shoot(Phyllotaxis::DISTICHOUS);
        plan.axis.inclination = FRAC_PI_2;
        plan.axis.upward = upward;
        grown(&plan).leaves[11].node.z
    };
    assert!(tip(0.0).abs() < 2.0);
    assert!(tip(1.0) > 50.0 && tip(-1.0) < -50.0);
}

#[test]
fn branches_are_of_the_order_asked_for() {
    let mut plan = shoot(Phyllotaxis::DECUSSATE);
    let bare = grown(&plan).leaves.len();
    let mut counts = vec![bare];
    for order in 1..=2 {
        plan.branching = Some(Branching {
            order,
            ..Branching::USUAL
        });
        counts.push(grown(&plan).leaves.len());
    }
    assert!(counts[0] < counts[1] && counts[1] < counts[2], "{counts:?}");
}

#[test]
fn short_shoots_bear_clusters() {
    let mut plan = shoot(Phyllotaxis::SPIRAL);
    plan.posture.cluster = 5;
    plan.posture.spur_mm = 10.0;
    let plant = grown(&plan);
    assert_eq!(plant.leaves.len(), 60);
    for cluster in plant.leaves.chunks(5) {
        for leaf in cluster {
            assert!(leaf.node.distance(cluster[0].node) < 4.0);
        }
    }
}

#[test]
fn neighbours_are_different_individuals_and_kinds_go_from_foot_to_tip() {
    let plan = shoot(Phyllotaxis::SPIRAL);
    let feet = vec![vec![SESSILE; 6]; 3];
    let plant = Plant::grow(&plan, &feet, None).expect("a good plan");
    for pair in plant.leaves.windows(2) {
        assert!(pair[0].individual != pair[1].individual || pair[0].kind != pair[1].kind);
        assert!(pair[0].kind <= pair[1].kind);
    }
    assert_eq!(plant.leaves[11].kind, 2);
}

#[test]
fn neighbours_differ_also_on_both_sides_of_a_branch() {
    let mut plan = shoot(Phyllotaxis::SPIRAL);
    plan.individuals = 2;
    plan.axis.length_mm = 400.0;
    plan.branching = Some(Branching {
        share: 0.5,
        ..Branching::USUAL
    });
    let plant = grown(&plan);
    // Those of the main axis stand beside the z axis.
    let on_main = plant
        .leaves
        .iter()
        .filter(|leaf| leaf.node.truncate().length() < 3.0);
    let on_main: Vec<u32> = on_main.map(|leaf| leaf.individual).collect();
    assert!(on_main.len() > 6 && on_main.len() < plant.leaves.len());
    assert!(
        on_main.windows(2).all(|pair| pair[0] != pair[1]),
        "{on_main:?}"
    );
}

#[test]
fn an_axis_that_bends_too_sharply_is_reported() {
    let mut plan = shoot(Phyllotaxis::SPIRAL);
    plan.axis.length_mm = 1.0;
    plan.axis.nodes = 1;
    plan.axis.radius_mm = [3.0; 2];
    plan.axis.swelling = 0.0;
    plan.axis.inclination = 2.9;
    plan.axis.upward = 2.9;
    plan.axis.stray = 0.48;
    let feet = [vec![SESSILE]];
    let mut bent = 0;
    for seed in 0..2000 {
        let grown = Plant::grow(
            &PlantPlan {
                seed,
                ..plan.clone()
            },
            &feet,
            None,
        );
        let reason = grown.as_ref().err().map(NotGrown::to_string);
        assert!(reason.is_none_or(|reason| reason.starts_with("an axis cannot be built")));
        bent += u32::from(grown.is_err());
    }
    assert!((1..500).contains(&bent), "{bent} of 2000");
}

#[test]
fn the_same_plan_gives_the_same_plant_and_another_seed_another() {
    let plan = presets::find("birch-twig").expect("a preset").plan();
    let other = PlantPlan {
        seed: 1,
        ..plan.clone()
    };
    assert_eq!(grown(&plan), grown(&plan));
    assert_ne!(grown(&plan).leaves, grown(&other).leaves);
}

/// Why there is nothing.
fn refused<T>(grown: Result<T, NotGrown>) -> String {
    let error = grown.err().expect("it is refused");
    error.to_string()
}

#[test]
fn what_no_plant_bears_and_what_has_no_room_is_refused() {
    let mut leaf = species::find("maple").expect("a preset").plan();
    leaf.stance.on_ground = true;
    assert!(refused(Foot::of(&leaf)).contains("rests on the ground"));
    let nasturtium = species::find("nasturtium").expect("a preset").plan();
    assert!(refused(Foot::of(&nasturtium)).contains("peltate"));
    let mut plan = shoot(Phyllotaxis::SPIRAL);
    plan.axis.nodes = 400;
    assert!(refused(plan.validate()).starts_with("an internode of an axis of"));
    plan = shoot(Phyllotaxis::SPIRAL);
    plan.axis.length_mm = f64::NAN;
    assert!(refused(plan.validate()).starts_with("length_mm is NaN"));
    plan = shoot(Phyllotaxis {
        per_node: 12,
        divergence: PI,
    });
    plan.axis.length_mm = 1e5;
    plan.axis.nodes = 1000;
    plan.axis.shortening = 1.0;
    plan.branching = Some(Branching {
        order: 4,
        ..Branching::USUAL
    });
    let feet = vec![vec![SESSILE]];
    assert!(refused(Plant::grow(&plan, &feet, None)).starts_with("the plant has more than"));
    assert!(refused(Plant::grow(&plan, &[], None)).starts_with("a plant bears one leaf"));
}

#[test]
fn relief_stands_out_from_closed_axes_and_moves_no_leaf() {
    for preset in ["birch-twig", "cherry-bough", "poplar-branch", "maple-bough"] {
        let mut plan = presets::find(preset).expect("a preset").plan();
        let smooth = grown(&plan);
        // Without heights the axes are as they were, but for smooth bends.
        let [flat, rough] = [0.0, 1.0].map(|high| {
            plan.relief = Some(BarkRelief {
                ridges_mm: 0.2 * high,
                lenticel_height_mm: 0.3 * high,
                edge_mm: 0.5,
                ..BarkRelief::USUAL
            });
            grown(&plan)
        });
        for plant in [&flat, &rough] {
            assert_eq!(plant.axes.validate(), Ok(()), "{preset}");
            assert_eq!(plant.leaves, smooth.leaves);
        }
        let area = |plant: &Plant| plant.axes.area();
        assert!((area(&flat) / area(&smooth) - 1.0).abs() < 0.02, "{preset}");
        let more = area(&rough) / area(&flat);
        assert!((1.02..2.0).contains(&more), "{preset}: {more}");
    }
}
