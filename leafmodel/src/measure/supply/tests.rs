//! Conductances and losses that are known in closed form, or from another way of computing them.

use std::f64::consts::PI;

use super::*;
use crate::measure::{Blade, Known};
use crate::venation::network::VenationNetwork;
use crate::venation::testing::{poplar, wide};

fn supply(network: &VenationNetwork) -> Supply {
    let subject = Subject::new(Blade::Unknown, network, Known::ALL);
    subject.supply(1000).expect("radii and an origin")
}

/// Conductance of a pipe of radius 0.1 mm and this length, mm³ s⁻¹ MPa⁻¹.
fn pipe(length: f64) -> f64 {
    PI * 1e-4 / (8.0 * VISCOSITY_MPA_S * length)
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-9 * b.abs().max(1e-3), "{a} is not {b}");
}

#[test]
fn water_that_leaves_along_a_pipe_sees_a_third_of_its_resistance() {
    for pieces in [1_u32, 2, 10, 100] {
        let step = 8.0 / f64::from(pieces);
        let places: Vec<DVec2> = (0..=pieces)
            .map(|i| DVec2::new(0.0, step * f64::from(i)))
            .collect();
        let edges: Vec<(u32, u32, f64, u8)> = (0..pieces).map(|i| (i, i + 1, 0.1, 1)).collect();
        let found = supply(&wide(&places, &edges));
        // ∫ (x − x²/2) dx = 1/3 by the trapezoid rule, which is exact up to h²/12.
        let mean = 1.0 / 3.0 - 1.0 / (12.0 * f64::from(pieces).powi(2));
        near(found.conductance, pipe(8.0) / mean);
        near(found.bridges, 1.0);
        near(found.supplied, 1.0);
    }
}

#[test]
fn a_cone_conducts_what_the_integral_over_its_radius_says() {
    let veins = wide(&[DVec2::ZERO, DVec2::new(0.0, 3.0)], &[(0, 1, 0.1, 1)]);
    let mut edges = veins.edges().to_vec();
    edges[0].radius_from = 0.2;
    let veins = VenationNetwork::from_parts(veins.nodes().to_vec(), edges, 1.0).expect("valid");
    // R = 8 μ/π ∫ dx / r⁴ by the midpoint rule; half leaves at the end, half at the petiole.
    let steps = 100_000;
    let integral: f64 = (0..steps)
        .map(|i| {
            let r = 0.2 - 0.1 * (f64::from(i) + 0.5) / f64::from(steps);
            3.0 / f64::from(steps) / (r * r * r * r)
        })
        .sum();
    let expected = PI / (8.0 * VISCOSITY_MPA_S * integral) * 4.0;
    let found = supply(&veins).conductance;
    assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
}

#[test]
fn pipes_in_series_and_side_by_side_add_up_as_resistors_do() {
    // A stalk of length 1, then two equal ways of length 1 each to a common end.
    let places = [(0.0, 0.0), (0.0, 1.0), (0.6, 1.8), (-0.6, 1.8), (0.0, 2.6)].map(DVec2::from);
    let veins = wide(
        &places,
        &[
            (0, 1, 0.1, 1),
            (1, 2, 0.1, 2),
            (1, 3, 0.1, 2),
            (2, 4, 0.1, 2),
            (3, 4, 0.1, 2),
        ],
    );
    let found = supply(&veins);
    // In units of one pipe's resistance: nodes lose 1.5, 1, 1 and 1 of 5; drops are 4.5 behind the
    // stalk, 1.5 more behind the first pipes, and 0.5 more at the end.
    let power = 1.5 * 4.5 + 2.0 * (4.5 + 1.5) + (4.5 + 1.5 + 0.5);
    near(found.conductance, 25.0 / power * pipe(1.0));
    near(found.bridges, 0.2);
    // The stalk's cut takes all that lies beyond, but for half of its own length.
    let stalk = found
        .cuts
        .iter()
        .find(|cut| cut.order == 1)
        .expect("it is a vein");
    near(stalk.cut_off, 0.9);
    // A cut in one way: all goes along the other. Chains run from the fork through the end.
    let ring = found
        .cuts
        .iter()
        .find(|cut| cut.order == 2)
        .expect("it is a vein");
    assert_eq!(ring.cut_off, 0.0);
    // Which of the two pipes of a way is cut depends on where its chain starts.
    let cut_at_end = 1.5 * 4.5 + (4.5 + 1.0) + (4.5 + 2.0) + (4.5 + 2.0 + 1.0);
    let cut_at_fork = 1.5 * 4.5 + (4.5 + 3.0) + (4.5 + 3.0 + 2.0) + (4.5 + 3.0 + 2.0 + 1.0);
    let losses = [cut_at_end, cut_at_fork].map(|after| 1.0 - power / after);
    assert!(
        losses.iter().any(|loss| (ring.lost - loss).abs() < 1e-12),
        "{ring:?} {losses:?}"
    );
    // Without order 2 the stalk alone is left; half of its length leaves behind it in both.
    let second = found.orders[1];
    assert_eq!((second.order, second.cut_off), (2, 0.0));
    near(second.lost.expect("the stalk is supplied") + 1.0, 1.0);
    assert_eq!(
        found.orders[0],
        OrderLoss {
            order: 1,
            cut_off: 1.0,
            lost: None
        }
    );
}

