//! Measures of networks that are known in closed form.

use std::f64::consts::PI;

use glam::DVec2;
use proptest::prelude::*;

use super::subject::PROBES;
use super::*;
use crate::venation::testing::{hexagons, network, poplar, rectangle, squares, wide};
use properties::fixed;

fn number(measures: &Measures, key: &str) -> f64 {
    let value = measures.number(key);
    value.unwrap_or_else(|| panic!("{key} is missing"))
}

fn near(measures: &Measures, key: &str, expected: f64) {
    let value = number(measures, key);
    let tolerance = 1e-9 * expected.abs().max(1.0);
    assert!(
        (value - expected).abs() <= tolerance,
        "{key} is {value}, not {expected}"
    );
}

#[test]
fn a_square_lattice_has_the_density_areoles_and_spanning_tree_of_one() {
    let (n, side) = (12_u32, 0.5);
    let (count, width) = (f64::from(n), f64::from(n) * side);
    let area = (width + 2.0) * (width + 3.0);
    let blade = rectangle((-1.0, -1.0), (width + 1.0, width + 2.0));
    let measures = measure(&blade, &squares(n, side), 3.0);
    let length = 2.0 * count * (count + 1.0) * side;
    near(&measures, "blade_area_mm2", area);
    near(&measures, "vein_length_mm", length);
    near(&measures, "vein_density_mm_per_mm2", length / area);
    near(&measures, "areole_count", count * count);
    near(&measures, "areoles_per_mm2", count * count / area);
    near(&measures, "areole_area_mm2_mean", side * side);
    near(&measures, "areole_area_mm2_median", side * side);
    near(&measures, "areole_area_cv", 0.0);
    near(&measures, "areole_circularity_median", PI / 4.0);
    near(&measures, "freely_ending_veinlet_count", 0.0);
    let list = |key: &str| {
        let entry = measures.entries().iter().find(|entry| entry.key == key);
        match entry.map(|entry| &entry.value) {
            Some(Value::List(list)) => list.clone(),
            other => panic!("{key} is {other:?}"),
        }
    };
    for area in list("areole_area_mm2_percentiles") {
        assert!((area - side * side).abs() < 1e-12, "{area}");
    }
    assert_eq!(list("areole_circularity_percentiles").len(), 5);
    // Corners of the lattice are not junctions; the other nodes on its rim have three edges, those
    // inside four.
    let (rim, inside) = (4.0 * (count - 1.0), (count - 1.0) * (count - 1.0));
    near(&measures, "junction_count", rim + inside);
    near(&measures, "junction_degree_3_share", rim / (rim + inside));
    let degrees = list("junction_degree_shares");
    let expected = [rim / (rim + inside), inside / (rim + inside), 0.0];
    assert!(
        degrees
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-12),
        "{degrees:?}"
    );
    // On the rim two veins go straight on: 180° where 120° would be in balance.
    near(&measures, "junction_bent_share", 1.0);
    near(&measures, "junction_largest_angle_deg_median", 180.0);
    near(
        &measures,
        "spanning_tree_ratio",
        (rim + inside - 1.0) * side / length,
    );
}

#[test]
fn points_between_square_veins_are_as_far_from_them_as_integrals_say() {
    let blade = rectangle((0.0, 0.0), (10.0, 10.0));
    let measures = measure(&blade, &squares(10, 1.0), 3.0);
    // P(d > t) = (1 − 2 t)²: mean 1/6, standard deviation √(1/72), median (1 − √½)/2 where the
    // density is 2√2.
    let error = (1.0 / 72.0 / PROBES as f64).sqrt();
    let mean = number(&measures, "vein_distance_mm_mean");
    assert!((mean - 1.0 / 6.0).abs() < 4.0 * error, "mean {mean}");
    let median = number(&measures, "vein_distance_mm_median");
    let error = 0.5 / (PROBES as f64).sqrt() / 8.0_f64.sqrt();
    assert!(
        (median - 0.5 * (1.0 - 0.5_f64.sqrt())).abs() < 4.0 * error,
        "median {median}"
    );
}

