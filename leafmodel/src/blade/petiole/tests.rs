//! Petioles of flat and bent blades, and their joints.

use super::*;
use crate::blade::mesh::BladeMesh;
use crate::blade::tests::{ellipse, flat};
use crate::venation::network::{VeinEdge, VeinNode};

fn midrib() -> VenationNetwork {
    let node = |i: u32| VeinNode {
        position: DVec2::new(0.0, f64::from(i) * 0.5),
        born: i,
    };
    let edge = |i: u32| VeinEdge {
        from: i,
        to: i + 1,
        radius_from: 0.5 - 0.003 * f64::from(i),
        radius_to: 0.5 - 0.003 * f64::from(i + 1),
        order: 1,
    };
    VenationNetwork::from_parts(
        (0..=120).map(node).collect(),
        (0..120).map(edge).collect(),
        0.5,
    )
    .expect("a midrib")
}

#[test]
fn a_petiole_is_closed_and_goes_from_its_foot_into_the_blade() {
    let outline = ellipse(20.0, 60.0, 60);
    for (curl, bend, radius_mm) in [
        (0.0_f64, 0.0, None),
        (1.0, 0.8, Some(0.9)),
        (-0.5, -1.2, Some(0.1)),
    ] {
        let form = BladeForm {
            curl: bend,
            fold: 0.3,
            relief: 0.5,
            ..flat()
        };
        let plan = PetiolePlan {
            length: 0.5,
            radius_mm,
            curl,
            course: Course::STRAIGHT,
            section: Section::default(),
        };
        let mesh = plan.build(&outline, &midrib(), &form).expect("a petiole");
        assert_eq!(mesh.validate(), Ok(()), "{curl}");
        let radius = radius_mm.unwrap_or(0.5);
        assert_eq!(plan.radius_on(&outline, &midrib()), radius);
        // The foot lies on an arc of 30 mm that leaves the base along −y and bends down.
        let foot = if curl == 0.0 {
            DVec3::NEG_Y * 30.0
        } else {
            30.0 / curl * DVec3::new(0.0, -curl.sin(), curl.cos() - 1.0)
        };
        let least = mesh
            .positions
            .iter()
            .map(|p| p.distance(foot))
            .fold(f64::INFINITY, f64::min);
        assert!(
            (least - radius * (1.0 + plan.section.foot)).abs() < 0.02 * radius,
            "{least}"
        );
        assert!((foot.z < 0.0) == (curl > 0.0) || curl == 0.0);
        assert!(
            mesh.positions.iter().any(|p| p.y > 0.02 * 60.0),
            "it reaches into the blade"
        );
    }
}

#[test]
fn the_joint_ends_within_the_vein() {
    let outline = ellipse(20.0, 60.0, 60);
    let plan = PetiolePlan {
        length: 0.3,
        radius_mm: Some(0.8),
        curl: 0.0,
        course: Course::STRAIGHT,
        section: Section::default(),
    };
    let form = BladeForm {
        relief: 0.5,
        ..flat()
    };
    let mesh = plan.build(&outline, &midrib(), &form).expect("a petiole");
    let end = mesh.positions.iter().map(|p| p.y).fold(0.0, f64::max);
    let tip = mesh.positions.iter().filter(|p| p.y > end - 0.3);
    for p in tip {
        // Half-width and height of the mound: 1.5 r, and as much as the relief says.
        assert!(p.x.abs() < 0.5 && p.z < 0.0 && p.z > -0.75, "{p}");
    }
}

#[test]
fn numbers_out_of_range_are_named() {
    let plan = PetiolePlan {
        length: 0.3,
        radius_mm: None,
        curl: 0.0,
        course: Course::STRAIGHT,
        section: Section::default(),
    };
    for (bad, name) in [
        (
            PetiolePlan {
                length: -0.1,
                ..plan
            },
            "length",
        ),
        (
            PetiolePlan {
                radius_mm: Some(0.0),
                ..plan
            },
            "radius_mm",
        ),
        (
            PetiolePlan {
                curl: f64::NAN,
                ..plan
            },
            "curl_deg",
        ),
    ] {
        let message = bad.validate().expect_err("out of range").to_string();
        assert!(message.starts_with(name), "{message}");
    }
}

