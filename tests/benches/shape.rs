//! How long outlines and their measures take: `cargo bench -p lamina-benches --bench shape`.
//!
//! One thread. The growth algorithm's Figs. 3b and 8d, the same with curved veins and unlike
//! halves, a maple of five lobes; and the measures of that.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use leafmodel::measure;
use leafmodel::shape::growth_form::{Axis, GrowthForm, HalfForm, VeinRow};
use leafmodel::species::find;

/// Unlike halves with veins that bend.
fn oblique() -> GrowthForm {
    let half = |rate_ratio| HalfForm {
        lobe_decay: 0.004,
        lobe_exponent: 1.0,
        veins: [0.1, 0.3, 0.5, 0.7, 0.9]
            .map(|position| VeinRow {
                position,
                slope: 0.4 + position,
                bend: 2.0,
            })
            .to_vec(),
        ..HalfForm::entire(rate_ratio, 0.35, 3.0)
    };
    GrowthForm::from(Axis {
        left: Some(half(1.3)),
        ..half(1.2).into()
    })
}

/// The growth form of a preset.
fn grown(name: &str) -> GrowthForm {
    let plan = find(name).expect("a preset").plan();
    plan.outline.growth_form().expect("it grows").clone()
}

fn outlines(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("outline");
    group.measurement_time(Duration::from_secs(3));
    for name in ["young-3b", "young-8d"] {
        let shape = grown(name);
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(&shape).grow(80.0));
        });
    }
    let form = oblique();
    group.bench_function("curved veins", |bencher| {
        bencher.iter(|| black_box(&form).grow(80.0));
    });
    let palm = grown("maple-palmate");
    group.bench_function("maple", |bencher| {
        bencher.iter(|| black_box(&palm).grow(80.0));
    });
    let outline = palm.grow(80.0).expect("a good form");
    group.bench_function("measures of the maple", |bencher| {
        bencher.iter(|| measure::shape(black_box(&outline)));
    });
    group.finish();
}

criterion_group!(benches, outlines);
criterion_main!(benches);
