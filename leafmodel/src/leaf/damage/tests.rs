use std::sync::LazyLock;

use super::*;
use crate::blade::frame::UvFrame;
use crate::grow_options::GrowOptions;
use crate::leaf::{Lamina, Leaf, LeafPlan};
use crate::optics::Constituent;
use crate::species::find;
use crate::venation::network::VeinSegment;

/// A small leaf with a net, much eaten.
fn eaten() -> LeafPlan {
    let mut plan = find("tertiary").expect("a preset").plan();
    plan.map_size = 300;
    plan.damage = Some(Damage {
        holes: 9,
        hole_mm: 4.0,
        bites: 3,
        bite_mm: 9.0,
        mines: 1,
        blotches: 1,
        ..Damage::default()
    });
    plan
}

#[test]
fn holes_are_holes_of_the_mesh_and_no_vein_leads_through_them() {
    let plan = eaten();
    let leaf = Leaf::grow(&plan).expect("a good plan");
    let lamina = &leaf.lamina;
    assert_eq!(lamina.holes().len(), 9);
    assert_eq!(leaf.mesh.validate_holed(lamina.area(), 9), Ok(()));
    assert_eq!(lamina.network.validate(), Ok(()));
    for vein in lamina.network.segments() {
        for hole in lamina.holes() {
            assert!(!touches(hole, vein.from, vein.to), "{vein:?}");
        }
    }
    let whole = LeafPlan {
        damage: None,
        ..plan.clone()
    };
    let whole = Leaf::grow(&whole).expect("a good plan");
    assert!(whole.lamina.network.edges().len() > lamina.network.edges().len() + 20);
    assert_eq!(lamina.intact(), &whole.lamina.outline);
    assert_eq!(leaf.frame, whole.frame);
    assert_eq!(Leaf::grow(&plan).expect("a good plan"), leaf);
}

#[test]
fn bites_take_area_from_the_margin_and_leave_both_ends() {
    let mut plan = eaten();
    plan.damage = Some(Damage {
        bites: 4,
        ..Damage::default()
    });
    let lamina = plan.grow_lamina().expect("a good plan");
    let (bitten, intact) = (&lamina.outline, lamina.intact());
    let lost = intact.area() - bitten.area();
    // About half discs of 9 mm, some smaller and some greater.
    assert!((40.0..300.0).contains(&lost), "{lost} mm²");
    assert_eq!(
        (bitten.base(), bitten.apex()),
        (intact.base(), intact.apex())
    );
    for node in lamina.network.nodes() {
        let p = node.position;
        assert!(
            bitten.contains(p) || bitten.distance_to_margin(p) < 1e-6,
            "{p}"
        );
    }
}

#[test]
fn tissue_about_holes_and_in_mines_is_dead() {
    let plan = eaten();
    let leaf = Leaf::grow(&plan).expect("a good plan");
    let frame = UvFrame::around(leaf.lamina.intact().points());
    let at = |p: DVec2| {
        let uv = frame.uv(p);
        let map = &leaf.contents;
        let column = (uv.x * f64::from(map.width)) as usize;
        let row = (uv.y * f64::from(map.height)) as usize;
        map.texels[row * map.width as usize + column]
    };
    let green = plan.tissue.lamina.to_texel()[Constituent::Chlorophyll];
    for hole in leaf.lamina.holes() {
        let texel = at(hole[0]);
        assert!(texel[Constituent::Chlorophyll] < 0.5 * green);
        assert!(texel[Constituent::Brown] > 0.3);
    }
    let wounds = leaf.lamina.wounds.as_ref().expect("wounds");
    // A rim for each hole and bite; mines where there is room.
    let rims = leaf.lamina.holes().len() + 3;
    assert!((rims + 1..=rims + 2).contains(&wounds.stains.len()));
}