#[test]
fn a_cut_beside_a_way_around_that_is_far_finer_is_finite_and_right() {
    // Behind a stalk a thick pipe of length 8, beside it two thin ones of length 5, and a twig. Thin
    // ones have 10²⁰ times the resistance a length: `1 − g R` is 0 in floating point.
    let places = [(0.0, -1.0), (0.0, 0.0), (3.0, 4.0), (0.0, 8.0), (0.0, 9.0)].map(DVec2::from);
    let edges = [
        (0, 1, 1.0, 1),
        (1, 3, 1.0, 2),
        (1, 2, 1e-5, 3),
        (2, 3, 1e-5, 3),
        (3, 4, 1.0, 4),
    ];
    let found = supply(&wide(&places, &edges));
    // The middle of the thin way loses 5, the end of the thick pipe 7 and the twig 0.5. In units of
    // a thin pipe's resistance the power is 5² / 2 before, and 12.5² + 7.5² after the cut.
    let thick = found.cuts.iter().find(|cut| cut.order == 2);
    let thick = thick.expect("it is a vein");
    assert_eq!(thick.cut_off, 0.0);
    near(thick.lost, 1.0 - 12.5 / (12.5 * 12.5 + 7.5 * 7.5));
    assert!(found.cuts.iter().all(|cut| cut.lost.is_finite()));
}

#[test]
fn each_cut_of_a_grown_leaf_loses_what_a_solution_without_the_edge_says() {
    let (_, veins) = poplar(2);
    let subject = Subject::new(Blade::Unknown, &veins, Known::ALL);
    let found = subject.supply(40).expect("radii and an origin");
    let graph = subject.areoles().graph();
    let roots = subject.roots();
    let whole = Pipes::new(graph, &roots, |_| true).expect("veins");
    let power = dot(
        &whole.outflow,
        &Factored::new(&whole.places, &whole.pipes)
            .expect("sound")
            .solve(&whole.outflow),
    );
    assert_eq!(found.cuts.len(), 40);
    let mut compared = 0;
    for cut in &found.cuts {
        let mut left = Pipes::new(graph, &roots, |_| true).expect("veins");
        let is_cut = |edge: u32| {
            let edge = &graph.edges()[edge as usize];
            graph.nodes()[edge.to as usize] == cut.place && edge.order == cut.order
        };
        let pipes: Vec<usize> = (0..left.pipes.len())
            .filter(|&i| is_cut(left.edges[i]))
            .collect();
        let &[pipe] = pipes.as_slice() else { continue };
        left.pipes.remove(pipe);
        if cut.cut_off > 0.0 {
            continue;
        }
        let after = dot(
            &left.outflow,
            &Factored::new(&left.places, &left.pipes)
                .expect("sound")
                .solve(&left.outflow),
        );
        assert!((cut.lost - (1.0 - power / after)).abs() < 1e-7, "{cut:?}");
        compared += 1;
    }
    assert!(compared > 10, "only {compared} cuts were compared");
    assert!((0.0..=1.0).contains(&found.bridges));
    assert!(
        found
            .orders
            .iter()
            .all(|loss| (0.0..=1.0).contains(&loss.cut_off))
    );
    assert!(
        found
            .orders
            .iter()
            .filter_map(|loss| loss.lost)
            .all(|lost| (-1e-9..1.0).contains(&lost))
    );
}
