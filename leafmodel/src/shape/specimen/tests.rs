use proptest::prelude::*;

use super::*;
use crate::shape::tips::Point;
use properties::fixed;

/// A blunt blade 50 mm long and about 30 wide, broadest at a third.
fn blunt() -> Outline {
    let half = |i: i32| {
        let t = f64::from(i) / 60.0;
        let y = t * t * (3.0 - 2.0 * t);
        // Round at both ends.
        DVec2::new(
            15.0 * (1.0 - (2.0 * y - 1.0).powi(4)).max(0.0).sqrt(),
            50.0 * y,
        )
    };
    let right = (0..=60).map(half);
    let left = (1..60).rev().map(half).map(|p| DVec2::new(-p.x, p.y));
    Outline::new(
        right.chain(left).collect(),
        DVec2::ZERO,
        DVec2::new(0.0, 50.0),
    )
    .expect("a blade")
}

fn with(specimen: Specimen, seed: u64) -> Outline {
    specimen.applied(blunt(), seed).expect("it fits")
}

/// Widths to the right and to the left of the midrib at a height.
fn widths(outline: &Outline, y: f64) -> [f64; 2] {
    let points = outline.points();
    let ends = points.iter().zip(points.iter().cycle().skip(1));
    let across = ends.filter(|(a, b)| (a.y > y) != (b.y > y));
    let crossings = across.map(|(a, b)| a.lerp(*b, (y - a.y) / (b.y - a.y)).x);
    crossings.fold([0.0, 0.0], |[right, left], x| [right.max(x), left.max(-x)])
}

#[test]
fn without_anything_the_outline_is_the_same_bit_for_bit() {
    assert_eq!(with(Specimen::default(), 7), blunt());
    let point = Point::default();
    let mucronate = Specimen {
        apex: Some(ApexShape::Mucronate(point)),
        ..Specimen::default()
    };
    // A tip comes with the teeth.
    assert_eq!(with(mucronate, 7), blunt());
}

#[test]
fn sides_differ_by_what_is_asked_for_and_each_leaf_in_its_own_way() {
    let wanted = 0.04;
    let specimen = Specimen {
        asymmetry: Asymmetry {
            width: wanted,
            ..Asymmetry::default()
        },
        ..Specimen::default()
    };
    let mut squares = Vec::new();
    let mut sum = 0.0;
    for seed in 0..150 {
        let outline = with(specimen, seed);
        for y in [10.0, 20.0, 30.0, 40.0] {
            let [right, left] = widths(&outline, y);
            let difference = (right - left) / (right + left);
            squares.push(difference * difference);
            sum += difference;
        }
    }
    let n = squares.len() as f64;
    let deviation = (squares.iter().sum::<f64>() / n).sqrt();
    // 150 leaves: a standard error of some 6 %.
    assert!((deviation / wanted - 1.0).abs() < 0.2, "{deviation}");
    assert!((sum / n).abs() < 0.01, "{}", sum / n);
    let [right, left] = widths(&blunt(), 20.0);
    assert!((right - left).abs() < 1e-9);
    assert_ne!(with(specimen, 1), with(specimen, 2));
    assert_eq!(with(specimen, 1), with(specimen, 1));
}

#[test]
fn a_bowed_blade_lies_beside_its_chord_in_the_middle_and_wandering_moves_the_margin() {
    let of = |asymmetry| Specimen {
        asymmetry,
        ..Specimen::default()
    };
    let bow = of(Asymmetry {
        bow: 0.03,
        ..Asymmetry::default()
    });
    let mean: f64 = (0..60)
        .map(|seed| {
            let [right, left] = widths(&with(bow, seed), 25.0);
            let beside = 0.5 * (right - left) / 50.0;
            beside * beside
        })
        .sum::<f64>()
        / 60.0;
    assert!((mean.sqrt() / 0.03 - 1.0).abs() < 0.3, "{}", mean.sqrt());
    let wander = of(Asymmetry {
        wander: 0.01,
        ..Asymmetry::default()
    });
    let plain = blunt();
    for seed in 0..20 {
        let outline = with(wander, seed);
        let moved = outline
            .points()
            .iter()
            .map(|&p| plain.distance_to_margin(p));
        let farthest = moved.fold(0.0, f64::max);
        assert!((0.1..2.5).contains(&farthest), "{farthest} mm");
    }
}

#[test]
fn a_sinus_and_a_notch_are_as_deep_as_they_should_be() {
    let sinus = Specimen {
        base: Some(BaseShape::Cordate {
            depth: 0.12,
            width: 0.25,
        }),
        ..Specimen::default()
    };
    let (low, high) = with(sinus, 0).bounds();
    assert!((low.y + 0.12 * 50.0).abs() < 1e-6, "{low}");
    assert!((high.y - 50.0).abs() < 1e-6, "{high}");
    let notch = Specimen {
        apex: Some(ApexShape::Emarginate {
            depth: 0.1,
            width: 0.3,
        }),
        ..Specimen::default()
    };
    let outline = with(notch, 0);
    assert!((outline.bounds().1.y - 55.0).abs() < 1e-6);
    assert_eq!(outline.apex(), DVec2::new(0.0, 50.0));
    assert!(outline.points().contains(&outline.apex()));
    assert!(!outline.contains(DVec2::new(0.0, 51.0)));
}

