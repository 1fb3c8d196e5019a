//! The model and its extensions, tested against closed forms and intended effects.

use proptest::prelude::*;

use crate::shape::growth::RateCurve;

use super::*;
use crate::measure::shape;
use crate::shape::outline::OutlineError;
use properties::fixed;

fn half(veins: Vec<VeinRow>) -> HalfForm {
    HalfForm {
        lobe_exponent: 1.0,
        veins,
        ..HalfForm::entire(1.2, 0.4, 3.0)
    }
}

fn form(right: HalfForm) -> GrowthForm {
    right.into()
}

fn unlike(right: HalfForm, left: HalfForm) -> GrowthForm {
    GrowthForm::from(Axis {
        left: Some(left),
        ..right.into()
    })
}

fn with_curve(knots: Vec<[f64; 2]>) -> HalfForm {
    HalfForm {
        lateral: LateralGrowth::Curve(RateCurve::new(knots).expect("rates in range")),
        ..half(Vec::new())
    }
}

fn vein(position: f64, slope: f64, bend: f64) -> VeinRow {
    VeinRow {
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
fn rows_end_where_the_closed_form_says() {
    let slopes = [(0.1, -0.5), (0.4, 0.2), (0.8, 1.4)];
    let mut right = half(slopes.map(|(at, slope)| vein(at, slope, 0.0)).to_vec());
    right.lobe_decay = 0.004;
    let once = grown(&form(right.clone()));
    assert_eq!(once, grown(&unlike(right.clone(), right)));
    let steps = libm::log(1000.0) / libm::log(1.1);
    // Rows, from 0, of the veins.
    let veins = [(15_i32, -0.5), (60, 0.2), (119, 1.4)];
    for j in 0..150_i32 {
        let away = if j <= 60 {
            f64::from(60 - j) / 60.0
        } else {
            f64::from(j - 60) / 89.0
        };
        let nearest = veins.map(|(row, _)| (row - j).abs());
        let nearest = nearest.into_iter().min().expect("three veins");
        let rate = 0.1 / 1.2 * (1.0 - away * away * away) * libm::exp(-0.004 * f64::from(nearest));
        let between = |a: (i32, f64), b: (i32, f64)| {
            a.1 + (b.1 - a.1) * f64::from(j - a.0) / f64::from(b.0 - a.0)
        };
        let slope = match j {
            ..15 => -0.5,
            15..60 => between(veins[0], veins[1]),
            60..119 => between(veins[1], veins[2]),
            _ => 1.4,
        };
        let x = 0.1 * libm::pow(1.0 + rate, steps);
        let expected = DVec2::new(x, 100.0 * f64::from(j) / 149.0 + slope * x);
        let found = once.points()[1 + j as usize];
        assert!((found - expected).length() < 1e-11, "{found} {expected}");
    }
}

#[test]
fn a_curve_through_the_papers_rates_gives_the_papers_leaf() {
    let knots = (0..150).map(|j| {
        let y = f64::from(j) / 149.0;
        let at = f64::from(60) / 149.0;
        let u = (y - at).abs() / if y <= at { at } else { 1.0 - at };
        [y, 0.1 / 1.2 * (1.0 - u * u * u)]
    });
    let law = grown(&form(half(Vec::new())));
    let curve = grown(&form(with_curve(knots.collect())));
    for (p, q) in law.points().iter().zip(curve.points()) {
        assert!((*p - *q).length() < 1e-11, "{p} {q}");
    }
}

#[test]
fn a_growth_law_with_two_maxima_makes_a_leaf_with_a_waist() {
    // A fiddle-shaped (panduriform) leaf, which Eq. 3 cannot produce.
    let fiddle = form(with_curve(vec![
        [0.0, 0.0],
        [0.2, 0.08],
        [0.5, 0.06],
        [0.75, 0.083],
        [1.0, 0.0],
    ]));
    let rows = fiddle.row_growth(Side::Right).expect("good");
    let x = |row: usize| rows[row].half_width;
    assert!(
        x(75) < 0.6 * x(30) && x(75) < 0.6 * x(112),
        "{} {} {}",
        x(30),
        x(75),
        x(112)
    );
    assert!((number(&grown(&fiddle), "widest_at") - 0.75).abs() < 0.01);
}

#[test]
fn unlike_halves_are_as_wide_as_each_alone() {
    let narrow = HalfForm::entire(1.5, 0.4, 3.0);
    let oblique = unlike(half(Vec::new()), narrow.clone());
    let outline = grown(&oblique);
    let width = |form: &GrowthForm| number(&grown(form), "width_mm");
    let sum = 0.5 * (width(&form(half(Vec::new()))) + width(&form(narrow)));
    assert!((number(&outline, "width_mm") - sum).abs() < 1e-9);
    let (low, high) = outline.bounds();
    assert!(high.x > 2.5 * -low.x, "{low} {high}");
    for (side, reach) in [(Side::Right, high.x), (Side::Left, -low.x)] {
        let rows = oblique.row_growth(side).expect("good");
        let widest = rows.iter().map(|row| row.half_width).fold(0.0, f64::max);
        assert!((100.0 * widest - reach).abs() < 1e-9);
    }
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
    let lines = form(half(vec![vein(0.5, 0.5, 4.0)])).vein_lines(100.0);
    let line = &lines.expect("good")[0];
    let steep = |i: usize| (line[i + 1] - line[i]).y / (line[i + 1] - line[i]).x;
    assert!(steep(line.len() - 2) > 1.5 * steep(0));
    let row = (0.5_f64 * 149.0).round_ties_even() as usize;
    assert!((line[line.len() - 1] - bent.points()[1 + row]).length() < 1e-9);
}

#[test]
fn rows_that_pass_over_each_other_are_merged() {
    // The veins at the ends are short and do not meet; the long rows between them, whose slopes
    // fall, do.
    let right = HalfForm {
        veins: vec![vein(0.03, 2.0, 0.0), vein(0.97, -2.0, 0.0)],
        ..HalfForm::entire(1.1, 0.5, 2.0)
    };
    let form = form(right);
    let rows = form.row_growth(Side::Right).expect("in range");
    let end = |row: &RowGrowth| {
        let slope = 2.0 - 4.0 * ((row.place - 4.0 / 149.0) / (141.0 / 149.0)).clamp(0.0, 1.0);
        DVec2::new(row.half_width, row.place + slope * row.half_width)
    };
    let raw = std::iter::once(DVec2::ZERO)
        .chain(rows.iter().map(end))
        .chain([DVec2::Y]);
    let crossed = Outline::new(raw.collect(), DVec2::ZERO, DVec2::Y);
    assert!(
        matches!(crossed, Err(OutlineError::SelfCrossing { .. })),
        "this test needs rows that cross: {crossed:?}"
    );
    assert!(grown(&form).area() > 0.0);
}

#[test]
fn veins_that_cross_are_refused_with_the_slopes_that_keep_them_apart() {
    let veins = |slope| {
        vec![
            vein(0.2, 2.0, 0.0),
            vein(0.4, 1.5, 0.0),
            vein(0.6, slope, 0.0),
        ]
    };
    let error = form(half(veins(-1.0))).grow(80.0).expect_err("they cross");
    let GrowthFormProblem::VeinsCross {
        lower: 1,
        upper: 2,
        allowed: SlopeRange::Of { vein: 2, from, to },
    } = error.problem
    else {
        panic!("{error:?}");
    };
    // At the end of the shorter vein the upper one must still be above: s₂ > s₁ − Δy / x, x the
    // half width of the shorter one.
    let rows = form(half(veins(1.5)))
        .row_growth(Side::Right)
        .expect("they do not cross");
    let bound = 1.5 - (rows[89].place - rows[60].place) / rows[89].half_width;
    assert!(from >= bound && from < bound + 0.001 && to == 20.0);
    let said = error.to_string();
    let expected = format!(
        "veins[1] and veins[2] cross; they do not if the slope of veins[2] is within {from} to 20"
    );
    assert_eq!(said, expected);
    // These veins bend towards each other.
    let bent = vec![vein(0.4, 0.0, 90.0), vein(0.43, 0.0, -100.0)];
    let error = unlike(half(Vec::new()), half(bent)).grow(80.0);
    let error = error.expect_err("they cross");
    assert_eq!(error.part.side, Side::Left);
    assert!(
        error.to_string().starts_with("left.veins[0] and"),
        "{error}"
    );
}

#[test]
fn parameters_as_near_to_an_excluded_end_as_numbers_come_grow_or_say_why_not() {
    let least = f64::MIN_POSITIVE;
    for (widest_at, falloff, lobe_exponent) in [
        (least, 3.0, 2.0),
        (1.0 - f64::EPSILON, 3.0, 2.0),
        (0.4, least, 2.0),
        (0.4, 3.0, least),
    ] {
        let mut near = form(HalfForm {
            lobe_decay: 0.01,
            lobe_exponent,
            ..HalfForm::entire(1.2, widest_at, falloff)
        });
        near.midrib.right.veins = vec![vein(0.5, 0.3, 0.0)];
        assert_eq!(near.validate(), Ok(()));
        if let Ok(outline) = near.grow(60.0) {
            assert!(outline.area().is_finite() && outline.area() > 0.0);
        }
    }
}

#[test]
fn every_bad_parameter_is_named() {
    type Break = fn(&mut GrowthForm);
    let breaks: [(&str, Break); 12] = [
        ("rows", |f| f.midrib.rows = 2),
        ("axial_rate", |f| f.axial_rate = f64::NAN),
        ("rate_ratio", |f| {
            f.midrib.right.lateral = HalfForm::entire(0.4, 0.4, 3.0).lateral;
        }),
        ("rate_ratio", |f| {
            f.midrib.right.lateral = HalfForm::entire(f64::NAN, 0.4, 3.0).lateral;
        }),
        ("widest_at", |f| {
            f.midrib.right.lateral = HalfForm::entire(1.2, 0.0, 3.0).lateral;
        }),
        ("widest_at", |f| {
            f.midrib.right.lateral = HalfForm::entire(1.2, 1.0, 3.0).lateral;
        }),
        ("falloff", |f| {
            f.midrib.right.lateral = HalfForm::entire(1.2, 0.4, 0.0).lateral;
        }),
        ("lobe_decay", |f| f.midrib.right.lobe_decay = -1.0),
        ("left.lobe_exponent", |f| {
            f.midrib.left = Some(HalfForm {
                lobe_exponent: 11.0,
                ..half(Vec::new())
            });
        }),
        ("veins[0]", |f| {
            f.midrib.right.veins[0].position = -0.1;
        }),
        ("veins[0]", |f| f.midrib.right.veins[0].slope = 21.0),
        ("veins[0]", |f| f.midrib.right.veins[0].bend = -101.0),
    ];
    let good = form(half(vec![vein(0.2, 0.3, 0.0), vein(0.6, 0.3, 0.0)]));
    for (expected, change) in breaks {
        let mut form = good.clone();
        change(&mut form);
        let error = form.grow(80.0).expect_err(expected).to_string();
        assert!(error.starts_with(&format!("{expected} is ")), "{error}");
        assert!(error.contains("outside "), "{error}");
    }
    assert!(good.grow(0.0).is_err());
    let wide = form(HalfForm {
        lateral: LateralGrowth::Curve(RateCurve::constant(0.9).expect("in range")),
        ..half(Vec::new())
    });
    assert!(matches!(
        wide.grow(80.0).map_err(|error| error.problem),
        Err(GrowthFormProblem::TooWide { row: 1, .. })
    ));
    let shared = form(half(vec![vein(0.4999, 0.3, 0.0), vein(0.5, 0.3, 0.0)]));
    assert!(matches!(
        shared.grow(80.0).map_err(|error| error.problem),
        Err(GrowthFormProblem::VeinOrder {
            index: 1,
            row: 75,
            before: 75,
            rows: 150
        })
    ));
}

fn half_of(form: &mut GrowthForm, side: Side) -> &mut HalfForm {
    match side {
        Side::Right => &mut form.midrib.right,
        Side::Left => form.midrib.left.as_mut().expect("it has one"),
    }
}

proptest! {
    #![proptest_config(fixed(512))]

    #[test]
    fn no_parameters_bring_forth_a_crossing_margin(
        ratios in (0.9..2.0, 0.9..2.0), widest_at in 0.05..0.95, falloff in 0.5..9.0, lobe_decay in 0.0..0.02,
        lobe_exponent in 0.5..2.0,
        veins in proptest::collection::vec((0.0..1.0, -4.0..4.0, -6.0..6.0), 0..6), bent: bool,
    ) {
        let bent = if bent { 1.0 } else { 0.0 };
        let mut veins: Vec<VeinRow> =
            veins.into_iter().map(|(at, slope, bend)| vein(at, slope, bent * bend)).collect();
        veins.sort_by(|p, q| p.position.total_cmp(&q.position));
        veins.dedup_by(|p, q| (p.position - q.position).abs() < 0.02);
        let side = |ratio| HalfForm {
            lobe_decay, lobe_exponent, veins: veins.clone(), ..HalfForm::entire(ratio, widest_at, falloff)
        };
        let mut form = unlike(side(ratios.0), side(ratios.1));
        // `Outline::new` refuses every crossing, so an outline is the proof. Crossing veins are
        // moved apart as their error says.
        for _ in 0..100 {
            let Err(error) = form.grow(80.0) else { return Ok(()) };
            let GrowthFormProblem::VeinsCross { lower, upper, allowed: SlopeRange::Of { vein, from, to } } = error.problem else {
                return Err(TestCaseError::fail(format!("{error:?}")));
            };
            let side = error.part.side;
            let (below, above) = (half_of(&mut form, side).veins[lower], half_of(&mut form, side).veins[upper]);
            prop_assert!(vein == lower || vein == upper);
            prop_assert!(!(from..=to).contains(&half_of(&mut form, side).veins[vein].slope));
            // Every slope of the range keeps these two apart.
            for share in [0.0, 0.1, 0.3, 0.7, 1.0] {
                let mut pair = form.clone();
                let veins = &mut half_of(&mut pair, side).veins;
                *veins = vec![below, above];
                veins[usize::from(vein == upper)].slope = from + share * (to - from);
                let again = pair.validate().err().filter(|again| again.part == error.part);
                prop_assert!(again.is_none(), "{again:?}");
            }
            half_of(&mut form, side).veins[vein].slope = from;
        }
        prop_assert!(false, "still crossing");
    }
}
