//! Means over draws of the leaves, and their errors, against what is known of discs at random.

use std::f64::consts::PI;

use renderer::instruments::{Budget, Effort, Reading, Row, read_out_watched};
use renderer::scene::description::Description;
use renderer::scene::world::{BuildOptions, World};

use super::canopy::discs;
use super::{NORMAL, built, figures_of, of, rays};

/// Radius of the discs, m; the box is 1 m wide.
const RADIUS: f64 = 0.1;
/// As many level discs as have a leaf area index of 1.
const COUNT: f64 = 32.0;

/// Level discs at random over ground, of which so many draws are measured.
fn level_discs(draws: u32, seed: u64) -> String {
    let text = discs(RADIUS, 1.0, [0.0, 1.0]);
    let level = "inclination = \"table\", inclinations = { table = [[0, 1], [1e-4, 0]] }";
    let text = text.replace("seed = 4", &format!("seed = {seed}, {level}"));
    format!(
        "{text}[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550, 800]\n\
         soil = \"ground\"\nrealisations = {draws}\n"
    )
}

/// The figures of a scene whose instrument asks for several draws.
fn drawn(text: &str, budget: Budget) -> Reading {
    drawn_of(&mut built(text), budget)
}

/// The same of a scene that is built.
fn drawn_of(
    (scene, world, first): &mut (Description, World, Vec<usize>),
    budget: Budget,
) -> Reading {
    let watch = None;
    let effort = Effort { budget, watch };
    let options = BuildOptions::default();
    let found = read_out_watched(world, scene, 0, first[0], &effort, &options);
    found.expect("it can be measured")
}

fn gap(rows: &[Row]) -> &Row {
    of(rows, "uncollided", NORMAL, 550.0)
        .next()
        .expect("it is measured")
}

/// Mean and variance over draws of the fraction of the box that no disc covers: discs cover two points
/// independently of each other, with the area in which their middles then lie.
fn known() -> (f64, f64) {
    let disc = PI * RADIUS * RADIUS;
    let mean = (1.0 - disc).powf(COUNT);
    // Both points are free if no middle lies in the union of two discs about them.
    let free = |apart: f64| {
        let (half, whole) = (apart / (2.0 * RADIUS), 2.0 * RADIUS);
        let lens = 2.0 * RADIUS * RADIUS * half.acos()
            - 0.5 * apart * (whole * whole - apart * apart).sqrt();
        (1.0 - 2.0 * disc + lens).powf(COUNT)
    };
    let steps = 10_000;
    let step = 2.0 * RADIUS / f64::from(steps);
    let near: f64 = (0..steps)
        .map(|i| (f64::from(i) + 0.5) * step)
        .map(|apart| 2.0 * PI * apart * step * free(apart))
        .sum();
    let far = (1.0 - 4.0 * disc) * (1.0 - 2.0 * disc).powf(COUNT);
    (mean, near + far - mean * mean)
}

#[test]
fn the_error_over_draws_is_that_of_discs_at_random() {
    let (mean, variance) = known();
    let draws = 100;
    let found = drawn(&level_discs(draws, 1), rays(1 << 11));
    assert_eq!(found.draws, draws);
    let gap = gap(&found.rows);
    let parts = gap.parts.expect("there are several draws");
    assert_eq!(parts.draws, draws);
    let expected = (variance / f64::from(draws)).sqrt();
    // A deviation of 100 draws is uncertain by 1 / √(2 · 99), 7 %.
    assert!(
        (parts.by_draws / expected - 1.0).abs() < 4.0 * 0.071,
        "{parts:?} for {expected}"
    );
    assert!(parts.by_rays < parts.by_draws, "{parts:?}");
    let whole = parts.by_rays.hypot(parts.by_draws);
    assert!((gap.error / whole - 1.0).abs() < 1e-12, "{gap:?}");
    assert!(
        (gap.value - mean).abs() < 4.0 * gap.error,
        "{gap:?} for {mean}"
    );
    // Of all light nothing is lost, in the mean of draws too.
    let of_all = ["reflected", "transmitted", "absorbed_by_soil", "absorbed"];
    let parts = of_all
        .into_iter()
        .flat_map(|quantity| of(&found.rows, quantity, NORMAL, 550.0));
    let sum: f64 = parts.map(|row| row.value).sum();
    assert!((sum - 1.0).abs() < 1e-6, "{sum}");
}

#[test]
#[ignore = "slow: 20 s"]
fn the_error_that_is_reported_over_draws_is_the_error_that_is_made() {
    let (mean, _) = known();
    let (draws, repetitions) = (8, 60);
    let mut squares = [0.0; 2];
    for seed in 0..repetitions {
        let found = drawn(&level_discs(draws, 100 + seed), rays(1 << 11));
        let gap = gap(&found.rows);
        let by_rays = gap.parts.expect("there are several draws").by_rays;
        for (sum, error) in squares.iter_mut().zip([gap.error, by_rays]) {
            *sum += ((gap.value - mean) / error).powi(2);
        }
    }
    let [whole, rays] = squares.map(|sum| sum / repetitions as f64);
    // Student's t of 7 degrees of freedom has the variance 7 / 5; over 60 repetitions that is uncertain by
    // √((κ − 1) / 60) of itself, with the kurtosis κ = 3 + 6 / 3.
    assert!(
        (whole / 1.4 - 1.0).abs() < 3.0 * (4.0_f64 / 60.0).sqrt(),
        "{whole}"
    );
    assert!(rays > 4.0, "errors by rays alone are far too small: {rays}");
}

#[test]
fn draws_are_the_same_on_any_number_of_threads_and_differ_from_each_other() {
    let text = level_discs(3, 1);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.expect("there are threads");
        pool.install(|| drawn(&text, rays(1 << 10)))
    };
    let one = run(1);
    assert_eq!(one, run(3));
    let parts = gap(&one.rows).parts.expect("there are several draws");
    assert!(parts.by_draws > 0.0, "{parts:?}");
    // A single draw is what it is without the key.
    let single = drawn(&level_discs(1, 1), rays(1 << 10));
    let plain = level_discs(1, 1).replace("realisations = 1\n", "");
    assert_eq!(single, drawn(&plain, rays(1 << 10)));
    assert!(single.rows.iter().all(|row| row.parts.is_none()));
}

#[test]
fn after_all_draws_the_world_is_that_of_the_first_again() {
    let mut scene = built(&level_discs(4, 1));
    let before = figures_of(&scene, &rays(1 << 10));
    let mean = drawn_of(&mut scene, rays(1 << 10)).rows;
    assert_eq!(figures_of(&scene, &rays(1 << 10)), before);
    assert_ne!(Ok(mean), before);
}
