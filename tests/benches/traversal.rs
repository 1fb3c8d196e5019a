//! Rays per second, traversal alone.
//!
//! `cargo bench -p lamina-benches --bench traversal` traces rays that bounce from a curved leaf and rays
//! from it to the sky, at each level of instructions that runs here: one leaf of 5,000 and of
//! 500,000 triangles, and 1,000 instances.
//!
//! With arguments it is Lamina's side of `reference/bench/rates`, which compares with Embree:
//! `LEAF.ply PLACEMENTS.f32|- RAYS closest|occluded ROUNDS`, as told in
//! `reference/bench/README.md`.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, Throughput};
use glam::{Affine3A, DAffine3, Mat3A, Quat, Vec2, Vec3, Vec3A};
use renderer::geometry::{Geometry, Instance, Ray, TriangleMesh, import};
use renderer::sampling::stream::Stream;
use renderer::sampling::warp::cosine_hemisphere;
use renderer::simd::Level;

fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    if let [leaf, placements, rays, kind, rounds] = arguments.as_slice() {
        compare(leaf, placements, rays, kind, rounds);
        return;
    }
    let mut criterion = Criterion::default().configure_from_args();
    rates(&mut criterion);
    criterion.final_summary();
}

/// A leaf of `2 · side²` triangles, 5 cm long, curved and wavy.
fn leaf(side: usize) -> TriangleMesh {
    let place = |i: usize, j: usize| {
        let (u, v) = (i as f32 / side as f32, j as f32 / side as f32);
        let width = 0.03 * libm::sinf(std::f32::consts::PI * (0.05 + 0.9 * v));
        let height = 0.004 * libm::cosf(9.0 * v) + 0.01 * u * u + 0.0003 * libm::sinf(80.0 * u * v);
        Vec3::new((u - 0.5) * width, 0.05 * v, height)
    };
    let positions = (0..=side)
        .flat_map(|j| (0..=side).map(move |i| place(i, j)))
        .collect();
    let triangles = (0..side)
        .flat_map(|j| {
            (0..side).flat_map(move |i| {
                let a = (j * (side + 1) + i) as u32;
                let b = a + side as u32 + 1;
                [[a, a + 1, b + 1], [a, b + 1, b]]
            })
        })
        .collect();
    TriangleMesh::new(positions, None, None, triangles).expect("a leaf is a mesh")
}

/// Four numbers without pattern.
fn numbers(index: u32) -> [f32; 4] {
    Stream::new(7, index, 0, 0).next4()
}

/// Instances in a cube of 40 cm, turned at random.
fn scattered(count: u32) -> Vec<Instance> {
    (0..count)
        .map(|i| {
            let ([x, y, z, _], [a, b, c, d]) = (numbers(2 * i), numbers(2 * i + 1));
            let turn = Quat::from_xyzw(a - 0.5, b - 0.5, c - 0.5, d - 0.5).normalize();
            let at = (Vec3::new(x, y, z) - 0.5) * 0.4;
            let to_scene = Affine3A::from_rotation_translation(turn, at);
            Instance::new(0, &to_scene.as_daffine3())
        })
        .collect()
}

/// Rays that leave what a camera sees: bounces to either side, or towards the sky.
fn rays(geometry: &Geometry, count: u32) -> [Vec<Ray>; 2] {
    let (low, high) = geometry.bounds();
    let middle = (low + high) * 0.5;
    let size = (high - low).length();
    let (mut bounces, mut to_sky) = (Vec::new(), Vec::new());
    let mut number = 0;
    while bounces.len() < count as usize {
        let ([x, y, ..], [p, q, side, _]) = (numbers(2 * number), numbers(2 * number + 1));
        number += 1;
        let eye = middle + Vec3::new(0.0, -0.6, 1.0) * size;
        let target = middle + (Vec3::new(x, y, 0.5) - 0.5) * size * 0.6;
        let ray = Ray::new(eye, (target - eye).normalize());
        let Some(hit) = geometry.intersect(&ray) else {
            continue;
        };
        let surface = geometry.surface(&hit);
        let frame = renderer::geometry::frame::Frame::from_normal(surface.geometric_normal);
        let up = cosine_hemisphere(Vec2::new(p, q));
        let down = if side < 0.5 { -1.0 } else { 1.0 };
        bounces.push(surface.spawn(frame.to_world(Vec3::new(up.x, up.y, down * up.z))));
        to_sky.push(surface.spawn(up));
    }
    [bounces, to_sky]
}

