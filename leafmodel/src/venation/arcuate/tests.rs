//! Tests of the fields and networks of spline veins.

use proptest::prelude::*;

use super::spline::Quadratic;
use super::*;
use crate::shape::cubic::FLATNESS;
use crate::species::{PRESETS, Preset, find};
use crate::venation::areole::areoles;
use properties::fixed;

const LENGTH: f64 = 100.0;

/// Straight secondaries.
fn pinnate() -> ArcuatePlan {
    ArcuatePlan {
        squish: 0.9,
        squish2: 1.0,
        squish3: 1.0,
        up: 0.45,
        ..ArcuatePlan::default()
    }
}

/// Secondaries that sweep along the margin to the tip.
fn arcuate() -> ArcuatePlan {
    ArcuatePlan {
        squish: 0.15,
        squish2: 0.75,
        squish3: 0.35,
        up: 0.85,
        ..ArcuatePlan::default()
    }
}

fn palmate() -> ArcuatePlan {
    ArcuatePlan {
        veins: 4,
        width: 0.02,
        palmate: Some(PalmateVeins {
            per_side: 2,
            spread: 0.8,
            bow: 0.15,
        }),
        ..pinnate()
    }
}

fn plans() -> [ArcuatePlan; 4] {
    [ArcuatePlan::default(), pinnate(), arcuate(), palmate()]
}

/// A point in the article's coordinates: along the midrib, and upwards, in lengths.
fn at(x: f64, y: f64) -> DVec2 {
    DVec2::new(-y, x) * LENGTH
}

fn own(plan: &ArcuatePlan) -> ArcuateVeins {
    plan.veins_within(&CubicMargin::default(), LENGTH)
        .expect("a good plan")
}

fn grown(plan: &ArcuatePlan) -> (Outline, VenationNetwork) {
    let margin = CubicMargin::default();
    let network = plan.network_within(&margin, LENGTH);
    (
        margin.grow(LENGTH).expect("a good margin"),
        network.expect("a good plan"),
    )
}

/// Distance of each lateral's control point from its chord, in chord lengths.
fn bends(plan: &ArcuatePlan) -> Vec<f64> {
    let veins = own(plan);
    let bend = |i| {
        let [a, b, c] = veins.lateral(i).expect("there are so many");
        ((b - a).perp_dot(c - a) / (c - a).length_squared()).abs()
    };
    (0..veins.laterals()).map(bend).collect()
}

#[test]
fn laterals_start_bend_and_end_where_the_articles_formulas_say() {
    let plan = ArcuatePlan::default();
    let veins = own(&plan);
    assert_eq!(veins.laterals(), 14);
    // sincos(70 degrees); handles of length 1.
    let (s, c) = (
        libm::sin(70.0_f64.to_radians()),
        libm::cos(70.0_f64.to_radians()),
    );
    let edge = |t: f64| {
        let u = 1.0 - t;
        let (b1, b2, b3) = (3.0 * u * u * t, 3.0 * u * t * t, t * t * t);
        (b1 * c + b2 * (1.0 - c) + b3, (b1 + b2) * s)
    };
    for i in 0..7 {
        let (down, up) = (veins.lateral(2 * i + 1), veins.lateral(2 * i));
        let up = up.expect("there are 14");
        let delta = 0.125;
        let k = i as f64 * delta;
        let t = (k + delta / 2.0) * 0.5 + 0.5;
        let (x, y) = edge(t);
        let expected = [at(k * 0.5 + delta / 2.0, 0.0), at(x, 0.5 * y), at(x, y)];
        for (p, q) in up.iter().zip(expected) {
            assert!((*p - q).length() < 1e-12, "vein {i}: {p} {q}");
        }
        for (p, q) in down.expect("there are 14").iter().zip(up) {
            assert!((*p - DVec2::new(-q.x, q.y)).length() < 1e-12);
        }
    }
    // The end of each lateral lies on the margin, up to its flatness.
    let outline = CubicMargin::default().grow(LENGTH).expect("a good margin");
    for i in 0..14 {
        let [_, _, end] = veins.lateral(i).expect("there are 14");
        assert!(outline.distance_to_margin(end) < 2.0 * FLATNESS * LENGTH);
    }
}

#[test]
fn without_variation_both_halves_are_mirror_images() {
    for plan in plans() {
        let veins = own(&plan);
        let (_, network) = grown(&plan);
        for i in 0..40 {
            for j in 0..20 {
                let (x, y) = (f64::from(i) / 39.0, 0.013 + f64::from(j) / 21.0);
                assert_eq!(
                    veins.fields_at(at(x, y)),
                    veins.fields_at(at(x, -y)),
                    "{x} {y}"
                );
            }
        }
        for node in network.nodes() {
            let twin = DVec2::new(-node.position.x, node.position.y);
            let near = network.nodes().iter().map(|n| (n.position - twin).length());
            assert!(near.fold(f64::INFINITY, f64::min) < 1e-6, "{twin}");
        }
    }
    // Variation breaks the symmetry, by the one term that only the upper side has.
    let varied = own(&ArcuatePlan {
        variation: 1.0,
        ..pinnate()
    });
    let start = |i| varied.lateral(i).expect("there are 14")[0].y;
    for i in 0..7 {
        let more = start(2 * i) - start(2 * i + 1);
        assert!(more > 0.0 && more < LENGTH * 0.125 / 4.0, "{more}");
    }
}

