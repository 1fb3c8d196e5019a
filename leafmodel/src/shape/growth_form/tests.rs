//! The extensions against the first model, and against what each is for.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::*;
use crate::measure::shape;
use crate::shape::growth_shape::{GrowthShape, VeinRow};

fn half(veins: Vec<CurvedVein>) -> HalfForm {
    HalfForm {
        lateral: LateralGrowth::Peak {
            rate_ratio: 1.2,
            widest_at: 0.4,
            falloff: 3.0,
        },
        lobe_decay: 0.0,
        lobe_exponent: 1.0,
        veins,
    }
}

fn form(right: HalfForm) -> GrowthForm {
    GrowthForm {
        rows: 150,
        axial_rate: 0.1,
        right,
        left: None,
    }
}

fn vein(position: f64, slope: f64, bend: f64) -> CurvedVein {
    CurvedVein {
        position,
        slope,
        bend,
    }
}

fn grown(form: &GrowthForm) -> Outline {
    form.grow(100.0).expect("a good form")
}

fn number(outline: &Outline, key: &str) -> f64 {
    shape(outline).number(key).expect("every outline has it")
}

#[test]
fn equal_halves_and_straight_rows_are_the_first_model() {
    let slopes = [(0.1, -0.5), (0.4, 0.2), (0.8, 1.4)];
    let plain = GrowthShape {
        rows: 150,
        axial_rate: 0.1,
        rate_ratio: 1.2,
        widest_at: 0.4,
        falloff: 3.0,
        lobe_decay: 0.004,
        lobe_exponent: 1.0,
        veins: slopes
            .map(|(position, slope)| VeinRow { position, slope })
            .to_vec(),
    };
    let mut right = half(slopes.map(|(at, slope)| vein(at, slope, 0.0)).to_vec());
    right.lobe_decay = 0.004;
    let twice = GrowthForm {
        left: Some(right.clone()),
        ..form(right.clone())
    };
    let expected = plain.grow(100.0).expect("a good shape");
    for outline in [grown(&form(right)), grown(&twice)] {
        assert_eq!(outline.points().len(), expected.points().len());
        for (p, q) in outline.points().iter().zip(expected.points()) {
            // Steps multiplied one by one, or their power: 72 roundings.
            assert!((*p - *q).length() < 1e-11, "{p} {q}");
        }
    }
}

#[test]
fn a_curve_through_the_papers_rates_gives_the_papers_leaf() {
    let law = form(half(Vec::new()));
    let knots = (0..150).map(|j| {
        let y = f64::from(j) / 149.0;
        let at = f64::from(60) / 149.0;
        let u = (y - at).abs() / if y <= at { at } else { 1.0 - at };
        [y, 0.1 / 1.2 * (1.0 - u * u * u)]
    });
    let curve = RateCurve::new(knots.collect()).expect("rates in range");
    let mut right = half(Vec::new());
    right.lateral = LateralGrowth::Curve(curve);
    for (p, q) in grown(&law)
        .points()
        .iter()
        .zip(grown(&form(right)).points())
    {
        assert!((*p - *q).length() < 1e-11, "{p} {q}");
    }
}

#[test]
fn a_growth_law_with_two_maxima_makes_a_leaf_with_a_waist() {
    // A fiddle-shaped (panduriform) leaf, which Eq. 3 cannot bring forth.
    let knots = vec![
        [0.0, 0.0],
        [0.2, 0.08],
        [0.5, 0.06],
        [0.75, 0.083],
        [1.0, 0.0],
    ];
    let mut right = half(Vec::new());
    right.lateral = LateralGrowth::Curve(RateCurve::new(knots).expect("rates in range"));
    let outline = grown(&form(right));
    let x = |row: usize| outline.points()[1 + row].x;
    assert!(
        x(75) < 0.6 * x(30) && x(75) < 0.6 * x(112),
        "{} {} {}",
        x(30),
        x(75),
        x(112)
    );
    assert!((number(&outline, "widest_at") - 0.75).abs() < 0.01);
}

#[test]
fn unlike_halves_are_as_wide_as_each_alone() {
    let narrow = HalfForm {
        lateral: LateralGrowth::Peak {
            rate_ratio: 1.5,
            widest_at: 0.4,
            falloff: 3.0,
        },
        ..half(Vec::new())
    };
    let oblique = GrowthForm {
        left: Some(narrow.clone()),
        ..form(half(Vec::new()))
    };
    let outline = grown(&oblique);
    let width = |form: &GrowthForm| number(&grown(form), "width_mm");
    let sum = 0.5 * (width(&form(half(Vec::new()))) + width(&form(narrow)));
    assert!((number(&outline, "width_mm") - sum).abs() < 1e-9);
    let (low, high) = outline.bounds();
    assert!(high.x > 2.5 * -low.x, "{low} {high}");
}

