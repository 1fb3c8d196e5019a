use glam::Vec3;
use proptest::prelude::*;

use super::*;
use crate::light::patch::{Patch, patches};
use properties::fixed;

/// Pseudo-random numbers in [0, 1) from a seed.
fn numbers(seed: u32) -> impl FnMut() -> f32 {
    let mut stream = crate::sampling::stream::Stream::new(7, seed, 0, 0);
    let mut left = Vec::new();
    move || {
        if left.is_empty() {
            left.extend(stream.next4());
        }
        left.pop().expect("four numbers have come")
    }
}

fn direction(next: &mut impl FnMut() -> f32) -> Vec3 {
    let z = 2.0 * next() - 1.0;
    let (sin, cos) = libm::sincosf(std::f32::consts::TAU * next());
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(radius * cos, radius * sin, z).normalize()
}

/// Rectangles and triangles of all sizes around the origin, in clusters, with radiances over six
/// decades.
fn lamps(count: usize, next: &mut impl FnMut() -> f32) -> Vec<(Patch, f32)> {
    let mut lamps = Vec::new();
    let mut cluster = (Vec3::ZERO, 1.0);
    while lamps.len() < count {
        if next() < 0.2 {
            cluster = (
                10.0 * (next() - 0.5) * direction(next),
                libm::powf(10.0, -2.0 * next()),
            );
        }
        let (center, size) = cluster;
        let place = center + size * direction(next);
        let (along, normal) = (direction(next), direction(next));
        let across = along.cross(normal).normalize();
        let size = size * libm::powf(10.0, -1.5 * next());
        let [p, q] = [along * size, across * size * (0.1 + next())];
        let triangles = [
            [place, place + p, place + p + q],
            [place, place + p + q, place + q],
        ];
        let few = if next() < 0.5 {
            &triangles[..1]
        } else {
            &triangles[..]
        };
        let radiance = libm::powf(10.0, 6.0 * next() - 3.0);
        lamps.extend(patches(few).0.into_iter().map(|patch| (patch, radiance)));
    }
    lamps.truncate(count);
    lamps
}

fn tree_of(lamps: &[(Patch, f32)]) -> LightTree {
    let emitters: Vec<_> = lamps
        .iter()
        .map(|(patch, radiance)| patch.emitter(*radiance))
        .collect();
    LightTree::new(&emitters)
}

/// A receiver among the lamps, or right beside one.
fn receiver(lamps: &[(Patch, f32)], next: &mut impl FnMut() -> f32) -> Receiver {
    let far = 8.0 * next() * direction(next);
    let lamp = &lamps[((next() * lamps.len() as f32) as usize).min(lamps.len() - 1)];
    let emitter = lamp.0.emitter(1.0);
    let near = emitter.center + emitter.radius * 2.0 * next() * direction(next);
    Receiver {
        position: if next() < 0.5 { far } else { near },
        normal: direction(next),
    }
}

proptest! {
    #![proptest_config(fixed(256))]

    #[test]
    fn every_lamp_that_shines_on_a_point_from_either_side_can_be_chosen_there(
        seed in 0_u32..1_000_000, count in 1_usize..300
    ) {
        let mut next = numbers(seed);
        let lamps = lamps(count, &mut next);
        let tree = tree_of(&lamps);
        for _ in 0..20 {
            let receiver = receiver(&lamps, &mut next);
            let mut sum = 0.0;
            let mut shining = 0;
            for (number, (patch, _)) in lamps.iter().enumerate() {
                let probability = tree.probability(number, &receiver);
                sum += probability;
                // A flat lamp sends light to all points on the side of its normal.
                let shines = patch.sample(&receiver, glam::Vec2::new(next(), next())).is_some();
                shining += usize::from(shines);
                prop_assert!(!shines || probability > 0.0, "lamp {number} of {count} is hidden");
            }
            prop_assert!(sum < 1.0 + 1e-4, "sum {sum}");
            // If no lamp is dark, the choice never fails.
            prop_assert!(shining < count || sum > 1.0 - 1e-4, "sum {sum}");
        }
    }

    #[test]
    fn a_lamp_is_chosen_as_often_as_its_probability_says(
        seed in 0_u32..1_000_000, count in 1_usize..100
    ) {
        const DRAWS: usize = 4096;
        let mut next = numbers(seed);
        let lamps = lamps(count, &mut next);
        let tree = tree_of(&lamps);
        let receiver = receiver(&lamps, &mut next);
        let (mut counts, mut nothing) = (vec![0_usize; count], 0);
        for draw in 0..DRAWS {
            let u = (draw as f32 + 0.5) / DRAWS as f32;
            let Some((number, probability)) = tree.choose(&receiver, u) else {
                nothing += 1;
                continue;
            };
            let told = tree.probability(number, &receiver);
            prop_assert!((told / probability - 1.0).abs() < 1e-5, "{told}, not {probability}");
            counts[number] += 1;
        }
        // The number of evenly spaced numbers in an interval is proportional to its length, up to
        // its two ends.
        let mut vain = DRAWS as f32;
        for (number, &count) in counts.iter().enumerate() {
            let expected = tree.probability(number, &receiver) * DRAWS as f32;
            prop_assert!((count as f32 - expected).abs() < 1.5, "{count} for {expected}");
            vain -= expected;
        }
        prop_assert!((nothing as f32 - vain).abs() < 1.5 * count as f32, "{nothing} for {vain}");
    }
}

#[test]
fn lamps_that_hang_in_one_place_and_lamps_on_one_line_make_trees_too() {
    let one = Emitter {
        center: Vec3::ONE,
        radius: 0.0,
        axis: Vec3::Z,
        spread: std::f32::consts::PI,
        reach: std::f32::consts::FRAC_PI_2,
        intensity: 1.0,
    };
    // With doubling distances, each split by cost would separate only one lamp.
    let doubling = |i: usize| libm::powf(2.0, (i % 60) as f32 - 30.0);
    for spacing in [|_| 0.0, |i| i as f32, doubling] {
        let emitters: Vec<_> = (0..1000)
            .map(|i| Emitter {
                center: one.center + Vec3::X * spacing(i),
                ..one
            })
            .collect();
        let tree = LightTree::new(&emitters);
        assert_eq!(tree.len(), 1000);
        let receiver = Receiver {
            position: Vec3::ZERO,
            normal: Vec3::Z,
        };
        let sum: f32 = (0..1000).map(|i| tree.probability(i, &receiver)).sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    }
}

#[test]
fn a_spot_is_dark_outside_its_cone_and_a_point_shines_all_round() {
    let spot = Emitter {
        center: Vec3::Z,
        radius: 0.0,
        axis: -Vec3::Z,
        spread: 0.0,
        reach: 0.3,
        intensity: 1.0,
    };
    let point = Emitter {
        spread: std::f32::consts::PI,
        reach: std::f32::consts::PI,
        ..spot
    };
    let tree = LightTree::new(&[spot, point]);
    let at = |x: f32| Receiver {
        position: Vec3::new(x, 0.0, 0.0),
        normal: Vec3::Z,
    };
    assert!(tree.probability(0, &at(0.29)) > 0.4);
    assert_eq!(tree.probability(0, &at(0.35)), 0.0);
    assert_eq!(tree.probability(1, &at(0.35)), 1.0);
}
