//! How long mosaics take to grow: `cargo bench -p leafmodel --bench mosaic`.
//!
//! Two threads. The rows of Table I of the clonal mosaic's paper on a sphere, a cube or a sheet, each to its last day; and one
//! relaxed day of ten thousand and of a hundred thousand cells that do not divide, each with the same number of neighbours.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use leafmodel::mosaic::{ControlImage, CylinderControl, Mosaic, MosaicPlan, Steered, Surface};

/// Name; days, `w_r`, cells; adhesion within the types; days between their divisions; the surface.
type Row = (
    &'static str,
    f64,
    f64,
    usize,
    [f64; 2],
    [f64; 2],
    fn() -> Surface,
);

const ROWS: [Row; 8] = [
    ("fig 1", 35.0, 1.0, 2000, [0.5, 0.8], [10.0, 10.0], sheet),
    ("fig 5", 30.0, 1.0, 10_000, [0.5, 0.8], [5.0, 10.0], sheet),
    ("fig 9", 30.0, 1.0, 2000, [0.5, 0.8], [10.0, 10.0], sheet),
    ("fig 10", 20.0, 0.5, 10_000, [0.5, 0.9], [5.0, 10.0], sphere),
    (
        "fig 12, w_r 1",
        20.0,
        1.0,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        sphere,
    ),
    (
        "fig 12, w_r 2",
        20.0,
        2.0,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        sphere,
    ),
    (
        "fig 12, w_r 3",
        20.0,
        3.0,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        sphere,
    ),
    ("fig 13", 20.0, 3.0, 6000, [0.7, 0.9], [6.0, 8.0], sphere),
];

fn rows(criterion: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let pool = pool.expect("two threads");
    let mut group = criterion.benchmark_group("mosaic");
    group.measurement_time(Duration::from_secs(10));
    group.warm_up_time(Duration::from_millis(100));
    group.sample_size(10);
    for (name, days, radius_weight, initial_cells, adhesion, division, surface) in ROWS {
        let surface = surface();
        // The watermelons' stripes.
        let stripes = CylinderControl {
            from: DVec3::Z * -200.0,
            to: DVec3::Z * 200.0,
            radius_mm: None,
            image: ControlImage::Stripes {
                count: 12,
                share: 0.4,
                waviness: 0.1,
                bends: 6.0,
                seed: 1,
            },
            steers: Steered::InitialType(0),
        };
        let striped = name.contains("10") || name.contains("12");
        let plan = MosaicPlan {
            days,
            radius_weight,
            initial_cells,
            types: MosaicPlan::two_types(division, adhesion, 0.1, 0.0),
            controls: if striped { vec![stripes] } else { Vec::new() },
            ..MosaicPlan::default()
        };
        let grow = || Mosaic::grow(black_box(&surface), &plan, 1).expect("a good plan");
        let cells = pool.install(grow).cells.len();
        group.bench_function(format!("{name}: {cells} cells"), |bencher| {
            bencher.iter(|| pool.install(grow));
        });
    }
    for cells in [10_000, 100_000] {
        let surface = sphere();
        let plan = MosaicPlan {
            initial_cells: cells,
            initial_relaxations: 0,
            radius_weight: 3.0,
            days: 5.0,
            types: MosaicPlan::two_types([f64::INFINITY; 2], [0.5, 0.8], 0.1, 0.0),
            ..MosaicPlan::default()
        };
        group.bench_function(format!("20 relaxations of {cells} cells"), |bencher| {
            bencher.iter(|| pool.install(|| Mosaic::grow(black_box(&surface), &plan, 1)));
        });
    }
}

/// A leaf-like sheet, 60 × 150 mm.
fn sheet() -> Surface {
    let corners = [(0.0, 0.0), (60.0, 0.0), (60.0, 150.0), (0.0, 150.0)];
    let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let sheet = Surface::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a good sheet");
    sheet.subdivided(2.0).expect("a good length").0
}

/// A melon of 100 mm radius: an octahedron cut fine and blown up.
fn sphere() -> Surface {
    let corners = [
        DVec3::X,
        DVec3::Y,
        DVec3::NEG_X,
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::NEG_Z,
    ];
    let faces = (0..4).flat_map(|k| [[k, (k + 1) % 4, 4], [(k + 1) % 4, k, 5]]);
    let octahedron = Surface::new(corners.to_vec(), faces.collect()).expect("an octahedron");
    let fine = octahedron.subdivided(0.03).expect("a good length").0;
    let round = fine.positions().iter().map(|at| at.normalize() * 100.0);
    fine.moved(round.collect()).expect("a good sphere")
}

criterion_group!(mosaic, rows);
criterion_main!(mosaic);
