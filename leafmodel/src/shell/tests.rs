//! Sheets whose form is known in closed form.

use glam::{DVec2, DVec3};

use super::*;

/// A rectangle from the origin along +y.
fn rectangle(width: f64, length: f64) -> [DVec2; 4] {
    let half = 0.5 * width;
    [(-half, 0.0), (half, 0.0), (half, length), (-half, length)].map(DVec2::from)
}

fn over(margin: &[DVec2], spacing: f64) -> Grid {
    let (low, high) = (margin[0], margin[2]);
    let within = |p: DVec2| p.cmpge(low).all() && p.cmple(high).all();
    Grid::over(margin, within, spacing)
}

fn flat(grid: &Grid) -> Vec<DVec3> {
    grid.fitted(|p| p.extend(0.0))
}

/// A lamina 0.2 mm thick of 30 N/mm².
fn patch() -> Patch {
    Patch {
        stretch: 30.0 * 0.2,
        bend: 30.0 * 0.008 / 12.0,
        growth: [1.0, 1.0, 0.0],
        curvature: [0.0; 3],
        veins: [[[0.0; 3]; 3]; 2],
        veins_growth: 1.0,
        veins_curvature: 0.0,
        weight: 0.0,
    }
}

const THOROUGH: Effort = Effort {
    steps: 400,
    tolerance: 1e-9,
};

#[test]
fn a_sheet_as_it_wants_to_be_does_not_move() {
    let grid = over(&rectangle(20.0, 30.0), 2.0);
    let rest = grid.fitted(|p| {
        DVec3::new(
            p.x,
            20.0 * libm::sin(p.y / 20.0),
            20.0 * libm::cos(p.y / 20.0),
        )
    });
    let patches = vec![patch(); grid.cells()];
    let sheet = Sheet::new(&grid, &rest, &patches, DVec3::ZERO, None, None);
    let (x, [start, _]) = relaxed(&sheet, &rest, THOROUGH);
    assert!(start < 1e-18, "{start}");
    for (a, b) in x.iter().zip(&rest) {
        assert!(a.distance(*b) < 1e-7, "{a} is not {b}");
    }
}

#[test]
fn the_slope_is_that_of_the_energy() {
    let grid = over(&rectangle(8.0, 12.0), 2.0);
    let patches: Vec<Patch> = (0..grid.cells())
        .map(|cell| Patch {
            growth: [1.0 + 0.01 * cell as f64, 0.95, 0.02],
            curvature: [0.02, 0.01, -0.01],
            veins: [[[3.0, 0.2, 0.1], [0.2, 1.0, 0.0], [0.1, 0.0, 2.0]]; 2],
            veins_growth: 0.98,
            weight: 1e-3,
            ..patch()
        })
        .collect();
    let ground = Ground {
        height: 0.5,
        stiffness: 0.01,
    };
    let clamp = Clamp {
        at: DVec2::new(0.0, 1.0),
        stiffness: 2.0,
    };
    let rest = flat(&grid);
    let sheet = Sheet::new(&grid, &rest, &patches, -DVec3::Z, Some(ground), Some(clamp));
    let x: Vec<DVec3> = rest
        .iter()
        .enumerate()
        .map(|(i, &p)| {
            let i = i as f64;
            p + 0.4 * DVec3::new(libm::sin(i), libm::cos(2.0 * i), libm::sin(1.0 + 3.0 * i))
        })
        .collect();
    let mut slope = vec![DVec3::ZERO; x.len()];
    sheet.slope(&x, &mut slope);
    for point in (0..x.len()).step_by(3) {
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut x = x.clone();
                x[point][axis] += by;
                sheet.energy(&x)
            };
            let found = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            let told = slope[point][axis];
            assert!(
                (found - told).abs() < 1e-5 * (1.0 + told.abs()),
                "{found} is not {told}"
            );
        }
    }
}