#[test]
fn a_wedge_is_narrower_at_the_base_and_a_drip_tip_at_the_apex() {
    let of = |base, apex| Specimen {
        base,
        apex,
        ..Specimen::default()
    };
    let plain = blunt();
    let wedge = BaseShape::Cuneate {
        height: 0.15,
        width: 0.5,
    };
    let wedge = with(of(Some(wedge), None), 0);
    let drip = ApexShape::Acuminate {
        length: 0.2,
        narrowing: 0.7,
    };
    let drip = with(of(None, Some(drip)), 0);
    let width = |outline: &Outline, y| widths(outline, y).iter().sum::<f64>();
    assert!(width(&wedge, 3.0) < 0.6 * width(&plain, 3.0));
    assert!((width(&wedge, 40.0) - width(&plain, 40.0)).abs() < 0.01);
    assert!(width(&drip, 49.0) < 0.4 * width(&plain, 49.0));
    assert!((width(&drip, 30.0) - width(&plain, 30.0)).abs() < 1e-9);
    // The upper half of a wedge is straight: half way out it is half as high.
    let [near, far] = [2.5, 5.0].map(|y| width(&wedge, y));
    assert!(far > 1.6 * near, "{near} {far}");
}

#[test]
fn the_petiole_of_a_peltate_leaf_is_attached_inside_it() {
    let peltate = Specimen {
        base: Some(BaseShape::Peltate { inset: 0.2 }),
        ..Specimen::default()
    };
    let outline = with(peltate, 0);
    assert_eq!(outline.base(), DVec2::ZERO);
    assert!((outline.distance_to_margin(DVec2::ZERO) - 10.0).abs() < 0.5);
    assert!((outline.bounds().0.y + 10.0).abs() < 1e-6);
}

#[test]
fn the_right_half_of_an_oblique_leaf_begins_lower() {
    let oblique = Specimen {
        oblique: 0.1,
        ..Specimen::default()
    };
    let outline = with(oblique, 0);
    let lowest = |side: f64| {
        let points = outline.points().iter().filter(|p| p.x * side > 7.5);
        points.map(|p| p.y).fold(f64::INFINITY, f64::min)
    };
    let apart = lowest(-1.0) - lowest(1.0);
    assert!((2.0..6.0).contains(&apart), "{apart} mm");
}

#[test]
fn what_does_not_fit_is_refused() {
    let kite = [(0.0, 0.0), (5.0, 20.0), (0.0, 50.0), (-5.0, 20.0)].map(DVec2::from);
    let kite = || Outline::new(kite.to_vec(), DVec2::ZERO, DVec2::new(0.0, 50.0)).expect("a kite");
    let notch = Specimen {
        apex: Some(ApexShape::Emarginate {
            depth: 0.2,
            width: 1.0,
        }),
        ..Specimen::default()
    };
    let message = notch
        .applied(kite(), 0)
        .expect_err("too pointed")
        .to_string();
    assert!(
        message.contains("an emarginate apex of depth 0.2 does not fit"),
        "{message}"
    );
    let sinus = |depth| Specimen {
        base: Some(BaseShape::Cordate { depth, width: 0.25 }),
        ..Specimen::default()
    };
    let cordate = with(sinus(0.2), 0);
    let deeper = sinus(0.1).applied(cordate, 0).expect_err("it is deeper");
    assert!(deeper.to_string().contains("reaches less far"), "{deeper}");
    let wide = Specimen {
        breadth: 9.0,
        ..Specimen::default()
    };
    let wide = wide.applied(kite(), 0).expect_err("it is too wide");
    assert!(wide.to_string().starts_with("breadth is 9"), "{wide}");
}

proptest! {
    #![proptest_config(fixed(48))]

    #[test]
    fn a_bent_margin_does_not_cross_itself(
        breadth in 0.3..2.0, oblique in -0.3..0.3, depth in 0.02..0.3, width in 0.1..0.8,
        length in 0.05..0.6, narrowing in 0.05..0.95, which in 0..3, seed in 0_u64..100,
        asymmetry in (0.0..0.15, 0.0..0.1, 0.0..0.02),
    ) {
        let specimen = Specimen {
            breadth,
            oblique,
            base: match which {
                0 => None,
                1 => Some(BaseShape::Cuneate { height: depth, width }),
                _ => Some(BaseShape::Cordate { depth, width }),
            },
            apex: Some(ApexShape::Acuminate { length, narrowing }),
            asymmetry: Asymmetry { width: asymmetry.0, bow: asymmetry.1, wander: asymmetry.2 },
            lobe_tip: None,
        };
        let outline = specimen.applied(blunt(), seed);
        // A wide sinus of a narrow blade is refused.
        let outline = outline.map_err(|error| error.to_string());
        prop_assume!(!outline.as_ref().is_err_and(|error| error.contains("too pointed")));
        let outline = outline.map_err(TestCaseError::fail)?;
        prop_assert_eq!(outline.length(), 50.0);
        prop_assert!(outline.points().contains(&outline.apex()));
    }
}
