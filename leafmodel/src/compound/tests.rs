//! Ash, horse chestnut, mimosa: leaves with leaflets of the growth algorithm.

use glam::DVec2;

use super::*;
use crate::species;

pub(super) fn leaflet() -> LeafPlan {
    let lanceolate = species::find("young-3c").expect("a preset");
    LeafPlan {
        length_mm: 40.0,
        ..lanceolate.plan()
    }
}

pub(super) fn feather() -> Feather {
    Feather {
        pairs: 5,
        terminal: true,
        rachis: 2.2,
        alternation: 0.0,
        angles: [1.2, 0.8],
        sizes: [0.7, 1.0, 0.8],
        turn: 0.0,
    }
}

fn plan(arrangement: Arrangement) -> CompoundForm {
    CompoundForm {
        petiole: 0.5,
        petiolule: 0.08,
        ..CompoundForm::new(arrangement)
    }
}

fn bipinnate() -> Arrangement {
    let small = Feather {
        pairs: 6,
        rachis: 2.4,
        ..feather()
    };
    let pinnae = Feather {
        pairs: 3,
        rachis: 5.0,
        sizes: [0.9, 1.0, 0.8],
        ..feather()
    };
    Arrangement::Bipinnate {
        pinnae,
        leaflets: small,
        stalk: 1.0,
    }
}

pub(super) fn palmate() -> Arrangement {
    Arrangement::Palmate {
        leaflets: 7,
        spread: 4.2,
        sizes: [0.5, 1.0],
    }
}

fn arranged(arrangement: Arrangement) -> CompoundLeaf {
    plan(arrangement).arrange(&leaflet()).expect("a good plan")
}

#[test]
fn a_pinnate_leaf_is_paired_along_its_rachis_and_ends_in_a_leaflet() {
    let leaf = arranged(Arrangement::Pinnate(feather()));
    assert_eq!(leaf.leaflets.len(), 11);
    for pair in leaf.leaflets[..10].chunks(2) {
        let (right, left) = (&pair[0], &pair[1]);
        assert!(!right.mirrored && left.mirrored && right.scale == left.scale);
        for p in [DVec2::new(3.0, 10.0), DVec2::new(-1.0, 40.0)] {
            let (q, r) = (right.place(p), left.place(p));
            assert!((q - DVec2::new(-r.x, r.y)).length() < 1e-12, "{q} {r}");
        }
    }
    let end = &leaf.leaflets[10];
    assert_eq!((end.angle, end.base.x), (0.0, 0.0));
    // Petiole, rachis, petiolule.
    assert!((end.base.y - 40.0 * (0.5 + 2.2 + 0.08 * 0.8)).abs() < 1e-9);
}

#[test]
fn cross_sections_of_stalks_add_up() {
    for arrangement in [Arrangement::Pinnate(feather()), palmate(), bipinnate()] {
        let leaf = arranged(arrangement);
        let sum: f64 = leaf
            .leaflets
            .iter()
            .map(|leaflet| leaflet.scale * leaflet.scale)
            .sum();
        assert_eq!(leaf.stalks[0].kind, StalkKind::Petiole);
        assert!((leaf.stalks[0].radii_mm[0] - 0.4 * sum.sqrt()).abs() < 1e-12);
        for stalk in &leaf.stalks {
            assert!(stalk.points.len() >= 2 && stalk.points.len() == stalk.radii_mm.len());
            assert!(
                stalk
                    .radii_mm
                    .windows(2)
                    .all(|pair| pair[0] >= pair[1] && pair[1] > 0.0)
            );
        }
    }
}

#[test]
fn a_palmate_leaf_fans_out_from_one_point() {
    let leaf = arranged(palmate());
    let point = DVec2::new(0.0, 20.0);
    let mut before = 4.2 / 2.0 + 0.7;
    for leaflet in &leaf.leaflets {
        assert!((before - leaflet.angle - 0.7).abs() < 1e-12);
        before = leaflet.angle;
        let stalk = (leaflet.base - point).length();
        assert!((stalk - 0.08 * 40.0 * leaflet.scale).abs() < 1e-12);
    }
    assert_eq!(leaf.leaflets.len(), 7);
}

#[test]
fn a_bipinnate_leaf_has_leaflets_on_every_pinna() {
    let leaf = arranged(bipinnate());
    assert_eq!(leaf.leaflets.len(), 7 * 13);
    let pinnae = leaf
        .stalks
        .iter()
        .filter(|stalk| stalk.kind == StalkKind::Pinna);
    assert_eq!(pinnae.count(), 7);
    let mut seeds: Vec<u64> = leaflet_plans(&leaflet(), &plan(bipinnate()))
        .iter()
        .map(|plan| plan.seed)
        .collect();
    seeds.sort_unstable();
    seeds.dedup();
    assert_eq!(seeds.len(), 3);
    for (number, leaflet) in leaf.leaflets.iter().enumerate() {
        assert_eq!(leaflet.variant as usize, number % 3);
    }
}

