//! Cutting at crossings, tested against all pairs of edges.

use std::collections::BTreeSet;

use proptest::prelude::*;

use super::*;
use crate::venation::areole::areoles;
use crate::venation::testing::network;
use properties::fixed;

/// Whether two segments share a point, up to a slack, that is not an end of both.
fn meet(graph: &PlaneGraph, e: &VeinEdge, f: &VeinEdge) -> bool {
    let place = |n: u32| graph.nodes()[n as usize];
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).normalize().perp_dot(r - p);
    let on = |n: u32, e: &VeinEdge| {
        let (a, b) = (place(e.from), place(e.to));
        let t = (place(n) - a).dot(b - a) / (b - a).length_squared();
        n != e.from && n != e.to && t > 0.0 && t < 1.0 && side(a, b, place(n)).abs() < 1e-10
    };
    let touching = on(e.from, f) || on(e.to, f) || on(f.from, e) || on(f.to, e);
    let [a, b, c, d] = [e.from, e.to, f.from, f.to].map(place);
    let apart = |p: f64, q: f64| p * q < 0.0 && p.abs() > 1e-10 && q.abs() > 1e-10;
    touching || apart(side(a, b, c), side(a, b, d)) && apart(side(c, d, a), side(c, d, b))
}

fn check(graph: &PlaneGraph) {
    let edges = graph.edges();
    for (i, e) in edges.iter().enumerate() {
        assert!(e.from != e.to && e.radius_from > 0.0 && e.radius_to > 0.0);
        for f in &edges[..i] {
            assert!(!meet(graph, e, f), "{e:?} and {f:?} meet");
        }
    }
    let mut pairs: Vec<_> = edges
        .iter()
        .map(|e| (e.from.min(e.to), e.from.max(e.to)))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    assert_eq!(pairs.len(), edges.len(), "an edge is there twice");
}

/// Edges − nodes with edges + components.
fn loops(graph: &PlaneGraph) -> usize {
    let mut leaders: Vec<usize> = (0..graph.nodes().len()).collect();
    let mut used = BTreeSet::new();
    let mut joined = 0;
    for e in graph.edges() {
        let [mut a, mut b] = [e.from as usize, e.to as usize];
        used.extend([a, b]);
        while leaders[a] != a {
            a = leaders[a];
        }
        while leaders[b] != b {
            b = leaders[b];
        }
        joined += usize::from(a != b);
        leaders[a.max(b)] = a.min(b);
    }
    graph.edges().len() - joined
}

fn scribble(places: &[DVec2], chords: &[(u32, u32)]) -> VenationNetwork {
    let count = places.len() as u32;
    let edges: BTreeSet<[u32; 2]> = chords
        .iter()
        .map(|&(a, b)| [(a % count).min(b % count), (a % count).max(b % count)])
        .filter(|e| places[e[0] as usize] != places[e[1] as usize])
        .collect();
    network(places, &edges.into_iter().collect::<Vec<_>>())
}

proptest! {
    #![proptest_config(fixed(300))]

    #[test]
    fn no_two_edges_meet_but_at_nodes_and_no_length_is_lost(
        at in prop::collection::vec((0.0..10.0_f64, 0.0..10.0_f64), 2..40),
        chords in prop::collection::vec((0_u32..40, 0_u32..40), 0..30),
    ) {
        let places: Vec<DVec2> = at.into_iter().map(DVec2::from).collect();
        let network = scribble(&places, &chords);
        let graph = PlaneGraph::new(&network);
        check(&graph);
        let length: f64 = graph.edges().iter()
            .map(|e| (graph.nodes()[e.to as usize] - graph.nodes()[e.from as usize]).length())
            .sum();
        prop_assert!((length - network.vein_length_mm()).abs() < 1e-9);
        prop_assert_eq!(areoles(&network).len(), loops(&graph));
    }

    #[test]
    fn edges_on_top_of_each_other_through_one_point_and_at_equal_nodes_are_cut_too(
        at in prop::collection::vec((0_i32..6, 0_i32..6), 2..25),
        chords in prop::collection::vec((0_u32..25, 0_u32..25), 0..25),
    ) {
        let places: Vec<DVec2> = at.into_iter().map(|(x, y)| DVec2::new(x.into(), y.into())).collect();
        let network = scribble(&places, &chords);
        let graph = PlaneGraph::new(&network);
        check(&graph);
        let found = areoles(&network);
        prop_assert_eq!(found.len(), loops(&graph));
        // All lie in the square of the points, and do not overlap.
        let total: f64 = found.iter().map(|a| a.area_mm2).sum();
        prop_assert!(total <= 25.0 + 1e-9);
        for (number, areole) in found.iter().enumerate() {
            let corners: Vec<DVec2> = found.polygon(number).collect();
            let doubled: f64 = (0..corners.len())
                .map(|i| corners[i].perp_dot(corners[(i + 1) % corners.len()]))
                .sum();
            prop_assert!((0.5 * doubled - areole.outline_area_mm2).abs() < 1e-9);
            prop_assert!(areole.area_mm2 <= areole.outline_area_mm2);
        }
    }
}
