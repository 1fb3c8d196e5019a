use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use super::super::inclination::InclinationTable;
use super::*;

const DE_WIT: [Inclination; 6] = [
    Inclination::Spherical,
    Inclination::Uniform,
    Inclination::Planophile,
    Inclination::Erectophile,
    Inclination::Plagiophile,
    Inclination::Extremophile,
];

#[test]
fn mean_inclinations_are_those_of_their_densities() {
    // ∫ θ g dθ in closed form; plagiophile and extremophile are symmetric about 45°.
    let pi = std::f64::consts::PI;
    let expected = [
        1.0,
        pi / 4.0,
        pi / 4.0 - 1.0 / pi,
        pi / 4.0 + 1.0 / pi,
        pi / 4.0,
        pi / 4.0,
    ];
    for (kind, expected) in DE_WIT.into_iter().zip(expected) {
        let count = 20_000;
        let angles = (0..count).map(|i| kind.angle((f64::from(i) + 0.5) / f64::from(count)));
        let mean = angles.sum::<f64>() / f64::from(count);
        assert!(
            (mean - expected).abs() < 1e-6,
            "{kind:?}: {mean} for {expected}"
        );
    }
}

#[test]
fn leaves_of_a_spherical_volume_cast_half_their_area_whatever_the_sun() {
    let volume = Volume {
        within: [DVec3::new(-1.0, 2.0, 0.0), DVec3::new(3.0, 3.0, 0.5)],
        lai: 5.0,
        inclination: Inclination::Spherical,
        arrangement: Arrangement::Even,
        seed: 3,
    };
    let places = volume
        .places(&[2e-4], Most::UNBOUND)
        .expect("there is room");
    assert_eq!(places.len(), 100_000);
    for sun in [DVec3::Z, DVec3::X, DVec3::new(0.0, 0.6, 0.8)] {
        let cast = places.iter().map(|place| {
            let normal = place.to_world.matrix3.z_axis;
            assert!((normal.length() - 1.0).abs() < 1e-12 && normal.z >= 0.0);
            normal.dot(sun).abs()
        });
        let mean = cast.sum::<f64>() / places.len() as f64;
        // |cos| is even in [0, 1]: its deviation is 1/√12.
        assert!((mean - 0.5).abs() < 4.0 / (12.0 * 1e5_f64).sqrt(), "{mean}");
    }
    let middle = places.iter().map(|place| place.to_world.translation);
    let middle = middle.sum::<DVec3>() / places.len() as f64;
    assert!(
        (middle - DVec3::new(1.0, 2.5, 0.25)).length() < 0.02,
        "{middle}"
    );
}

#[test]
fn shapes_of_a_list_take_turns_and_give_the_leaf_area_index() {
    let areas = [1e-3, 5e-3, 3e-2];
    let volume = Volume {
        within: [DVec3::ZERO, DVec3::ONE],
        lai: 1.2,
        inclination: Inclination::Uniform,
        arrangement: Arrangement::Even,
        seed: 8,
    };
    let places = volume.places(&areas, Most::UNBOUND).expect("there is room");
    assert_eq!(places.len(), 100);
    let lai: f64 = places.iter().map(|place| areas[place.body as usize]).sum();
    assert!((lai - 1.2).abs() <= 3e-2, "{lai}");
    let of = |body: u32| places.iter().filter(|place| place.body == body).count();
    assert_eq!([of(0), of(1), of(2)], [34, 33, 33]);
}

#[test]
fn less_than_a_leaf_and_too_many_are_refused() {
    let volume = |lai: f64| Volume {
        within: [DVec3::ZERO, DVec3::ONE],
        lai,
        inclination: Inclination::Uniform,
        arrangement: Arrangement::Even,
        seed: 1,
    };
    let none = volume(0.001).places(&[1.0], Most::UNBOUND);
    assert!(matches!(none, Err(VolumeError::None { .. })), "{none:?}");
    let many = volume(10.0).places(&[1e-8], Most::UNBOUND);
    assert!(matches!(many, Err(VolumeError::TooMany { .. })), "{many:?}");
}

/// De Wit's six as Beta distributions, μ and ν as \[goel1984\] gives them.
const GOEL: [[f64; 2]; 6] = [
    [1.101, 1.930],
    [1.0, 1.0],
    [2.770, 1.172],
    [1.172, 2.770],
    [3.326, 3.326],
    [0.433, 0.433],
];

/// χ of ellipsoids from upright to level leaves.
const CHIS: [f64; 5] = [0.2, 0.7, 1.0, 1.5, 5.0];