#[test]
fn without_damage_nothing_changes_and_bad_numbers_are_refused() {
    let mut plan = eaten();
    plan.damage = None;
    let whole = plan.grow_lamina().expect("a good plan");
    plan.damage = Some(Damage::default());
    let lamina = plan.grow_lamina().expect("a good plan");
    assert_eq!(lamina.outline, whole.outline);
    assert_eq!(lamina.network, whole.network);
    plan.damage = Some(Damage {
        bite_mm: -1.0,
        ..Damage::default()
    });
    let message = plan.grow_lamina().expect_err("a bad number").to_string();
    assert_eq!(message, "damage: bite_mm is -1, outside 0.2 to 200");
}

/// A broad leaf with pinnate secondaries and nothing else done to it than this.
fn torn(damage: Damage) -> LeafPlan {
    let mut plan = find("tertiary").expect("a preset").plan();
    plan.map_size = 300;
    plan.damage = Some(damage);
    plan
}

#[test]
fn tears_are_cuts_of_the_mesh_between_the_larger_veins() {
    let plan = torn(Damage {
        tears: 4,
        tear_mm: 0.18 * torn(Damage::default()).length_mm,
        ..Damage::default()
    });
    let leaf = Leaf::grow(&plan).expect("a good plan");
    let lamina = &leaf.lamina;
    let wounds = lamina.wounds.as_ref().expect("wounds");
    assert_eq!(wounds.tears.len(), 4);
    assert_eq!(leaf.mesh.validate(lamina.outline.area()), Ok(()));
    assert_eq!(lamina.network.validate(), Ok(()));
    let (torn, intact) = (&lamina.outline, lamina.intact());
    // A wedge takes half its mouth times its length, a little less where the margin bulges.
    let wedges: f64 = wounds
        .tears
        .iter()
        .map(|tear| 0.5 * 0.06 * tear.length() * tear.length())
        .sum();
    let lost = intact.area() - torn.area();
    assert!((0.7..1.3).contains(&(lost / wedges)), "{lost} of {wedges}");
    for tear in &wounds.tears {
        // Its two lips are farther apart than the mouth is wide, by twice the lift.
        let (mouth, way) = tear.mouth();
        let beside = 0.031 * tear.length() * way.perp();
        let [left, right] = [1.0, -1.0].map(|side| tear.height(mouth + way * 1e-3 + beside * side));
        assert!(left * right < 0.0, "{left} {right}");
        let step = (left - right).abs() / (2.0 * 0.05 * tear.length());
        assert!((0.7..=1.0).contains(&step), "{step}");
        for vein in lamina.network.segments() {
            assert!(!tear.crosses(vein.from, vein.to), "{vein:?}");
        }
        // It follows the secondaries: neither primaries nor thick secondaries were cut.
        let whole = torn_network(&plan);
        let stopping = Places::new(intact, &whole, 0).stopping_radius();
        assert!(stopping > 0.0);
        let stops =
            |vein: &VeinSegment| vein.order == 1 || vein.order == 2 && vein.radius_from >= stopping;
        for vein in whole.segments().filter(stops) {
            assert!(!tear.crosses(vein.from, vein.to), "{vein:?}");
        }
    }
    // The mesh has come out of the plane where the lips are.
    let mut flat = plan.clone();
    if let Some(damage) = &mut flat.damage {
        damage.tear_lift = 0.0;
    }
    let flat = Leaf::grow(&flat).expect("a good plan");
    assert_eq!(flat.lamina.outline, lamina.outline);
    let apart = |leaf: &Leaf| {
        let heights = leaf.mesh.lamina.iter().map(|&p| wounds.height(p).abs());
        heights.fold(0.0, f64::max)
    };
    assert!(
        apart(&leaf) > 0.03 * 0.1 * plan.length_mm,
        "{}",
        apart(&leaf)
    );
    let moved = leaf.mesh.positions.iter().zip(&flat.mesh.positions);
    let most = moved.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!((most / apart(&leaf) - 1.0).abs() < 0.05, "{most}");
}

