//! Ash and horse chestnut in space and in the plane.

use super::super::Feather;
use super::super::tests::{feather, leaflet, palmate};
use super::*;
use crate::compound::{Arrangement, FlatLeaf};
use crate::leaf::Lamina;
use crate::optics::Constituent;
use crate::shape::outline::Outline;

/// A leaf with few veins.
fn plan(arrangement: Arrangement, change: impl FnOnce(&mut CompoundForm)) -> LeafPlan {
    let mut plan = leaflet();
    let mut veins = plan.venation.auxin().expect("the veins grow").clone();
    veins.final_length = 60.0;
    veins.growth = crate::venation::plan::Growth::None;
    plan.venation = veins.into();
    plan.map_size = 16;
    plan.form.max_edge_mm = 4.0;
    let mut form = CompoundForm {
        petiole: 0.5,
        petiolule: 0.08,
        variants: 2,
        ..CompoundForm::new(arrangement)
    };
    change(&mut form);
    plan.compound = Some(form);
    plan
}

#[test]
fn a_leaf_that_is_not_bent_lies_where_it_is_arranged() {
    let plan = plan(Arrangement::Pinnate(feather()), |_| ());
    let whole = WholeLeaf::grow(&plan).expect("a good plan");
    let flat = whole.flat.as_ref().expect("it is compound");
    assert_eq!((whole.blades.len(), whole.placements.len()), (2, 11));
    for (placement, leaflet) in whole.placements.iter().zip(&flat.leaflets) {
        for p in [DVec2::ZERO, DVec2::new(3.0, 20.0)] {
            let placed = placement.to_leaf.transform_point3(p.extend(0.0));
            assert!(
                (placed - leaflet.place(p).extend(0.0)).length() < 1e-9,
                "{placed}"
            );
        }
    }
    let axes = whole.axes.expect("it has a rachis");
    assert_eq!(axes.validate(), Ok(()));
    assert!(axes.positions.iter().all(|p| p.z.abs() < 2.0));
}

#[test]
fn leaflets_stay_on_a_bent_rachis_and_are_raised_about_it() {
    let plan = plan(Arrangement::Pinnate(feather()), |form| {
        form.curl = 1.0;
        form.fold = 0.4;
    });
    let whole = WholeLeaf::grow(&plan).expect("a good plan");
    let flat = whole.flat.as_ref().expect("it is compound");
    let axes = whole.axes.as_ref().expect("it has a rachis");
    for (placement, leaflet) in whole.placements.iter().zip(&flat.leaflets) {
        let own_foot = DVec3::Y * (-0.08 * plan.length_mm);
        let foot = placement.to_leaf.transform_point3(own_foot);
        let near = axes
            .positions
            .iter()
            .map(|p| p.distance(foot))
            .fold(f64::INFINITY, f64::min);
        // On the axis, whose surface is a radius away; vertices are some millimetres apart.
        assert!(near < 2.0, "{near}");
        let midrib = placement.to_leaf.transform_vector3(DVec3::Y).normalize();
        let up = DVec3::new(
            0.0,
            libm::sin(whole_angle(foot)),
            libm::cos(whole_angle(foot)),
        );
        let expected = libm::sin(leaflet.from_axis) * libm::sin(0.4 * libm::sin(leaflet.from_axis));
        assert!(
            (midrib.dot(up) - expected).abs() < 1e-9,
            "{midrib} {expected}"
        );
        assert_eq!(
            placement.to_leaf.matrix3.determinant() < 0.0,
            leaflet.mirrored
        );
    }
}

/// The angle by which the plane has turned at a point of an arc of 1 radian over petiole and
/// rachis, 108 mm.
fn whole_angle(p: DVec3) -> f64 {
    libm::atan2(-p.z, p.y) * 2.0
}

#[test]
fn the_flat_leaf_is_one_graph_from_the_petioles_foot() {
    for arrangement in [Arrangement::Pinnate(feather()), palmate()] {
        let plan = plan(arrangement, |_| ());
        let form = plan.compound.as_ref().expect("it is compound");
        let leaf = form.arrange(&plan).expect("a good plan");
        let laminas: Vec<Lamina> = leaflet_plans(&plan, form)
            .iter()
            .map(|plan| plan.grow_lamina().expect("a good plan"))
            .collect();
        let flat = FlatLeaf::compound(&leaf, &laminas.iter().collect::<Vec<_>>()).expect("a leaf");
        assert_eq!(flat.network.validate(), Ok(()));
        assert_eq!((flat.network.components(), flat.network.origins()), (1, 1));
        assert_eq!(flat.outlines.len(), leaf.leaflets.len());
        let loops = leaf
            .leaflets
            .iter()
            .map(|l| laminas[l.variant as usize].network.loops());
        assert_eq!(flat.network.loops(), loops.sum::<usize>());
        let area = leaf
            .leaflets
            .iter()
            .map(|l| laminas[l.variant as usize].outline.area() * l.scale * l.scale);
        let (all, expected): (f64, f64) =
            (flat.outlines.iter().map(Outline::area).sum(), area.sum());
        assert!((all / expected - 1.0).abs() < 1e-9);
        let (low, high) = flat.bounds();
        assert!(low.y < 1e-9 && high.y > 40.0 && low.x < -20.0 && high.x > 20.0);
    }
}