fn rates(criterion: &mut Criterion) {
    let alone = || vec![Instance::new(0, &DAffine3::IDENTITY)];
    for (name, side, instances) in [
        ("5,000 triangles", 50, alone()),
        ("500,000 triangles", 500, alone()),
        ("1,000 instances of 5,000", 50, scattered(1000)),
    ] {
        let geometry = Geometry::build(vec![leaf(side)], instances).expect("a sound geometry");
        let [bounces, to_sky] = rays(&geometry, 20_000);
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        group.measurement_time(Duration::from_secs(2));
        group.throughput(Throughput::Elements(bounces.len() as u64));
        for level in Level::all() {
            let geometry = geometry.clone().at_level(level);
            group.bench_function(BenchmarkId::new("closest", level.name()), |bencher| {
                bencher.iter(|| {
                    let hits = bounces.iter().filter_map(|ray| geometry.intersect(ray));
                    black_box(hits.map(|hit| hit.t).sum::<f32>())
                });
            });
            group.bench_function(BenchmarkId::new("occluded", level.name()), |bencher| {
                bencher
                    .iter(|| black_box(to_sky.iter().filter(|ray| geometry.occluded(ray)).count()));
            });
        }
        group.finish();
    }
}

/// Traces the rays of a file and prints one line of JSON.
fn compare(leaf: &str, placements: &str, rays: &str, kind: &str, rounds: &str) {
    let read = |path: &str| std::fs::read(path).unwrap_or_else(|why| panic!("{path}: {why}"));
    let floats = |path: &str| -> Vec<f32> {
        let bytes = read(path);
        let words = bytes.chunks_exact(4);
        words
            .map(|word| f32::from_le_bytes(word.try_into().expect("four bytes")))
            .collect()
    };
    let mesh = import(&read(leaf), "ply", 1.0).unwrap_or_else(|why| panic!("{leaf}: {why}"));
    let instances = if placements == "-" {
        vec![Affine3A::IDENTITY]
    } else {
        let matrices = floats(placements);
        let rows = |m: &[f32]| Affine3A {
            matrix3: Mat3A::from_cols(
                Vec3A::new(m[0], m[4], m[8]),
                Vec3A::new(m[1], m[5], m[9]),
                Vec3A::new(m[2], m[6], m[10]),
            ),
            translation: Vec3A::new(m[3], m[7], m[11]),
        };
        matrices.chunks_exact(12).map(rows).collect()
    };
    let instances = instances
        .into_iter()
        .map(|to_world| Instance::new(0, &to_world.as_daffine3()))
        .collect();
    let geometry = Geometry::build(vec![mesh], instances).expect("a sound geometry");
    let rays: Vec<Ray> = floats(rays)
        .chunks_exact(7)
        .map(|r| {
            let (origin, direction) = (Vec3::new(r[0], r[1], r[2]), Vec3::new(r[3], r[4], r[5]));
            Ray::new(origin, direction).up_to(r[6])
        })
        .collect();
    let rounds: u32 = rounds.parse().expect("a number of rounds");
    let (mut wall, mut processor) = (Vec::new(), Vec::new());
    let (mut hits, mut sum) = (0_u64, 0.0_f64);
    for _ in 0..rounds {
        (hits, sum) = (0, 0.0);
        let (started, busy) = (Instant::now(), processor_seconds());
        if kind == "occluded" {
            hits = rays.iter().filter(|ray| geometry.occluded(ray)).count() as u64;
        } else {
            for hit in rays.iter().filter_map(|ray| geometry.intersect(ray)) {
                hits += 1;
                sum += f64::from(hit.t);
            }
        }
        let rate = |seconds: f64| rays.len() as f64 * 1e-6 / seconds;
        wall.push(rate(started.elapsed().as_secs_f64()));
        if let (Some(before), Some(now)) = (busy, processor_seconds()) {
            processor.push(rate(now - before));
        }
    }
    let report = serde_json::json!({
        "rays": rays.len(),
        "mrays_per_s": wall,
        "mrays_per_cpu_s": processor,
        "hits": hits,
        "sum_of_t": sum,
    });
    #[allow(clippy::print_stdout, reason = "the result is for the harness to read")]
    {
        println!("{report}");
    }
}

/// Processor seconds of this thread, where Linux tells them.
fn processor_seconds() -> Option<f64> {
    let schedule = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = schedule.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}
