//! How long veins take to grow: `cargo bench -p lamina-benches`.
//!
//! One thread. The rows are those of Table 1 of Runions et al. 2005 at 10 units of the table to a
//! segment, the poplar ten times finer, the broad leaf of the first scene, and a leaf that grows at
//! its margin, whose sources wait by the hundred before a long front of veins. The poplar by length
//! shows how time grows with the number of nodes: each row has about ten times the nodes of the one
//! before. "Slow growth" are leaves that grow little in a step, so that thousands of sources wait
//! far ahead of the veins; the names of the large ones end in "large", and they take minutes in
//! all: `cargo bench -p lamina-benches --bench venation -- "slow growth"`.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use leafmodel::measure::measure;
use leafmodel::shape::growth_form::{Axis, GrowthForm, HalfForm, VeinRow};
use leafmodel::shape::outline::Outline;
use leafmodel::species::PRESETS;
use leafmodel::venation::grow;
use leafmodel::venation::plan::{AuxinPlan, Growth, Neighbourhood, Pattern};

/// A broad ovate leaf, 80 mm long.
fn outline() -> Outline {
    let half = HalfForm {
        veins: vec![VeinRow::straight(0.1, -0.35), VeinRow::straight(0.9, 0.45)],
        ..HalfForm::entire(1.22, 0.32, 3.0)
    };
    let shape = GrowthForm::from(Axis {
        rows: 200,
        ..half.into()
    });
    shape.grow(80.0).expect("these rates bring forth a margin")
}

/// An isogonic closed plan; all lengths in segments.
fn plan(lengths: [f64; 3], birth_distance: f64, darts_per_area: f64) -> AuxinPlan {
    let [initial_length, length_step, final_length] = lengths;
    AuxinPlan {
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
        ..AuxinPlan::default()
    }
}

/// The poplar so many segments long.
fn poplar(length: f64) -> AuxinPlan {
    let share = length / 3500.0;
    plan([115.0 * share, 0.9, length], 2.0, 2e-5 / share)
}

/// Marginal growth with many sources.
fn marginal() -> AuxinPlan {
    AuxinPlan {
        growth: Growth::Marginal {
            initial_length: 60.0,
            length_step: 2.0,
        },
        ..plan([60.0, 2.0, 600.0], 3.0, 0.01)
    }
}

fn open(plan: &AuxinPlan) -> AuxinPlan {
    AuxinPlan {
        pattern: Pattern::Open,
        ..plan.clone()
    }
}

fn rows(criterion: &mut Criterion) {
    let outline = outline();
    let broad = plan([60.0, 2.5, 600.0], 3.5, 0.01);
    let mut group = criterion.benchmark_group("venation");
    let mut run = |name: &str, plan: &AuxinPlan, seconds: u64| {
        group.measurement_time(Duration::from_secs(seconds));
        group.sample_size(10);
        group.bench_function(name, |bencher| {
            bencher.iter(|| grow(black_box(&outline), black_box(plan), 1));
        });
    };
    run("broad leaf", &broad, 3);
    run("marginal growth", &marginal(), 6);
    for (length, seconds) in [(110.0, 2), (350.0, 3), (1100.0, 3), (3500.0, 15)] {
        let poplar = poplar(length);
        run(&format!("poplar, {length} segments"), &poplar, seconds);
        run(
            &format!("poplar, {length} segments, open"),
            &open(&poplar),
            seconds / 2 + 1,
        );
    }
}

/// Every preset of Table 1, and measures of the finest net: areoles and all.
fn presets(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("presets");
    group.sample_size(10);
    for preset in PRESETS {
        let plan = preset.plan();
        let outline = plan.grow_outline().expect("a good outline");
        let Some(auxin) = plan.venation.auxin() else {
            continue;
        };
        let grow_it = || grow(&outline, auxin, plan.seed).expect("a good plan");
        let is_fine = preset.name == "poplar-x10";
        group.measurement_time(Duration::from_secs(if is_fine { 15 } else { 1 }));
        group.bench_function(preset.name, |bencher| bencher.iter(grow_it));
        if is_fine {
            let network = grow_it();
            let exponent = auxin.murray_exponent;
            group.bench_function("poplar-x10, measures", |bencher| {
                bencher.iter(|| measure(&outline, black_box(&network), exponent));
            });
        }
    }
}

/// A preset whose growth steps are small against its net.
fn slow(name: &str, change: impl Fn(&mut AuxinPlan)) -> (Outline, AuxinPlan, u64) {
    let preset = PRESETS.iter().find(|preset| preset.name == name);
    let plan = preset.expect("a preset").plan();
    let outline = plan.grow_outline().expect("a good outline");
    let mut auxin = plan.venation.auxin().expect("veins by auxin").clone();
    change(&mut auxin);
    (outline, auxin, plan.seed)
}

/// A cottonwood whose net is `length` segments long in the end, half of them at the start.
fn slow_cottonwood(length: f64, initial: f64, kill_distance: f64) -> impl Fn(&mut AuxinPlan) {
    move |auxin| {
        auxin.source_birth_distance = 2.0;
        auxin.vein_birth_distance = 2.0;
        auxin.kill_distance = kill_distance;
        auxin.final_length = length;
        if let Growth::Isogonic { initial_length, .. } = &mut auxin.growth {
            *initial_length = initial;
        }
    }
}

/// The poplar at one unit of the paper's table to a segment, with the table's own growth step and
/// darts.
fn poplar_of_the_table(auxin: &mut AuxinPlan) {
    auxin.darts_per_area = 200e-6;
    if let Growth::Isogonic { length_step, .. } = &mut auxin.growth {
        *length_step = 9.0;
    }
}

fn slow_growth(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("slow growth");
    group.sample_size(10);
    let cases = [
        (
            "cottonwood",
            slow("cottonwood", slow_cottonwood(560.0, 300.0, 1.0)),
        ),
        (
            "cottonwood, large",
            slow("cottonwood", slow_cottonwood(1800.0, 900.0, 0.93)),
        ),
        (
            "poplar of the table, large",
            slow("poplar-x10", poplar_of_the_table),
        ),
    ];
    let patterns = [
        ("relative", Pattern::Closed(Neighbourhood::Relative)),
        ("Urquhart", Pattern::Closed(Neighbourhood::Urquhart)),
        ("open", Pattern::Open),
    ];
    for (name, (outline, auxin, seed)) in &cases {
        for (kind, pattern) in &patterns {
            let auxin = AuxinPlan {
                pattern: *pattern,
                ..auxin.clone()
            };
            group.bench_function(format!("{name}, {kind}"), |bencher| {
                bencher.iter(|| grow(outline, black_box(&auxin), *seed).expect("a good plan"));
            });
        }
    }
}

criterion_group!(venation, rows, presets, slow_growth);
criterion_main!(venation);