#[test]
fn tilts_are_chance_that_the_seed_decides() {
    let with = |seed: u64, tilt: f64| {
        let mut plan = plan(palmate(), |form| form.tilt = tilt);
        plan.seed = seed;
        WholeLeaf::grow(&plan).expect("a good plan").placements
    };
    assert_eq!(with(1, 0.2), with(1, 0.2));
    assert_ne!(with(1, 0.2), with(2, 0.2));
    assert_ne!(with(1, 0.2), with(1, 0.0));
}

#[test]
fn stalks_age_as_the_base_of_the_blade_does() {
    use crate::blade::senescence::{AgeSource, Senescence};

    let mut plan = plan(Arrangement::Pinnate(feather()), |_| ());
    plan.compound = None;
    let example = crate::transport::example(1).expect("there is one");
    plan.outline = crate::leaf::outline_plan::Contour::Transport(example).into();
    plan.petiole = Some(PetiolePlan {
        length: 0.3,
        radius_mm: None,
        curl: 0.0,
        course: crate::blade::petiole::Course::STRAIGHT,
        section: crate::blade::petiole::Section::default(),
    });
    let dead = plan
        .tissue
        .lamina
        .with(&[(Constituent::Chlorophyll, 0.0), (Constituent::Brown, 2.0)]);
    let mut at = |share: Option<f64>| {
        plan.senescence = share.map(|share| Senescence {
            source: AgeSource::Revenue { share },
            blend: 0.1,
            contents: dead,
        });
        let leaf = WholeLeaf::grow(&plan).expect("a good plan");
        leaf.stalk_contents(&plan).expect("it has cells")
    };
    let (living, summer, end) = (at(None), at(Some(1.0)), at(Some(0.0)));
    assert_eq!(living, summer);
    assert!(living[Constituent::Chlorophyll] > 0.0 && living[Constituent::Brown] < 1.0);
    assert_eq!(end[Constituent::Chlorophyll], 0.0);
    assert!(end[Constituent::Brown] > living[Constituent::Brown]);
}

#[test]
fn a_single_pair_is_at_the_end_of_its_rachis() {
    // Found by a random plan: it was at the start, and the rest had a radius of 0.
    let pair = |rachis| Feather {
        pairs: 1,
        terminal: false,
        rachis,
        ..feather()
    };
    let arrangement = Arrangement::Bipinnate {
        pinnae: Feather {
            pairs: 2,
            ..feather()
        },
        leaflets: pair(0.03),
        stalk: 100.0,
    };
    let whole = WholeLeaf::grow(&plan(arrangement, |_| ())).expect("a good plan");
    let axes = whole.axes.expect("it has stalks");
    assert_eq!(axes.validate(), Ok(()));
}

#[test]
fn a_leaf_on_the_ground_lies_on_it_flat_and_holds_together() {
    let arrangements = [Arrangement::Pinnate(feather()), palmate()];
    for (arrangement, curl) in arrangements.into_iter().zip([2.0, -0.8]) {
        let mut plan = plan(arrangement, |form| {
            (form.curl, form.fold, form.tilt) = (curl, 0.5, 0.3);
        });
        plan.form.curl = 0.4;
        let held = WholeLeaf::grow(&plan).expect("a good plan");
        plan.stance.on_ground = true;
        let lying = WholeLeaf::grow(&plan).expect("a good plan");
        let heights = |leaf: &WholeLeaf| {
            let mut heights: Vec<f64> = leaf
                .placements
                .iter()
                .flat_map(|placement| {
                    let blade = &leaf.blades[placement.blade];
                    let stalk = blade.petiole.iter().flat_map(|stalk| &stalk.positions);
                    let points = blade.mesh.positions.iter().chain(stalk);
                    points.map(|&p| placement.to_leaf.transform_point3(p).z)
                })
                .chain(
                    leaf.axes
                        .iter()
                        .flat_map(|axes| &axes.positions)
                        .map(|p| p.z),
                )
                .collect();
            heights.sort_by(f64::total_cmp);
            heights
        };
        let (above, before) = (heights(&lying), heights(&held));
        assert!(before[0] < -1.0, "held it reaches below the plane");
        assert!(above[0] > -1e-9, "{} mm deep", above[0]);
        // Of a leaf 150 mm long: it neither stands nor floats.
        let highest = above[above.len() - 1];
        assert!(highest < 15.0 && above[2] < 0.5, "{highest} {}", above[2]);
        // Petiolules begin on the axis, which is turned as a whole.
        let flat = lying.flat.as_ref().expect("it is compound");
        let foot = |number: usize| {
            let placement = &lying.placements[number];
            let stalk = lying.blades[placement.blade].petiole.as_ref();
            let foot = stalk.expect("leaflets have stalks").positions[0];
            placement.to_leaf.transform_point3(foot)
        };
        for number in 1..flat.leaflets.len() {
            let expected = flat.leaflets[number].foot.distance(flat.leaflets[0].foot);
            let found = foot(number).distance(foot(0));
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
        assert_eq!(lying.axes.expect("it has axes").validate(), Ok(()));
    }
}