#[test]
fn alternate_leaflets_on_a_curved_rachis_stand_on_its_arc() {
    let leaf = arranged(Arrangement::Pinnate(Feather {
        alternation: 0.5,
        turn: 0.8,
        ..feather()
    }));
    let rachis = leaf
        .stalks
        .iter()
        .find(|stalk| stalk.kind == StalkKind::Rachis);
    let rachis = rachis.expect("it has one");
    let length: f64 = rachis
        .points
        .windows(2)
        .map(|edge| (edge[1] - edge[0]).length())
        .sum();
    // Chords of 24 pieces over 0.8 radians are shorter by (0.8/24)²/24.
    assert!((length / 88.0 - 1.0).abs() < 5e-5, "{length}");
    let radius = 88.0 / 0.8;
    for p in &rachis.points {
        let away = (*p - DVec2::new(radius, 20.0)).length();
        assert!((away - radius).abs() < 1e-9, "{p}");
    }
}

#[test]
fn leaflets_in_each_others_way_are_refused() {
    let crowded = Feather {
        pairs: 14,
        ..feather()
    };
    assert!(matches!(
        plan(Arrangement::Pinnate(crowded)).arrange(&leaflet()),
        Err(CompoundError::Overlap { .. })
    ));
    let steep = Feather {
        pairs: 1,
        angles: [3_f64.to_radians(); 2],
        rachis: 6.0,
        ..feather()
    };
    assert!(matches!(
        plan(Arrangement::Pinnate(steep)).arrange(&leaflet()),
        Err(CompoundError::OnStalk { leaflet: 0 } | CompoundError::Overlap { .. })
    ));
}

#[test]
fn a_leaf_that_its_curl_would_roll_up_is_refused_unless_it_lies_on_the_ground() {
    // Pinnae many times as long as the axis that bears them.
    let pinnae = Feather {
        pairs: 1,
        terminal: false,
        angles: [1.0; 2],
        rachis: 0.02,
        ..feather()
    };
    let leaflets = Feather {
        pairs: 3,
        rachis: 6.0,
        ..feather()
    };
    let curled = |curl: f64| CompoundForm {
        petiole: 0.02,
        curl,
        ..plan(Arrangement::Bipinnate {
            pinnae,
            leaflets,
            stalk: 1.0,
        })
    };
    let little = curled(0.2).arrange(&leaflet());
    assert!(little.is_ok(), "{little:?}");
    let much = curled(6.0).arrange(&leaflet());
    assert!(
        matches!(much, Err(CompoundError::RolledUp { degrees }) if degrees > 720.0),
        "{much:?}"
    );
    let mut lying = leaflet();
    lying.stance.on_ground = true;
    assert!(curled(6.0).arrange(&lying).is_ok());
}

/// The same leaf with an irregularity.
fn irregular(arrangement: Arrangement, irregularity: f64) -> CompoundForm {
    CompoundForm {
        irregularity,
        ..plan(arrangement)
    }
}

#[test]
fn leaflets_stray_by_chance_as_far_as_the_plan_says() {
    // Narrow and far apart: none is in another's way.
    let sparse = Feather {
        pairs: 60,
        terminal: false,
        rachis: 100.0,
        angles: [1.0; 2],
        sizes: [0.5; 3],
        ..feather()
    };
    let leaf = irregular(Arrangement::Pinnate(sparse), 0.1)
        .arrange(&leaflet())
        .expect("a good plan");
    let gap = 100.0 * 40.0 / 59.0;
    let base = 0.5 * 40.0;
    let deviation = |values: Vec<f64>| {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
        (mean, (square / count).sqrt())
    };
    // The first pair strays only ahead and the last not at all.
    let inner: Vec<_> = leaf.leaflets[2..118].iter().enumerate().collect();
    let along = inner
        .iter()
        .map(|(i, leaflet)| (leaflet.foot.y - base) / gap - (1 + i / 2) as f64);
    let (mean, spread) = deviation(along.collect());
    assert!(
        mean.abs() < 0.03 && (spread - 0.1).abs() < 0.02,
        "{mean} ± {spread}"
    );
    let angles = inner.iter().map(|(_, leaflet)| leaflet.from_axis.abs());
    let (mean, spread) = deviation(angles.collect());
    assert!(
        (mean - 1.0).abs() < 0.03 && (spread - 0.1).abs() < 0.02,
        "{mean} ± {spread}"
    );
    let sizes = inner.iter().map(|(_, leaflet)| leaflet.scale / 0.5);
    let (mean, spread) = deviation(sizes.collect());
    assert!(
        (mean - 1.0).abs() < 0.02 && (spread - 0.05).abs() < 0.01,
        "{mean} ± {spread}"
    );
    // Another leaf strays otherwise.
    let other = LeafPlan {
        seed: leaflet().seed + 1,
        ..leaflet()
    };
    let sparse = irregular(Arrangement::Pinnate(sparse), 0.1);
    assert_ne!(sparse.arrange(&other).expect("a good plan"), leaf);
}

