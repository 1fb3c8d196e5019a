//! Measures of margins that are known in closed form.

use std::f64::consts::{PI, TAU};

use glam::DVec2;
use proptest::prelude::*;

use super::*;
use properties::fixed;

fn outline(points: Vec<DVec2>, base: (f64, f64), apex: (f64, f64)) -> Outline {
    Outline::new(points, base.into(), apex.into()).expect("a simple margin")
}

fn corners(points: &[(f64, f64)], base: (f64, f64), apex: (f64, f64)) -> Outline {
    let points = points.iter().copied().map(DVec2::from).collect();
    outline(points, base, apex)
}

/// An ellipse with its base at the origin and the midrib along y.
fn ellipse(across: f64, along: f64, n: usize) -> Outline {
    let point = |i: usize| {
        let angle = TAU * i as f64 / n as f64;
        DVec2::new(across * libm::sin(angle), along * (1.0 - libm::cos(angle)))
    };
    outline((0..n).map(point).collect(), (0.0, 0.0), (0.0, 2.0 * along))
}

fn near(measures: &Measures, key: &str, expected: f64, tolerance: f64) {
    let value = measures.number(key);
    let value = value.unwrap_or_else(|| panic!("{key} is missing"));
    assert!(
        (value - expected).abs() <= tolerance,
        "{key} is {value}, not {expected}"
    );
}

fn fourier(measures: &Measures) -> Vec<f64> {
    let entry = measures
        .entries()
        .iter()
        .find(|entry| entry.key == "elliptic_fourier");
    match entry.map(|entry| &entry.value) {
        Some(Value::List(list)) => list.clone(),
        other => panic!("{other:?}"),
    }
}

/// All descriptors are 0 but those listed as (harmonic, [a, b, c, d]).
fn only(measures: &Measures, expected: &[(usize, [f64; 4])], tolerance: f64) {
    for (n, found) in fourier(measures).chunks(4).enumerate() {
        let wanted = expected
            .iter()
            .find(|(harmonic, _)| *harmonic == n + 1)
            .map_or([0.0; 4], |(_, values)| *values);
        for (value, wanted) in found.iter().zip(wanted) {
            assert!(
                (value - wanted).abs() <= tolerance,
                "harmonic {}: {found:?}",
                n + 1
            );
        }
    }
}

#[test]
fn a_circle_is_as_wide_as_long_round_and_solid() {
    // A polygon of n corners in a circle: area and perimeter fall short by (2π/n)²/6 and /24.
    let n = 4000;
    let short = libm::pow(TAU / n as f64, 2.0);
    let measures = shape(&ellipse(3.0, 3.0, n));
    near(&measures, "length_mm", 6.0, 1e-12);
    near(&measures, "width_mm", 6.0, 6.0 * short);
    near(&measures, "width_over_length", 1.0, short);
    near(&measures, "circularity", 1.0, short);
    near(&measures, "solidity", 1.0, 1e-12);
    near(&measures, "widest_at", 0.5, 1e-12);
    near(&measures, "area_mm2", 9.0 * PI, 9.0 * PI * short);
    near(&measures, "perimeter_mm", 6.0 * PI, 6.0 * PI * short);
    only(&measures, &[(1, [1.0, 0.0, 0.0, 1.0])], 1e-6);
}

#[test]
fn an_ellipse_has_its_axes_and_its_perimeter() {
    let (across, along) = (2.0, 5.0);
    let measures = shape(&ellipse(across, along, 4000));
    near(&measures, "width_over_length", across / along, 1e-6);
    near(&measures, "area_mm2", PI * across * along, 1e-4);
    // Ramanujan's series h = ((a − b)/(a + b))²: π (a + b)(1 + h/4 + h²/64 + h³/256 + …), the rest
    // below h⁴/1000.
    let h = libm::pow((along - across) / (along + across), 2.0);
    let round = PI * (along + across) * (1.0 + h / 4.0 + h * h / 64.0 + h * h * h / 256.0);
    near(&measures, "perimeter_mm", round, 0.001);
    near(&measures, "solidity", 1.0, 1e-12);
    near(&measures, "widest_at", 0.5, 1e-12);
}

#[test]
fn a_square_has_the_descriptors_of_one() {
    let square = [(-1.0, 0.0), (1.0, 0.0), (1.0, 2.0), (-1.0, 2.0)];
    let measures = shape(&corners(&square, (0.0, 0.0), (0.0, 2.0)));
    near(&measures, "width_over_length", 1.0, 0.0);
    near(&measures, "circularity", PI / 4.0, 1e-15);
    near(&measures, "solidity", 1.0, 1e-15);
    near(&measures, "widest_at", 0.5, 1e-15);
    near(&measures, "perimeter_mm", 8.0, 0.0);
    // The corners of a regular m-gon turn about its centre, so that only harmonics 1 + m j exist,
    // as 1/(1 + m j)²; seen from the middle of a side their signs alternate.
    let square_of = |k: f64| -1.0 / (k * k);
    let mut expected = vec![(1, [1.0, 0.0, 0.0, 1.0])];
    for j in 1..=5 {
        let sign = if j % 2 == 1 { 1.0 } else { -1.0 };
        let (back, forth) = (4 * j - 1, 4 * j + 1);
        let size = sign * square_of(back as f64);
        expected.push((back, [size, 0.0, 0.0, -size]));
        let size = sign * square_of(forth as f64);
        expected.push((forth, [size, 0.0, 0.0, size]));
    }
    only(&measures, &expected, 1e-12);
}

