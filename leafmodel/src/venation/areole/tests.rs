//! Areoles, tested against closed forms, all pairs of edges and Euler's formula.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::venation::testing::{hexagons, network, poplar, squares};
use properties::fixed;

fn places(list: &[(f64, f64)]) -> Vec<DVec2> {
    list.iter().copied().map(DVec2::from).collect()
}

/// Whether a polygon contains a point, by crossings of the ray towards −x.
fn contains(polygon: &[DVec2], p: DVec2) -> bool {
    let crossed = |(i, &a): (usize, &DVec2)| {
        let b = polygon[(i + 1) % polygon.len()];
        (a.y > p.y) != (b.y > p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) <= p.x
    };
    polygon.iter().enumerate().filter(|&e| crossed(e)).count() % 2 == 1
}

fn near(value: f64, expected: f64) {
    assert!(
        (value - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{value} is not {expected}"
    );
}

#[test]
fn squares_have_their_area_and_circularity() {
    let found = areoles(&squares(7, 0.3));
    assert_eq!(found.len(), 49);
    for (i, areole) in found.iter().enumerate() {
        near(areole.area_mm2, 0.09);
        near(areole.perimeter_mm, 1.2);
        near(areole.circularity(), PI / 4.0);
        assert!((areole.elongation - 1.0).abs() < 1e-6);
        assert_eq!(found.polygon(i).count(), 4);
    }
    assert_eq!(found.free_endings().count(), 0);
}

#[test]
fn hexagons_have_their_area_and_circularity() {
    let found = areoles(&hexagons(6, 2.0));
    assert_eq!(found.len(), 36);
    for areole in found.iter() {
        near(areole.area_mm2, 6.0 * 3.0_f64.sqrt());
        near(areole.circularity(), PI * 3.0_f64.sqrt() / 6.0);
    }
}

#[test]
fn elongation_is_the_ratio_of_the_sides_of_a_rectangle() {
    let turned = |x: f64, y: f64| DVec2::new(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y);
    let corners = [
        turned(0.0, 0.0),
        turned(5.0, 0.0),
        turned(5.0, 2.0),
        turned(0.0, 2.0),
    ];
    let found = areoles(&network(&corners, &[[0, 1], [1, 2], [2, 3], [0, 3]]));
    let areole = found.iter().next().expect("one ring");
    near(areole.elongation, 2.5);
    near(areole.area_mm2, 10.0);
    assert!((areole.centroid - turned(2.5, 1.0)).length() < 1e-12);
}

#[test]
fn what_hangs_inside_an_areole_changes_neither_its_perimeter_nor_its_outline() {
    // A square with a branched tree inside, a ring on a stalk, and a tree outside.
    let nodes = places(&[
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 4.0),
        (0.0, 4.0),
        (1.0, 1.0),
        (1.0, 2.0),
        (1.5, 1.0),
        (3.0, 3.0),
        (2.5, 3.0),
        (2.5, 2.0),
        (3.0, 2.0),
        (5.0, -1.0),
    ]);
    let edges = [
        [0, 1],
        [1, 2],
        [2, 3],
        [0, 3],
        [0, 4],
        [4, 5],
        [4, 6],
        [2, 7],
        [7, 8],
        [8, 9],
        [9, 10],
        [7, 10],
        [1, 11],
    ];
    let found = areoles(&network(&nodes, &edges));
    let mut sizes: Vec<_> = found
        .iter()
        .map(|a| (a.area_mm2, a.outline_area_mm2, a.perimeter_mm))
        .collect();
    sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(sizes, [(0.5, 0.5, 3.0), (15.5, 16.0, 16.0)]);
    let inside: Vec<bool> = found.free_endings().map(|f| f.areole.is_some()).collect();
    assert_eq!(inside.iter().filter(|&&inside| inside).count(), 2);
    assert_eq!(inside.len(), 3);
    let lengths: f64 = found.free_endings().map(|f| f.length_mm).sum();
    near(lengths, 1.0 + 0.5 + 2.0_f64.sqrt());
}