#[test]
fn a_hexagonal_lattice_has_the_areoles_of_one() {
    let (n, side) = (9, 0.4);
    let lattice = hexagons(n, side);
    let blade = rectangle((-1.0, -1.0), (12.0, 12.0));
    let measures = measure(&blade, &lattice, 3.0);
    let edges = lattice.edges().len() as f64;
    near(&measures, "vein_density_mm_per_mm2", edges * side / 169.0);
    near(&measures, "areole_count", f64::from(n * n));
    near(
        &measures,
        "areole_area_mm2_median",
        1.5 * 3.0_f64.sqrt() * side * side,
    );
    near(
        &measures,
        "areole_circularity_mean",
        PI * 3.0_f64.sqrt() / 6.0,
    );
    near(&measures, "junction_degree_3_share", 1.0);
    assert!((number(&measures, "areole_elongation_median") - 1.0).abs() < 1e-6);
}

#[test]
fn a_comb_has_the_spacing_and_angles_of_its_teeth() {
    // A midrib of 100 steps; every tenth node a tooth to the right, every twentieth one to the
    // left, each with a shorter tooth at right angles.
    let mut places: Vec<DVec2> = (0..=100).map(|i| DVec2::new(0.0, f64::from(i))).collect();
    let mut edges: Vec<(u32, u32, f64, u8)> = (1..=100).map(|i| (i - 1, i, 1.0, 1)).collect();
    let angle = 50.0_f64.to_radians();
    for level in (10..100).step_by(10) {
        for side in [1.0, -1.0] {
            if side < 0.0 && level % 20 != 0 {
                continue;
            }
            let along = DVec2::new(side * libm::sin(angle), libm::cos(angle));
            let mut tail = level;
            for step in 1..=8 {
                let node = places.len() as u32;
                places.push(DVec2::new(0.0, f64::from(level)) + along * f64::from(step));
                edges.push((tail, node, 0.3, 2));
                tail = node;
            }
            let node = places.len() as u32;
            places.push(places[tail as usize - 4] + along.perp() * 0.5);
            edges.push((tail - 4, node, 0.1, 3));
        }
    }
    let blade = rectangle((-20.0, 0.0), (20.0, 120.0));
    let measures = measure(&blade, &wide(&places, &edges), 3.0);
    near(&measures, "midrib_length_mm", 100.0);
    near(&measures, "secondary_vein_count_right", 9.0);
    near(&measures, "secondary_vein_count_left", 4.0);
    // Eight gaps of 10 and three of 20.
    near(&measures, "secondary_spacing_mm_mean", 140.0 / 11.0);
    let spread = (8.0 * (30.0_f64 / 11.0).powi(2) + 3.0 * (80.0_f64 / 11.0).powi(2)) / 10.0;
    near(
        &measures,
        "secondary_spacing_cv",
        spread.sqrt() * 11.0 / 140.0,
    );
    near(&measures, "secondary_angle_deg_mean", 50.0);
    near(&measures, "tertiary_angle_deg_mean", 90.0);
    // Each tooth and each tooth's tooth, and the midrib's end.
    near(&measures, "freely_ending_veinlet_count", 27.0);
    near(&measures, "freely_ending_veinlets_per_mm2", 27.0 / 4800.0);
    near(
        &measures,
        "freely_ending_veinlet_length_mm_mean",
        (13.0 * (0.5 + 4.0) + 10.0) / 27.0,
    );
    assert_eq!(measures.number("freely_ending_veinlets_per_areole"), None);
    let orders = &measures
        .entries()
        .iter()
        .find(|e| e.key.ends_with("by_order"))
        .expect("there")
        .value;
    let Value::List(orders) = orders else {
        panic!("one number an order")
    };
    for (density, length) in orders.iter().zip([100.0, 104.0, 6.5]) {
        assert!((density - length / 4800.0).abs() < 1e-12);
    }
}

#[test]
fn veins_that_end_at_the_margin_are_no_freely_ending_veinlets() {
    let places = [(0.0, 0.0), (0.0, 1.0), (-1.0, 1.5), (0.0, 2.0), (0.5, 1.5)].map(DVec2::from);
    let veins = network(&places, &[[0, 1], [1, 2], [1, 3], [1, 4]]);
    let blade = rectangle((-1.1, 0.0), (1.1, 2.1));
    near(
        &measure(&blade, &veins, 3.0),
        "freely_ending_veinlet_count",
        1.0,
    );
}

