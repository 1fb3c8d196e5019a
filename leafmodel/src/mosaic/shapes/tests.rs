use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::mosaic::shapes::lathe::lathe;

use super::*;

/// Areas of the triangles, longest edge, Euler characteristic, number of open edges.
fn measured(shape: &Shape) -> (Vec<f64>, f64, i64, usize) {
    let mut edges = BTreeMap::new();
    let mut areas = Vec::new();
    let mut longest: f64 = 0.0;
    for face in &shape.faces {
        let [a, b, c] = face.map(|v| shape.positions[v as usize]);
        areas.push(0.5 * (b - a).cross(c - a).length());
        for k in 0..3 {
            let (p, q) = (face[k], face[(k + 1) % 3]);
            let way: &mut [u32; 2] = edges.entry((p.min(q), p.max(q))).or_default();
            way[usize::from(p < q)] += 1;
            longest =
                longest.max(shape.positions[p as usize].distance(shape.positions[q as usize]));
        }
    }
    for (edge, ways) in &edges {
        assert!(
            ways[0] <= 1 && ways[1] <= 1,
            "edge {edge:?} is used {ways:?} times"
        );
    }
    let open = edges.values().filter(|ways| ways[0] + ways[1] == 1).count();
    let euler = shape.positions.len() as i64 - edges.len() as i64 + shape.faces.len() as i64;
    (areas, longest, euler, open)
}

/// Greatest angle between a face and the normals of its corners, radians.
fn worst_normal(shape: &Shape) -> f64 {
    shape
        .faces
        .iter()
        .flat_map(|face| {
            let [a, b, c] = face.map(|v| shape.positions[v as usize]);
            let flat = (b - a).cross(c - a).normalize();
            face.map(|v| libm::acos(flat.dot(shape.normals[v as usize]).clamp(-1.0, 1.0)))
        })
        .fold(0.0, f64::max)
}

fn spread(areas: &[f64]) -> f64 {
    let most = areas.iter().copied().fold(0.0, f64::max);
    let least = areas.iter().copied().fold(f64::INFINITY, f64::min);
    most / least
}

#[test]
fn a_sphere_is_closed_even_and_has_its_area() {
    let shape = sphere(40.0, 2.0).expect("good sizes");
    let (areas, longest, euler, open) = measured(&shape);
    assert_eq!((euler, open), (2, 0));
    assert!(longest <= 2.0, "{longest}");
    let area: f64 = areas.iter().sum();
    let exact = 4.0 * PI * 1600.0;
    // A chord of 2 mm on a radius of 40 mm falls short by about (2 / 40)² / 6 in area.
    assert!(area < exact && area > exact * 0.999, "{area}");
    assert!(spread(&areas) < 2.2, "{}", spread(&areas));
    assert!(worst_normal(&shape) < 2.0 / 40.0);
}

#[test]
fn an_ellipsoid_has_normals_square_to_its_surface() {
    let axes = DVec3::new(30.0, 30.0, 45.0);
    let shape = ellipsoid(axes, 2.0).expect("good sizes");
    let (_, longest, euler, open) = measured(&shape);
    assert_eq!((euler, open), (2, 0));
    assert!(longest <= 2.0);
    for (p, n) in shape.positions.iter().zip(&shape.normals) {
        assert!(((*p / axes).length() - 1.0).abs() < 1e-12);
        let tangent = n.cross(DVec3::Z);
        assert!((*p / axes / axes).dot(tangent).abs() < 1e-12);
    }
    assert!(worst_normal(&shape) < 0.12, "{}", worst_normal(&shape));
}

#[test]
fn a_rounded_cube_is_closed_and_has_its_area() {
    let (side, radius) = (100.0, 18.0);
    let shape = rounded_cube(side, radius, 3.0).expect("good sizes");
    let (areas, longest, euler, open) = measured(&shape);
    assert_eq!((euler, open), (2, 0));
    assert!(longest <= 3.0 + 1e-9, "{longest}");
    let flat = side - 2.0 * radius;
    let exact = 6.0 * flat * flat + 12.0 * flat * 0.5 * PI * radius + 4.0 * PI * radius * radius;
    let area: f64 = areas.iter().sum();
    assert!((area / exact - 1.0).abs() < 2e-3, "{area} against {exact}");
    assert!(spread(&areas) < 3.0, "{}", spread(&areas));
    assert!(worst_normal(&shape) < 3.0 / radius);
    let ball = rounded_cube(80.0, 40.0, 3.0).expect("good sizes");
    assert!(
        ball.positions
            .iter()
            .all(|p| (p.length() - 40.0).abs() < 1e-9)
    );
}

