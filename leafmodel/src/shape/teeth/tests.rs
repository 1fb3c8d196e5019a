use proptest::prelude::*;

use super::*;
use properties::fixed;

/// A strip 2 mm wide and 10 mm long, pointed at both ends where base and apex are.
fn strip() -> Outline {
    let corners = [
        (0.0, 0.0),
        (1.0, 0.5),
        (1.0, 9.5),
        (0.0, 10.0),
        (-1.0, 9.5),
        (-1.0, 0.5),
    ];
    let points = corners.map(DVec2::from).to_vec();
    Outline::new(points, DVec2::ZERO, DVec2::new(0.0, 10.0)).expect("a strip")
}

fn at(wave: &ToothWave, share: f64, before: bool) -> f64 {
    Layout::new(wave, None, 0, 0).at(share, before)
}

fn toothed(outline: &Outline, waves: &[ToothWave]) -> Result<Outline, NotGrown> {
    super::toothed(outline, waves, LobeTips::default(), 0)
}

fn even(per_side: u32, height: f64) -> ToothWave {
    ToothWave {
        per_side,
        height,
        ..ToothWave::default()
    }
}

#[test]
fn a_wave_is_a_triangle_of_its_height_and_lean() {
    let wave = ToothWave {
        lean: 0.5,
        ..even(4, 0.1)
    };
    let heights = [0.0, 0.75 / 8.0, 0.75 / 4.0, 0.875 / 4.0, 0.25].map(|s| at(&wave, s, false));
    for (height, expected) in heights.into_iter().zip([0.0, 0.05, 0.1, 0.05, 0.0]) {
        assert!(
            (height - expected).abs() < 1e-12,
            "{height} is not {expected}"
        );
    }
    // An upright side: full height before, none behind, at the apex too.
    let saw = ToothWave {
        lean: 1.0,
        ..even(4, 0.1)
    };
    assert_eq!((at(&saw, 0.25, true), at(&saw, 0.25, false)), (0.1, 0.0));
    assert_eq!((at(&saw, 1.0, true), at(&saw, 1.0, false)), (0.1, 0.0));
    assert_eq!((at(&saw, 0.0, true), at(&saw, 0.0, false)), (0.0, 0.0));
    let back = ToothWave {
        lean: -1.0,
        ..even(4, 0.1)
    };
    assert_eq!((at(&back, 0.25, true), at(&back, 0.25, false)), (0.0, 0.1));
    let faded = ToothWave {
        fade_base: 0.5,
        fade_apex: 0.25,
        ..even(8, 0.1)
    };
    // Tips of the first and the last tooth lie a sixteenth from either end.
    assert!((at(&faded, 1.0 / 16.0, false) - 0.1 / 8.0).abs() < 1e-12);
    assert!((at(&faded, 15.0 / 16.0, false) - 0.1 / 4.0).abs() < 1e-12);
}

#[test]
fn waves_add_up() {
    let waves = [even(1, 0.2), even(4, 0.1)];
    let sum: f64 = waves.iter().map(|wave| at(wave, 0.375, false)).sum();
    assert!((sum - (0.15 + 0.1)).abs() < 1e-12);
}

#[test]
fn teeth_on_a_straight_side_are_triangles_of_known_area() {
    let plain = strip();
    // A side is 2 √(1 + 1/4) + 9 long; with so many teeth, those at its corners hardly count.
    let side = 2.0 * 1.25_f64.sqrt() + 9.0;
    let height = 0.01;
    let toothed = toothed(&plain, &[even(200, height)]).expect("small teeth");
    let gain = toothed.area() - plain.area();
    let expected = 2.0 * side * (height * 10.0) / 2.0;
    assert!(
        (gain / expected - 1.0).abs() < 0.02,
        "{gain} is not {expected}"
    );
    assert_eq!(
        (toothed.base(), toothed.apex()),
        (plain.base(), plain.apex())
    );
    for end in [plain.base(), plain.apex()] {
        assert!(toothed.points().contains(&end), "{end} is no corner");
    }
    let (low, high) = toothed.bounds();
    assert!((high.x - 1.1).abs() < 1e-9 && (low.x + 1.1).abs() < 1e-9);
}

#[test]
fn saw_teeth_have_upright_sides_towards_the_apex() {
    let saw = ToothWave {
        lean: 1.0,
        ..even(40, 0.02)
    };
    let toothed = toothed(&strip(), &[saw]).expect("saw teeth");
    let right: Vec<DVec2> = toothed
        .points()
        .iter()
        .copied()
        .filter(|p| p.x > 0.5 && (2.0..8.0).contains(&p.y))
        .collect();
    let level = right
        .windows(2)
        .filter(|edge| (edge[1].y - edge[0].y).abs() < 1e-9);
    // Each upright side is level, 0.2 mm long, and leads inward going up.
    assert!(level.clone().count() >= 20);
    for edge in level {
        assert!((edge[0].x - edge[1].x - 0.2).abs() < 1e-9, "{edge:?}");
    }
}