#[test]
fn a_binary_tree_forks_at_its_angle_and_obeys_its_murrays_law() {
    let exponent = 2.7;
    let mut places = vec![DVec2::ZERO, DVec2::new(0.0, 1.0)];
    let mut edges = vec![(0, 1, 1.0, 1)];
    let mut tips = vec![(1_u32, DVec2::Y, 1.0_f64)];
    for _ in 0..7 {
        let mut next = Vec::new();
        for (tip, direction, radius) in tips {
            // One daughter carries 0.7 of the flow with a deflection of 20°, the other 0.3 with
            // 35°.
            for (share, degrees) in [(0.7, 20.0_f64), (0.3, -35.0)] {
                let turned = DVec2::from_angle(degrees.to_radians()).rotate(direction) * 0.6;
                let node = places.len() as u32;
                places.push(places[tip as usize] + turned);
                let radius = radius * libm::pow(share, 1.0 / exponent);
                edges.push((tip, node, radius, 1));
                next.push((node, turned, radius));
            }
        }
        tips = next;
    }
    let veins = wide(&places, &edges);
    let blade = rectangle((-10.0, -10.0), (10.0, 10.0));
    let measures = measure(&blade, &veins, exponent);
    // Branches of later generations cross; those junctions are not forks.
    near(&measures, "branching_angle_deg_median", 55.0);
    near(&measures, "branching_wide_deflection_deg_median", 20.0);
    near(&measures, "branching_fine_deflection_deg_median", 35.0);
    near(&measures, "murray_ratio_median", 1.0);
    near(&measures, "murray_exponent_median", exponent);
    let other = number(&measure(&blade, &veins, 2.0), "murray_ratio_median");
    let expected = 1.0
        / [0.7, 0.3]
            .map(|x| libm::pow(x, 2.0 / exponent))
            .iter()
            .sum::<f64>();
    assert!((other - expected).abs() < 1e-9);
    assert_eq!(
        measure(&blade, &veins, f64::NAN).number("murray_ratio_median"),
        None
    );
}

/// Four squares in a row; the three veins between them have these radii.
fn row(radii: [f64; 3]) -> Measures {
    let places: Vec<DVec2> = (0..10)
        .map(|i| DVec2::new(f64::from(i / 2), f64::from(i % 2)))
        .collect();
    let mut edges = vec![(0, 1, 1.0, 1), (8, 9, 1.0, 1)];
    for i in 0..4 {
        edges.extend([(2 * i, 2 * i + 2, 1.0, 1), (2 * i + 1, 2 * i + 3, 1.0, 1)]);
    }
    edges.extend((0..3).map(|i| (2 * i + 2, 2 * i + 3, radii[i as usize], 1)));
    measure(
        &rectangle((-1.0, -1.0), (5.0, 2.0)),
        &wide(&places, &edges),
        3.0,
    )
}

#[test]
fn loops_merge_from_the_finest_vein_to_the_widest() {
    let paired = row([0.1, 0.3, 0.2]);
    near(&paired, "loop_nesting", 1.0);
    near(&paired, "loop_nesting_weighted", 1.0);
    near(&paired, "loop_tree_strahler", 3.0);
    let chained = row([0.1, 0.2, 0.3]);
    near(
        &chained,
        "loop_nesting",
        (1.0 + 1.0 / 2.0 + 1.0 / 3.0) / 3.0,
    );
    near(
        &chained,
        "loop_nesting_weighted",
        (1.0 + 2.0 / 2.0 + 3.0 / 3.0) / 6.0,
    );
    near(&chained, "loop_tree_strahler", 2.0);
}

#[test]
fn what_is_not_there_is_null_and_a_dash() {
    let blade = rectangle((0.0, 0.0), (1.0, 1.0));
    let point = DVec2::new(0.5, 0.0);
    for veins in [
        network(&[], &[]),
        network(&[point], &[]),
        network(&[point, DVec2::new(0.5, 0.5)], &[[0, 1]]),
    ] {
        let measures = measure(&blade, &veins, 3.0);
        let json = measures.json();
        assert!(json["areole_area_mm2_median"].is_null());
        assert!(json["branching_angle_deg_median"].is_null());
        assert_eq!(json["areoles_per_mm2"], 0.0);
        assert_eq!(json["areole_count"], 0);
        let table = measures.table();
        assert_eq!(table.lines().count(), measures.entries().len());
        assert!(
            table.contains("areole_area_mm2_median                –"),
            "{table}"
        );
    }
}