fn all() -> impl Iterator<Item = Inclination> {
    let beta = GOEL.map(|[mu, nu]| Inclination::Beta { mu, nu });
    let ellipsoidal = CHIS.map(|chi| Inclination::Ellipsoidal { chi });
    let rows = vec![
        [5.0, 0.5],
        [30.0, 2.0],
        [50.0, 0.0],
        [60.0, 0.0],
        [90.0, 3.0],
    ];
    let table = InclinationTable::new(rows).expect("it is sound");
    DE_WIT
        .into_iter()
        .chain(beta)
        .chain(ellipsoidal)
        .chain([Inclination::Table(table)])
}

/// `∫ f g dθ` from one inclination to another.
fn by_density(kind: &Inclination, [low, high]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    // Midpoints in the fourth root of the distance from the ends, where densities may be infinite.
    let count = 4000;
    let (mut sum, middle) = (0.0, 0.5 * (low + high));
    for i in 0..count {
        let s = (f64::from(i) + 0.5) / f64::from(count);
        let near = s.powi(4).max(1e-12);
        let slope = 4.0 * s.powi(3) / f64::from(count) * (middle - low);
        for theta in [low + near * (middle - low), high - near * (high - middle)] {
            sum += f(theta) * kind.density(theta) * slope;
        }
    }
    sum
}

fn of(inclination: Inclination, lai: f64) -> Volume {
    Volume {
        within: [DVec3::ZERO, DVec3::ONE],
        lai,
        inclination,
        arrangement: Arrangement::Even,
        seed: 5,
    }
}

#[test]
fn inclinations_are_drawn_as_their_densities_say() {
    // χ² of 18 classes of 5° against the integrals of the density.
    for kind in all() {
        let places = of(kind.clone(), 1.0)
            .places(&[1e-5], Most::UNBOUND)
            .expect("there is room");
        let count = places.len() as f64;
        let mut classes = [0.0; 18];
        for place in &places {
            let angle = libm::acos(place.to_world.matrix3.z_axis.z).to_degrees();
            classes[((angle / 5.0) as usize).min(17)] += 1.0;
        }
        let mut chi2 = 0.0;
        for (i, found) in classes.into_iter().enumerate() {
            let ends = [i, i + 1].map(|i| (5.0 * i as f64).to_radians());
            let expected = count * by_density(&kind, ends, |_| 1.0);
            if expected < 1e-6 {
                assert_eq!(found, 0.0, "{kind:?}");
            } else {
                chi2 += (found - expected).powi(2) / expected;
            }
        }
        // 17 degrees of freedom: 47 is exceeded once in 10,000; eighteen distributions are tried.
        assert!(chi2 < 47.0, "{kind:?}: {chi2}");
    }
}

#[test]
fn the_beta_distributions_of_de_wits_six_have_their_mean_inclinations() {
    let pi = PI;
    let de_wit = [
        1.0,
        pi / 4.0,
        pi / 4.0 - 1.0 / pi,
        pi / 4.0 + 1.0 / pi,
        pi / 4.0,
        pi / 4.0,
    ];
    for ([mu, nu], expected) in GOEL.into_iter().zip(de_wit) {
        let kind = Inclination::Beta { mu, nu };
        let mean = by_density(&kind, [0.0, FRAC_PI_2], |theta| theta);
        assert!((mean - FRAC_PI_2 * nu / (mu + nu)).abs() < 1e-4, "{mean}");
        assert!(
            (mean - expected).abs() < 0.01,
            "{mu} {nu}: {mean} {expected}"
        );
    }
}

/// Mean of |cos| between leaves of one inclination, all azimuths, and a direction: \[warren1960\].
fn projection(theta_leaf: f64, theta_sun: f64) -> f64 {
    let (sin_l, cos_l) = libm::sincos(theta_leaf);
    let (sin_s, cos_s) = libm::sincos(theta_sun);
    let product = cos_l * cos_s / (sin_l * sin_s);
    if product.abs() >= 1.0 || product.is_nan() {
        return cos_l * cos_s;
    }
    let turn = libm::acos(product);
    cos_l * cos_s * (1.0 + FRAC_2_PI * (libm::tan(turn) - turn))
}