#[test]
fn high_teeth_do_not_cross_in_a_bay() {
    // The bay turns by 2 · 45°, and the teeth are as high as its side is long.
    let corners = [
        (0.0, 0.0),
        (2.0, 1.0),
        (2.0, 4.0),
        (1.0, 5.0),
        (2.0, 6.0),
        (2.0, 9.0),
        (0.0, 10.0),
        (-1.0, 5.0),
    ];
    let points = corners.map(DVec2::from).to_vec();
    let outline =
        Outline::new(points, DVec2::ZERO, DVec2::new(0.0, 10.0)).expect("a leaf with a bay");
    for height in [0.005, 0.02, 0.08] {
        assert!(toothed(&outline, &[even(9, height)]).is_ok(), "{height}");
    }
}

#[test]
fn teeth_that_run_into_each_other_are_refused() {
    // A notch one tenth of a millimetre wide, teeth half a millimetre high.
    let corners = [
        (0.0, 0.0),
        (2.0, 0.0),
        (2.0, 4.95),
        (1.0, 5.0),
        (2.0, 5.05),
        (2.0, 10.0),
        (0.0, 10.0),
    ];
    let points = corners.map(DVec2::from).to_vec();
    let outline =
        Outline::new(points, DVec2::ZERO, DVec2::new(0.0, 10.0)).expect("a notched strip");
    let crossed = toothed(&outline, &[even(24, 0.05)]).expect_err("teeth that cross");
    assert!(
        crossed
            .to_string()
            .starts_with("the toothed margin is none: ")
    );
}

#[test]
fn a_midrib_away_from_the_margin_takes_teeth_if_its_ends_part_it() {
    let square = [(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)].map(DVec2::from);
    let between = |base: (f64, f64), apex: (f64, f64)| {
        let outline = Outline::new(square.to_vec(), base.into(), apex.into());
        toothed(&outline.expect("a square"), &[even(5, 0.1)])
    };
    let inside = between((0.0, -2.0), (0.0, 2.0)).expect("two sides");
    assert!(inside.area() > 100.0);
    // Both ends are nearest to the same place, (5, 0).
    let sideless = between((3.0, 0.0), (4.0, 0.0)).expect_err("no sides");
    assert!(sideless.to_string().contains("it has no sides"));
}

#[test]
fn each_bad_wave_is_refused_by_name() {
    type Spoil = fn(&mut ToothWave);
    let spoils: [(Spoil, &str); 5] = [
        (|w| w.per_side = 0, "per_side"),
        (|w| w.height = -0.1, "height"),
        (|w| w.lean = f64::NAN, "lean"),
        (|w| w.fade_base = 1.5, "fade_base"),
        (|w| w.fade_apex = -1.0, "fade_apex"),
    ];
    for (spoil, key) in spoils {
        let mut wave = even(3, 0.01);
        spoil(&mut wave);
        let message = toothed(&strip(), &[even(3, 0.01), wave])
            .expect_err(key)
            .to_string();
        assert!(
            message.starts_with(&format!("teeth 1: {key} is ")),
            "{message}"
        );
    }
    let many = [even(3, 0.001); 21];
    let refused = toothed(&strip(), &many).expect_err("too many");
    assert!(refused.to_string().ends_with("here are 21"));
}

proptest! {
    #![proptest_config(fixed(64))]

    #[test]
    fn a_toothed_symmetric_leaf_is_symmetric(
        per_side in 1_u32..60, height in 0.001..0.02, lean in -1.0..1.0_f64,
        fades in prop::array::uniform2(0.0..1.0_f64),
    ) {
        let wave = ToothWave { per_side, height, lean, fade_base: fades[0], fade_apex: fades[1], ..ToothWave::default() };
        let outline = toothed(&strip(), &[wave, even(7, 0.01)]).expect("small teeth");
        for p in outline.points() {
            prop_assert!(outline.points().contains(&DVec2::new(-p.x, p.y)), "{} has no mirror image", p);
        }
        prop_assert!(outline.area() > strip().area());
    }
}

#[test]
fn crenate_teeth_bulge_and_spines_are_hollow() {
    let areas = [
        ToothForm::Spinose,
        ToothForm::Triangular,
        ToothForm::Crenate,
    ]
    .map(|form| {
        let wave = ToothWave {
            form,
            ..even(20, 0.03)
        };
        let outline = toothed(&strip(), &[wave]).expect("small teeth");
        let (low, high) = outline.bounds();
        // All reach as far out.
        assert!(
            (high.x - 1.3).abs() < 0.01 && (low.x + 1.3).abs() < 0.01,
            "{form:?}"
        );
        outline.area() - strip().area()
    });
    // Triangles fill half of what is between notches and tips, spines a quarter, crenations π/4.
    let [spines, triangles, rounds] = areas;
    assert!((spines / triangles - 0.5).abs() < 0.1, "{areas:?}");
    assert!((rounds / triangles - 1.57).abs() < 0.1, "{areas:?}");
}

