use glam::Vec3;

use super::*;
use crate::geometry::TriangleMesh;

impl Scatter {
    /// The places of any number of things.
    fn places(
        &self,
        ground: &Ground,
        others: impl IntoIterator<Item = [DVec3; 3]>,
        bodies: &[Body],
    ) -> Result<Vec<Strewn>, ScatterError> {
        self.places_up_to(ground, others, bodies, Most::UNBOUND, &|_| {})
    }
}

/// A sheet of `n` × `n` squares over the square of side `side` around the origin.
fn sheet(side: f64, n: u32, height: impl Fn(f64, f64) -> f64) -> TriangleMesh {
    let at = |i: u32| side * (f64::from(i) / f64::from(n) - 0.5);
    let places = (0..=n).flat_map(|y| (0..=n).map(move |x| (at(x), at(y))));
    let positions = places.map(|(x, y)| DVec3::new(x, y, height(x, y)).as_vec3());
    let corner = |x: u32, y: u32| y * (n + 1) + x;
    let squares = (0..n).flat_map(|y| (0..n).map(move |x| (x, y)));
    let triangles = squares.flat_map(|(x, y)| {
        let [a, b] = [corner(x, y), corner(x + 1, y)];
        let [c, d] = [corner(x + 1, y + 1), corner(x, y + 1)];
        [[a, b, c], [a, c, d]]
    });
    TriangleMesh::new(positions.collect(), None, None, triangles.collect()).expect("a sheet")
}

fn ball(radius: f64) -> TriangleMesh {
    let (rings, around) = (48, 96);
    let at = |ring: u32, step: u32| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(ring) / f64::from(rings));
        let (y, x) = libm::sincos(std::f64::consts::TAU * f64::from(step) / f64::from(around));
        (radius * DVec3::new(sin * x, sin * y, cos)).as_vec3()
    };
    let positions: Vec<Vec3> = (0..=rings)
        .flat_map(|ring| (0..around).map(move |step| at(ring, step)))
        .collect();
    let triangles = (0..rings).flat_map(|ring| {
        (0..around).flat_map(move |step| {
            let next = (step + 1) % around;
            let [a, b] = [ring * around + step, ring * around + next];
            let (upper, lower) = ([a, b + around, b], [a, a + around, b + around]);
            // At the poles one of the two has no area.
            match ring {
                0 => vec![lower],
                _ if ring + 1 == rings => vec![upper],
                _ => vec![upper, lower],
            }
        })
    });
    TriangleMesh::new(positions, None, None, triangles.collect()).expect("a ball")
}

fn plan(count: u32) -> Scatter {
    Scatter {
        amount: Amount::Count(count),
        within: None,
        least_distance: 0.0,
        scale: [1.0; 2],
        tilt: 0.0,
        turn: std::f64::consts::PI,
        flipped: 0.0,
        upright: false,
        rest: Rest::Settled { gap: 0.0 },
        furrows: 0.0,
        merge: false,
        seed: 1,
    }
}

fn alone(mesh: &TriangleMesh) -> [(&TriangleMesh, DAffine3); 1] {
    [(mesh, DAffine3::IDENTITY)]
}

fn floor(side: f64) -> TriangleMesh {
    sheet(side, 1, |_, _| 0.0)
}

/// The corners of a strewn mesh in the world.
fn corners(mesh: &TriangleMesh, place: &Strewn) -> Vec<DVec3> {
    let positions = mesh.positions().iter();
    positions
        .map(|p| place.to_world.transform_point3(p.as_dvec3()))
        .collect()
}

#[test]
fn a_leaning_card_comes_to_lie_flat() {
    let (ground, card) = (floor(1.0), sheet(0.1, 20, |_, _| 0.0));
    let plan = Scatter {
        tilt: 1.2,
        rest: Rest::Settled { gap: 0.001 },
        least_distance: 0.15,
        ..plan(6)
    };
    let ground = Ground::of(alone(&ground)).expect("a ground");
    let places = plan.places(&ground, [], &[Body::of(alone(&card))]);
    for place in places.expect("there is room") {
        for corner in corners(&card, &place) {
            assert!((corner.z - 0.001).abs() < 1e-4, "{corner}");
        }
    }
}

