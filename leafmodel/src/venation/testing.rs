//! Networks whose measures are known in closed form.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::network::{VeinEdge, VeinNode, VenationNetwork};
use super::plan::{AuxinPlan, Growth, Neighbourhood, Pattern};
use crate::shape::outline::Outline;

/// A network of veins of radius 0.01 mm and order 1, resolved at 0.1 mm.
pub(crate) fn network(places: &[DVec2], edges: &[[u32; 2]]) -> VenationNetwork {
    let edges: Vec<(u32, u32, f64, u8)> = edges.iter().map(|e| (e[0], e[1], 0.01, 1)).collect();
    wide(places, &edges)
}

/// A network of veins given by from, to, radius and order.
pub(crate) fn wide(places: &[DVec2], edges: &[(u32, u32, f64, u8)]) -> VenationNetwork {
    let nodes = places
        .iter()
        .map(|&position| VeinNode { position, born: 0 });
    let edges = edges.iter().map(|&(from, to, radius, order)| VeinEdge {
        from,
        to,
        radius_from: radius,
        radius_to: radius,
        order,
    });
    VenationNetwork::from_parts(nodes.collect(), edges.collect(), 0.1).expect("a valid network")
}

/// An upright rectangle as a margin, its midrib in the middle.
pub(crate) fn rectangle(low: (f64, f64), high: (f64, f64)) -> Outline {
    let middle = 0.5 * (low.0 + high.0);
    Outline::new(
        vec![
            low.into(),
            (high.0, low.1).into(),
            high.into(),
            (low.0, high.1).into(),
        ],
        (middle, low.1).into(),
        (middle, high.1).into(),
    )
    .expect("a rectangle is a margin")
}

/// A poplar leaf with a closed pattern of some thousands of nodes, 40 mm long, and its margin.
pub(crate) fn poplar(seed: u64) -> (Outline, VenationNetwork) {
    let outline = Outline::new(
        (0..96)
            .map(|i| {
                let angle = std::f64::consts::TAU * f64::from(i) / 96.0;
                DVec2::new(14.0 * libm::cos(angle), 20.0 * (1.0 + libm::sin(angle)))
            })
            .collect(),
        DVec2::ZERO,
        DVec2::new(0.0, 40.0),
    )
    .expect("an ellipse is a margin");
    let plan = AuxinPlan {
        pattern: Pattern::Closed(Neighbourhood::Relative),
        final_length: 200.0,
        kill_distance: 1.0,
        source_birth_distance: 3.0,
        vein_birth_distance: 3.0,
        darts_per_area: 0.01,
        growth: Growth::Isogonic {
            initial_length: 30.0,
            length_step: 2.0,
        },
        murray_exponent: 2.5,
        veinlet_radius_mm: 0.015,
        ..AuxinPlan::default()
    };
    let network = super::grow(&outline, &plan, seed).expect("a plan that can be carried out");
    (outline, network)
}

/// `n × n` squares of side `side`, lower left corner at the origin.
pub(crate) fn squares(n: u32, side: f64) -> VenationNetwork {
    let mut places = Vec::new();
    let mut edges = Vec::new();
    for row in 0..=n {
        for column in 0..=n {
            let node = places.len() as u32;
            places.push(DVec2::new(f64::from(column), f64::from(row)) * side);
            if column > 0 {
                edges.push([node - 1, node]);
            }
            if row > 0 {
                edges.push([node - n - 1, node]);
            }
        }
    }
    network(&places, &edges)
}

/// `n × n` regular hexagons of side `side`, their rows along x.
pub(crate) fn hexagons(n: i32, side: f64) -> VenationNetwork {
    let mut numbers = BTreeMap::new();
    let mut places = Vec::new();
    let mut edges = BTreeSet::new();
    let half = 0.75_f64.sqrt();
    for row in 0..n {
        for column in 0..n {
            // Corners in units of (half a hexagon's width, half a side).
            let (x, y) = (2 * column + row, 3 * row);
            let corners = [(0, 2), (-1, 1), (-1, -1), (0, -2), (1, -1), (1, 1)].map(|(dx, dy)| {
                let key = (x + dx, y + dy);
                *numbers.entry(key).or_insert_with(|| {
                    let (x, y) = (f64::from(key.0) * half, f64::from(key.1) * 0.5);
                    places.push(DVec2::new(x, y) * side);
                    places.len() as u32 - 1
                })
            });
            for i in 0..6 {
                let (a, b) = (corners[i], corners[(i + 1) % 6]);
                edges.insert([a.min(b), a.max(b)]);
            }
        }
    }
    let edges: Vec<[u32; 2]> = edges.into_iter().collect();
    network(&places, &edges)
}
