//! Unions of lobes.

use proptest::prelude::*;

use super::*;
use properties::fixed;

fn lobe(rate_ratio: f64) -> Axis {
    Axis {
        rows: 120,
        ..HalfForm::entire(rate_ratio, 0.4, 3.0).into()
    }
}

fn palm(axes: Vec<SecondaryAxis>) -> GrowthForm {
    GrowthForm::from(Axis { axes, ..lobe(1.3) })
}

fn axis(degrees: f64, length: f64) -> SecondaryAxis {
    SecondaryAxis {
        position: 0.0,
        angle: degrees.to_radians(),
        paired: true,
        length,
        axis: lobe(1.3),
    }
}

/// The same with axes on it.
fn bearing(axis: SecondaryAxis, axes: Vec<SecondaryAxis>) -> SecondaryAxis {
    SecondaryAxis {
        axis: Axis { axes, ..axis.axis },
        ..axis
    }
}

#[test]
fn an_axis_as_long_as_the_midrib_grows_as_it_does() {
    assert!((axis(10.0, 1.0).axial_rate(0.1) - 0.1).abs() < 1e-15);
    // A lobe that lies on the midrib adds nothing.
    let alone = palm(Vec::new()).grow(50.0).expect("good");
    let twice = palm(vec![SecondaryAxis {
        paired: false,
        ..axis(0.0, 1.0)
    }]);
    let twice = twice.grow(50.0).expect("good");
    assert!((alone.area() - twice.area()).abs() < 1e-5 * alone.area());
    // After T steps the axis is 0.4 · 1000 times as long as its primordium.
    let rate = axis(0.0, 0.4).axial_rate(0.1);
    let steps = libm::log(1000.0) / libm::log(1.1);
    assert!((libm::pow(1.0 + rate, steps) - 400.0).abs() < 1e-9);
}

#[test]
fn axes_get_as_long_as_their_own_growth_makes_them() {
    let palm = palm(vec![axis(50.0, 0.8), axis(100.0, 0.5)]);
    let lines = palm.axis_lines(60.0).expect("good");
    let lengths = lines.iter().map(|[base, tip]| (*tip - *base).length());
    for (length, expected) in lengths.zip([60.0, 48.0, 48.0, 30.0, 30.0]) {
        assert!(
            (length - expected).abs() < 1e-9,
            "{length} is not {expected}"
        );
    }
    let outline = palm.grow(60.0).expect("good");
    // Lobes overlap: the union covers every lobe but less than the sum of their areas.
    let lobes = palm.lobes().expect("good");
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
    let palm = palm(vec![bearing(axis(50.0, 0.8), vec![axis(40.0, 0.4)])]);
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
            let palm = palm(vec![axis(degrees, length), axis(degrees, length)]);
            let outline = palm.grow(80.0);
            assert!(outline.is_ok(), "{degrees}, {length}: {outline:?}");
        }
    }
}

#[test]
fn what_no_leaf_has_is_refused_by_name() {
    type Break = fn(&mut SecondaryAxis);
    let bad: [(&str, Break); 5] = [
        ("axes[1].position", |a| a.position = 1.5),
        ("axes[1].angle_deg", |a| a.angle = 4.0),
        ("axes[1].length", |a| a.length = 0.005),
        ("axes[1].rows", |a| a.axis.rows = 1),
        ("axes[1].axes[0].left.lobe_decay", |a| {
            a.axis.axes = vec![axis(40.0, 0.4)];
            a.axis.axes[0].axis.left = Some(HalfForm {
                lobe_decay: -1.0,
                ..HalfForm::entire(1.3, 0.4, 3.0)
            });
        }),
    ];
    for (expected, spoil) in bad {
        let mut axes = vec![axis(30.0, 0.9), axis(50.0, 0.8)];
        spoil(&mut axes[1]);
        let error = palm(axes).grow(50.0).expect_err(expected).to_string();
        assert!(error.starts_with(&format!("{expected} is ")), "{error}");
    }
    let mut many = axis(50.0, 0.8);
    for _ in 0..8 {
        many = bearing(many.clone(), vec![many]);
    }
    let error = palm(vec![many]).grow(50.0).expect_err("too deep");
    assert!(error.to_string().contains("depth is 9"), "{error}");
    let many = palm(vec![axis(50.0, 0.8); 101]).grow(50.0);
    let error = many.expect_err("too many").to_string();
    assert_eq!(error, "axes (count) is 202, outside 0 to 200");
}

#[test]
fn a_lobe_apart_from_the_rest_is_refused_by_its_path() {
    // Axes start on the blade, so only rounding can part them from it. The test moves one away.
    let mut lobes = palm(vec![axis(50.0, 0.5)]).lobes().expect("good");
    for p in &mut lobes[2].1 {
        *p += DVec2::new(-3.0, 3.0);
    }
    lobes[2].0.shift(DVec2::new(-3.0, 3.0));
    let error = axes::union(&lobes, 50.0).map(|_| ());
    let error = error.expect_err("it lies apart").to_string();
    assert!(error.starts_with("axes[0].position: this axis"), "{error}");
}

proptest! {
    #![proptest_config(fixed(200))]

    #[test]
    fn lobes_unite_to_a_margin_that_covers_them_all(
        axes in proptest::collection::vec((0.0..0.7, 15.0..115.0_f64, 0.2..1.1_f64, 1.1..1.6_f64, -0.5..1.0_f64), 1..4),
        decay in 0.0..0.01, paired: bool,
    ) {
        let grown = |(position, degrees, length, ratio, slope): (f64, f64, f64, f64, f64)| {
            let mut axis = SecondaryAxis { position, paired, ..axis(degrees, length) };
            let half = &mut axis.axis.right;
            *half = HalfForm { lobe_decay: decay, ..HalfForm::entire(ratio, 0.4, 3.0) };
            half.veins = [0.25, 0.5, 0.75].map(|position| VeinRow { position, slope, bend: 1.0 }).to_vec();
            axis
        };
        let palm = palm(axes.into_iter().map(grown).collect());
        let outline = palm.grow(80.0);
        prop_assert!(outline.is_ok(), "{outline:?}");
        let outline = outline.expect("just checked");
        for (_, points) in palm.lobes().expect("good") {
            for p in points {
                prop_assert!(outline.covers(p * 80.0), "{p}");
            }
        }
    }
}
