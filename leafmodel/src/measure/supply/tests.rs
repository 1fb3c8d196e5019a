//! Conductances and losses that are known in closed form, or from another way of computing them.

use std::f64::consts::PI;

use super::*;
use crate::measure::{Blade, Known};
use crate::venation::network::{VeinEdge, VenationNetwork};
use crate::venation::planar::PlaneGraph;
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
        // ∫ (x − x²/2) dx = 1/3, however finely the pipe is digitised.
        near(found.conductance, pipe(8.0) * 3.0);
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
    // ∫ f² dx / r⁴ by the midpoint rule, with the flow f that falls evenly from 3 to 0.
    let steps = 100_000;
    let integral: f64 = (0..steps)
        .map(|i| {
            let along = (f64::from(i) + 0.5) / f64::from(steps);
            let (r, f) = (0.2 - 0.1 * along, 3.0 * (1.0 - along));
            3.0 / f64::from(steps) * f * f / (r * r * r * r)
        })
        .sum();
    let expected = PI / (8.0 * VISCOSITY_MPA_S * integral) * 9.0;
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
    // Each of the five pipes adds a twelfth.
    let within = 5.0 / 12.0;
    let power = 1.5 * 4.5 + 2.0 * (4.5 + 1.5) + (4.5 + 1.5 + 0.5) + within;
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
    let losses = [cut_at_end, cut_at_fork].map(|after| 1.0 - power / (after + within));
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
    // a thin pipe's resistance the power is 5² / 2 before, and 12.5² + 7.5² after the cut; both thin
    // pipes add a twelfth of 5² each.
    let thick = found.cuts.iter().find(|cut| cut.order == 2);
    let thick = thick.expect("it is a vein");
    assert_eq!(thick.cut_off, 0.0);
    let within = 2.0 * 25.0 / 12.0;
    near(
        thick.lost,
        1.0 - (12.5 + within) / (12.5 * 12.5 + 7.5 * 7.5 + within),
    );
    assert!(found.cuts.iter().all(|cut| cut.lost.is_finite()));
}

