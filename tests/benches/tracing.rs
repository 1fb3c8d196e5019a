//! How long a picture of 12 megapixels takes to become a network: `cargo bench -p lamina-benches --bench
//! tracing`. All threads.
//!
//! The picture is a drawing of the preset `poplar`, 4000 pixels long with its border, with noise.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec2;
use leafmodel::leaf::Lamina;
use leafmodel::species;
use leafmodel::tracing::{Raster, Settings, trace};

const HEIGHT: usize = 4000;
const WIDTH: usize = 3000;
const MM_PER_PIXEL: f64 = 0.0185;

fn drawn(lamina: &Lamina) -> Raster {
    let (low, high) = lamina.outline.bounds();
    let middle = 0.5 * (low + high);
    let centre = 0.5 * DVec2::new(WIDTH as f64, HEIGHT as f64);
    let to_mm = |p: DVec2| middle + (p - centre) * DVec2::new(1.0, -1.0) * MM_PER_PIXEL;
    let to_px = |p: DVec2| centre + (p - middle) * DVec2::new(1.0, -1.0) / MM_PER_PIXEL;
    let mut values: Vec<f32> = (0..WIDTH * HEIGHT)
        .map(|at| {
            let p = DVec2::new((at % WIDTH) as f64 + 0.5, (at / WIDTH) as f64 + 0.5);
            if lamina.outline.contains(to_mm(p)) {
                0.75
            } else {
                1.0
            }
        })
        .collect();
    for vein in lamina.network.segments() {
        let (a, b) = (to_px(vein.from), to_px(vein.to));
        // Finer veins than two pixels are drawn two pixels wide.
        let radius = (vein.radius_from / MM_PER_PIXEL).max(1.0);
        let (from, to) = (a.min(b) - radius, a.max(b) + radius);
        for y in from.y.max(0.0) as usize..(to.y as usize + 1).min(HEIGHT) {
            for x in from.x.max(0.0) as usize..(to.x as usize + 1).min(WIDTH) {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                if p.distance(a + (b - a) * along) <= radius {
                    values[y * WIDTH + x] = 0.25;
                }
            }
        }
    }
    let mut state = 1_u64;
    for value in &mut values {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        *value += 0.04 * ((state >> 40) as f32 / (1 << 24) as f32 - 0.5);
    }
    Raster::new(WIDTH, HEIGHT, values).expect("12 megapixels")
}

fn megapixels(criterion: &mut Criterion) {
    let plan = species::find("poplar").expect("a preset").plan();
    let picture = drawn(&plan.grow_lamina().expect("a good plan"));
    let settings = Settings::new(MM_PER_PIXEL);
    let mut group = criterion.benchmark_group("tracing");
    group.sample_size(10);
    group.bench_function("12 megapixels", |bencher| {
        bencher.iter(|| trace(black_box(&picture), &settings).expect("a leaf"));
    });
}

criterion_group!(tracing, megapixels);
criterion_main!(tracing);