#[test]
fn leaves_cast_the_shade_of_their_projection_function_whatever_the_sun() {
    for kind in all() {
        let places = of(kind.clone(), 1.0)
            .places(&[1e-5], Most::UNBOUND)
            .expect("there is room");
        for degrees in [0.0_f64, 20.0, 45.0, 57.5, 80.0] {
            let theta = degrees.to_radians();
            let sun = DVec3::new(libm::sin(theta), 0.0, libm::cos(theta));
            let cast = places
                .iter()
                .map(|place| place.to_world.matrix3.z_axis.dot(sun).abs());
            let mean = cast.sum::<f64>() / places.len() as f64;
            let whole = [0.0, FRAC_PI_2];
            let expected = by_density(&kind, whole, |leaf| projection(leaf, theta));
            // |cos| lies between 0 and 1: its deviation is 1/2 at most.
            let slack = 4.0 * 0.5 / (places.len() as f64).sqrt();
            assert!(
                (mean - expected).abs() < slack,
                "{kind:?} {degrees}: {mean} {expected}"
            );
            if kind == Inclination::Spherical {
                assert!((expected - 0.5).abs() < 1e-4, "{expected}");
            }
        }
    }
}

/// Λ of \[campbell1990\]: half of an ellipsoid's surface over π times the product of its axes.
fn half_surface(chi: f64) -> f64 {
    if chi < 1.0 {
        let e = (1.0 - chi * chi).sqrt();
        chi + libm::asin(e) / e
    } else if chi > 1.0 {
        let e = (1.0 - 1.0 / (chi * chi)).sqrt();
        chi + libm::log((1.0 + e) / (1.0 - e)) / (2.0 * e * chi)
    } else {
        2.0
    }
}

#[test]
fn ellipsoidal_leaves_shade_as_campbells_extinction_coefficient_says() {
    for chi in CHIS {
        let kind = Inclination::Ellipsoidal { chi };
        let places = of(kind.clone(), 2.0)
            .places(&[1e-5], Most::UNBOUND)
            .expect("there is room");
        for degrees in [0.0_f64, 30.0, 57.5, 75.0, 85.0] {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            // G = K cos θ, K = √(χ² + tan² θ) / Λ.
            let expected = (chi * chi * cos * cos + sin * sin).sqrt() / half_surface(chi);
            let whole = [0.0, FRAC_PI_2];
            let exact = by_density(&kind, whole, |leaf| projection(leaf, degrees.to_radians()));
            assert!(
                (exact - expected).abs() < 2e-4,
                "{chi} {degrees}: {exact} {expected}"
            );
            let sun = DVec3::new(sin, 0.0, cos);
            let cast = places
                .iter()
                .map(|place| place.to_world.matrix3.z_axis.dot(sun).abs());
            let mean = cast.sum::<f64>() / places.len() as f64;
            // The deviation of |cos| is 1/2 at most.
            let slack = 4.0 * 0.5 / (places.len() as f64).sqrt();
            assert!(
                (mean - expected).abs() < slack,
                "{chi} {degrees}: {mean} {expected}"
            );
        }
    }
}

#[test]
fn ellipsoidal_leaves_have_the_mean_inclination_of_an_ellipsoids_surface() {
    for chi in [0.1, 0.3, 0.5, 1.0, 2.0, 4.0, 10.0] {
        let kind = Inclination::Ellipsoidal { chi };
        let count = 20_000;
        let midpoints = || (0..count).map(|i| (f64::from(i) + 0.5) / f64::from(count));
        let mean = midpoints().map(|u| kind.angle(u)).sum::<f64>() / f64::from(count);
        // Rings of the surface (χ sin t, cos t), each with its area.
        let rings = midpoints().map(|t| {
            let (sin, cos) = libm::sincos(FRAC_PI_2 * t);
            let area = sin * (chi * chi * cos * cos + sin * sin).sqrt();
            (area, area * libm::atan2(sin, chi * cos))
        });
        let (area, turned) = rings.fold((0.0, 0.0), |sum, ring| (sum.0 + ring.0, sum.1 + ring.1));
        assert!(
            (mean - turned / area).abs() < 1e-6,
            "{chi}: {mean} {}",
            turned / area
        );
    }
    let sphere = Inclination::Ellipsoidal { chi: 1.0 };
    for u in [0.0, 0.2, 0.5, 0.9, 1.0 - 1e-12] {
        let expected = libm::acos(1.0 - u);
        assert!((sphere.angle(u) - expected).abs() < 1e-6, "{u}");
    }
}

