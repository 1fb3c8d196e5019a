//! How long mosaics take: `cargo bench -p lamina-benches --bench mosaic`.
//!
//! Two threads. The rows of Table I of the clonal mosaic's paper (\[binsfeld2011\]), each on a body
//! of its own kind and to its last day: cells grow, and are tessellated and blended into tissue.
//! And one relaxed day of ten thousand and of a hundred thousand cells that do not divide, each
//! with the same number of neighbours.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{DVec2, DVec3};
use leafmodel::grow_options::GrowOptions;
use leafmodel::mosaic::pattern::{LeafFaces, MosaicPattern};
use leafmodel::mosaic::shapes::lathe::lathe;
use leafmodel::mosaic::shapes::{Shape, rounded_cube, sheet, sphere};
use leafmodel::mosaic::{ControlImage, CylinderControl, Mosaic, MosaicPlan, Steered, Surface};
use leafmodel::optics::{Constituent, Contents};
use leafmodel::species;

/// Name; days, `w_r`, cells; adhesion within the types; days between their divisions; the body.
type Row = (&'static str, f64, f64, usize, [f64; 2], [f64; 2], Body);

/// On what the cells live.
#[derive(Clone, Copy, PartialEq)]
enum Body {
    Leaf,
    Melon,
    SquareMelon,
    Cap,
}

const ROWS: [Row; 10] = [
    (
        "fig 1",
        35.0,
        1.0,
        2000,
        [0.5, 0.8],
        [10.0, 10.0],
        Body::Leaf,
    ),
    (
        "figs 5 and 7",
        30.0,
        1.0,
        10_000,
        [0.5, 0.8],
        [5.0, 10.0],
        Body::Leaf,
    ),
    (
        "fig 9",
        30.0,
        1.0,
        2000,
        [0.5, 0.8],
        [10.0, 10.0],
        Body::Leaf,
    ),
    (
        "fig 10",
        20.0,
        0.5,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        Body::Melon,
    ),
    (
        "fig 11",
        20.0,
        0.5,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        Body::SquareMelon,
    ),
    (
        "fig 12, w_r 1",
        20.0,
        1.0,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        Body::Melon,
    ),
    (
        "fig 12, w_r 2",
        20.0,
        2.0,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        Body::Melon,
    ),
    (
        "fig 12, w_r 3",
        20.0,
        3.0,
        10_000,
        [0.5, 0.9],
        [5.0, 10.0],
        Body::Melon,
    ),
    (
        "fig 13, 6 days",
        20.0,
        3.0,
        6000,
        [0.7, 0.9],
        [6.0, 8.0],
        Body::Cap,
    ),
    (
        "fig 13, 20 days",
        20.0,
        3.0,
        6000,
        [0.7, 0.9],
        [20.0, 8.0],
        Body::Cap,
    ),
];

fn rows(criterion: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let pool = pool.expect("two threads");
    let mut group = criterion.benchmark_group("mosaic");
    for (name, days, radius_weight, initial_cells, adhesion, division, body) in ROWS {
        let plan = MosaicPlan {
            days,
            radius_weight,
            initial_cells,
            types: MosaicPlan::two_types(division, adhesion, 0.1, 0.0),
            controls: body.controls(),
            ..MosaicPlan::default()
        };
        let tissue = Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 40.0),
            (Constituent::Carotenoids, 8.0),
            (Constituent::Water, 0.01),
            (Constituent::DryMatter, 0.01),
        ]);
        let pattern = MosaicPattern {
            plan,
            contents: vec![tissue; 2],
            blend_mm: 0.3,
            faces: LeafFaces::Through,
        };
        let surface = body.surface(&pattern);
        let grow = || {
            let grown = pattern.grow(black_box(&surface), 1, GrowOptions::default());
            grown.expect("a good plan")
        };
        let cells = pool.install(grow).0.cells.len();
        group.bench_function(format!("{name}: {cells} cells"), |bencher| {
            bencher.iter(|| pool.install(grow));
        });
    }
    for cells in [10_000, 100_000] {
        let surface = sphere(100.0, 3.0).expect("good sizes");
        let surface = Surface::new(surface.positions, surface.faces).expect("a surface");
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

impl Body {
    /// Triangles as fine as the mosaic's cells.
    fn surface(self, pattern: &MosaicPattern) -> Surface {
        let of_edge = |edge: f64| -> Shape {
            let shape = match self {
                Self::Leaf => {
                    let croton = species::find("croton").expect("a preset").plan();
                    let outline = croton.outline.grow(150.0, 1).expect("a good outline");
                    sheet(&outline, edge)
                }
                Self::Melon => sphere(115.0, edge),
                Self::SquareMelon => rounded_cube(190.0, 35.0, edge),
                Self::Cap => {
                    let profile = [(0.0, 22.0), (40.0, 18.0), (60.0, 20.0), (0.0, 55.0)];
                    lathe(&profile.map(DVec2::from), edge)
                }
            };
            shape.expect("good sizes")
        };
        let coarse = of_edge(10.0);
        let coarse = Surface::new(coarse.positions, coarse.faces).expect("a surface");
        let shape = of_edge(pattern.edge_mm(coarse.total_area()));
        Surface::new(shape.positions, shape.faces).expect("a surface")
    }

    fn controls(self) -> Vec<CylinderControl> {
        let stripes = ControlImage::Stripes {
            count: 12,
            share: 0.4,
            waviness: 0.1,
            bends: 6.0,
            seed: 1,
        };
        let (from, to, image, steers) = match self {
            Self::Leaf => return Vec::new(),
            Self::Melon | Self::SquareMelon => (-200.0, 200.0, stripes, Steered::InitialType(0)),
            // No cells below the rim.
            Self::Cap => (0.0, 20.0, ControlImage::Constant(1.0), Steered::Blocked),
        };
        vec![CylinderControl {
            from: DVec3::Z * from,
            to: DVec3::Z * to,
            radius_mm: None,
            image,
            steers,
        }]
    }
}

/// Few and long: a run takes up to seconds.
fn lengths() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_secs(10))
        .sample_size(10)
}

criterion_group! { name = mosaic; config = lengths(); targets = rows }
criterion_main!(mosaic);