/// A fruit with a dimple at the stalk and one at the calyx.
fn apple() -> Vec<DVec2> {
    [
        (0.0, 8.0),
        (8.0, 2.0),
        (22.0, 3.0),
        (36.0, 28.0),
        (36.0, 46.0),
        (20.0, 62.0),
        (7.0, 60.0),
        (0.0, 52.0),
    ]
    .map(DVec2::from)
    .to_vec()
}

#[test]
fn a_fruit_from_the_lathe_is_closed_even_and_smooth_at_its_dimples() {
    let shape = lathe(&apple(), 2.0).expect("a good profile");
    let (areas, longest, euler, open) = measured(&shape);
    assert_eq!((euler, open), (2, 0));
    assert!(longest <= 2.0, "{longest}");
    assert!(spread(&areas) < 5.0, "{}", spread(&areas));
    let worst = worst_normal(&shape);
    let fine = lathe(&apple(), 1.0).expect("a good profile");
    assert!(
        worst < 0.5 && worst_normal(&fine) < 0.6 * worst,
        "half the edge, half the angle: {worst}"
    );
    let mut upside_down = apple();
    upside_down.reverse();
    let turned = lathe(&upside_down, 2.0).expect("a good profile");
    assert!(
        worst_normal(&turned) < 0.5,
        "the way of the profile does not matter"
    );
    let volume: f64 = shape
        .faces
        .iter()
        .map(|face| {
            let [a, b, c] = face.map(|v| shape.positions[v as usize]);
            a.cross(b).dot(c) / 6.0
        })
        .sum();
    assert!(volume > 0.0, "faces look outwards");
}

#[test]
fn a_half_circle_on_the_lathe_is_a_sphere() {
    let half: Vec<DVec2> = (0..=16)
        .map(|i| {
            let angle = PI * (f64::from(i) / 16.0 - 0.5);
            let r = if i % 16 == 0 {
                0.0
            } else {
                30.0 * libm::cos(angle)
            };
            DVec2::new(r, 30.0 * libm::sin(angle))
        })
        .collect();
    let shape = lathe(&half, 2.0).expect("a good profile");
    for (p, n) in shape.positions.iter().zip(&shape.normals) {
        assert!((p.length() - 30.0).abs() < 0.02);
        assert!(p.normalize().dot(*n) > 0.9995, "{p} {n}");
    }
    let (areas, ..) = measured(&shape);
    assert!((areas.iter().sum::<f64>() / (4.0 * PI * 900.0) - 1.0).abs() < 3e-3);
}

#[test]
fn a_stem_is_open_at_both_ends() {
    let stem = [(5.0, 0.0), (4.0, 20.0), (4.5, 40.0)].map(DVec2::from);
    let (_, longest, euler, open) = measured(&lathe(&stem, 1.0).expect("a good profile"));
    assert_eq!(euler, 0);
    assert!(open > 40 && longest <= 1.0);
}

#[test]
fn a_sheet_fills_its_outline_evenly() {
    let points = (0..60)
        .map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / 60.0;
            DVec2::new(20.0 * libm::sin(angle), 40.0 - 40.0 * libm::cos(angle))
        })
        .collect();
    let outline =
        Outline::new(points, DVec2::ZERO, DVec2::new(0.0, 80.0)).expect("a simple outline");
    let shape = sheet(&outline, 2.0).expect("good sizes");
    let (areas, longest, euler, open) = measured(&shape);
    assert_eq!(euler, 1);
    assert!(open >= 60 && longest <= 2.0, "{longest}");
    assert!((areas.iter().sum::<f64>() - outline.area()).abs() < 1e-9 * outline.area());
    // The arc cosine of 1 less a rounding error is its square root.
    assert!(worst_normal(&shape) < 1e-6);
}

#[test]
fn bad_sizes_and_profiles_are_named() {
    assert!(
        sphere(0.0, 1.0)
            .expect_err("no radius")
            .to_string()
            .contains("radius_mm is 0")
    );
    let fine = sphere(1e3, 1e-2).expect_err("too many triangles");
    assert!(fine.to_string().starts_with("it would take about"));
    assert!(rounded_cube(10.0, 6.0, 1.0).is_err());
    assert!(ellipsoid(DVec3::new(1.0, f64::NAN, 1.0), 0.1).is_err());
    let profile = |points: &[(f64, f64)]| {
        lathe(
            &points.iter().copied().map(DVec2::from).collect::<Vec<_>>(),
            1.0,
        )
        .expect_err("a bad profile")
        .to_string()
    };
    assert!(profile(&[(1.0, 0.0)]).contains("at least 2 points"));
    assert!(profile(&[(1.0, 0.0), (-1.0, 2.0)]).contains("point 1"));
    assert!(profile(&[(1.0, 0.0), (1.0, 0.0)]).contains("points 0 and 1"));
    assert!(
        profile(&[(0.0, 0.0), (5.0, 5.0), (0.0, 10.0), (5.0, 15.0)]).contains("meets the axis")
    );
}