#[test]
fn a_card_on_two_rods_lies_in_the_plane_of_both() {
    // Two rods along y at x = ±0.03, 10 and 4 mm high.
    let rod = |x: f64, height: f64| {
        let corner = |dx: f64, y: f64, z: f64| DVec3::new(x + dx, y, z);
        let [a, b, c] = [
            corner(-1e-4, -1.0, height),
            corner(1e-4, -1.0, height),
            corner(0.0, 1.0, height),
        ];
        [a, b, c]
    };
    let rods = [rod(-0.03, 0.010), rod(0.03, 0.004)];
    let (ground, card) = (floor(0.002), sheet(0.1, 50, |_, _| 0.0));
    let plan = Scatter {
        tilt: 0.3,
        ..plan(1)
    };
    let places = plan.places(
        &Ground::of(alone(&ground)).expect("a ground"),
        rods,
        &[Body::of(alone(&card))],
    );
    let up = places.expect("there is room")[0].to_world.matrix3.z_axis;
    // Rods are lines across the card, so its slope along x is theirs and along y it is level.
    let slope = up.x / up.z;
    assert!((slope - 0.006 / 0.06).abs() < 0.005, "{up}");
    assert!((up.y / up.z).abs() < 0.005, "{up}");
}

#[test]
fn a_ball_lies_on_its_lowest_point() {
    let (ground, ball) = (floor(0.5), ball(0.02));
    let places = plan(1).places(
        &Ground::of(alone(&ground)).expect("a ground"),
        [],
        &[Body::of(alone(&ball))],
    );
    let place = places.expect("there is room")[0].to_world.translation;
    assert!((place.z - 0.02).abs() < 2e-4, "{place}");
}

/// Whether the segment from `a` to `b` passes through a triangle.
fn pierces(a: DVec3, b: DVec3, [p, q, r]: [DVec3; 3]) -> bool {
    let side = |x: DVec3| (q - p).cross(r - p).dot(x - p);
    if side(a) * side(b) >= 0.0 {
        return false;
    }
    let volume = |u: DVec3, v: DVec3| (b - a).dot((u - a).cross(v - a));
    let [x, y, z] = [volume(p, q), volume(q, r), volume(r, p)];
    (x > 0.0 && y > 0.0 && z > 0.0) || (x < 0.0 && y < 0.0 && z < 0.0)
}

/// The greatest or least height of triangles over a point of the plan; infinite without any.
fn height(triangles: &[[DVec3; 3]], point: DVec3, which: fn(f64, f64) -> f64) -> f64 {
    let over = |[p, q, r]: &[DVec3; 3]| {
        let from = |corner: &DVec3| (*corner - point).truncate();
        let (a, b, c) = (from(p), from(q), from(r));
        let shares = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
        let sum: f64 = shares.iter().sum();
        let inside = sum != 0.0 && shares.iter().all(|share| share / sum >= 0.0);
        inside.then(|| (shares[0] * p.z + shares[1] * q.z + shares[2] * r.z) / sum)
    };
    let heights = triangles.iter().filter_map(over);
    let nothing = which(f64::NEG_INFINITY, f64::INFINITY);
    heights.fold(-nothing, which)
}