#[test]
fn an_island_is_taken_off_the_areole_around_it_and_so_is_the_island_in_its_areole() {
    let square =
        |low: f64, high: f64| places(&[(low, low), (high, low), (high, high), (low, high)]);
    let mut nodes = Vec::new();
    let mut edges = Vec::new();
    // Three rings in each other, a tree between the outer two, a ring beside.
    for (low, high) in [(3.0, 4.0), (0.0, 10.0), (2.0, 8.0), (11.0, 12.0)] {
        let first = nodes.len() as u32;
        nodes.extend(square(low, high));
        edges.extend([[0, 1], [1, 2], [2, 3], [0, 3]].map(|e| e.map(|n| n + first)));
    }
    let first = nodes.len() as u32;
    nodes.extend(places(&[(9.0, 1.0), (9.0, 2.0), (8.5, 3.0), (9.5, 3.0)]));
    edges.extend([[0, 1], [1, 2], [1, 3]].map(|e| e.map(|n| n + first)));
    let found = areoles(&network(&nodes, &edges));
    let mut sizes: Vec<_> = found
        .iter()
        .map(|a| (a.area_mm2, a.outline_area_mm2))
        .collect();
    sizes.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)));
    assert_eq!(sizes, [(1.0, 1.0), (1.0, 1.0), (35.0, 36.0), (64.0, 100.0)]);
    let around = found.iter().position(|a| a.outline_area_mm2 == 100.0);
    assert_eq!(
        found.free_endings().map(|f| f.areole).collect::<Vec<_>>(),
        [around, around]
    );
}

#[test]
fn veins_on_top_of_each_other_and_three_through_a_point_are_cut_right() {
    // A star of three lines through one point, inside a hexagon that goes through their ends.
    let corners: Vec<DVec2> = (0..6)
        .map(|i| PI / 3.0 * f64::from(i))
        .map(|angle| DVec2::new(libm::cos(angle), libm::sin(angle)))
        .collect();
    let mut edges = vec![[0, 3], [1, 4], [2, 5]];
    edges.extend((0..5).map(|i| [i, i + 1]));
    edges.push([0, 5]);
    assert_eq!(areoles(&network(&corners, &edges)).len(), 6);
    // Two squares with overlapping sides of different length; a corner of one lies on a side of the
    // other.
    let nodes = places(&[
        (0.0, 0.0),
        (2.0, 0.0),
        (2.0, 2.0),
        (0.0, 2.0),
        (2.0, 0.5),
        (3.0, 0.5),
        (3.0, 1.5),
        (2.0, 1.5),
    ]);
    let edges = [
        [0, 1],
        [1, 2],
        [2, 3],
        [0, 3],
        [4, 5],
        [5, 6],
        [6, 7],
        [4, 7],
    ];
    let found = areoles(&network(&nodes, &edges));
    let sizes: Vec<_> = found.iter().map(|a| (a.area_mm2, a.perimeter_mm)).collect();
    assert_eq!(sizes, [(4.0, 8.0), (1.0, 4.0)]);
    // Two nodes at one place.
    let nodes = places(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.0), (1.0, 1.0)]);
    let found = areoles(&network(&nodes, &[[0, 1], [1, 2], [3, 4]]));
    assert_eq!(found.iter().map(|a| a.area_mm2).collect::<Vec<_>>(), [0.5]);
}

#[test]
fn no_vein_and_a_straight_vein_enclose_nothing() {
    assert!(areoles(&network(&[], &[])).is_empty());
    assert!(areoles(&network(&places(&[(1.0, 1.0)]), &[])).is_empty());
    let line = network(
        &places(&[(0.0, 0.0), (0.0, 1.0), (0.0, 2.0)]),
        &[[0, 1], [1, 2]],
    );
    assert!(areoles(&line).is_empty());
    assert_eq!(areoles(&line).free_endings().count(), 0);
}

