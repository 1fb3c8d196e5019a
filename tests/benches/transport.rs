//! How long transport leaves take to grow: `cargo bench -p lamina-benches --bench transport`.
//!
//! One thread. Examples 1 and 2 of Xia 2007, a leaf of about ten thousand cells, and the first as
//! an outline and veins; and the maple's blade filled with the cheapest veins.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use leafmodel::species;
use leafmodel::transport::{FilledPlan, TransportPlan, VeinStyle, example};

fn rows(criterion: &mut Criterion) {
    let plans = [
        ("example 1", example(1).expect("there is one")),
        ("example 2", example(2).expect("there is one")),
        ("10000 cells", large()),
    ];
    let mut group = criterion.benchmark_group("transport");
    group.measurement_time(Duration::from_secs(5));
    group.sample_size(10);
    for (name, plan) in &plans {
        group.bench_function(*name, |bencher| bencher.iter(|| black_box(plan).grow(1)));
        let both_sides = TransportPlan {
            mirrored: false,
            ..plan.clone()
        };
        group.bench_function(format!("{name}, not mirrored"), |bencher| {
            bencher.iter(|| black_box(&both_sides).grow(1));
        });
    }
    let leaf = plans[0].1.grow(1).expect("a good plan");
    let style = VeinStyle {
        base_radius_mm: 0.5,
        least_cells: 3,
    };
    let maple = species::find("maple").expect("a preset").plan();
    let maple = maple.grow_outline().expect("a good outline");
    for cells_along in [40, 111] {
        let plan = FilledPlan {
            cells_along,
            ..FilledPlan::default()
        };
        let blade = plan.fill(&maple).expect("a good plan");
        let name = format!("maple filled with {} cells", blade.leaf().cells().len());
        group.bench_function(name, |bencher| {
            bencher.iter(|| plan.fill(black_box(&maple)));
        });
    }
    group.bench_function("example 1 as outline and veins", |bencher| {
        bencher.iter(|| (leaf.outline(80.0), leaf.network(80.0, style)));
    });
}

/// Somewhat more than ten thousand cells.
fn large() -> TransportPlan {
    TransportPlan {
        alpha: 0.66,
        epsilon: 10.5,
        ..TransportPlan::default()
    }
}

criterion_group!(transport, rows);
criterion_main!(transport);