#[test]
fn rows_that_bend_towards_the_tip_end_higher_and_nearer_to_the_midrib() {
    let straight = grown(&form(half(vec![vein(0.5, 0.5, 0.0)])));
    let bent = grown(&form(half(vec![vein(0.5, 0.5, 4.0)])));
    for row in 10..140 {
        let (p, q) = (straight.points()[1 + row], bent.points()[1 + row]);
        let midrib = 100.0 * row as f64 / 149.0;
        let slope = |p: DVec2| (p.y - midrib) / p.x;
        assert!((slope(p) - 0.5).abs() < 1e-9);
        // Mean slope of the parabola.
        assert!((slope(q) - (0.5 + 2.0 * q.x / 100.0)).abs() < 1e-9);
    }
    let line = &form(half(vec![vein(0.5, 0.5, 4.0)]))
        .vein_lines(100.0)
        .expect("good")[0];
    let steep = |i: usize| (line[i + 1] - line[i]).y / (line[i + 1] - line[i]).x;
    assert!(steep(line.len() - 2) > 1.5 * steep(0));
    let row = (0.5_f64 * 149.0).round_ties_even() as usize;
    assert!((line[line.len() - 1] - bent.points()[1 + row]).length() < 1e-9);
}

#[test]
fn every_bad_parameter_is_named() {
    type Break = fn(&mut GrowthForm);
    let breaks: [(&str, Break); 9] = [
        ("rows", |f| f.rows = 2),
        ("axial_rate", |f| f.axial_rate = f64::NAN),
        ("rate_ratio", |f| f.right.lateral = peak(0.4, 0.4, 3.0)),
        ("widest_at", |f| f.right.lateral = peak(1.2, 0.0, 3.0)),
        ("falloff", |f| f.right.lateral = peak(1.2, 0.4, 0.0)),
        ("lobe_decay", |f| f.right.lobe_decay = -1.0),
        ("lobe_exponent", |f| {
            f.left = Some(HalfForm {
                lobe_exponent: 11.0,
                ..half(Vec::new())
            });
        }),
        ("veins.slope", |f| f.right.veins[0].slope = 21.0),
        ("veins.bend", |f| f.right.veins[0].bend = -101.0),
    ];
    for (expected, change) in breaks {
        let mut form = form(half(vec![vein(0.2, 0.3, 0.0), vein(0.6, 0.3, 0.0)]));
        change(&mut form);
        match form.grow(80.0) {
            Err(GrowthFormError::OutOfRange { key, .. }) => assert_eq!(key, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
    let mut wide = half(Vec::new());
    wide.lateral = LateralGrowth::Curve(RateCurve::constant(0.9).expect("in range"));
    assert!(matches!(
        form(wide).grow(80.0),
        Err(GrowthFormError::TooWide { row: 1, .. })
    ));
    let shared = form(half(vec![vein(0.4999, 0.3, 0.0), vein(0.5, 0.3, 0.0)]));
    assert!(matches!(
        shared.grow(80.0),
        Err(GrowthFormError::VeinOrder { index: 1, .. })
    ));
}

fn peak(rate_ratio: f64, widest_at: f64, falloff: f64) -> LateralGrowth {
    LateralGrowth::Peak {
        rate_ratio,
        widest_at,
        falloff,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2005), failure_persistence: None, ..ProptestConfig::with_cases(256) })]

    #[test]
    fn no_parameters_bring_forth_a_crossing_margin(
        ratios in (0.9..2.0, 0.9..2.0), widest_at in 0.05..0.95, falloff in 0.5..9.0, lobe_decay in 0.0..0.02,
        veins in proptest::collection::vec((0.0..1.0, -4.0..4.0, -6.0..6.0), 0..6),
    ) {
        let mut veins: Vec<CurvedVein> =
            veins.into_iter().map(|(at, slope, bend)| vein(at, slope, bend)).collect();
        veins.sort_by(|p, q| p.position.total_cmp(&q.position));
        veins.dedup_by(|p, q| (p.position - q.position).abs() < 0.02);
        let side = |ratio| HalfForm {
            lateral: peak(ratio, widest_at, falloff), lobe_decay, lobe_exponent: 1.0, veins: veins.clone(),
        };
        let form = GrowthForm { left: Some(side(ratios.1)), ..form(side(ratios.0)) };
        // `Outline::new` refuses every crossing, so an outline is the proof.
        let outline = form.grow(80.0);
        prop_assert!(outline.is_ok(), "{outline:?}");
    }
}
