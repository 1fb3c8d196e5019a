//! What random choices cost: `cargo bench -p lamina-benches --bench samplers`.
//!
//! One thread, 64 samples of one pixel, so time ÷ elements is the time of a sample, or of one choice
//! of a sample: its random numbers for a camera ray and three bounces (four sets of four), its
//! wavelengths, a direction from a point, one within the sun's disc and a place in a sky of
//! 1024 × 512 texels.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec2;
use renderer::sampling::distribution::Piecewise2d;
use renderer::sampling::stream::Pixel;
use renderer::sampling::warp;
use renderer::spectrum::WavelengthSampler;
use renderer::spectrum::observer::Observer;
use renderer::spectrum::recorded::FilmKind;

const SAMPLES: u32 = 64;
/// Sets of four numbers of a sample.
const SETS: usize = 4;
/// `1 − cos` of the sun's angular radius.
const SUN: f32 = 1.08e-5;

fn sampling(criterion: &mut Criterion) {
    let pixel = Pixel::new(1, 40, 30, 0);
    let numbers: Vec<[f32; 4]> = (0..SAMPLES)
        .map(|sample| pixel.stream(sample).next4())
        .collect();
    let mut group = criterion.benchmark_group("samplers");
    group.throughput(Throughput::Elements(u64::from(SAMPLES)));
    group.bench_function("sixteen random numbers", |bencher| {
        bencher.iter(|| {
            let pixel = Pixel::new(1, black_box(40), 30, 0);
            for sample in 0..SAMPLES {
                let mut stream = pixel.stream(sample);
                for _ in 0..SETS {
                    black_box(stream.next4());
                }
            }
        });
    });
    let colour = WavelengthSampler::new(&FilmKind::Rgb {
        range_nm: [400.0, 780.0],
        observer: Observer::Cie1931,
    });
    group.bench_function("wavelengths", |bencher| {
        bencher.iter(|| {
            for [u, ..] in black_box(&numbers) {
                black_box(colour.draw::<8>(*u, 0));
            }
        });
    });
    group.bench_function("a bounce", |bencher| {
        bencher.iter(|| {
            for [x, y, ..] in black_box(&numbers) {
                black_box(warp::cosine_hemisphere(Vec2::new(*x, *y)));
            }
        });
    });
    group.bench_function("the sun", |bencher| {
        bencher.iter(|| {
            for [x, y, ..] in black_box(&numbers) {
                black_box(warp::cone(Vec2::new(*x, *y), SUN));
            }
        });
    });
    // Brighter upwards and around a spot.
    let width = 1024;
    let weights: Vec<f32> = (0..width * 512)
        .map(|i| {
            let (x, y) = ((i % width) as f32 / 1024.0, (i / width) as f32 / 512.0);
            y + 40.0 * (-80.0 * ((x - 0.3).powi(2) + (y - 0.8).powi(2))).exp()
        })
        .collect();
    let sky = Piecewise2d::new(&weights, width);
    group.bench_function("a sky", |bencher| {
        bencher.iter(|| {
            for [x, y, ..] in black_box(&numbers) {
                black_box(sky.sample([*x, *y]));
            }
        });
    });
    group.finish();
}

criterion_group!(benches, sampling);
criterion_main!(benches);