#[test]
fn a_table_of_two_rows_has_the_mean_of_a_triangle() {
    let table = InclinationTable::new(vec![[0.0, 0.0], [90.0, 7.0]]).expect("it is sound");
    let kind = Inclination::Table(table);
    // Density 2 t of t = θ / 90°: its mean is 2/3, half of the leaves lie below √½.
    assert!((kind.angle(0.5) - FRAC_PI_2 * 0.5_f64.sqrt()).abs() < 1e-12);
    let mean = by_density(&kind, [0.0, FRAC_PI_2], |theta| theta);
    assert!((mean - FRAC_PI_2 * 2.0 / 3.0).abs() < 1e-5, "{mean}");
    for (rows, problem) in [
        (vec![[0.0, 1.0], [0.0, 2.0]], "row 2: 0° does not"),
        (vec![[0.0, 1.0], [91.0, 2.0]], "row 2: 91° does not"),
        (vec![[0.0, 1.0], [9.0, -2.0]], "row 2: the density -2"),
        (vec![[0.0, 0.0], [9.0, 0.0]], "no density"),
        (vec![[0.0, 1.0]], "no density"),
    ] {
        let error = InclinationTable::new(rows).expect_err(problem).to_string();
        assert!(error.starts_with(problem), "{error}");
    }
}

#[test]
fn rows_keep_their_distance_and_fill_their_width() {
    let volume = Volume {
        arrangement: Arrangement::Rows {
            spacing: 0.25,
            width: 0.1,
        },
        within: [DVec3::new(-1.0, 0.0, 0.0), DVec3::new(1.0, 3.0, 0.5)],
        ..of(Inclination::Spherical, 1.0)
    };
    let places = volume
        .places(&[2e-4], Most::UNBOUND)
        .expect("there is room");
    let mut rows = [0; 8];
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for place in &places {
        let x = place.to_world.translation.x + 1.0;
        let off = x.rem_euclid(0.25) - 0.125;
        assert!(off.abs() <= 0.05 + 1e-12, "{x}");
        (least, most) = (least.min(off), most.max(off));
        rows[(x / 0.25) as usize] += 1;
    }
    assert!(least < -0.0499 && most > 0.0499, "{least} {most}");
    let expected = places.len() as f64 / 8.0;
    for count in rows {
        assert!(
            (f64::from(count) - expected).abs() < 4.0 * expected.sqrt(),
            "{rows:?}"
        );
    }
}

#[test]
fn crowns_are_balls_of_even_density_and_have_as_many_leaves_each() {
    let centres = vec![DVec3::new(0.2, 0.5, 0.4), DVec3::new(0.95, 0.5, 0.6)];
    let radius = 0.15;
    let volume = Volume {
        arrangement: Arrangement::Crowns {
            radius,
            centres: Centres::At(centres.clone()),
        },
        ..of(Inclination::Spherical, 2.0)
    };
    let places = volume
        .places(&[1e-4], Most::UNBOUND)
        .expect("there is room");
    let (mut of_first, mut inner, mut wrapped) = (0, 0, 0);
    for place in &places {
        let at = place.to_world.translation;
        let apart = |centre: &DVec3| {
            // By the nearest copy of the crown.
            let mut off = at - *centre;
            off.x -= off.x.round();
            off.y -= off.y.round();
            off.length()
        };
        let [first, second] = [apart(&centres[0]), apart(&centres[1])];
        let nearest = first.min(second);
        assert!(nearest <= radius + 1e-12, "{at}");
        assert!(
            (0.0..1.0).contains(&at.x) && (0.0..1.0).contains(&at.y),
            "{at}"
        );
        of_first += usize::from(first < second);
        wrapped += usize::from(second <= radius && at.x < 0.5);
        // Half of the volume lies within this radius.
        inner += usize::from(nearest < radius * libm::cbrt(0.5));
    }
    assert_eq!(2 * of_first, places.len());
    let half = places.len() as f64 / 2.0;
    assert!(
        (inner as f64 - half).abs() < 4.0 * (half / 2.0).sqrt(),
        "{inner}"
    );
    assert!(
        wrapped > 1000,
        "a crown at a side comes in at the other: {wrapped}"
    );
}

#[test]
fn random_crowns_fit_into_the_height_of_the_box_and_differ_by_seed() {
    let crowns = |seed| Volume {
        arrangement: Arrangement::Crowns {
            radius: 0.2,
            centres: Centres::Random(7),
        },
        seed,
        ..of(Inclination::Spherical, 1.0)
    };
    let [a, b] =
        [crowns(1), crowns(2)].map(|volume| volume.places(&[1e-3], Most::UNBOUND).expect("room"));
    let heights = a.iter().map(|place| place.to_world.translation.z);
    let (least, most) = heights.fold((1.0_f64, 0.0_f64), |(l, m), z| (l.min(z), m.max(z)));
    assert!(least >= 0.0 && most <= 1.0, "{least} {most}");
    assert_ne!(a[0].to_world.translation, b[0].to_world.translation);
}