#[test]
fn curled_leaves_in_a_heap_neither_pass_through_one_another_nor_hang_in_the_air() {
    // Saddles and bowls with a curl of some 10 mm on 80.
    let shapes = [
        sheet(0.08, 12, |x, y| 8.0 * (x * x - y * y)),
        sheet(0.08, 12, |x, y| 6.0 * x * x + 3.0 * y * y),
        sheet(0.06, 12, |x, y| 4.0 * x * y),
    ];
    let hills = sheet(0.3, 30, |x, y| {
        0.01 * libm::sin(30.0 * x) * libm::cos(25.0 * y)
    });
    let bodies: Vec<Body> = shapes.iter().map(|mesh| Body::of(alone(mesh))).collect();
    let plan = Scatter {
        tilt: 0.5,
        flipped: 0.5,
        within: Some([DVec2::splat(-0.08), DVec2::splat(0.08)]),
        rest: Rest::Settled { gap: 1e-4 },
        ..plan(30)
    };
    let ground = Ground::of(alone(&hills)).expect("a ground");
    let places = plan.places(&ground, [], &bodies).expect("there is room");
    assert!(
        places
            .iter()
            .any(|place| place.to_world.matrix3.z_axis.z < 0.0)
    );
    let mut below: Vec<[DVec3; 3]> = ground.triangles().collect();
    let mut highest = 0.0_f64;
    for place in &places {
        let mesh = &shapes[place.body as usize];
        let at = corners(mesh, place);
        let own: Vec<[DVec3; 3]> = mesh
            .triangles()
            .iter()
            .map(|triangle| triangle.map(|corner| at[corner as usize]))
            .collect();
        let edges = |triangle: [DVec3; 3]| {
            let [a, b, c] = triangle;
            [[a, b], [b, c], [c, a]]
        };
        let box_of = |triangle: &[DVec3; 3]| {
            let [a, b, c] = *triangle;
            (a.min(b).min(c), a.max(b).max(c))
        };
        for mine in &own {
            let (least, most) = box_of(mine);
            for other in &below {
                let (low, high) = box_of(other);
                if least.cmpgt(high).any() || low.cmpgt(most).any() {
                    continue;
                }
                let through = edges(*mine).iter().any(|[a, b]| pierces(*a, *b, *other))
                    || edges(*other).iter().any(|[a, b]| pierces(*a, *b, *mine));
                assert!(!through, "{place:?}");
            }
        }
        // Points that nearly touch what lies below, seen from the centre of mass: on all sides.
        let middle = place
            .to_world
            .transform_point3(bodies[place.body as usize].middle());
        let points = |[p, q, r]: [DVec3; 3]| {
            let middle = |a: DVec3, b: DVec3| (a + b) / 2.0;
            [p, middle(p, q), middle(q, r), (p + q + r) / 3.0]
        };
        // Cells (0.4 mm) times slopes (up to 4), the slope left (0.01 of 57 mm) and points 3 mm apart.
        let mine = own.iter().copied().flat_map(points);
        let mine = mine.filter(|point| point.z - height(&below, *point, f64::max) < 4e-3);
        let theirs = below.iter().copied().flat_map(points);
        let theirs = theirs.filter(|point| height(&own, *point, f64::min) - point.z < 4e-3);
        let mut towards: Vec<f64> = mine
            .chain(theirs)
            .map(|point| libm::atan2(point.y - middle.y, point.x - middle.x))
            .collect();
        towards.sort_by(f64::total_cmp);
        let next = towards.iter().cycle().skip(1);
        let widest = towards
            .iter()
            .zip(next)
            .map(|(a, b)| (b - a).rem_euclid(std::f64::consts::TAU));
        let widest = widest.fold(0.0, f64::max);
        assert!(towards.len() >= 2, "{place:?} hangs");
        assert!(widest < 1.02 * std::f64::consts::PI, "{widest} {place:?}");
        highest = at.iter().map(|corner| corner.z).fold(highest, f64::max);
        below.extend(own);
    }
    assert!(highest > 0.03, "they lie on one another: {highest}");
}

#[test]
fn points_are_as_dense_as_the_surface_is_large() {
    // One half is a slope of 60°, which has twice the area of its plan.
    let steep = sheet(
        2.0,
        2,
        |x, _| if x > 0.0 { x * 3.0_f64.sqrt() } else { 0.0 },
    );
    let ground = Ground::of(alone(&steep)).expect("a ground");
    let body = [Body::of(alone(&steep))];
    let fixed = Scatter {
        amount: Amount::PerSquareMetre(1000.0),
        rest: Rest::Fixed { sink: 0.0 },
        ..plan(0)
    };
    let places = fixed.places(&ground, [], &body).expect("there is room");
    assert_eq!(places.len(), 6000);
    let on_slope = |place: &&Strewn| place.to_world.translation.x > 0.0;
    let count = places.iter().filter(on_slope).count() as f64;
    // 4000 are expected, with a standard deviation of 36.5.
    assert!((count - 4000.0).abs() < 4.0 * 36.5, "{count}");
    for place in places.iter().filter(on_slope) {
        let up = place.to_world.matrix3.z_axis;
        assert!(
            up.distance(DVec3::new(-0.75_f64.sqrt(), 0.0, 0.5)) < 1e-6,
            "{up}"
        );
    }
    let upright = Scatter {
        upright: true,
        ..fixed
    };
    let places = upright.places(&ground, [], &body).expect("there is room");
    assert!(
        places
            .iter()
            .all(|place| place.to_world.matrix3.z_axis.z > 1.0 - 1e-12)
    );
}

