//! Flowers, pots, walls.

use super::*;

fn feet_of(kinds: usize, individuals: u32) -> Vec<Vec<Foot>> {
    vec![vec![SESSILE; individuals as usize]; kinds]
}

#[test]
fn a_trillium_has_three_leaves_sepals_and_petals_that_alternate() {
    let plan = presets::find("trillium").expect("a preset").plan();
    let plant = Plant::grow(&plan, &feet_of(3, plan.individuals), None).expect("a good plan");
    let of = |kind: usize| plant.leaves.iter().filter(move |leaf| leaf.kind == kind);
    assert_eq!([0, 1, 2].map(|kind| of(kind).count()), [3, 3, 3]);
    // Above the whorl of leaves, by about the peduncle's length.
    let height = |kind: usize| of(kind).map(|leaf| leaf.node.z).sum::<f64>() / 3.0;
    let above = height(1) - height(0);
    assert!((40.0..62.0).contains(&above), "{above}");
    assert!(height(2) > height(1));
    // About the flower's axis, petals stand between sepals.
    let middle = |kind: usize| of(kind).map(|leaf| leaf.node).sum::<DVec3>() / 3.0;
    let axis = (middle(2) - middle(1)).normalize();
    let out = |leaf: &BorneLeaf, kind: usize| (leaf.node - middle(kind)).normalize();
    for sepal in of(1) {
        for petal in of(2) {
            let angle = out(sepal, 1).angle_between(out(petal, 2));
            let off = (angle - PI / 3.0).abs().min((angle - PI).abs());
            assert!(off < 1e-6, "{angle}");
        }
        // It stands out from the axis by its angle, less or more by a few degrees.
        let angle = sepal.to_plant.matrix3.y_axis.angle_between(axis);
        assert!(
            (angle - FlowerPlan::USUAL.angles[0]).abs() < 0.25,
            "{angle}"
        );
    }
    let organs: Vec<Organ> = plant.organs.iter().map(|organ| organ.0).collect();
    let expected = [
        Organ::Peduncle,
        Organ::Filaments,
        Organ::Anthers,
        Organ::Pistil,
    ];
    assert_eq!(organs, expected);
    for (organ, body) in &plant.organs {
        assert_eq!(body.validate(), Ok(()), "{organ:?}");
    }
    let anthers = plant.organs[2].1.positions.iter();
    let highest = anthers
        .map(|p| (*p - middle(2)).dot(axis))
        .fold(0.0, f64::max);
    // Stamens of 15 to 25 mm.
    assert!((15.0..25.0).contains(&highest), "{highest}");
    assert!(
        refused(Plant::grow(&plan, &feet_of(2, 3), None)).starts_with("a plant bears one leaf")
    );
}

#[test]
fn a_potted_plant_stands_in_its_soil_and_the_soil_in_the_pot() {
    let plan = presets::find("croton-in-pot").expect("a preset").plan();
    let pot = plan.pot.expect("it has a pot");
    let plant = Plant::grow(&plan, &feet_of(1, plan.individuals), None).expect("a good plan");
    let body = |organ: Organ| {
        let found = plant.organs.iter().find(|own| own.0 == organ);
        &found.expect("it is there").1
    };
    let lowest = |body: &StalkMesh| body.positions.iter().map(|p| p.z).fold(f64::MAX, f64::min);
    let (vessel, soil) = (body(Organ::Pot), body(Organ::Soil));
    assert!(lowest(vessel).abs() < 1e-9);
    let top = vessel.positions.iter().map(|p| p.z).fold(0.0, f64::max);
    assert!((top - pot.height_mm - pot.wall_mm).abs() < 1e-9, "{top}");
    let widest = vessel.positions.iter().map(|p| p.truncate().length());
    let widest = widest.fold(0.0, f64::max);
    assert!((widest - 0.5 * pot.diameter_mm).abs() < 0.05 * pot.diameter_mm);
    // The soil ends within the wall, below the rim.
    let rim = soil.positions.iter().map(|p| p.truncate().length());
    let rim = rim.fold(0.0, f64::max);
    assert!(rim > pot.soil_radius() && rim < pot.soil_radius() + pot.wall_mm);
    assert!(soil.positions.iter().all(|p| p.z < top));
    // Each stem has its foot below the soil; the axes rise from three places.
    assert!(lowest(&plant.axes) < lowest(soil) + 0.5 * pot.crumb_mm);
    let below = plant
        .axes
        .positions
        .iter()
        .filter(|p| p.z < pot.soil_height() - 3.0);
    assert!(below.count() > 3 * 8);
    assert!(plant.crumbs.len() > 500);
    for crumb in &plant.crumbs {
        assert!(crumb.at.truncate().length() + crumb.radius_mm < pot.soil_radius() + 1e-9);
        let surface = soil.positions.iter().min_by(|a, b| {
            let far = |p: &DVec3| p.truncate().distance(crumb.at.truncate());
            far(a).total_cmp(&far(b))
        });
        let gap = crumb.at.z - surface.expect("it has vertices").z;
        // Its middle lies above the soil, its lower side below.
        assert!(gap.abs() < crumb.radius_mm + 1.5, "{gap}");
    }
}

