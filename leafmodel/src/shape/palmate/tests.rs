//! Unions of lobes.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::*;
use crate::shape::growth_form::{CurvedVein, HalfForm, LateralGrowth};

fn form(axial_rate: f64, rate_ratio: f64) -> GrowthForm {
    GrowthForm {
        rows: 120,
        axial_rate,
        right: HalfForm {
            lateral: LateralGrowth::Peak {
                rate_ratio,
                widest_at: 0.4,
                falloff: 3.0,
            },
            lobe_decay: 0.0,
            lobe_exponent: 1.0,
            veins: Vec::new(),
        },
        left: None,
    }
}

fn axis(degrees: f64, length: f64) -> SecondaryAxis {
    SecondaryAxis {
        position: 0.0,
        angle: degrees.to_radians(),
        paired: true,
        form: form(SecondaryAxis::axial_rate_for(length, 0.1), 1.3),
        axes: Vec::new(),
    }
}

#[test]
fn a_leaf_without_secondary_axes_is_its_main_lobe() {
    let alone = PalmateForm {
        main: form(0.1, 1.3),
        axes: Vec::new(),
    };
    let (one, other) = (
        alone.grow(50.0).expect("good"),
        form(0.1, 1.3).grow(50.0).expect("good"),
    );
    // The boundary starts at the lowest point instead of the base.
    assert!(
        (one.area() - other.area()).abs() < 1e-9
            && (one.perimeter() - other.perimeter()).abs() < 1e-9
    );
}

#[test]
fn axes_get_as_long_as_their_own_growth_makes_them() {
    let palm = PalmateForm {
        main: form(0.1, 1.3),
        axes: vec![axis(50.0, 0.8), axis(100.0, 0.5)],
    };
    let lines = palm.axis_lines(60.0).expect("good");
    let lengths = lines.iter().map(|[base, tip]| (*tip - *base).length());
    for (length, expected) in lengths.zip([60.0, 48.0, 48.0, 30.0, 30.0]) {
        assert!(
            (length - expected).abs() < 1e-9,
            "{length} is not {expected}"
        );
    }
    let outline = palm.grow(60.0).expect("good");
    // Lobes overlap, so that they cover less than they do one by one, and all of each.
    let lobes = palm.lobes(60.0).expect("good");
    let mut sum = 0.0;
    for (_, points) in &lobes {
        let scaled: Vec<DVec2> = points.iter().map(|&p| p * 60.0).collect();
        assert!(scaled.iter().all(|&p| outline.covers(p)));
        sum += Outline::new(scaled.clone(), scaled[0], scaled[60])
            .expect("simple")
            .area();
    }
    assert!(outline.area() < 0.95 * sum && outline.area() > 0.5 * sum);
}

#[test]
fn a_paired_palm_is_its_own_mirror_image() {
    let palm = PalmateForm {
        main: form(0.1, 1.3),
        axes: vec![SecondaryAxis {
            axes: vec![axis(40.0, 0.4)],
            ..axis(50.0, 0.8)
        }],
    };
    let outline = palm.grow(60.0).expect("good");
    for &p in outline.points() {
        let mirrored = DVec2::new(-p.x, p.y);
        assert!(outline.distance_to_margin(mirrored) < 1e-9, "{p}");
    }
}

#[test]
fn axes_that_lie_on_each_other_or_opposite_unite_too() {
    for degrees in [0.0, 30.0, 45.0, 90.0, 180.0] {
        for length in [1.0, 0.5] {
            let palm = PalmateForm {
                main: form(0.1, 1.3),
                axes: vec![axis(degrees, length), axis(degrees, length)],
            };
            let outline = palm.grow(80.0);
            assert!(outline.is_ok(), "{degrees}, {length}: {outline:?}");
        }
    }
}

#[test]
fn what_no_leaf_has_is_refused_by_name() {
    let with = |axis: SecondaryAxis| PalmateForm {
        main: form(0.1, 1.3),
        axes: vec![axis],
    };
    let bad = [
        (
            "axes.position",
            SecondaryAxis {
                position: 1.5,
                ..axis(50.0, 0.8)
            },
        ),
        (
            "axes.angle",
            SecondaryAxis {
                angle: 4.0,
                ..axis(50.0, 0.8)
            },
        ),
        ("axes.length", axis(50.0, 0.005)),
        (
            "axial_rate",
            SecondaryAxis {
                form: form(f64::NAN, 1.3),
                ..axis(50.0, 0.8)
            },
        ),
    ];
    for (expected, axis) in bad {
        match with(axis).grow(50.0) {
            Err(GrowthFormError::OutOfRange { key, .. }) => assert_eq!(key, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
    let mut many = axis(50.0, 0.8);
    for _ in 0..8 {
        many = SecondaryAxis {
            axes: vec![many.clone()],
            ..many
        };
    }
    assert!(matches!(
        with(many).grow(50.0),
        Err(GrowthFormError::OutOfRange { .. })
    ));
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2005), failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn lobes_unite_to_a_margin_that_covers_them_all(
        axes in proptest::collection::vec((0.0..0.7, 15.0..115.0_f64, 0.2..1.1_f64, 1.1..1.6_f64, -0.5..1.0_f64), 1..4),
        decay in 0.0..0.01, paired: bool,
    ) {
        let lobe = |(position, degrees, length, ratio, slope): (f64, f64, f64, f64, f64)| {
            let mut axis = SecondaryAxis { position, paired, ..axis(degrees, length) };
            axis.form.right.lateral = LateralGrowth::Peak { rate_ratio: ratio, widest_at: 0.4, falloff: 3.0 };
            axis.form.right.lobe_decay = decay;
            axis.form.right.veins = [0.25, 0.5, 0.75].map(|position| CurvedVein { position, slope, bend: 1.0 }).to_vec();
            axis
        };
        let palm = PalmateForm { main: form(0.1, 1.3), axes: axes.into_iter().map(lobe).collect() };
        let outline = palm.grow(80.0);
        prop_assert!(outline.is_ok(), "{outline:?}");
        let outline = outline.expect("just checked");
        for (_, points) in palm.lobes(80.0).expect("good") {
            for p in points {
                prop_assert!(outline.covers(p * 80.0), "{p}");
            }
        }
    }
}