#[test]
fn however_far_leaflets_stray_none_is_in_anothers_way() {
    // Pairs as near as they may stand in order.
    let with = |pairs| Arrangement::Pinnate(Feather { pairs, ..feather() });
    let dense = (5..14)
        .rev()
        .map(with)
        .find(|dense| plan(dense.clone()).arrange(&leaflet()).is_ok())
        .expect("five have room");
    for arrangement in [dense, palmate(), bipinnate()] {
        plan(arrangement.clone())
            .arrange(&leaflet())
            .expect("in order they have room");
        let leaf = irregular(arrangement, 0.25)
            .arrange(&leaflet())
            .expect("they stray less where they have none");
        let outline = leaflet().grow_outline().expect("a good outline");
        assert!(overlap::find(&leaf, &[outline], 1).is_empty());
    }
    assert!(matches!(
        irregular(with(14), 0.25).arrange(&leaflet()),
        Err(CompoundError::Overlap { .. })
    ));
}

#[test]
fn a_pinna_whose_leaflets_stay_in_each_others_way_is_straightened_last() {
    let form = irregular(bipinnate(), 0.25);
    let mut stray = stray::Stray::new(&form, leaflet().seed);
    let turn = |stray: &stray::Stray| stray.of(stray::Part::Pinna(0)).turn;
    let along = |stray: &stray::Stray| stray.of(stray::Part::Leaflet(0)).along;
    let before = turn(&stray);
    assert!(before != 0.0 && along(&stray) != 0.0);
    let on_one = [CompoundError::Overlap {
        first: 0,
        second: 1,
    }];
    while along(&stray) != 0.0 {
        assert!(stray.calm(&on_one));
        assert_eq!(turn(&stray), before);
    }
    while turn(&stray) != 0.0 {
        assert!(stray.calm(&on_one));
    }
    assert!(!stray.calm(&on_one));
}

#[test]
fn every_bad_number_is_named() {
    let with = |change: fn(&mut Feather)| {
        let mut feather = feather();
        change(&mut feather);
        plan(Arrangement::Pinnate(feather))
    };
    let bad = [
        ("pinnate.pairs", with(|f| f.pairs = 0)),
        ("pinnate.rachis", with(|f| f.rachis = f64::NAN)),
        ("pinnate.alternation", with(|f| f.alternation = 1.0)),
        ("pinnate.angles_deg", with(|f| f.angles[1] = 0.0)),
        ("pinnate.sizes", with(|f| f.sizes[2] = 1.1)),
        ("pinnate.turn_deg", with(|f| f.turn = 3.0)),
        (
            "palmate.petiole",
            CompoundForm {
                petiole: -1.0,
                ..plan(palmate())
            },
        ),
        (
            "palmate.petiolule",
            CompoundForm {
                petiolule: 11.0,
                ..plan(palmate())
            },
        ),
        (
            "palmate.stalk_radius_mm",
            CompoundForm {
                stalk_radius_mm: 0.0,
                ..plan(palmate())
            },
        ),
        (
            "palmate.variants",
            CompoundForm {
                variants: 0,
                ..plan(palmate())
            },
        ),
        (
            "palmate.curl_deg",
            CompoundForm {
                curl: 7.0,
                ..plan(palmate())
            },
        ),
        (
            "palmate.fold_deg",
            CompoundForm {
                fold: f64::NAN,
                ..plan(palmate())
            },
        ),
        (
            "palmate.tilt_deg",
            CompoundForm {
                tilt: -0.1,
                ..plan(palmate())
            },
        ),
        ("palmate.irregularity", irregular(palmate(), 0.3)),
        (
            "palmate.leaflets",
            plan(Arrangement::Palmate {
                leaflets: 1,
                spread: 1.0,
                sizes: [1.0, 1.0],
            }),
        ),
        (
            "palmate.spread_deg",
            plan(Arrangement::Palmate {
                leaflets: 3,
                spread: 7.0,
                sizes: [1.0, 1.0],
            }),
        ),
    ];
    for (expected, plan) in bad {
        match plan.arrange(&leaflet()) {
            Err(CompoundError::Range(error)) => assert_eq!(error.path, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
}
