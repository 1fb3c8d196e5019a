//! How long it takes to measure a network of a million nodes, and to read it:
//! `cargo bench -p lamina-benches --bench measure`.
//!
//! A net of 57,600 hexagons whose sides are six pieces each and whose corners are moved, so that no
//! two areoles are alike; radii fall from the middle outwards.

use std::collections::{BTreeMap, BTreeSet};
use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec2;
use leafmodel::export;
use leafmodel::import::{Format, Wanted, read};
use leafmodel::measure::{Blade, Known, Subject, measure};
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::{VeinEdge, VeinNode, VenationNetwork};

/// Hexagons in a row, rows of them, and pieces to a side.
const HEXAGONS: i32 = 240;
const PIECES: u32 = 6;

/// A number in [0, 1) that looks random.
fn chance(number: u64) -> f64 {
    let mut bits = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((bits ^ (bits >> 32)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// The net, and a rectangle around it.
fn net() -> (Outline, VenationNetwork) {
    let mut numbers: BTreeMap<(i32, i32), u32> = BTreeMap::new();
    let mut corners: Vec<DVec2> = Vec::new();
    let mut sides: BTreeSet<(u32, u32)> = BTreeSet::new();
    for row in 0..HEXAGONS {
        for column in 0..HEXAGONS {
            // Corners in units of (half a hexagon's width, half a side).
            let (x, y) = (2 * column + row % 2, 3 * row);
            let six = [(0, 2), (-1, 1), (-1, -1), (0, -2), (1, -1), (1, 1)].map(|(dx, dy)| {
                *numbers.entry((x + dx, y + dy)).or_insert_with(|| {
                    let number = corners.len() as u64;
                    let moved = DVec2::new(chance(2 * number), chance(2 * number + 1)) - 0.5;
                    let place = DVec2::new(f64::from(x + dx) * 0.866, f64::from(y + dy) * 0.5);
                    corners.push((place + 0.4 * moved) * 0.2);
                    number as u32
                })
            });
            for i in 0..6 {
                let (a, b) = (six[i], six[(i + 1) % 6]);
                sides.insert((a.min(b), a.max(b)));
            }
        }
    }
    let (low, high) = corners
        .iter()
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), &p| {
            (low.min(p), high.max(p))
        });
    let middle = 0.5 * (low.x + high.x);
    let node = |position| VeinNode { position, born: 0 };
    let mut nodes: Vec<VeinNode> = corners.iter().copied().map(node).collect();
    let mut edges = Vec::new();
    for &(a, b) in &sides {
        let (from, to) = (corners[a as usize], corners[b as usize]);
        let away = (from.x - middle).abs() / (high.x - low.x);
        let radius = 0.03 - 0.05 * away;
        let mut last = a;
        for piece in 1..=PIECES {
            let next = if piece == PIECES {
                b
            } else {
                nodes.len() as u32
            };
            if piece < PIECES {
                nodes.push(node(from.lerp(to, f64::from(piece) / f64::from(PIECES))));
            }
            edges.push(VeinEdge {
                from: last,
                to: next,
                radius_from: radius,
                radius_to: radius,
                order: 1 + (10.0 * away) as u8,
            });
            last = next;
        }
    }
    let rim = DVec2::splat(0.5);
    let (low, high) = (low - rim, high + rim);
    let corners = vec![
        low,
        DVec2::new(high.x, low.y),
        high,
        DVec2::new(low.x, high.y),
    ];
    let outline = Outline::new(
        corners,
        DVec2::new(middle, low.y),
        DVec2::new(middle, high.y),
    );
    let network = VenationNetwork::from_parts(nodes, edges, 0.03);
    (
        outline.expect("a rectangle is a margin"),
        network.expect("a valid network"),
    )
}

fn a_million_nodes(criterion: &mut Criterion) {
    let (outline, network) = net();
    let mut group = criterion.benchmark_group(format!("{} nodes", network.nodes().len()));
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(10));
    group.bench_function("measures", |bencher| {
        bencher.iter(|| measure(&outline, black_box(&network), 3.0));
    });
    let subject = Subject::new(Blade::Margin(&outline), &network, Known::ALL);
    group.bench_function("structure factor", |bencher| {
        bencher.iter(|| subject.structure());
    });
    group.bench_function("conductance and 100 cuts", |bencher| {
        bencher.iter(|| subject.supply(black_box(100)));
    });
    group.bench_function("1000 draws of areoles", |bencher| {
        bencher.iter(|| subject.confidence(black_box(1000), 1));
    });
    for (name, format, text) in [
        (
            "reading GraphML",
            Format::GraphMl,
            export::graphml(&network),
        ),
        (
            "reading JSON",
            Format::Json,
            export::json(&[], &network, false),
        ),
        ("reading a table", Format::Table, export::table(&network)),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let draft = read(format, black_box(&text), None).expect("just written");
                draft.network(&Wanted::default()).expect("just written")
            });
        });
    }
}

criterion_group!(networks, a_million_nodes);
criterion_main!(networks);