#[test]
fn a_strip_held_at_one_end_sags_as_euler_and_bernoulli_say() {
    let (length, weight) = (30.0, 2e-8);
    let grid = over(&rectangle(6.0, length), 1.5);
    let patches = vec![Patch { weight, ..patch() }; grid.cells()];
    let clamp = Clamp {
        at: DVec2::new(0.0, 0.75),
        stiffness: 1e5,
    };
    let rest = flat(&grid);
    let sheet = Sheet::new(&grid, &rest, &patches, -DVec3::Z, None, Some(clamp));
    let (x, _) = relaxed(&sheet, &rest, THOROUGH);
    let tip = grid.value(&x, DVec2::new(0.0, length))[0].z;
    // A narrow strip is a beam: w L⁴ / 8 D, with D the stiffness without Poisson's effect.
    let free = length - 0.75;
    let beam = -weight * free.powi(4) / (8.0 * patch().bend);
    // A plate held at its middle only lies between the beam and 1 − ν² of it.
    assert!((0.9..1.08).contains(&(tip / beam)), "{tip} for {beam}");
}

#[test]
fn two_layers_that_shrink_unequally_curl_as_timoshenko_says() {
    // Equal layers: κ = 3/2 Δε/t. A sheet much wider than √(t/κ) curves one way only, to
    // (1 + ν) κ; a narrow one to κ.
    let wanted = 1.5 * 0.004 / 0.2;
    let curved = |width: f64| {
        let grid = over(&rectangle(width, 40.0), 1.0);
        let curvature = [wanted, wanted, 0.0];
        let patches = vec![
            Patch {
                curvature,
                ..patch()
            };
            grid.cells()
        ];
        let rest = flat(&grid);
        let sheet = Sheet::new(&grid, &rest, &patches, DVec3::ZERO, None, None);
        let (x, _) = relaxed(&sheet, &rest, THOROUGH);
        let direction = |x: &[DVec3], p: DVec2, axis: usize| grid.value(x, p)[axis].normalize();
        let turned = |from: DVec2, to: DVec2, axis: usize| {
            let cos = direction(&x, from, axis).dot(direction(&x, to, axis));
            libm::acos(cos) / from.distance(to)
        };
        let across = DVec2::new(0.25 * width, 20.0);
        [
            turned(DVec2::new(0.0, 10.0), DVec2::new(0.0, 30.0), 2),
            turned(across * DVec2::new(-1.0, 1.0), across, 1),
        ]
    };
    let [along, _] = curved(1.0);
    assert!((along / wanted - 1.0).abs() < 0.01, "{along} for {wanted}");
    let [along, across] = curved(14.0);
    let whole = along + across;
    assert!(
        (whole / wanted - 1.3).abs() < 0.1,
        "{along} and {across} for {wanted}"
    );
}

#[test]
fn a_margin_that_grows_in_excess_buckles_into_waves_as_long_as_its_rim_is_wide() {
    let (width, length) = (10.0, 40.0);
    let grid = over(&rectangle(width, length), 1.0);
    let rest = flat(&grid);
    let mut waves = Vec::new();
    for rim in [2.0, 0.5] {
        let patches: Vec<Patch> = (0..grid.cells())
            .map(|cell| {
                let p = grid.centre(cell);
                let from_margin = 0.5 * width - p.x.abs();
                let grown = 1.0 + 0.3 * libm::exp(-from_margin / rim);
                // A seed of disorder, as nature has it.
                let disorder = libm::sin(1.7 * p.y) + libm::sin(0.7 * p.y) + libm::sin(0.4 * p.y);
                Patch {
                    growth: [1.0, grown, 0.0],
                    curvature: [0.0, 1e-2 * disorder * p.x, 0.0],
                    ..patch()
                }
            })
            .collect();
        let sheet = Sheet::new(&grid, &rest, &patches, DVec3::ZERO, None, None);
        let effort = Effort {
            steps: 80,
            tolerance: 1e-6,
        };
        let (x, [start, end]) = relaxed(&sheet, &rest, effort);
        assert!(end < 0.2 * start, "{end} of {start}");
        let height = |y: f64| {
            let at = |x_mm: f64| grid.value(&x, DVec2::new(x_mm, y))[0].z;
            at(0.48 * width) - at(0.0)
        };
        let heights: Vec<f64> = (0..80).map(|i| height(0.5 * f64::from(i))).collect();
        let turns = heights
            .windows(3)
            .filter(|z| (z[1] - z[0]) * (z[2] - z[1]) < 0.0);
        waves.push(0.5 * turns.count() as f64);
        assert_eq!(relaxed(&sheet, &rest, effort).0, x, "the same bits");
    }
    assert!(
        waves[0] >= 1.0 && waves[1] > waves[0] && waves[1] < 8.0,
        "{waves:?}"
    );
}
