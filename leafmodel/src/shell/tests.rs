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

/// Triangles of a sheet, finer than its cells, and pairs of them that pass through each other.
fn crossings_of(grid: &Grid, x: &[DVec3], [width, length]: [f64; 2]) -> usize {
    let step = 0.25 * grid.spacing();
    let count = [width, length].map(|side| (side / step).ceil() as u32 + 1);
    let mut places = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..count[0] * count[1] {
        let (column, row) = (i % count[0], i / count[0]);
        let share = |k: u32, of: usize| f64::from(k) / f64::from(count[of] - 1);
        let p = DVec2::new(width * (share(column, 0) - 0.5), length * share(row, 1));
        places.push(grid.value(x, p)[0]);
        if column + 1 < count[0] && row + 1 < count[1] {
            triangles.push([i, i + 1, i + count[0]]);
            triangles.push([i + 1, i + count[0] + 1, i + count[0]]);
        }
    }
    crossings(&places, &triangles).len()
}

#[test]
fn a_strip_that_dries_winds_into_a_scroll_without_passing_through_itself() {
    let (width, length) = (6.0, 60.0);
    let margin = rectangle(width, length);
    let grid = over(&margin, 1.2);
    let rest = flat(&grid);
    // It has begun to roll up: not quite one turn.
    let begun = grid.fitted(|p| {
        let angle = 0.1 * p.y;
        DVec3::new(p.x, 10.0 * libm::sin(angle), 10.0 - 10.0 * libm::cos(angle))
    });
    // It curls ever more tightly towards its end, twice round on the whole, and a little askew.
    let patches: Vec<Patch> = (0..grid.cells())
        .map(|cell| {
            let p = grid.centre(cell);
            let along = 0.21 + 0.05 * libm::cos(p.y / 7.0);
            Patch {
                curvature: [0.0, along, 0.004],
                ..patch()
            }
        })
        .collect();
    let effort = Effort {
        steps: 400,
        tolerance: 1e-6,
    };
    let sheet = Sheet::new(&grid, &rest, &patches, DVec3::ZERO, None, None);
    let (free, _) = relaxed(&sheet, &begun, effort);
    let through = crossings_of(&grid, &free, [width, length]);
    assert!(through > 100, "{through}");
    let within = |p: DVec2| p.cmpge(margin[0]).all() && p.cmple(margin[2]).all();
    let skin = Skin::over(&grid, &margin, within, |_| 0.1);
    let (x, [start, end]) = relaxed(&sheet.keeping_clear(skin), &begun, effort);
    assert_eq!(crossings_of(&grid, &x, [width, length]), 0);
    // It has wound up all the same, more than once round, and its layers are within a cell of
    // each other, but not nearer than it is thick.
    assert!(end < 0.2 * start, "{end} of {start}");
    let at = |y: f64| grid.value(&x, DVec2::new(0.0, y))[0];
    let way = |y: f64| grid.value(&x, DVec2::new(0.0, y))[2];
    let turned: f64 = (0..600)
        .map(|i| {
            let y = 0.1 * f64::from(i);
            way(y).angle_between(way(y + 0.1))
        })
        .sum();
    assert!(turned > 2.2 * std::f64::consts::PI, "{turned}");
    let nearest = (0..=600)
        .flat_map(|i| (0..=600).map(move |j| [i, j].map(|k| 0.1 * f64::from(k))))
        .filter(|[y, z]| z - y > 8.0)
        .map(|[y, z]| at(y).distance(at(z)))
        .fold(f64::INFINITY, f64::min);
    assert!((0.2..1.2).contains(&nearest), "{nearest}");
}

#[test]
fn the_slope_of_what_touches_is_that_of_the_energy() {
    let margin = rectangle(4.0, 24.0);
    let grid = over(&margin, 1.0);
    let patches = vec![patch(); grid.cells()];
    let within = |p: DVec2| p.cmpge(margin[0]).all() && p.cmple(margin[2]).all();
    let skin = Skin::over(&grid, &margin, within, |_| 0.1);
    let rest = flat(&grid);
    let sheet = Sheet::new(&grid, &rest, &patches, DVec3::ZERO, None, None);
    // A coil of pitch 0.35 mm, whose layers touch.
    let coiled = |p: DVec2| {
        let angle = p.y / 2.0;
        let radius = 2.0 + 0.055 * angle;
        DVec3::new(
            p.x + 0.03 * p.y,
            radius * libm::sin(angle),
            radius * libm::cos(angle),
        )
    };
    let x = grid.fitted(coiled);
    let alone = sheet.energy(&x);
    let sheet = sheet.keeping_clear(skin);
    assert!(
        sheet.energy(&x) > 1.001 * alone,
        "{} {alone}",
        sheet.energy(&x)
    );
    let mut slope = vec![DVec3::ZERO; x.len()];
    sheet.slope(&x, &mut slope);
    for point in (0..x.len()).step_by(5) {
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut x = x.clone();
                x[point][axis] += by;
                sheet.energy(&x)
            };
            let found = (moved(1e-6) - moved(-1e-6)) / 2e-6;
            let told = slope[point][axis];
            assert!(
                (found - told).abs() < 1e-4 * (1.0 + told.abs()),
                "{found} is not {told}"
            );
        }
    }
}

#[test]
fn a_corrugated_strip_sags_as_little_as_its_section_says() {
    let (width, length, weight) = (12.0, 40.0, 2e-7);
    let grid = over(&rectangle(width, length), 1.0);
    let patches = vec![Patch { weight, ..patch() }; grid.cells()];
    let tip = |height: f64| {
        let wave = |p: DVec2| height * libm::sin(std::f64::consts::TAU * p.x / 6.0);
        let rest = grid.fitted(|p| p.extend(wave(p)));
        let sheet = Sheet::new(&grid, &rest, &patches, -DVec3::Z, None, None);
        // Held along its whole end: what is left free bends as a beam.
        let (x, _) = relaxed(&sheet.held_below(&grid, &rest, 3.0), &rest, THOROUGH);
        let mean = |x: &[DVec3]| {
            let places = (0..=24).map(|i| DVec2::new(-6.0 + 0.5 * f64::from(i), length));
            places.map(|p| grid.value(x, p)[0].z).sum::<f64>() / 25.0
        };
        mean(&x) - mean(&rest)
    };
    // Second moment over width: that of the plate, and t a² / 2 of its midplane if the section
    // keeps its form. Its free edges yield a little.
    let (a, flat) = (0.4, tip(0.0));
    let stiffer = 1.0 + patch().stretch * a * a / (2.0 * patch().bend);
    let found = flat / tip(a);
    assert!(
        (0.75..1.0).contains(&(found / stiffer)),
        "{found} for {stiffer}"
    );
}