/// Distance along a ray to the nearest of some triangles.
fn first_hit(from: DVec3, along: DVec3, positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let hits = triangles.iter().filter_map(|corners| {
        let [a, b, c] = corners.map(|v| positions[v as usize]);
        let (u, v) = (b - a, c - a);
        let normal = u.cross(v);
        let facing = normal.dot(along);
        let away = (a - from).dot(normal) / facing;
        let at = from + along * away - a;
        let (s, t) = (
            at.cross(v).dot(normal) / normal.length_squared(),
            u.cross(at).dot(normal) / normal.length_squared(),
        );
        // Rays may go through edges.
        let within = s.min(t).min(1.0 - s - t) >= -1e-9;
        (facing != 0.0 && within && away > 0.0).then_some(away)
    });
    hits.fold(f64::INFINITY, f64::min)
}

/// A leaf with a narrow base.
fn spindle(width: f64, length: f64) -> Outline {
    let half = |t: f64| {
        let sin = libm::sin(std::f64::consts::PI * t);
        DVec2::new(0.5 * width * sin * sin, length * t)
    };
    let right = (0..80).map(|i| half(f64::from(i) / 80.0));
    let left = (1..=80)
        .rev()
        .map(|i| half(f64::from(i) / 80.0) * DVec2::new(-1.0, 1.0));
    let apex = DVec2::new(0.0, length);
    Outline::new(right.chain(left).collect(), DVec2::ZERO, apex).expect("a spindle is simple")
}

/// A midrib that zigzags and deviates to the side by `aside` mm.
fn crooked(aside: f64) -> VenationNetwork {
    let node = |i: u32| {
        let share = f64::from(i) / 120.0;
        let zigzag = if i % 2 == 1 { 0.03 } else { 0.0 };
        VeinNode {
            position: DVec2::new(aside * share * share + zigzag, 60.0 * share),
            born: i,
        }
    };
    let thick = |i: u32| 0.5 - 0.003 * f64::from(i);
    let edge = |i: u32| VeinEdge {
        from: i,
        to: i + 1,
        radius_from: thick(i),
        radius_to: thick(i + 1),
        order: 1,
    };
    VenationNetwork::from_parts(
        (0..=120).map(node).collect(),
        (0..120).map(edge).collect(),
        0.5,
    )
    .expect("a midrib")
}

#[test]
fn the_tube_hides_the_blade_from_below_until_it_ends_and_sinks_once_from_above() {
    let bent = BladeForm {
        fold: 0.4,
        curl: 0.6,
        ruffle: 0.01,
        ruffle_waves: 3.0,
        ..flat()
    };
    for (outline, network, bend, relief, radius_mm) in [
        (ellipse(20.0, 60.0, 60), midrib(), flat(), 0.6, None),
        (spindle(24.0, 60.0), midrib(), bent, 0.6, None),
        (spindle(24.0, 60.0), crooked(8.0), bent, 0.6, None),
        (ellipse(20.0, 60.0, 60), crooked(-8.0), bent, 0.9, None),
        (spindle(24.0, 60.0), crooked(4.0), bent, 0.0, Some(0.7)),
        (spindle(24.0, 60.0), midrib(), flat(), 0.9, Some(0.1)),
    ] {
        let form = BladeForm { relief, ..bend };
        let plan = PetiolePlan {
            length: 0.5,
            radius_mm,
            curl: 0.3,
            course: Course::STRAIGHT,
            section: Section::default(),
        };
        let tube = plan.build(&outline, &network, &form).expect("a petiole");
        assert_eq!(tube.validate(), Ok(()), "{form:?} {plan:?}");
        let blade = BladeMesh::build(&outline, &network, &form).expect("a blade");
        let way = Midrib::new(&outline, &network, 12.0);
        let veins: Vec<VeinSegment> = network.segments().collect();
        let posture = || Posture::new(&form, &outline, (network.map(), &veins), None);
        let bending = posture();
        let joint = Joint::new(
            radius_mm.unwrap_or(way.radius),
            &way,
            Relief::new(&form, &veins),
            posture(),
            60.0,
        );
        // How far the tube stands out from the blade, seen from 5 mm above or below it, at a
        // distance from the midrib given as a share of the tube's radius.
        let ahead = |t: f64, beside: f64, side: f64| {
            let p = way.at(joint.length * t).0;
            let p = p + DVec2::X * (beside * joint.at(&way, t).1);
            let eye = bending.place(p, 5.0 * side);
            let along = (bending.place(p, 0.0) - eye).normalize();
            let hit = |positions: &[DVec3], triangles: &[[u32; 3]]| {
                first_hit(eye, along, positions, triangles)
            };
            let blade = hit(&blade.positions, &blade.triangles);
            blade - hit(&tube.positions, &tube.triangles)
        };
        let mut sunk = 0.0;
        for i in 1..=60 {
            let t = f64::from(i) / 60.0;
            assert!(
                ahead(t, 0.0, -1.0) > 0.0,
                "{form:?} {t}: the blade shows below by {}",
                -ahead(t, 0.0, -1.0)
            );
            // The end of the blade lies within the tube.
            for beside in [-0.5, 0.5] {
                let wide = t < 0.1;
                let below = ahead(t, beside, -1.0);
                assert!(!wide || below > 0.0, "{t} {beside}: the blade shows below");
                let above = ahead(t, beside, 1.0);
                assert!(!wide || above > 0.0, "{t} {beside}: the blade shows above");
            }
            let above = ahead(t, 0.0, 1.0);
            if sunk == 0.0 && above < 0.0 {
                sunk = t;
            }
            assert!(
                sunk == 0.0 || above < 0.0,
                "{t}: it comes up again, {above}"
            );
            // Where it has sunk it still lies on the blade.
            assert!(above > -0.02, "{t}: a gap of {above}");
        }
        assert!(sunk > 0.3, "{sunk}");
        // There is no step at its end.
        assert!(ahead(1.0, 0.0, -1.0) < 0.06, "{}", ahead(1.0, 0.0, -1.0));
    }
}