#[test]
fn each_cut_of_a_grown_leaf_loses_what_a_solution_without_the_edge_says() {
    let (_, veins) = poplar(2);
    let subject = Subject::new(Blade::Unknown, &veins, Known::ALL);
    let found = subject.supply(40).expect("radii and an origin");
    let graph = subject.areoles().graph();
    let roots = subject.roots();
    let whole = Direct::new(graph, &roots, |_| true);
    let power = whole.power();
    near(
        found.conductance,
        PI / (8.0 * VISCOSITY_MPA_S) * whole.total * whole.total / power,
    );
    assert_eq!(found.cuts.len(), 40);
    let mut compared = 0;
    for cut in &found.cuts {
        let is_cut = |edge: &VeinEdge| {
            graph.nodes()[edge.to as usize] == cut.place && edge.order == cut.order
        };
        if cut.cut_off > 0.0 || graph.edges().iter().filter(|edge| is_cut(edge)).count() != 1 {
            continue;
        }
        let mut left = Direct::new(graph, &roots, |edge| !is_cut(edge));
        // What leaves stays the same.
        left.outflow.clone_from(&whole.outflow);
        left.within = whole.within;
        let after = left.power();
        let lost = 1.0 - power / after;
        assert!((cut.lost - lost).abs() < 1e-7, "{cut:?} {lost}");
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

/// A network without anything condensed: each edge a pipe, each node an unknown.
struct Direct {
    places: Vec<DVec2>,
    pipes: Vec<Pipe>,
    outflow: Vec<f64>,
    within: f64,
    total: f64,
}

impl Direct {
    /// Of the wanted edges, which must all hang together with a root.
    fn new(graph: &PlaneGraph, roots: &[bool], is_wanted: impl Fn(&VeinEdge) -> bool) -> Self {
        let mut direct = Self {
            places: Vec::new(),
            pipes: Vec::new(),
            outflow: Vec::new(),
            within: 0.0,
            total: 0.0,
        };
        let wanted = || graph.edges().iter().filter(|edge| is_wanted(edge));
        let mut number = vec![Pipe::GROUND; roots.len()];
        for node in wanted().flat_map(|edge| [edge.from, edge.to]) {
            number[node as usize] = 0;
        }
        // In the order of nodes, so that it is the same with an edge less.
        for (node, number) in number.iter_mut().enumerate() {
            if roots[node] {
                *number = Pipe::GROUND;
            }
            if *number != Pipe::GROUND {
                *number = direct.places.len() as u32;
                direct.places.push(graph.nodes()[node]);
                direct.outflow.push(0.0);
            }
        }
        for edge in wanted() {
            let [from, to] = [edge.from, edge.to].map(|node| graph.nodes()[node as usize]);
            let (l, r, s) = (from.distance(to), edge.radius_from, edge.radius_to);
            let ends = [edge.from, edge.to].map(|node| number[node as usize]);
            let squares = r * r + r * s + s * s;
            let start = l * r * (2.0 * r + s) / (2.0 * squares);
            for (end, leaving) in ends.into_iter().zip([start, l - start]) {
                if end != Pipe::GROUND {
                    direct.outflow[end as usize] += leaving;
                }
            }
            direct.within += l.powi(3) / (4.0 * r * s * squares);
            direct.total += l;
            if ends != [Pipe::GROUND; 2] {
                let conductance = 3.0 * (r * s).powi(3) / (l * (r * r + r * s + s * s));
                direct.pipes.push(Pipe { ends, conductance });
            }
        }
        direct
    }

    fn power(&self) -> f64 {
        let factored = Factored::new(&self.places, &self.pipes).expect("sound");
        let drops = factored.solve(&self.outflow);
        let lumped: f64 = self.outflow.iter().zip(drops).map(|(q, p)| q * p).sum();
        lumped + self.within
    }
}

#[test]
fn what_is_condensed_loses_nothing_whatever_meets_where() {
    // A ring on a stalk with a twig, a ring at a ring, two petioles with a way between them, and
    // orders that change along a vein.
    let places = [
        (0.0, 0.0),
        (0.0, 1.0),
        (0.4, 1.5),
        (0.5, 2.2),
        (0.0, 2.5),
        (-0.6, 1.7),
        (-1.0, 1.8),
        (-1.6, 2.1),
        (0.9, 2.4),
        (1.3, 2.0),
        (1.0, 1.6),
        (3.0, 0.0),
        (2.0, -0.5),
        (1.0, -0.4),
    ]
    .map(DVec2::from);
    let edges = [
        (0, 1, 0.2, 1),
        (1, 2, 0.1, 2),
        (2, 3, 0.08, 2),
        (3, 4, 0.07, 3),
        (1, 5, 0.11, 2),
        (5, 4, 0.05, 2),
        (5, 6, 0.04, 3),
        (6, 7, 0.03, 4),
        (3, 8, 0.06, 3),
        (8, 9, 0.05, 3),
        (9, 10, 0.04, 4),
        (2, 10, 0.03, 3),
        (0, 13, 0.02, 4),
        (13, 12, 0.02, 4),
        (12, 11, 0.03, 3),
    ];
    let veins = wide(&places, &edges);
    for two_petioles in [false, true] {
        let subject = Subject::new(Blade::Unknown, &veins, Known::ALL);
        let graph = subject.areoles().graph();
        let mut roots = subject.roots();
        if two_petioles {
            let second = graph.nodes().iter().position(|p| *p == places[11]);
            roots[second.expect("a node")] = true;
        }
        let chains = subject.areoles().chains();
        let direct = Direct::new(graph, &roots, |_| true);
        for cuts in [0, 100] {
            let stretches = Stretches::new(graph, chains, &roots, |chain| chain < cuts);
            let system = stretches.system(|_| true).expect("veins");
            let factored = system.factored().expect("sound");
            let drops = factored.solve(&system.outflow);
            near(system.total, direct.total);
            near(system.power(&drops), direct.power());
            near(system.power_of(&system, &factored), direct.power());
            for order in 2..=4 {
                let left = stretches.system(|stretch| stretch.order != order);
                let left = left.expect("the stalk");
                let drops = left.factored().expect("sound").solve(&left.outflow);
                if order == 4 {
                    // What hangs together with the petiole without it.
                    let is_wanted = |edge: &VeinEdge| {
                        let is_twig = graph.nodes()[edge.from as usize] == places[12]
                            || graph.nodes()[edge.to as usize] == places[12];
                        edge.order != 4 && (two_petioles || !is_twig)
                    };
                    let direct = Direct::new(graph, &roots, is_wanted);
                    near(left.total, direct.total);
                    near(left.power(&drops), direct.power());
                }
            }
        }
    }
}