#[test]
fn a_pot_whose_walls_fill_it_is_refused() {
    let mut plan = shoot(Phyllotaxis::SPIRAL);
    plan.pot = Some(PotPlan {
        wall_mm: 60.0,
        ..PotPlan::USUAL
    });
    assert!(refused(plan.validate()).starts_with("the walls of the pot"));
}

/// Steps of bricks: 12 mm high every other 40 mm, in the plane x = 0.
fn stepped() -> Wall {
    let mut triangles = Vec::new();
    for step in -20..40_i32 {
        let height = if step % 2 == 0 { 12.0 } else { 0.0 };
        let [low, high] = [f64::from(step) * 40.0, f64::from(step + 1) * 40.0];
        let corner = |y: f64, z: f64| DVec3::new(height, y, z);
        let [a, b] = [corner(-900.0, low), corner(900.0, low)];
        let [c, d] = [corner(900.0, high), corner(-900.0, high)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    Wall::of(&triangles, DVec3::X)
}

#[test]
fn axes_that_climb_lie_on_the_wall_and_leaves_stand_off_it() {
    let plan = presets::find("ivy-on-wall").expect("a preset").plan();
    let climbing = plan.climbing.expect("it climbs");
    let leaf = species::find("ivy").expect("a preset").plan();
    let feet = (0..u64::from(plan.individuals))
        .map(|number| Foot::of(&leaf.individual(None, number + 1)).expect("it is borne"));
    let feet = vec![feet.collect::<Vec<_>>()];
    let even = Wall::flat(DVec3::X);
    for wall in [&even, &stepped()] {
        let plant = Plant::grow(&plan, &feet, Some(wall)).expect("a good plan");
        assert_eq!(plant.axes.validate(), Ok(()));
        assert!(plant.leaves.len() > 60, "{}", plant.leaves.len());
        let mut near = 0;
        for leaf in &plant.leaves {
            // The middle line lies as far before the wall as the axis is thick, and never within.
            let before = leaf.node.x - wall.height(leaf.node);
            assert!((0.2..20.0).contains(&before), "{before}");
            near += u32::from(before < 8.0);
            let foot = &feet[0][leaf.individual as usize];
            for point in foot.reach() {
                let place = leaf.to_plant.transform_point3(foot.at + point);
                let gap = place.x - wall.height(place);
                assert!(gap > 0.5 * climbing.clearance_mm, "{gap}");
            }
            // Blades face the light, not the wall.
            assert!(leaf.to_plant.matrix3.z_axis.x > 0.0);
        }
        assert!(f64::from(near) > 0.4 * plant.leaves.len() as f64, "{near}");
        // Rootlets reach the wall: some vertices lie just behind its surface.
        let touching = plant.axes.positions.iter().filter(|place| {
            let gap = place.x - wall.height(**place);
            (-0.6..0.2).contains(&gap)
        });
        assert!(touching.count() > 500);
    }
}

#[test]
fn a_wall_has_the_heights_of_its_triangles_and_beside_them_those_of_the_plane() {
    let wall = stepped();
    for (z, height) in [(20.0, 12.0), (60.0, 0.0), (100.0, 12.0), (-20.0, 0.0)] {
        assert!((wall.height(DVec3::new(5.0, 30.0, z)) - height).abs() < 1e-6);
    }
    assert_eq!(wall.height(DVec3::new(0.0, 5000.0, 0.0)), 0.0);
    assert_eq!(Wall::of(&[], DVec3::Z), Wall::flat(DVec3::Z));
}

#[test]
fn stems_rise_side_by_side_within_their_spread() {
    let alone = grown(&shoot(Phyllotaxis::SPIRAL));
    let mut plan = shoot(Phyllotaxis::SPIRAL);
    plan.stems = Stems {
        count: 4,
        spread_mm: 50.0,
        fan: 0.3,
    };
    let plant = grown(&plan);
    assert!(plant.leaves.len() > 2 * alone.leaves.len());
    let lowest = plant.axes.positions.iter().filter(|p| p.z < 2.0);
    let widest = lowest.map(|p| p.truncate().length()).fold(0.0, f64::max);
    assert!((30.0..55.0).contains(&widest), "{widest}");
}