#[test]
fn a_petiole_takes_its_course_and_is_closed_on_each_leaf_in_a_way_of_its_own() {
    let outline = ellipse(20.0, 60.0, 60);
    let plan = PetiolePlan {
        length: 0.6,
        radius_mm: Some(0.7),
        curl: 0.2,
        course: Course {
            sag: 0.4,
            neck: -0.5,
            neck_length: 0.2,
            sway: 0.3,
            twist: 0.5,
            stray: 0.15,
        },
        section: Section {
            groove: 0.4,
            flatness: 0.4,
            foot: 0.5,
            head: 0.3,
        },
    };
    let network = midrib();
    let foot = |seed: u64| {
        let tube = plan.settled((&outline, &network), &flat(), None, seed);
        let tube = tube.expect("a petiole");
        assert_eq!(tube.validate(), Ok(()), "{seed}");
        tube.positions[0]
    };
    let feet: Vec<DVec3> = (0..8).map(foot).collect();
    for (i, a) in feet.iter().enumerate() {
        assert!(a.x > 0.0 && a.y < -25.0, "{a}");
        for b in &feet[..i] {
            assert!(a.distance(*b) > 0.1, "{a} {b}");
        }
    }
}

/// Veins that spread from a base inside the blade.
fn star(base: DVec2, rays: u32) -> VenationNetwork {
    let mut nodes = vec![VeinNode {
        position: base,
        born: 0,
    }];
    let mut edges = Vec::new();
    for ray in 0..rays {
        let turn = std::f64::consts::TAU * (f64::from(ray) + 0.25) / f64::from(rays);
        for step in 1..=20 {
            let way = 0.45 * f64::from(step);
            let last = nodes.len() as u32 - 1;
            nodes.push(VeinNode {
                position: base + way * DVec2::new(libm::sin(turn), libm::cos(turn)),
                born: step,
            });
            edges.push(VeinEdge {
                from: if step == 1 { 0 } else { last },
                to: last + 1,
                radius_from: 0.35 - 0.01 * f64::from(step - 1),
                radius_to: 0.35 - 0.01 * f64::from(step),
                order: 1,
            });
        }
    }
    VenationNetwork::from_parts(nodes, edges, 0.45).expect("a star")
}

