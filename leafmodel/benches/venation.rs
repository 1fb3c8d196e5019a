//! How long veins take to grow: `cargo bench -p leafmodel`.
//!
//! One thread. The rows are those of Table 1 of Runions et al. 2005 at 10 units of the table to a
//! segment, the poplar ten times finer, and the broad leaf of the first scene.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use leafmodel::shape::growth_shape::{GrowthShape, VeinRow};
use leafmodel::shape::outline::Outline;
use leafmodel::venation::grow;
use leafmodel::venation::plan::{Growth, Neighbourhood, Pattern, VenationPlan};

/// A broad ovate leaf, 80 mm long.
fn outline() -> Outline {
    let vein = |position, slope| VeinRow { position, slope };
    let shape = GrowthShape {
        rows: 200,
        axial_rate: 0.1,
        rate_ratio: 1.22,
        widest_at: 0.32,
        falloff: 3.0,
        lobe_decay: 0.0,
        lobe_exponent: 1.0,
        veins: vec![vein(0.1, -0.35), vein(0.9, 0.45)],
    };
    shape.grow(80.0).expect("these rates bring forth a margin")
}

/// An isogonic closed plan; all lengths in segments.
fn plan(lengths: [f64; 3], birth_distance: f64, darts_per_area: f64) -> VenationPlan {
    let [initial_length, length_step, final_length] = lengths;
    VenationPlan {
        pattern: Pattern::Closed(Neighbourhood::Relative),
        final_length,
        kill_distance: 1.0,
        source_birth_distance: birth_distance,
        vein_birth_distance: birth_distance,
        darts_per_area,
        growth: Growth::Isogonic {
            initial_length,
            length_step,
        },
        murray_exponent: 2.0,
        veinlet_radius_mm: 0.015,
        ..VenationPlan::default()
    }
}

fn open(plan: &VenationPlan) -> VenationPlan {
    VenationPlan {
        pattern: Pattern::Open,
        ..plan.clone()
    }
}

fn rows(criterion: &mut Criterion) {
    let outline = outline();
    let poplar = plan([11.5, 0.9, 350.0], 2.0, 200e-6);
    let broad = plan([60.0, 2.5, 600.0], 3.5, 0.01);
    let fine = plan([115.0, 0.9, 3500.0], 2.0, 2e-5);
    let mut group = criterion.benchmark_group("venation");
    let mut run = |name: &str, plan: &VenationPlan, seconds: u64| {
        group.measurement_time(Duration::from_secs(seconds));
        group.sample_size(10);
        group.bench_function(name, |bencher| {
            bencher.iter(|| grow(black_box(&outline), black_box(plan), 1));
        });
    };
    run("poplar", &poplar, 3);
    run("poplar open", &open(&poplar), 3);
    run("broad leaf", &broad, 5);
    run("poplar x10", &fine, 30);
    run("poplar x10 open", &open(&fine), 10);
}

criterion_group!(venation, rows);
criterion_main!(venation);