#[test]
fn what_settles_is_as_dense_as_the_plan_is_large() {
    // One half is a slope of 20°.
    let slope = sheet(0.8, 2, |x, _| 0.364 * x.max(0.0));
    let card = sheet(0.004, 2, |_, _| 0.0);
    let settled = Scatter {
        amount: Amount::PerSquareMetre(2000.0),
        ..plan(0)
    };
    let ground = Ground::of(alone(&slope)).expect("a ground");
    let places = settled.places(&ground, [], &[Body::of(alone(&card))]);
    let places = places.expect("there is room");
    assert_eq!(places.len(), 1280);
    let on_slope = places
        .iter()
        .filter(|place| place.to_world.translation.x > 0.0);
    let count = on_slope.count() as f64;
    // Half of them, with a standard deviation of 17.9.
    assert!((count - 640.0).abs() < 4.0 * 17.9, "{count}");
}

#[test]
fn what_is_strewn_keeps_to_its_rectangle_and_its_distance() {
    let ground = floor(10.0);
    let within = [DVec2::new(-1.0, 2.0), DVec2::new(1.5, 2.5)];
    let plan = Scatter {
        within: Some(within),
        least_distance: 0.05,
        rest: Rest::Fixed { sink: 0.01 },
        ..plan(200)
    };
    let ground = Ground::of(alone(&ground)).expect("a ground");
    let pebble = ball(0.01);
    let bodies = [Body::of(alone(&pebble))];
    let places = plan.places(&ground, [], &bodies).expect("there is room");
    for (number, place) in places.iter().enumerate() {
        let at = place.to_world.translation;
        let plan = at.truncate();
        assert!(
            plan.cmpge(within[0]).all() && plan.cmple(within[1]).all(),
            "{at}"
        );
        assert!((at.z + 0.01).abs() < 1e-12, "{at}");
        for other in &places[..number] {
            assert!(other.to_world.translation.distance(at) >= 0.05);
        }
    }
    let crowd = Scatter {
        amount: Amount::Count(2000),
        ..plan.clone()
    };
    let Err(ScatterError::NoRoom { found, wanted, why }) = crowd.places(&ground, [], &bodies)
    else {
        panic!("2000 discs of 5 cm do not fit into 1.25 m²");
    };
    // The densest random packing covers some 0.547 of the area.
    assert_eq!(why, NoPlace::Near);
    assert!(wanted == 2000 && (300..=400).contains(&found), "{found}");
    let nowhere = Scatter {
        within: Some([DVec2::splat(20.0), DVec2::splat(21.0)]),
        ..plan
    };
    let refused = nowhere.places(&ground, [], &bodies);
    assert_eq!(refused, Err(ScatterError::NoSurface { rests: false }));
}

#[test]
fn nothing_tips_over_an_edge() {
    // Bent to one side, so that some would have their centre of mass beyond the rim.
    let (ground, bent) = (
        floor(0.1),
        sheet(0.1, 20, |x, _| if x > 0.0 { 3.0 * x } else { 0.0 }),
    );
    let plan = Scatter {
        rest: Rest::Settled { gap: 1e-5 },
        least_distance: 0.005,
        ..plan(12)
    };
    let bodies = [Body::of(alone(&bent))];
    let ground = Ground::of(alone(&ground)).expect("a ground");
    let places = plan.places(&ground, [], &bodies).expect("there is room");
    // The first lies on the floor alone: its lowest corners hold its centre of mass between them.
    let at = corners(&bent, &places[0]);
    let middle = places[0].to_world.transform_point3(bodies[0].middle());
    let held = at
        .iter()
        .filter(|corner| corner.z < 1e-3 && corner.abs().max_element() < 0.051);
    let held: Vec<DVec2> = held.map(|corner| (*corner - middle).truncate()).collect();
    let mut sides: Vec<f64> = held.iter().map(|at| libm::atan2(at.y, at.x)).collect();
    sides.sort_by(f64::total_cmp);
    let next = sides.iter().cycle().skip(1);
    let turns = sides.iter().zip(next);
    let widest = turns.map(|(a, b)| (b - a).rem_euclid(std::f64::consts::TAU));
    let widest = widest.fold(0.0, f64::max);
    assert!(
        sides.len() >= 3 && widest <= std::f64::consts::PI + 0.05,
        "{widest} {held:?}"
    );
}