#[test]
fn veins_lie_in_the_net_and_their_height_falls_from_1_to_0() {
    for plan in plans() {
        let veins = own(&plan);
        let (mut on, mut off) = (0, 0);
        for i in 0..120 {
            for j in 0..90 {
                let fields = veins.fields_at(at(f64::from(i) / 119.0, f64::from(j - 45) / 90.0));
                assert!(fields.net || !fields.vein);
                assert!(fields.vein == (fields.fac > 0.0) && fields.fac <= 1.0);
                if fields.vein { on += 1 } else { off += 1 }
            }
        }
        assert!(on > 200 && off > 2000, "{on} {off}");
    }
    // A point on the midrib, half its width away from the centre line.
    let fields = own(&ArcuatePlan::default()).fields_at(at(0.03, 0.025));
    assert!((fields.fac - 0.5_f64.sqrt()).abs() < 1e-12);
    // The article's midrib tapers to nothing, ours to the tip width asked for.
    let tip = at(0.999, 0.02);
    assert!(!own(&pinnate()).fields_at(tip).vein);
    assert!(
        own(&ArcuatePlan {
            tip_width: 0.5,
            ..pinnate()
        })
        .fields_at(tip)
        .vein
    );
}

#[test]
fn from_pinnate_to_arcuate_veins_bend_and_turn_to_the_tip() {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (straight, bent) = (bends(&pinnate()), bends(&arcuate()));
    assert!(mean(&straight) < 0.06, "{straight:?}");
    assert!(mean(&bent) > 3.0 * mean(&straight), "{bent:?}");
    let veins = own(&arcuate());
    let apex = DVec2::new(0.0, LENGTH);
    for i in 0..veins.laterals() {
        let [_, _, end] = veins.lateral(i).expect("there are so many");
        assert!((end - apex).length() < 0.4 * LENGTH, "{end}");
    }
    let veins = own(&pinnate());
    let spread = |i| veins.lateral(i).expect("there are so many")[2].y;
    assert!(spread(12) - spread(0) > 0.6 * LENGTH);
}

#[test]
fn primaries_start_where_the_blade_is_wide_enough_for_them() {
    // The growth algorithm's leaves have a narrow base, and the first veins of a maple's must not
    // end there.
    let outline = outline_of("young-9d");
    let network = palmate().network(&outline).expect("a good plan");
    let widest = |order: u8| {
        let of_order = network.segments().filter(|segment| segment.order == order);
        of_order
            .map(|segment| segment.to.x.abs())
            .fold(0.0, f64::max)
    };
    assert!(widest(1) > 0.25 * LENGTH, "{}", widest(1));
    assert_sound(&network, &outline, "9d");
}

/// The outline of a preset.
fn outline_of(name: &str) -> Outline {
    let plan = find(name).expect("a preset").plan();
    let outline = plan.outline.grow(LENGTH, plan.seed);
    outline.expect("a good form")
}

/// The forms of the paper on the growth algorithm.
fn forms() -> impl Iterator<Item = &'static Preset> {
    let is_of_paper = |preset: &&Preset| preset.name.starts_with("young-");
    PRESETS.iter().filter(is_of_paper)
}

/// Checks what must hold for every network on every blade.
fn assert_sound(network: &VenationNetwork, outline: &Outline, name: &str) {
    assert_eq!(network.validate(), Ok(()), "{name}");
    assert_eq!(network.components(), 1, "{name}");
    assert_eq!(areoles(network).graph().crossings(), 0, "{name}");
    let mut leaving = vec![0; network.nodes().len()];
    for edge in network.edges() {
        leaving[edge.from as usize] += 1;
    }
    let slack = 1e-6 * outline.length();
    for (node, leaving) in network.nodes().iter().zip(leaving) {
        assert!(outline.covers(node.position), "{name}: {}", node.position);
        let at_margin = outline.distance_to_margin(node.position) < slack;
        assert!(
            leaving > 0 || at_margin,
            "{name}: a vein ends at {}",
            node.position
        );
    }
}

#[test]
fn networks_end_on_the_margin_of_any_blade() {
    for plan in plans() {
        let (outline, network) = grown(&plan);
        assert_sound(&network, &outline, "own");
        for form in forms() {
            let outline = outline_of(form.name);
            let network = plan.network(&outline).expect("a good plan");
            assert_sound(&network, &outline, form.name);
        }
    }
    let maple = outline_of("maple-palmate");
    let network = palmate().network(&maple).expect("a good plan");
    assert_sound(&network, &maple, "maple");
}

#[test]
fn palmate_veins_have_primaries_that_leave_the_petiole_together() {
    let (outline, network) = grown(&palmate());
    let first = network.edges().iter().filter(|edge| edge.from == 0);
    assert_eq!(first.clone().count(), 5);
    assert!(first.clone().all(|edge| edge.order == 1));
    // Midrib with 4 laterals a side, four primaries with 4 on each of theirs.
    assert_eq!(own(&palmate()).laterals(), 8 + 4 * 8);
    assert_eq!((network.origins(), outline.base()), (1, DVec2::ZERO));
}