#[test]
fn the_petiole_of_a_peltate_leaf_meets_the_blade_all_around_without_a_gap() {
    // An ellipse whose base lies 12 mm above its lower end.
    let whole = ellipse(30.0, 40.0, 90);
    let base = DVec2::new(0.0, 12.0);
    let outline = Outline::new(whole.points().to_vec(), base, DVec2::new(0.0, 40.0));
    let outline = outline.expect("a base inside");
    let network = star(base, 7);
    let bent = Course {
        sag: -0.8,
        sway: 0.3,
        twist: 0.4,
        ..Course::STRAIGHT
    };
    for (relief, fold, course) in [
        (0.0, 0.0, Course::STRAIGHT),
        (0.6, 0.2, bent),
        (0.6, -0.3, bent),
    ] {
        let form = BladeForm {
            relief,
            fold,
            curl: 0.4,
            ..flat()
        };
        let plan = PetiolePlan {
            length: 0.8,
            radius_mm: Some(0.8),
            curl: 0.1,
            course,
            section: Section {
                groove: 0.3,
                ..Section::default()
            },
        };
        let tube = plan.build(&outline, &network, &form).expect("a petiole");
        assert_eq!(tube.validate(), Ok(()), "{form:?}");
        let blade = BladeMesh::build(&outline, &network, &form).expect("a blade");
        let veins: Vec<VeinSegment> = network.segments().collect();
        let posture = Posture::new(&form, &outline, (network.map(), &veins), None);
        // What a ray along the blade's normal meets first, from above (1) or below (−1).
        let tube_is_first = |p: DVec2, side: f64| {
            let eye = posture.place(p, 3.0 * side);
            let along = (posture.place(p, 0.0) - eye).normalize();
            let hit = |positions: &[DVec3], triangles: &[[u32; 3]]| {
                first_hit(eye, along, positions, triangles)
            };
            let blade = hit(&blade.positions, &blade.triangles);
            assert!(blade.is_finite(), "a hole in the blade at {p}");
            hit(&tube.positions, &tube.triangles) < blade
        };
        let rim = 1.7 * 0.8;
        for i in 0..40 {
            let turn = std::f64::consts::TAU * (f64::from(i) + 0.3) / 40.0;
            let at = |share: f64| base + share * rim * DVec2::new(libm::cos(turn), libm::sin(turn));
            // Under its whole width the tube hides the blade from both sides; beside it, the blade
            // lies bare. Between them is the rim: nowhere does the tube stand off the blade.
            for share in [0.1, 0.5, 0.9] {
                assert!(tube_is_first(at(share), 1.0), "{share} of the rim, above");
            }
            // Farther in, the eye would be within the stalk.
            for share in [0.7, 0.8, 0.9] {
                assert!(tube_is_first(at(share), -1.0), "{share} of the rim, below");
            }
            assert!(!tube_is_first(at(1.3), 1.0), "it stands over the blade");
            assert!(!tube_is_first(at(1.3), -1.0), "it hangs below the blade");
        }
        // It comes from below.
        let lowest = tube.positions.iter().map(|p| p.z).fold(0.0, f64::min);
        assert!(lowest < -15.0, "{lowest}");
    }
}

#[test]
fn the_rim_of_a_peltate_petiole_lies_on_both_sides_of_the_blade() {
    let whole = ellipse(30.0, 40.0, 90);
    let base = DVec2::new(0.0, 12.0);
    let outline = Outline::new(whole.points().to_vec(), base, DVec2::new(0.0, 40.0));
    let outline = outline.expect("a base inside");
    let plan = PetiolePlan {
        length: 0.5,
        radius_mm: Some(0.8),
        curl: 0.0,
        course: Course::STRAIGHT,
        section: Section::default(),
    };
    let tube = plan
        .build(&outline, &star(base, 5), &flat())
        .expect("a petiole");
    // Of the flat blade, z = 0: the ring of the rim below it, the dome's first one above it, each
    // within 2 % of the radius.
    let near = |low: f64, high: f64| {
        let rim = tube
            .positions
            .iter()
            .filter(|p| p.truncate().length() > 1.2);
        rim.filter(|p| (low..high).contains(&p.z)).count()
    };
    assert!(near(-0.0161, 0.0) >= 8 && near(0.0, 0.0161) >= 8);
}

#[test]
fn a_petiole_is_a_tube_even_where_veins_are_thicker_than_it_is_long() {
    let outline = ellipse(0.15, 0.43, 60);
    let node = |i: u32| VeinNode {
        position: DVec2::new(0.0, f64::from(i) * 0.03),
        born: i,
    };
    let edge = |i: u32| VeinEdge {
        from: i,
        to: i + 1,
        radius_from: 52.0,
        radius_to: 51.0,
        order: 1,
    };
    let network = VenationNetwork::from_parts(
        (0..=12).map(node).collect(),
        (0..12).map(edge).collect(),
        0.03,
    )
    .expect("a midrib");
    for curl in [-2.9, -1.5, 0.0, 1.5, 2.967] {
        for relief in [0.0, 0.27, 1.0] {
            let plan = PetiolePlan {
                length: 0.139,
                radius_mm: Some(0.017),
                curl,
                course: Course {
                    sag: 0.5 * curl,
                    neck: 1.9,
                    neck_length: 0.02,
                    ..Course::STRAIGHT
                },
                section: Section::default(),
            };
            let form = BladeForm { relief, ..flat() };
            let tube = plan.build(&outline, &network, &form).expect("a petiole");
            assert!(
                tube.positions.iter().all(|p| p.is_finite()),
                "{curl} {relief}"
            );
            assert!(
                tube.normals.iter().all(|n| n.is_finite()),
                "{curl} {relief}"
            );
        }
    }
}