#[test]
fn every_key_is_used_once_and_carries_its_unit() {
    let measures = measure(&rectangle((-1.0, -1.0), (5.0, 5.0)), &squares(4, 1.0), 3.0);
    let mut keys: Vec<&str> = measures.entries().iter().map(|e| e.key).collect();
    keys.sort_unstable();
    let count = keys.len();
    keys.dedup();
    assert_eq!(keys.len(), count);
    for entry in measures.entries() {
        let infix = match entry.unit {
            "" => continue,
            "mm" => "_mm",
            "mm²" => "_mm2",
            "1/mm²" => "_per_mm2",
            "mm/mm²" => "_mm_per_mm2",
            "°" => "_deg",
            other => panic!("{other} has no place in keys"),
        };
        assert!(
            entry.key.contains(infix),
            "{} is in {}",
            entry.key,
            entry.unit
        );
    }
}

proptest! {
    #![proptest_config(fixed(100))]

    #[test]
    fn scribbles_with_any_widths_and_orders_have_finite_measures(
        at in prop::collection::vec((0_i32..60, 0_i32..60), 2..30),
        chords in prop::collection::vec((0_u32..30, 0_u32..30, 0.001..2.0_f64, 1_u8..5), 0..40),
        exponent in 0.1..20.0_f64,
    ) {
        let places: Vec<DVec2> = at.iter().map(|&(x, y)| DVec2::new(f64::from(x), f64::from(y)) * 0.1).collect();
        let count = places.len() as u32;
        let mut edges: Vec<(u32, u32, f64, u8)> = chords
            .iter()
            .map(|&(a, b, radius, order)| ((a % count).min(b % count), (a % count).max(b % count), radius, order))
            .filter(|e| places[e.0 as usize] != places[e.1 as usize])
            .collect();
        edges.sort_by_key(|e| (e.0, e.1));
        edges.dedup_by_key(|e| (e.0, e.1));
        let measures = measure(&rectangle((0.0, 0.0), (6.0, 6.0)), &wide(&places, &edges), exponent);
        for entry in measures.entries() {
            let fine = match &entry.value {
                Value::Count(_) | Value::Number(None) => true,
                Value::Number(Some(number)) => number.is_finite() && *number >= 0.0,
                Value::Orders(list) => list.iter().flatten().all(|n| n.is_finite() && *n > 0.0),
                Value::List(list) => {
                    let signed = entry.key == "elliptic_fourier";
                    list.iter().all(|number| number.is_finite() && (signed || *number >= 0.0))
                }
            };
            prop_assert!(fine, "{entry:?}");
        }
    }
}

#[test]
fn a_grown_leaf_obeys_the_law_by_which_it_was_grown() {
    let (blade, veins) = poplar(1);
    let measures = measure(&blade, &veins, 2.5);
    let length = number(&measures, "vein_length_mm");
    // A vein that leads back over itself to a junction counts once.
    let share = length / veins.vein_length_mm();
    assert!(share > 0.999 && share < 1.0 + 1e-12, "{share}");
    near(&measures, "murray_ratio_median", 1.0);
    near(&measures, "murray_exponent_median", 2.5);
    // In every order that has forks, too.
    let orders = measures
        .entries()
        .iter()
        .find(|e| e.key == "murray_exponent_by_order");
    let Some(Value::Orders(exponents)) = orders.map(|entry| &entry.value) else {
        panic!("the exponents of the orders are there");
    };
    assert!(exponents.len() >= 3, "{exponents:?}");
    for exponent in exponents.iter().flatten() {
        assert!((exponent - 2.5).abs() < 1e-9, "{exponents:?}");
    }
    let crossings = number(&measures, "crossing_count");
    near(&measures, "areole_count", veins.loops() as f64 + crossings);
    for entry in measures.entries() {
        assert_ne!(entry.value, Value::Number(None), "{} is missing", entry.key);
    }
    assert_eq!(measures, measure(&blade, &veins, 2.5));
}
