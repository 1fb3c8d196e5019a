use glam::DVec3;

use super::*;
use crate::random::{Use, uniform};

/// A strip of `n` × `m` squares of side 1, each cut in two.
fn sheet(n: u32, m: u32) -> Surface {
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let places =
        (0..=m).flat_map(|j| (0..=n).map(move |i| DVec3::new(f64::from(i), f64::from(j), 0.0)));
    let mut faces = Vec::new();
    for j in 0..m {
        for i in 0..n {
            faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    Surface::new(places.collect(), faces).expect("a good sheet")
}

#[test]
fn seams_are_welded_and_faces_keep_their_order() {
    let positions = vec![
        DVec3::ZERO,
        DVec3::X,
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(-0.0, 0.0, 0.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::Y,
    ];
    let surface = Surface::new(positions, vec![[0, 1, 2], [3, 4, 5]]).expect("good");
    assert_eq!(surface.neighbour(0, 2), Some(1));
    assert_eq!(surface.neighbour(1, 0), Some(0));
    assert_eq!(surface.neighbour(0, 0), None);
    assert!((surface.total_area() - 1.0).abs() < 1e-15);
}

#[test]
fn unfolding_a_neighbour_brings_the_shared_corners_together() {
    let surface = sheet(3, 2).moved(
        sheet(3, 2)
            .positions()
            .iter()
            .map(|p| *p + DVec3::Z * (p.x * p.y * 0.3))
            .collect(),
    );
    let surface = surface.expect("good");
    for face in 0..surface.faces().len() as u32 {
        for edge in 0..3 {
            let Some(unfold) = surface.unfold(face, edge) else {
                continue;
            };
            let other = surface.neighbour(face, edge).expect("it has one");
            let theirs = surface.neighbour_edge(face, edge).expect("it has one");
            let (mine, other) = (surface.corners(face), surface.corners(other));
            assert!(unfold.apply(other[theirs]).distance(mine[(edge + 1) % 3]) < 1e-12);
            assert!(unfold.apply(other[(theirs + 1) % 3]).distance(mine[edge]) < 1e-12);
            // The neighbour lies on the other side of the edge.
            let apex = unfold.apply(other[(theirs + 2) % 3]);
            let along = mine[(edge + 1) % 3] - mine[edge];
            assert!(along.perp_dot(apex - mine[edge]) < 0.0);
        }
    }
}

#[test]
fn what_is_no_surface_is_refused_with_the_place() {
    let square = || {
        vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::Y,
            DVec3::Z,
        ]
    };
    let refused = |positions, faces| {
        Surface::new(positions, faces)
            .expect_err("no surface")
            .to_string()
    };
    assert_eq!(refused(square(), vec![]), "the mesh has no faces");
    assert_eq!(
        refused(square(), vec![[0, 1, 9]]),
        "face 0 names vertex 9, but there are 5 (from 0)"
    );
    assert_eq!(
        refused(vec![DVec3::ZERO, DVec3::X, DVec3::NAN], vec![[0, 1, 2]]),
        "vertex 2 is at [NaN, NaN, NaN], which is not finite"
    );
    assert_eq!(
        refused(square(), vec![[0, 1, 2], [0, 1, 1]]),
        "not a manifold: the edge from [0, 0, 0] mm to [1, 0, 0] mm has 3 faces (0, 1, 1)"
    );
    assert_eq!(
        refused(vec![DVec3::ZERO, DVec3::X, DVec3::X * 2.0], vec![[0, 1, 2]]),
        "face 0 has no area; its corners are [0, 0, 0] mm, [1, 0, 0] mm and [2, 0, 0] mm"
    );
    assert_eq!(
        refused(square(), vec![[0, 1, 2], [0, 2, 3], [2, 0, 4]]),
        "not a manifold: the edge from [1, 1, 0] mm to [0, 0, 0] mm has 3 faces (0, 1, 2)"
    );
    assert_eq!(
        refused(square(), vec![[0, 1, 2], [0, 3, 2]]),
        "faces 0 and 1 are of opposite orientation: both run along their edge from [1, 1, 0] mm to [0, 0, 0] mm"
    );
}

#[test]
fn points_are_drawn_evenly_by_area() {
    let surface = Surface::new(
        vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.0, -3.0, 0.0)],
        vec![[0, 1, 2], [0, 3, 1]],
    )
    .expect("good");
    let n = 40_000;
    let mut mean = DVec3::ZERO;
    let mut small = 0;
    for i in 0..n {
        let u = |purpose| uniform(5, purpose, u64::from(i));
        let point = surface.sample([f64::from(i) / f64::from(n), u(Use::DartX), u(Use::DartY)]);
        small += u32::from(point.face == 0);
        mean += surface.position(&point) / f64::from(n);
        assert!(point.barycentric.iter().all(|w| (0.0..=1.0).contains(w)));
    }
    assert_eq!(small, n / 4, "a quarter of the area");
    // The centroid of both, by area: x = 1/3, y = (1/3 − 3)/4.
    assert!(
        mean.distance(DVec3::new(1.0 / 3.0, -2.0 / 3.0, 0.0)) < 0.02,
        "{mean}"
    );
}