#[test]
fn every_bad_parameter_is_named_with_its_range() {
    type Break = fn(&mut ArcuatePlan);
    let breaks: [(&str, Break); 11] = [
        ("laterals", |p| p.veins = 0),
        ("laterals", |p| p.veins = 101),
        ("variation", |p| p.variation = -0.1),
        ("width", |p| p.width = 0.0),
        ("net_width", |p| p.net_width = 1.5),
        ("squish", |p| p.squish = 1.1),
        ("squish2", |p| p.squish2 = -1.0),
        ("squish3", |p| p.squish3 = f64::INFINITY),
        ("up", |p| p.up = 2.1),
        ("tip_width", |p| p.tip_width = 1.1),
        ("palmate.per_side", |p| {
            p.palmate = Some(PalmateVeins {
                per_side: 0,
                spread: 0.5,
                bow: 0.0,
            });
        }),
    ];
    for (expected, change) in breaks {
        let mut plan = ArcuatePlan::default();
        change(&mut plan);
        match plan.network_within(&CubicMargin::default(), LENGTH) {
            Err(error) => {
                let said = error.to_string();
                assert!(said.starts_with(&format!("{expected} is ")), "{said}");
            }
            Ok(_) => panic!("{expected} is accepted"),
        }
    }
    let veins = own(&ArcuatePlan::default());
    assert_eq!(veins.laterals(), 14);
}

proptest! {
    #![proptest_config(fixed(256))]

    #[test]
    fn the_distance_to_a_spline_is_that_of_its_nearest_point(
        p in prop::array::uniform8(-1.0..1.0_f64), straight in 0.0..1.0_f64,
    ) {
        let [a, b, c, p] = [0, 2, 4, 6].map(|i| DVec2::new(p[i], p[i + 1]));
        // Some curves are nearly or exactly straight.
        let share = if straight < 0.2 { 0.0 } else if straight < 0.5 { 1e-7 } else { 1.0 };
        let curve = Quadratic([a, a.lerp(c, 0.5).lerp(b, share), c]);
        let sampled = (0..=20_000).map(|i| {
            let t = f64::from(i) / 20_000.0;
            ((curve.at(t) - p).length(), t)
        });
        let (least, t) = sampled.fold((f64::INFINITY, 0.0), |best, now| if now.0 < best.0 { now } else { best });
        match curve.nearest(p) {
            // Samples lie up to 6/20000 apart along the curve.
            Some(nearest) if t > 0.0 && t < 1.0 => {
                let off = least - nearest.distance;
                prop_assert!(off > -1e-12 && off < 2e-4, "{nearest:?} {least} {t}");
            }
            // The nearest point of the curve is an end, which has no cap.
            Some(nearest) => prop_assert!(nearest.distance >= least - 1e-12),
            None => prop_assert!(t == 0.0 || t == 1.0, "{t}"),
        }
    }

    #[test]
    fn no_parameters_make_veins_that_cross(
        squish in prop::array::uniform3(0.0..1.0_f64), up in 0.0..1.5_f64, variation in 0.0..1.0_f64,
        angles in prop::array::uniform2(20.0..110.0_f64), veins in 1_u32..20, seed: u32, form in 0_usize..28,
        palm in 0_u32..4, bow in -0.5..0.5_f64,
    ) {
        let plan = ArcuatePlan {
            squish: squish[0], squish2: squish[1], squish3: squish[2], up, variation, veins, seed,
            palmate: (palm > 0).then_some(PalmateVeins { per_side: palm, spread: 0.7, bow }),
            ..ArcuatePlan::default()
        };
        let margin = CubicMargin { angle1_deg: angles[0], angle2_deg: angles[1], length1: 0.6, length2: 0.6 };
        if let Ok(outline) = margin.grow(LENGTH) {
            assert_sound(&plan.network_within(&margin, LENGTH).expect("in range"), &outline, "own");
        }
        let name = forms().nth(form).expect("a form of the paper").name;
        let outline = outline_of(name);
        assert_sound(&plan.network(&outline).expect("in range"), &outline, name);
    }
}

#[test]
fn primaries_are_laid_whole_but_where_a_bay_lies_in_their_way() {
    let (outline, _) = grown(&palmate());
    let whole = palmate().primaries_laid(&outline).expect("a good plan");
    assert_eq!(whole.len(), 4);
    assert!(whole.iter().all(|&share| share > 0.99), "{whole:?}");
    // Lobes so deep that primaries run into a sinus.
    let lobed = outline_of("young-9a");
    let cut = palmate().primaries_laid(&lobed).expect("a good plan");
    assert_eq!(cut.len(), 4);
    assert!(cut.iter().any(|&share| share < 0.5), "{cut:?}");
    assert!(cut.iter().all(|&share| (0.0..=1.0).contains(&share)));
    let none = pinnate().primaries_laid(&outline).expect("a good plan");
    assert!(none.is_empty());
}
