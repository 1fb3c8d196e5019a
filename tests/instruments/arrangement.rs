//! Gaps of canopies whose leaves are inclined, in rows or in crowns, against closed forms.

use std::f64::consts::PI;

use renderer::instruments::Direction;

use super::canopy::discs;
use super::{NORMAL, figures, of, rays};

/// Discs as in the other canopies, with more keys of their volume, and a canopy with keys.
fn field([radius, lai]: [f64; 2], volume: &str, canopy: &str) -> String {
    let discs = discs(radius, lai, [0.0, 1.0]);
    let arranged = discs.replace(", seed = 4", &format!(", {volume}"));
    assert_ne!(arranged, discs);
    format!(
        "{arranged}[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550]\n\
         soil = \"ground\"\n{canopy}"
    )
}

/// Rays that leave less noise than a set of discs does.
const MANY: u64 = 1 << 16;

/// Light of some directions that arrives at the soil as it came, and its error.
fn gaps(text: &str, directions: &[Direction], count: u64) -> Vec<(f64, f64)> {
    let rows = figures(text, &rays(count)).expect("it can be measured");
    let gap = |direction: &Direction| {
        let row = of(&rows, "uncollided", *direction, 550.0).next();
        let row = row.expect("it is measured");
        (row.value, row.error)
    };
    directions.iter().map(gap).collect()
}

/// The deviation of one set of discs: that of about 1 / (π r²) independent places.
fn of_places(radius: f64) -> f64 {
    (0.14 * PI).sqrt() * radius
}

#[test]
#[ignore = "deep: 6 s"]
fn level_and_upright_leaves_leave_the_gaps_of_their_projection() {
    // exp(−G LAI) from above, where G is the mean of cos θ: 8/3π of planophile, 4/3π of erectophile
    // leaves, ½ of spherical ones. Beta with µ = 1, ν = 1 is uniform: 2/π.
    let radius = 0.004;
    for (inclination, projection) in [
        ("inclination = \"planophile\"", 8.0 / (3.0 * PI)),
        ("inclination = \"erectophile\"", 4.0 / (3.0 * PI)),
        ("inclination = \"spherical\"", 0.5),
        ("inclination = \"beta\", beta = [1, 1]", 2.0 / PI),
    ] {
        let text = field([radius, 1.0], &format!("{inclination}, seed = 4"), "");
        let [(gap, error)] = gaps(&text, &[NORMAL], MANY)[..] else {
            panic!("one light");
        };
        let expected = libm::exp(-projection);
        let slack = 4.0 * error.hypot(of_places(radius));
        assert!(
            (gap - expected).abs() < slack,
            "{inclination}: {gap} {expected}"
        );
    }
}

#[test]
fn rows_leave_the_gaps_between_them_and_the_denser_ones_within() {
    // 1 − w/s + w/s exp(−G LAI s/w / cos θ) from above and along the rows. Discs reach out of
    // their rows by up to their radius, which takes 1.4 % of the plan at these sizes and hides
    // 5 % of that more.
    let (radius, spacing, width) = (0.002, 0.5, 0.25);
    let volume = format!("rows = {{ spacing_m = {spacing}, width_m = {width} }}, seed = 4");
    let along = 50.0_f64.to_radians();
    let keys = "incidence_deg = [0, 50]\nazimuth_deg = 90\n";
    let text = field([radius, 1.0], &volume, keys);
    let directions = [NORMAL, Direction::Beam(along)];
    let found = gaps(&text, &directions, MANY);
    for ((gap, error), cosine) in found.into_iter().zip([1.0, libm::cos(along)]) {
        let share = width / spacing;
        let within = libm::exp(-0.5 / share / cosine);
        let expected = 1.0 - share + share * within;
        let slack = 4.0 * error.hypot(of_places(radius)) + 1e-3;
        assert!((gap - expected).abs() < slack, "{gap} {expected} ± {slack}");
        // Even leaves would leave far less.
        assert!(gap > libm::exp(-0.5 / cosine) + 5.0 * slack, "{gap}");
    }
}

/// Mean gap through a ball of leaves of radius `radius` and leaf area `area`, over its cross-section,
/// where leaves hide half of their area: ∫ exp(−κ chord) with κ the leaf area density over 2.
fn through_a_crown(radius: f64, area: f64) -> f64 {
    let density = area / (4.0 / 3.0 * PI * radius.powi(3));
    let k = density * radius;
    2.0 * (1.0 - (1.0 + k) * libm::exp(-k)) / (k * k)
}

#[test]
fn crowns_apart_hide_what_their_chords_hide() {
    let (disc, radius, lai) = (0.002, 0.15, 1.0);
    let centres = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.95, 0.75]];
    let places = centres.map(|[x, y]| format!("[{x}, {y}, 0.5]")).join(", ");
    let volume = format!("crowns = {{ radius_m = {radius}, at_m = [{places}] }}, seed = 4");
    let [(gap, error)] = gaps(&field([disc, lai], &volume, ""), &[NORMAL], MANY)[..] else {
        panic!("one light");
    };
    let hidden = 1.0 - through_a_crown(radius, lai / 4.0);
    let expected = 1.0 - 4.0 * PI * radius * radius * hidden;
    // Discs reach out of a crown by up to their radius, where it is thin: of 1.3 % of its radius
    // and half of the leaves' size, less than 1.5 % of its shade.
    let slack = 4.0 * error.hypot(of_places(disc)) + 0.015 * (1.0 - expected);
    assert!((gap - expected).abs() < slack, "{gap} {expected} ± {slack}");
    // The clumping index by which Nilson's form would have these gaps.
    let index = -libm::log(gap) / (0.5 * lai);
    assert!((0.3..0.7).contains(&index), "{index}");
}

#[test]
#[ignore = "deep: 5 s"]
fn crowns_at_random_have_the_gaps_of_nilsons_binomial_form() {
    // Each of N crowns hides the shadow π R² / cos θ of the plan but for what comes through:
    // (1 − π R² / cos θ (1 − p))^N.
    let (disc, radius, lai, crowns) = (0.003, 0.1, 2.0, 40);
    let p = through_a_crown(radius, lai / f64::from(crowns));
    let slant = 50.0_f64.to_radians();
    let directions = [NORMAL, Direction::Beam(slant)];
    let seeds = if super::in_full() { 16 } else { 5 };
    let sets: Vec<Vec<(f64, f64)>> = (1..=seeds)
        .map(|seed| {
            let crowns = format!("crowns = {{ radius_m = {radius}, count = {crowns} }}");
            let volume = format!("{crowns}, seed = {seed}");
            let text = field([disc, lai], &volume, "incidence_deg = [0, 50]\n");
            // Sets of crowns differ by far more than so few rays.
            gaps(&text, &directions, 1 << 13)
        })
        .collect();
    for (number, cosine) in [1.0, libm::cos(slant)].into_iter().enumerate() {
        let values: Vec<f64> = sets.iter().map(|set| set[number].0).collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let error = (squares / (count - 1.0) / count).sqrt();
        let shadow = PI * radius * radius / cosine;
        let expected = (1.0 - shadow * (1.0 - p)).powi(crowns);
        let even = libm::exp(-0.5 * lai / cosine);
        eprintln!("{mean:.4} ± {error:.4} for {expected:.4}, even {even:.4}");
        // Discs reach out of crowns by up to 3 % of the radius.
        let slack = 4.0 * error + 0.02 * (1.0 - expected);
        assert!(
            (mean - expected).abs() < slack,
            "{mean} {expected} ± {slack}"
        );
        assert!(mean > even + 4.0 * error, "{mean} {even}");
    }
}