#[test]
fn places_in_a_frame_are_points_and_back() {
    let surface = sheet(2, 2);
    for face in 0..8 {
        for barycentric in [[0.2, 0.3, 0.5], [1.0, 0.0, 0.0], [0.0, 0.25, 0.75]] {
            let point = SurfacePoint { face, barycentric };
            let back = surface.point(face, surface.flat(&point));
            assert!(surface.position(&point).distance(surface.position(&back)) < 1e-12);
        }
    }
}

#[test]
fn the_two_faces_of_a_sheet_meet_at_its_margin_only() {
    let sheet = sheet(3, 3);
    let count = sheet.faces().len() as u32;
    let both = Surface::both_faces(&sheet).expect("good");
    assert_eq!(both.faces().len(), 2 * sheet.faces().len());
    assert!((both.total_area() - 18.0).abs() < 1e-12);
    let mut round_the_margin = 0;
    for face in 0..2 * count {
        for edge in 0..3 {
            let neighbour = both.neighbour(face, edge).expect("closed");
            let theirs = both.neighbour_edge(face, edge).expect("closed");
            assert_eq!(both.neighbour(neighbour, theirs), Some(face));
            round_the_margin += u32::from((neighbour < count) != (face < count));
            // The shared edge has the same ends in space, in reverse.
            let ends = |face: u32, edge: usize| {
                let ids = both.faces()[face as usize];
                (ids[edge], ids[(edge + 1) % 3])
            };
            let (a, b) = ends(face, edge);
            assert_eq!(ends(neighbour, theirs), (b, a));
        }
    }
    assert_eq!(round_the_margin, 2 * 12);
}

#[test]
fn subdividing_keeps_the_surface_and_reports_where_the_parts_lie() {
    for surface in [
        sheet(2, 1),
        Surface::both_faces(&sheet(1, 1)).expect("good"),
    ] {
        let (fine, ancestry) = surface.subdivided(0.21).expect("good");
        assert!(fine.longest_edge() <= 0.21);
        assert!((fine.total_area() - surface.total_area()).abs() < 1e-12);
        let mut per_face = vec![0.0; surface.faces().len()];
        for face in 0..fine.faces().len() as u32 {
            let point = fine.centre(face);
            let back = ancestry.carry_back(&point);
            assert!(fine.position(&point).distance(surface.position(&back)) < 1e-12);
            assert_eq!(back.face, ancestry.face(face));
            per_face[back.face as usize] += fine.area(face);
            let margins = (0..3).filter(|&edge| fine.neighbour(face, edge).is_none());
            for edge in margins {
                let ids = fine.faces()[face as usize];
                let middle = 0.5
                    * (fine.positions()[ids[edge] as usize]
                        + fine.positions()[ids[(edge + 1) % 3] as usize]);
                let inside = middle.x > 1e-9
                    && middle.x < 2.0 - 1e-9
                    && middle.y > 1e-9
                    && middle.y < 1.0 - 1e-9;
                assert!(!inside, "a crack at {middle}");
            }
        }
        for (face, area) in per_face.iter().enumerate() {
            assert!((area - surface.area(face as u32)).abs() < 1e-12);
        }
    }
    assert!(sheet(1, 1).subdivided(0.0).is_err());
}

#[test]
fn needles_are_not_cut_into_more_faces_than_allowed() {
    // Their area asks for less than one face, their edges for hundreds.
    let points = vec![DVec3::ZERO, DVec3::X * 100.0, DVec3::new(100.0, 1e-6, 0.0)];
    let needle = Surface::new(points, vec![[0, 1, 2]]).expect("good");
    let cut = |most| needle.subdivided_to(1.0, most);
    let refused = cut(200).expect_err("too many");
    assert!(
        refused.to_string().contains("more than 200 faces"),
        "{refused}"
    );
    let (fine, _) = cut(100_000).expect("few enough");
    assert!(fine.faces().len() > 200 && fine.longest_edge() <= 1.0);
}

#[test]
fn a_point_in_which_two_bodies_touch_is_found_and_a_margin_is_none() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let body = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mirrored = corners.map(|corner| -corner);
    let mut positions = corners.to_vec();
    positions.extend(mirrored);
    let mut faces = body.to_vec();
    // Turned over, since a mirror does that.
    faces.extend(
        body.map(|face| face.map(|vertex| vertex + 4))
            .map(|[a, b, c]| [a, c, b]),
    );
    let two = Surface::new(positions, faces).expect("each edge has two faces");
    assert_eq!(
        two.check_vertices().expect_err("pinched").to_string(),
        "not a manifold: parts of the mesh touch at [0, 0, 0] mm in a point only"
    );
    let one = Surface::new(corners.to_vec(), body.to_vec()).expect("a body");
    assert_eq!(one.check_vertices(), Ok(()));
    let open = Surface::new(corners.to_vec(), body[..3].to_vec()).expect("a cup");
    assert_eq!(open.check_vertices(), Ok(()));
}
