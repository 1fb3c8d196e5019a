//! What the model claims, and what it promises for any plan.

use glam::DVec2;
use proptest::prelude::*;

use super::*;
use crate::shape::outline::Outline;
use properties::fixed;

const LENGTH_MM: f64 = 80.0;

/// A lobed leaf in which nothing is left to chance.
fn lobed(hold: f64) -> DevelopmentPlan {
    DevelopmentPlan {
        primordium: Primordium {
            width: 0.7,
            ..Primordium::default()
        },
        waves: vec![Wave {
            hold,
            hold_base: 0.5,
            ..Wave::default()
        }],
        irregularity: 0.0,
        ..DevelopmentPlan::default()
    }
}

/// The same with teeth on its lobes, and as irregular as leaves are.
fn toothed() -> DevelopmentPlan {
    let mut plan = lobed(0.2);
    plan.irregularity = 0.4;
    plan.waves.push(Wave {
        from: 5.0,
        until: 8.0,
        spacing: 0.6,
        sequence: Sequence::Intercalary,
        zone: [0.1, 0.95],
        hold: 0.1,
        blunt: 1.0,
        lean: 0.3,
        ..Wave::default()
    });
    plan
}

fn grown(plan: &DevelopmentPlan, seed: u64) -> (DevelopedLeaf, Outline) {
    let leaf = plan.develop(seed).expect("a good plan");
    let outline = leaf.outline(LENGTH_MM).expect("a good margin");
    (leaf, outline)
}

fn secondaries(leaf: &DevelopedLeaf) -> Vec<MainVein> {
    let veins = leaf.veins(LENGTH_MM).into_iter();
    veins.filter(|vein| vein.wave == Some(0)).collect()
}

#[test]
fn the_same_plan_and_seed_give_the_same_bits_and_another_seed_another_leaf() {
    let one = grown(&toothed(), 1);
    assert_eq!(one, grown(&toothed(), 1));
    assert_ne!(one.1, grown(&toothed(), 2).1);
}

#[test]
fn every_convergence_point_is_the_tip_of_one_vein_that_leads_to_the_base() {
    for (plan, seed) in [
        (lobed(0.0), 1),
        (lobed(0.3), 1),
        (lobed(1.0), 1),
        (toothed(), 3),
    ] {
        let (leaf, outline) = grown(&plan, seed);
        let veins = leaf.veins(LENGTH_MM);
        assert!(veins.len() > 6, "{} veins", veins.len());
        let network = leaf
            .network(LENGTH_MM, MainVeinStyle::default())
            .expect("good");
        assert_eq!(network.validate(), Ok(()));
        for vein in &veins {
            let tip = DVec2::from_array(vein.tip);
            assert!(
                outline.distance_to_margin(tip) < 1e-9 * LENGTH_MM,
                "{vein:?}"
            );
        }
        // One tip for each vein, and one way to each of them.
        let leads_on: Vec<u32> = network.edges().iter().map(|edge| edge.from).collect();
        let tips = (0..network.nodes().len() as u32).filter(|node| !leads_on.contains(node));
        assert_eq!(tips.count(), veins.len());
        for node in network.nodes() {
            assert!(outline.covers(node.position), "{node:?}");
        }
    }
}

/// Tips on the right side and the leaf's, from base to apex.
fn right_tips(leaf: &DevelopedLeaf) -> Vec<DVec2> {
    let veins = leaf.veins(LENGTH_MM).into_iter();
    let mut tips: Vec<DVec2> = veins.map(|vein| DVec2::from_array(vein.tip)).collect();
    tips.retain(|tip| tip.x >= 0.0);
    tips.sort_by(|a, b| a.y.total_cmp(&b.y));
    tips
}

#[test]
fn between_two_lobes_lies_a_sinus_and_at_the_tip_of_each_a_vein() {
    let (leaf, outline) = grown(&lobed(0.35), 1);
    let tips = right_tips(&leaf);
    assert!(tips.len() >= 3, "{tips:?}");
    for pair in tips.windows(2) {
        // The straight way from lobe to lobe leaves the blade.
        assert!(!outline.contains(pair[0].lerp(pair[1], 0.5)), "{pair:?}");
    }
    let (leaf, outline) = grown(&lobed(0.0), 1);
    for pair in right_tips(&leaf).windows(2) {
        assert!(outline.contains(pair[0].lerp(pair[1], 0.5)), "{pair:?}");
    }
}