#[test]
fn a_triangle_is_widest_at_its_base() {
    let height = 3.0_f64.sqrt();
    let triangle = [(-1.0, 0.0), (1.0, 0.0), (0.0, height)];
    let measures = shape(&corners(&triangle, (0.0, 0.0), (0.0, height)));
    near(&measures, "width_over_length", 2.0 / height, 1e-15);
    near(&measures, "circularity", PI / (3.0 * height), 1e-14);
    near(&measures, "solidity", 1.0, 1e-15);
    near(&measures, "widest_at", 0.0, 0.0);
    let mut expected = vec![(1, [1.0, 0.0, 0.0, 1.0])];
    for j in 1..=7 {
        let (back, forth) = (3 * j - 1, 3 * j + 1);
        let size = 1.0 / libm::pow(back as f64, 2.0);
        expected.push((back, [size, 0.0, 0.0, -size]));
        let size = 1.0 / libm::pow(forth as f64, 2.0);
        expected.push((forth, [size, 0.0, 0.0, size]));
    }
    only(&measures, &expected, 1e-12);
}

#[test]
fn lobes_that_pass_the_ends_of_the_midrib_count_as_extent_and_not_as_length() {
    // A butterfly: the midrib from (0, 0) to (0, 1), wings from −1 to 3.
    let wings = [
        (0.0, 0.0),
        (1.0, -1.0),
        (2.0, 3.0),
        (0.0, 1.0),
        (-2.0, 3.0),
        (-1.0, -1.0),
    ];
    let measures = shape(&corners(&wings, (0.0, 0.0), (0.0, 1.0)));
    near(&measures, "length_mm", 1.0, 0.0);
    near(&measures, "extent_over_length", 4.0, 1e-15);
    near(&measures, "width_over_length", 4.0, 1e-15);
    near(&measures, "widest_at", 3.0, 1e-15);
    // Hull: trapezoid of widths 2 and 4, height 4; the blade misses one triangle of area 1 below
    // and one of 4 above.
    near(&measures, "solidity", 7.0 / 12.0, 1e-15);
}

#[test]
fn the_measures_of_a_leaf_begin_with_those_of_its_shape() {
    let blade = ellipse(2.0, 3.0, 40);
    let network =
        crate::venation::testing::network(&[DVec2::ZERO, DVec2::new(0.0, 5.0)], &[[0, 1]]);
    let whole = measure(&blade, &network, 2.0);
    let of_shape = shape(&blade);
    let count = of_shape.entries().len();
    assert_eq!(of_shape.entries(), &whole.entries()[..count]);
    assert_eq!(fourier(&whole).len(), 80);
}

proptest! {
    #![proptest_config(fixed(64))]

    #[test]
    fn shape_does_not_depend_on_place_size_direction_or_the_first_corner(
        angle in 0.0..TAU, size in 0.1..10.0, x in -50.0..50.0, y in -50.0..50.0, first in 0_usize..120,
    ) {
        let point = |i: usize| {
            let turn = TAU * i as f64 / 120.0;
            let radius = 2.0 + 0.7 * libm::cos(2.0 * turn) + 0.3 * libm::sin(3.0 * turn);
            radius * DVec2::new(libm::cos(turn), libm::sin(turn))
        };
        let points: Vec<DVec2> = (0..120).map(point).collect();
        let (base, apex) = ((-1.0, 0.0), (1.5, 0.4));
        let one = shape(&outline(points.clone(), base, apex));
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        let image = |p: DVec2| size * DVec2::new(c * p.x - s * p.y, s * p.x + c * p.y) + DVec2::new(x, y);
        let mut moved: Vec<DVec2> = points.iter().map(|&p| image(p)).collect();
        moved.rotate_left(first);
        let (base, apex) = (image(base.into()), image(apex.into()));
        let other = shape(&outline(moved, base.into(), apex.into()));
        for key in ["width_over_length", "extent_over_length", "widest_at", "circularity", "solidity"] {
            let (one, other) = (one.number(key), other.number(key));
            let (Some(one), Some(other)) = (one, other) else { panic!("{key} is missing") };
            // Coordinates of up to 100 about a blade of 0.4 lose three of sixteen digits.
            prop_assert!((one - other).abs() < 1e-11, "{} is {} and {}", key, one, other);
        }
        for (one, other) in fourier(&one).iter().zip(fourier(&other)) {
            prop_assert!((one - other).abs() < 1e-11, "{} {}", one, other);
        }
    }
}