#[test]
fn where_nothing_finds_rest_the_search_ends_and_says_why() {
    let steep = sheet(0.5, 1, |x, _| 1.2 * x);
    let card = sheet(0.02, 4, |_, _| 0.0);
    let ground = Ground::of(alone(&steep)).expect("a ground");
    let refused = plan(50_000).places(&ground, [], &[Body::of(alone(&card))]);
    let why = NoPlace::Steep;
    let (found, wanted) = (0, 50_000);
    assert_eq!(refused, Err(ScatterError::NoRoom { found, wanted, why }));
    let wide = sheet(1000.0, 1, |_, _| 0.0);
    let ground = Ground::of(alone(&wide)).expect("a ground");
    let refused = plan(1).places(&ground, [], &[Body::of(alone(&card))]);
    assert!(
        matches!(refused, Err(ScatterError::TooWide { .. })),
        "{refused:?}"
    );
    let none = Scatter {
        amount: Amount::PerSquareMetre(1e-9),
        rest: Rest::Fixed { sink: 0.0 },
        ..plan(0)
    };
    let refused = none.places(&ground, [], &[Body::of(alone(&card))]);
    assert!(
        matches!(refused, Err(ScatterError::None { .. })),
        "{refused:?}"
    );
}

/// Furrows along y, a millimetre deep and 8 mm apart.
fn furrowed() -> TriangleMesh {
    sheet(0.08, 320, |x, _| {
        -0.0005 * libm::cos(std::f64::consts::TAU * x / 0.008)
    })
}

#[test]
fn drops_prefer_furrows_as_far_as_they_are_said_to() {
    let ground = Ground::of([(&furrowed(), DAffine3::IDENTITY)]).expect("few triangles");
    let bodies = [Body::of([(&ball(0.0008), DAffine3::IDENTITY)])];
    // Mean height of the points: the lower, the more of them lie in furrows.
    let mean = |furrows: f64| {
        let plan = Scatter {
            rest: Rest::Fixed { sink: 0.0 },
            furrows,
            ..plan(400)
        };
        let places = plan.places(&ground, [], &bodies).expect("there is room");
        assert_eq!(places.len(), 400);
        places
            .iter()
            .map(|place| place.to_world.translation.z)
            .sum::<f64>()
            / 400.0
    };
    let [none, half, all] = [0.0, 0.5, 1.0].map(mean);
    // Standard error of the mean of a cosine of 0.5 mm over 400 points: 0.018 mm.
    assert!(none.abs() < 7e-5, "{none}");
    assert!(half < -1e-4 && all < -4e-4, "{half} {all}");
}

#[test]
fn touching_drops_run_together_and_keep_their_volume() {
    let ground = Ground::of([(&furrowed(), DAffine3::IDENTITY)]).expect("few triangles");
    let bodies = [Body::of([(&ball(0.001), DAffine3::IDENTITY)])];
    let apart = Scatter {
        rest: Rest::Fixed { sink: 0.0 },
        scale: [0.4, 1.0],
        ..plan(900)
    };
    let together = Scatter {
        merge: true,
        ..apart.clone()
    };
    let [apart, together] =
        [apart, together].map(|plan| plan.places(&ground, [], &bodies).expect("there is room"));
    let volume = |places: &[Strewn]| -> f64 {
        let cubes = places
            .iter()
            .map(|place| place.to_world.matrix3.determinant());
        cubes.sum()
    };
    assert!(together.len() < apart.len() - 100, "{}", together.len());
    let ratio = volume(&together) / volume(&apart);
    assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
    let width = bodies[0].width();
    for (number, a) in together.iter().enumerate() {
        let reach = |place: &Strewn| width * place.to_world.matrix3.determinant().cbrt();
        for b in &together[..number] {
            let gap = a.to_world.translation.distance(b.to_world.translation);
            assert!(gap >= reach(a) + reach(b) - 1e-12);
        }
        // On the surface.
        let at = a.to_world.translation;
        let height = -0.0005 * libm::cos(std::f64::consts::TAU * at.x / 0.008);
        assert!((at.z - height).abs() < 2e-5, "{}", at.z - height);
    }
}