#[test]
fn the_number_of_secondaries_follows_spacing_and_length_at_initiation() {
    let pairs = |spacing: f64, from: f64| {
        let mut plan = lobed(0.0);
        plan.waves[0] = Wave {
            spacing,
            from,
            until: from * 1.02,
            zone: [0.1, 0.9],
            bow: 0.0,
            ..Wave::default()
        };
        let leaf = plan.develop(1).expect("a good plan");
        assert_eq!(secondaries(&leaf).len() % 2, 0, "both sides alike");
        // Length of the margin of one side when they come.
        let step = libm::ceil(libm::log(from) / libm::log(20.0) * f64::from(plan.steps()));
        let young = plan.develop_until(1, step as u32).expect("a good plan");
        let side = 0.5 * young.outline(young.length()).expect("good").perimeter();
        (secondaries(&leaf).len() as f64 / 2.0, 0.8 * side / spacing)
    };
    for from in [1.0, 2.0, 4.0] {
        for spacing in [0.08, 0.12, 0.2, 0.3, 0.45] {
            let (count, room) = pairs(spacing, from);
            // One more or less, by what is left over at both ends of the zone.
            assert!(
                (room - 1.2..=room + 1.2).contains(&count),
                "{count} in {room}"
            );
        }
    }
    assert!(pairs(0.1, 2.0).0 >= 1.8 * pairs(0.2, 2.0).0);
    assert!(pairs(0.2, 2.0).0 >= 1.8 * pairs(0.2, 1.0).0);
}

#[test]
fn holding_growth_back_leads_smoothly_from_an_entire_to_a_compound_leaf() {
    let areas: Vec<f64> = (0..=40)
        .map(|i| grown(&lobed(f64::from(i) / 40.0), 1).1.area())
        .collect();
    for pair in areas.windows(2) {
        assert!(pair[1] < pair[0], "{pair:?}");
        assert!(pair[1] > 0.9 * pair[0], "no leap: {pair:?}");
    }
    assert!(areas[40] < 0.5 * areas[0], "{} of {}", areas[40], areas[0]);
    // The sinuses of the compound leaf all but reach the midrib, those of the lobed one do not.
    let rachis = |hold: f64| {
        let (leaf, outline) = grown(&lobed(hold), 1);
        let tips = right_tips(&leaf);
        let between = 0.5 * (tips[1].y + tips[2].y) - 0.3 * tips[1].x;
        let width = |x: f64| outline.contains(DVec2::new(x, between));
        let shares = (0..200).map(|i| f64::from(i) / 200.0 * LENGTH_MM);
        let mut blade = shares.take_while(|&x| width(x));
        blade.by_ref().last().unwrap_or(0.0) / LENGTH_MM
    };
    assert!(rachis(1.0) < 0.05, "{}", rachis(1.0));
    assert!(rachis(0.2) > 0.1, "{}", rachis(0.2));
}

#[test]
fn dear_transport_along_veins_turns_a_pinnate_leaf_into_a_palmate_one() {
    let heights = |transport: f64| {
        let mut plan = lobed(0.2);
        plan.waves[0].transport = transport;
        let (leaf, _) = grown(&plan, 1);
        let origins = secondaries(&leaf).into_iter().map(|vein| vein.origin[1]);
        origins.collect::<Vec<f64>>()
    };
    let mean = |heights: &[f64]| heights.iter().sum::<f64>() / heights.len() as f64;
    let [square, acute, palmate] = [0.0, 0.6, 1.0].map(heights);
    assert!(mean(&square) > mean(&acute) && mean(&acute) > 0.0);
    assert!(palmate.iter().all(|&height| height == 0.0), "{palmate:?}");
}

#[test]
fn convergence_points_appear_in_their_sequence() {
    let order = |sequence: Sequence| {
        let mut plan = lobed(0.0);
        plan.waves[0] = Wave {
            sequence,
            spacing: 0.2,
            until: 4.0,
            ..Wave::default()
        };
        let (leaf, _) = grown(&plan, 1);
        let right = secondaries(&leaf)
            .into_iter()
            .filter(|vein| vein.tip[0] > 0.0);
        right.map(|vein| vein.tip[1]).collect::<Vec<f64>>()
    };
    let basipetal = order(Sequence::Basipetal);
    assert!(
        basipetal.len() > 3 && basipetal.is_sorted_by(|a, b| a > b),
        "{basipetal:?}"
    );
    let acropetal = order(Sequence::Acropetal);
    assert!(
        acropetal.len() > 3 && acropetal.is_sorted(),
        "{acropetal:?}"
    );
}

#[test]
fn without_chance_the_sides_are_alike_and_with_it_they_are_not() {
    let skew = |irregularity: f64| {
        let mut plan = lobed(0.3);
        plan.irregularity = irregularity;
        let tips = secondaries(&grown(&plan, 1).0);
        let [right, left] = [1.0, -1.0].map(|side| {
            let mine = tips.iter().filter(|vein| vein.tip[0] * side > 0.0);
            mine.map(|vein| vein.tip[1]).collect::<Vec<f64>>()
        });
        let apart = right.iter().zip(&left).map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max)
    };
    assert!(skew(0.0) < 0.01 * LENGTH_MM, "{}", skew(0.0));
    assert!(skew(0.5) > 0.02 * LENGTH_MM, "{}", skew(0.5));
}

#[test]
fn a_leaf_grows_from_its_primordium_and_its_veins_only_become_more() {
    let plan = toothed();
    let leaf = plan.develop(2).expect("a good plan");
    let mut before = (0.0, 0);
    for step in (0..=plan.steps()).step_by(10) {
        let young = leaf.at_step(step).expect("a good plan");
        let area = young.outline(young.length()).expect("a good margin").area();
        let veins = young.veins(1.0).len();
        assert!(
            area > before.0 && veins >= before.1,
            "step {step}: {area}, {veins}"
        );
        before = (area, veins);
    }
    assert_eq!(leaf.at_step(plan.steps()).expect("a good plan"), leaf);
    assert!((leaf.length() - plan.growth).abs() < 1e-9 * plan.growth);
}