#[test]
fn teeth_differ_on_the_two_sides_and_from_leaf_to_leaf() {
    let wave = ToothWave {
        spacing_cv: 0.25,
        height_cv: 0.25,
        ..even(20, 0.02)
    };
    let of = |seed| super::toothed(&strip(), &[wave], LobeTips::default(), seed);
    let leaf = of(3).expect("small teeth");
    assert_eq!(Ok(&leaf), of(3).as_ref());
    assert_ne!(Ok(&leaf), of(4).as_ref());
    let mirrored = |p: &DVec2| DVec2::new(-p.x, p.y);
    let is_there = |p: DVec2| leaf.points().iter().any(|q| q.distance(p) < 1e-9);
    let alike = leaf
        .points()
        .iter()
        .filter(|p| is_there(mirrored(p)))
        .count();
    assert!(alike < leaf.points().len() / 3, "{alike}");
}

#[test]
fn each_tooth_bears_its_tip() {
    use crate::shape::tips::{Gland, Point};

    let point = Point {
        length: 0.01,
        width: 0.002,
    };
    let gland = Gland {
        diameter: 0.01,
        ..Gland::default()
    };
    for (tip, corners, reach) in [
        (Tip::Awn(point), 5, 0.1),
        (Tip::Mucro(point), 3, 0.1),
        (Tip::Gland(gland), 11, 0.1),
    ] {
        let wave = ToothWave {
            tip: Some(tip),
            ..even(12, 0.02)
        };
        let plain = toothed(&strip(), &[even(12, 0.02)]).expect("teeth");
        let tipped = toothed(&strip(), &[wave]).expect("teeth with tips");
        let more = tipped.points().len() - plain.points().len();
        assert_eq!(more, 24 * (corners - 1), "{tip:?}");
        let out = tipped.bounds().1.x - plain.bounds().1.x;
        assert!((out / reach - 1.0).abs() < 0.3, "{tip:?}: {out} mm");
        // Glands are known, and move with the margin.
        let is_gland = matches!(tip, Tip::Gland(_));
        assert_eq!(tipped.knobs().len(), if is_gland { 24 } else { 0 });
        let larger = tipped.moved_and_scaled(DVec2::ONE, 3.0);
        for (knob, moved) in tipped.knobs().iter().zip(larger.knobs()) {
            assert!((moved.radius - 3.0 * knob.radius).abs() < 1e-12);
            assert!(larger.distance_to_margin(moved.feet[0]) < 1e-9);
            assert!((larger.distance_to_margin(moved.centre) / moved.radius - 1.0).abs() < 0.1);
        }
    }
}

#[test]
fn lobes_end_in_bristles_where_they_are_pointed() {
    use crate::shape::tips::Point;

    let tips = LobeTips {
        lobes: Some(Tip::Awn(Point {
            length: 0.05,
            width: 0.01,
        })),
        apex: None,
    };
    // A star of two points to either side, and the apex.
    let corners = [
        (0.0, 0.0),
        (3.0, 2.0),
        (1.0, 4.0),
        (3.0, 6.0),
        (1.0, 7.0),
        (0.0, 10.0),
        (-1.0, 7.0),
        (-3.0, 6.0),
        (-1.0, 4.0),
        (-3.0, 2.0),
    ];
    let points = corners.map(DVec2::from).to_vec();
    let plain = Outline::new(points, DVec2::ZERO, DVec2::new(0.0, 10.0)).expect("a star");
    let leaf = super::toothed(&plain, &[], tips, 0).expect("room for bristles");
    // Each has four corners more; the base, a corner too, bears none.
    assert_eq!(leaf.points().len(), corners.len() + 5 * 4);
    assert!((leaf.bounds().1.y - 10.5).abs() < 1e-9);
    assert!(
        (leaf.bounds().1.x - 3.4).abs() < 0.15,
        "{}",
        leaf.bounds().1
    );
}

#[test]
fn nested_teeth_need_teeth_to_stand_on() {
    let nested = |per_side| ToothWave {
        nested: true,
        ..even(per_side, 0.004)
    };
    assert!(toothed(&strip(), &[even(6, 0.02), nested(18)]).is_ok());
    for waves in [vec![nested(6)], vec![even(6, 0.02), nested(20)]] {
        let refused = toothed(&strip(), &waves).expect_err("nothing beneath");
        let said = refused.to_string();
        assert!(said.contains("do not share out evenly"), "{said}");
    }
}