/// The veins of a plan before damage.
fn torn_network(plan: &LeafPlan) -> VenationNetwork {
    let whole = LeafPlan {
        damage: None,
        ..plan.clone()
    };
    whole.grow_lamina().expect("a good plan").network
}

/// The leaf before it died.
static WHOLE: LazyLock<Lamina> =
    LazyLock::new(|| torn(Damage::default()).grow_lamina().expect("a good plan"));

fn frame() -> UvFrame {
    UvFrame::around(WHOLE.outline.points())
}

/// The lamina of a leaf with this dieback, and for places over it whether they are dead.
fn died(dieback: Dieback) -> (Lamina, Vec<(DVec2, bool)>) {
    let damage = Damage {
        dieback: Some(dieback),
        ..Damage::default()
    };
    let plan = torn(damage);
    let mut lamina = WHOLE.clone();
    let (outline, wounds) = damage.done_to(&WHOLE.outline, &mut lamina.network, plan.seed);
    lamina.outline = outline;
    lamina.wounds = Some(wounds);
    let map = GrowOptions::default()
        .contents(&plan, &lamina)
        .expect("a good plan");
    let frame = UvFrame::around(lamina.intact().points());
    let green = plan.tissue.lamina[Constituent::Chlorophyll];
    let mut places = Vec::new();
    for row in 0..map.height {
        for column in 0..map.width {
            let uv = (DVec2::new(f64::from(column), f64::from(row)) + 0.5)
                / DVec2::new(f64::from(map.width), f64::from(map.height));
            let p = frame.point(uv);
            if lamina.outline.contains(p) {
                let texel = &map.texels[(row * map.width + column) as usize];
                let dead = f64::from(texel[Constituent::Chlorophyll]) < 0.02 * green
                    && texel[Constituent::Brown] > 0.5;
                places.push((p, dead));
            }
        }
    }
    (lamina, places)
}

#[test]
fn dieback_takes_the_share_of_the_blade_that_was_asked_for() {
    for share in [0.05, 0.2, 0.6] {
        for vein_speed in [0.4, 3.0] {
            let (_, places) = died(Dieback {
                share,
                vein_speed,
                ..Dieback::default()
            });
            let dead = places.iter().filter(|(_, dead)| *dead).count() as f64;
            let dead = dead / places.len() as f64;
            // The margin and the front are a texel wide; veins hold less chlorophyll to begin with.
            assert!((dead - share).abs() < 0.02, "{dead} of {share}");
        }
    }
}

#[test]
fn dieback_runs_inwards_from_margin_or_tip() {
    let even = Dieback {
        share: 0.3,
        from_tip: 0.0,
        unevenness: 0.0,
        ..Dieback::default()
    };
    let (lamina, places) = died(even);
    // Alike along the margin the front is a parallel of it.
    let distance = |p: DVec2| lamina.outline.distance_to_margin(p);
    let dead = places
        .iter()
        .filter(|(_, dead)| *dead)
        .map(|(p, _)| distance(*p));
    let green = places
        .iter()
        .filter(|(_, dead)| !*dead)
        .map(|(p, _)| distance(*p));
    let (deepest, nearest) = (
        dead.fold(0.0, f64::max),
        green.fold(f64::INFINITY, f64::min),
    );
    let cell = frame().size.max_element() / 300.0;
    assert!(
        (deepest - nearest).abs() < 2.5 * cell,
        "{deepest} {nearest} {cell}"
    );
    // From the tip alone it lies across the blade.
    let (lamina, places) = died(Dieback {
        from_tip: 1.0,
        ..even
    });
    let lowest = |wanted: bool| {
        let those = places.iter().filter(|(_, dead)| *dead == wanted);
        those
            .map(|(p, _)| p.y)
            .fold([f64::INFINITY, 0.0], |[low, high], y| {
                [low.min(y), high.max(y)]
            })
    };
    let ([dead, _], [_, green]) = (lowest(true), lowest(false));
    let length = lamina.outline.length();
    assert!((dead - green).abs() < 0.12 * length, "{dead} {green}");
}