#[test]
fn bad_numbers_are_named_with_what_is_allowed() {
    type Spoil = fn(&mut DevelopmentPlan);
    let cases: [(Spoil, &str); 9] = [
        (
            |p| p.growth = f64::NAN,
            "growth is NaN, outside 1.1 to 1000",
        ),
        (
            |p| p.primordium.width = 0.0,
            "width is 0, outside 0.02 to 3",
        ),
        (|p| p.resolution = 5, "resolution is 5, outside 20 to 400"),
        (
            |p| p.waves[0].hold = 1.5,
            "waves[0].hold is 1.5, outside 0 to 1",
        ),
        (
            |p| p.waves[0].until = 1.0,
            "wave 0 lasts from a length of 1 until 1",
        ),
        (
            |p| p.waves[0].zone = [0.8, 0.2],
            "zone of wave 0 goes from 0.8 to 0.2",
        ),
        (|p| p.growth = 1.2, "wave 1 starts at a length of 5, but"),
        (
            |p| p.waves = vec![Wave::default(); 5],
            "waves is a list of 5, outside a list of at most 4 waves",
        ),
        (
            |p| {
                p.waves[0].spacing = 0.01;
                p.primordium.width = 3.0;
                p.waves[0].bow = 0.0;
                p.waves[0].zone = [0.0, 1.0];
            },
            "with a spacing of 0.01 wave 0 brings more than 300 convergence points",
        ),
    ];
    for (spoil, start) in cases {
        let mut plan = toothed();
        plan.irregularity = 0.0;
        plan.waves[0].until = 4.0;
        spoil(&mut plan);
        let message = plan.develop(1).expect_err("a bad plan").to_string();
        assert!(message.starts_with(start), "{message}");
    }
}

fn waves() -> impl Strategy<Value = Vec<(f64, Wave)>> {
    let times = (0.0..0.8, 1.05..2.0, 0.12..1.2);
    let sequence = prop_oneof![
        Just(Sequence::Basipetal),
        Just(Sequence::Acropetal),
        Just(Sequence::Intercalary),
    ];
    let place = (0.0..0.5, 0.5..1.0, 0.0..1.0);
    let form = (0.0..1.0, 0.0..1.0, 0.3..8.0, 0.3..8.0, -0.9..0.9);
    let growth = (0.5..1.5, 0.5..1.5, -0.3..0.3, -0.3..0.3);
    let wave = (times, sequence, place, form, growth).prop_map(
        |(times, sequence, place, form, growth)| {
            let wave = Wave {
                from: 1.0,
                until: times.1,
                spacing: times.2,
                sequence,
                zone: [place.0, place.1],
                transport: place.2,
                rates: [growth.0, growth.1],
                hold: form.0,
                hold_base: form.1,
                terminal: 0.1 + 0.8 * form.1,
                sinus: form.2,
                blunt: form.3,
                lean: form.4,
                bow: growth.2,
                splay: growth.3,
            };
            (times.0, wave)
        },
    );
    prop::collection::vec(wave, 0..5)
}

proptest! {
    #![proptest_config(fixed(100))]
    #[test]
    fn any_plan_within_range_gives_a_leaf_or_says_why_not(
        form in (0.02..3.0, 0.05..0.95, 0.2..3.0, 0.2..3.0),
        growth in 0.2_f64..3.5,
        basal_growth in -0.9..0.9,
        irregularity in 0.0..1.0,
        waves in waves(),
        seed in any::<u64>(),
    ) {
        let growth = libm::exp(growth);
        let at_time = |(time, wave): (f64, Wave)| {
            let from = libm::pow(growth, time);
            Wave { from, until: (from * wave.until).min(1000.0), spacing: (from * wave.spacing).min(10.0), ..wave }
        };
        let plan = DevelopmentPlan {
            primordium: Primordium { width: form.0, widest_at: form.1, taper_base: form.2, taper_tip: form.3 },
            growth,
            basal_growth,
            waves: waves.into_iter().map(at_time).collect(),
            irregularity,
            resolution: 20,
        };
        prop_assert_eq!(plan.validate(), Ok(()));
        match plan.develop(seed) {
            Ok(leaf) => {
                let network = leaf.network(LENGTH_MM, MainVeinStyle::default()).expect("good");
                prop_assert_eq!(network.validate(), Ok(()));
                // The outline proves itself simple; it holds every vein.
                if let Ok(outline) = leaf.outline(LENGTH_MM) {
                    prop_assert!(network.nodes().iter().all(|node| outline.covers(node.position)));
                }
            }
            Err(error) => {
                let message = error.to_string();
                let is_reported = message.contains("convergence points")
                    || message.starts_with("the margin takes");
                prop_assert!(is_reported, "{}", message);
            }
        }
    }
}