/// Edges − nodes + components once every crossing is a node, by comparing all pairs of edges.
fn loops_by_all_pairs(network: &VenationNetwork) -> usize {
    let place = |n: u32| network.nodes()[n as usize].position;
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let edges = network.edges();
    let mut leaders: Vec<usize> = (0..network.nodes().len()).collect();
    let find = |leaders: &[usize], mut n: usize| {
        while leaders[n] != n {
            n = leaders[n];
        }
        n
    };
    let mut join = |p: u32, q: u32| {
        let (p, q) = (find(&leaders, p as usize), find(&leaders, q as usize));
        leaders[p.max(q)] = p.min(q);
        usize::from(p != q)
    };
    let mut joined = 0;
    let mut crossings = 0;
    for (i, e) in edges.iter().enumerate() {
        joined += join(e.from, e.to);
        let (a, b) = (place(e.from), place(e.to));
        for f in &edges[..i] {
            let (c, d) = (place(f.from), place(f.to));
            if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
                crossings += 1;
                joined += join(e.from, f.from);
            }
        }
    }
    // A crossing adds one node and two edges; every union reduces the number of components by one.
    edges.len() + crossings - joined
}

fn check_partition(found: &Areoles, low: DVec2, high: DVec2) {
    let polygons: Vec<Vec<DVec2>> = (0..found.len())
        .map(|i| found.polygon(i).collect())
        .collect();
    let n = 60;
    let mut count = 0;
    for i in 0..n * n {
        let share = DVec2::new(f64::from(i % n) + 0.5, f64::from(i / n) + 0.5) / f64::from(n);
        let p = low + (high - low) * share;
        let of: Vec<usize> = (0..polygons.len())
            .filter(|&k| contains(&polygons[k], p))
            .collect();
        // A point may lie in the areole around its own, if that one is a ring or a net inside.
        count += usize::from(!of.is_empty());
    }
    let sampled = count as f64 / f64::from(n * n) * (high - low).element_product();
    let total: f64 = found.iter().map(|a| a.area_mm2).sum();
    let perimeter: f64 = found.iter().map(|a| a.perimeter_mm).sum();
    // A cell of the sample is misjudged only if a vein passes through it.
    let cell = (high - low).length() / f64::from(n);
    assert!(
        (sampled - total).abs() <= perimeter * cell,
        "{sampled} is not {total}"
    );
}

proptest! {
    #![proptest_config(fixed(200))]

    #[test]
    fn random_scribbles_have_as_many_areoles_as_all_pairs_and_euler_say(
        at in prop::collection::vec((0.0..10.0_f64, 0.0..10.0_f64), 2..40),
        chords in prop::collection::vec((0_u32..40, 0_u32..40), 0..30),
    ) {
        let nodes = places(&at);
        let count = nodes.len() as u32;
        let mut edges: Vec<[u32; 2]> = chords
            .iter()
            .map(|&(a, b)| [(a % count).min(b % count), (a % count).max(b % count)])
            .filter(|e| e[0] != e[1])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        let network = network(&nodes, &edges);
        let found = areoles(&network);
        prop_assert_eq!(found.len(), loops_by_all_pairs(&network));
        for (i, areole) in found.iter().enumerate() {
            prop_assert!(areole.area_mm2 > 0.0 && areole.elongation >= 1.0);
            prop_assert!(areole.circularity() > 0.0 && areole.circularity() <= 1.0);
            let polygon: Vec<DVec2> = found.polygon(i).collect();
            let length: f64 = (0..polygon.len()).map(|k| (polygon[(k + 1) % polygon.len()] - polygon[k]).length()).sum();
            prop_assert!((length - areole.perimeter_mm).abs() < 1e-9);
        }
        check_partition(&found, DVec2::ZERO, DVec2::splat(10.0));
    }
}

#[test]
fn grown_veins_have_as_many_areoles_as_all_pairs_and_euler_say() {
    for seed in 1..4 {
        let (_, network) = poplar(seed);
        let found = areoles(&network);
        assert!(found.len() > 50, "only {} areoles", found.len());
        assert_eq!(found.len(), loops_by_all_pairs(&network));
        assert_eq!(found.len(), network.loops() + found.graph().crossings());
    }
}