#[test]
fn a_front_that_is_fast_in_veins_is_deeper_there() {
    let deeper = |vein_speed: f64| {
        let (lamina, places) = died(Dieback {
            share: 0.25,
            from_tip: 0.0,
            unevenness: 0.0,
            vein_speed,
            rim_mm: 0.0,
        });
        let veins: Vec<_> = lamina
            .network
            .segments()
            .filter(|vein| vein.order == 2)
            .collect();
        let near = |p: DVec2| {
            veins
                .iter()
                .any(|vein| ((vein.from + vein.to) * 0.5).distance(p) < 0.012 * 100.0)
        };
        let share = |wanted: bool| {
            let those: Vec<_> = places.iter().filter(|(p, _)| near(*p) == wanted).collect();
            those.iter().filter(|(_, dead)| *dead).count() as f64 / those.len() as f64
        };
        share(true) / share(false)
    };
    let (slow, fast) = (deeper(0.3), deeper(4.0));
    assert!(fast > 1.3 * slow, "{slow} {fast}");
}

#[test]
fn a_yellow_rim_runs_ahead_of_dead_tissue_and_seeds_differ() {
    let dieback = Dieback {
        share: 0.2,
        rim_mm: 2.0,
        ..Dieback::default()
    };
    let plan = |seed| {
        let mut plan = torn(Damage {
            dieback: Some(dieback),
            ..Damage::default()
        });
        plan.seed = seed;
        plan
    };
    let grown = plan(1);
    let lamina = grown.grow_lamina().expect("a good plan");
    let front = lamina
        .wounds
        .as_ref()
        .and_then(|wounds| wounds.front.clone());
    let front = front.expect("a front");
    let map = GrowOptions::default()
        .contents(&grown, &lamina)
        .expect("a good plan");
    let frame = UvFrame::around(lamina.intact().points());
    let green = grown.tissue.lamina;
    let mut rim = 0;
    for (i, texel) in map.texels.iter().enumerate() {
        let (column, row) = (i % map.width as usize, i / map.width as usize);
        let uv = (DVec2::new(column as f64, row as f64) + 0.5)
            / DVec2::new(f64::from(map.width), f64::from(map.height));
        let depth = front.depth(frame.point(uv));
        if (-0.5..-0.1).contains(&depth) {
            rim += 1;
            let chlorophyll = f64::from(texel[Constituent::Chlorophyll]);
            assert!(chlorophyll < 0.4 * green[Constituent::Chlorophyll]);
            let carotenoids = f64::from(texel[Constituent::Carotenoids]);
            assert!(
                carotenoids
                    > 2.0 * chlorophyll * green[Constituent::Carotenoids]
                        / green[Constituent::Chlorophyll]
            );
            assert!(texel[Constituent::Brown] < 0.1);
        }
    }
    assert!(rim > 100, "{rim}");
    let other = plan(2).grow_lamina().expect("a good plan");
    assert_ne!(other.wounds.and_then(|wounds| wounds.front), Some(front));
}

#[test]
fn bad_numbers_of_tears_and_dieback_are_refused_by_name() {
    let refused = |damage: Damage| {
        let plan = torn(damage);
        plan.grow_lamina().expect_err("a bad number").to_string()
    };
    let gape = Damage {
        tear_gape: 0.9,
        ..Damage::default()
    };
    assert_eq!(
        refused(gape),
        "damage: tear_gape is 0.9, outside 0.005 to 0.5"
    );
    let dieback = Dieback {
        vein_speed: f64::NAN,
        ..Dieback::default()
    };
    let slow = Damage {
        dieback: Some(dieback),
        ..Damage::default()
    };
    assert_eq!(
        refused(slow),
        "damage: dieback.vein_speed is NaN, outside 0.1 to 10"
    );
}
