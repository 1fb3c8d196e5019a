//! What a sample costs the film: `cargo bench -p lamina-benches --bench film`.
//!
//! One thread, a colour film of 256 × 256 pixels, 16 samples a pixel, so time ÷ elements is the
//! time of a sample: among the first, that record position, normal and albedo, and among later
//! ones, which add radiance and coverage alone.

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use renderer::film::{FEATURE_SAMPLES, Film, Sum};

const SIDE: u32 = 256;
const SAMPLES: u32 = 16;
/// Those of position, normal, albedo and object.
const SUMS: [Sum; 10] = {
    let wide = Sum::Wide { fraction_bits: 24 };
    let normal = Sum::Narrow { fraction_bits: 22 };
    let albedo = Sum::Narrow { fraction_bits: 20 };
    [
        wide,
        wide,
        wide,
        normal,
        normal,
        normal,
        albedo,
        albedo,
        albedo,
        Sum::First,
    ]
};

type Sample = ([f32; 3], [f32; SUMS.len()]);

fn adding(criterion: &mut Criterion) {
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let samples: Vec<Sample> = (0..SAMPLES).map(sample).collect();
    let mut group = criterion.benchmark_group("film");
    group.throughput(Throughput::Elements(u64::from(SIDE * SIDE * SAMPLES)));
    for (name, first) in [("with features", 0), ("radiance", FEATURE_SAMPLES)] {
        // A new film each time: no more than 256 samples of a pixel may record features.
        let film = || Film::new(SIDE, SIDE, &[0.2, 0.7, 0.1], &SUMS).expect("a small film");
        group.bench_function(name, |bencher| {
            bencher.iter_batched_ref(
                film,
                |film| one.install(|| expose(film, first, &samples)),
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

fn expose(film: &mut Film, first: u32, samples: &[Sample]) {
    film.expose(|block| {
        block.expose(SAMPLES, |_, _, pixel| {
            for (number, (values, features)) in (first..).zip(samples) {
                pixel.add(number, black_box(values), Some(black_box(features)));
            }
        });
    });
}

/// Radiance and a first hit of the size that a leaf close up has.
fn sample(number: u32) -> Sample {
    let value = 0.1 + 0.05 * number as f32;
    let features = [
        0.01,
        -0.02,
        0.03 + 0.001 * value,
        0.0,
        0.6,
        0.8,
        0.1,
        0.3,
        0.05,
        4.0,
    ];
    ([value, 0.7 * value, 0.3 * value], features)
}

criterion_group!(benches, adding);
criterion_main!(benches);
