use glam::{DVec2, DVec3};

use super::super::surface::SurfacePoint;
use super::*;

/// The unit cube, two triangles a side, normals outwards.
fn cube() -> Surface {
    let positions =
        (0..8).map(|i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)));
    let quads: [[u32; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let faces = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Surface::new(positions.collect(), faces.collect()).expect("a cube")
}

fn find(surface: &Surface, at: DVec3) -> (u32, DVec2) {
    let near = (0..surface.faces().len() as u32).map(|face| {
        let [a, b, c] = surface.faces()[face as usize].map(|id| surface.positions()[id as usize]);
        let x = (b - a).normalize();
        let y = surface.normal(face).cross(x);
        let flat = DVec2::new((at - a).dot(x), (at - a).dot(y));
        let _ = c;
        let point = surface.point(face, flat);
        (surface.position(&point).distance(at), face, flat)
    });
    let (miss, face, flat) = near.min_by(|a, b| a.0.total_cmp(&b.0)).expect("faces");
    assert!(miss < 1e-12, "{at} is not on the surface");
    (face, flat)
}

fn distance(surface: &Surface, a: DVec3, b: DVec3) -> f64 {
    let (from, here) = find(surface, a);
    let (to, there) = find(surface, b);
    let patch = PatchFinder::new(surface).patch(from, 2.0);
    let unfold = patch.unfold(to).expect("within reach");
    unfold.apply(there).distance(here)
}

#[test]
fn unfolding_across_the_edges_of_a_cube_gives_the_exact_distance() {
    for surface in [cube(), cube().subdivided(0.3).expect("good").0] {
        // Over one edge: the two faces of the cube laid flat.
        let (a, b) = (DVec3::new(0.7, 0.25, 1.0), DVec3::new(1.0, 0.45, 0.6));
        assert!((distance(&surface, a, b) - DVec2::new(0.3 + 0.4, 0.2).length()).abs() < 1e-12);
        assert!((distance(&surface, b, a) - DVec2::new(0.3 + 0.4, 0.2).length()).abs() < 1e-12);
    }
    // Over two edges: from the top over a side to the bottom. (Of the coarse cube's faces some can
    // be entered over two ways of equal length; a patch takes one.)
    let fine = cube().subdivided(0.3).expect("good").0;
    let (a, b) = (DVec3::new(0.9, 0.5, 1.0), DVec3::new(0.95, 0.55, 0.0));
    let flat = DVec2::new(0.1 + 1.0 + 0.05, 0.05).length();
    assert!((distance(&fine, a, b) - flat).abs() < 1e-12);
}

#[test]
fn in_a_flat_sheet_patches_hold_all_points_within_the_radius_at_their_distance() {
    let sheet = crate::mosaic::Surface::new(
        vec![
            DVec3::ZERO,
            DVec3::new(4.0, 0.0, 0.0),
            DVec3::new(4.0, 3.0, 0.0),
            DVec3::new(0.0, 3.0, 0.0),
        ],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let (sheet, _) = sheet.expect("good").subdivided(0.5).expect("good");
    let mut finder = PatchFinder::new(&sheet);
    for face in (0..sheet.faces().len() as u32).step_by(7) {
        let patch = finder.patch(face, 0.8);
        assert_eq!(patch.base(), face);
        let corners = |f: u32| sheet.faces()[f as usize].map(|id| sheet.positions()[id as usize]);
        for other in 0..sheet.faces().len() as u32 {
            let least = corners(face)
                .iter()
                .flat_map(|a| corners(other).map(|b| a.distance(b)))
                .fold(f64::INFINITY, f64::min);
            let unfold = patch.unfold(other);
            assert!(
                least > 0.8 || unfold.is_some(),
                "a face {least} mm away is missing"
            );
            let Some(unfold) = unfold else { continue };
            for i in 0..3 {
                for j in 0..3 {
                    let flat =
                        sheet.corners(face)[i].distance(unfold.apply(sheet.corners(other)[j]));
                    assert!((flat - corners(face)[i].distance(corners(other)[j])).abs() < 1e-12);
                }
            }
        }
    }
}

#[test]
fn no_patch_reaches_through_a_thin_blade() {
    let (sheet, _) = Surface::new(
        vec![
            DVec3::ZERO,
            DVec3::new(4.0, 0.0, 0.0),
            DVec3::new(4.0, 3.0, 0.0),
            DVec3::new(0.0, 3.0, 0.0),
        ],
        vec![[0, 1, 2], [0, 2, 3]],
    )
    .expect("good")
    .subdivided(0.5)
    .expect("good");
    let both = Surface::both_faces(&sheet).expect("good");
    let count = sheet.faces().len() as u32;
    let (middle, _) = find(&sheet, DVec3::new(2.0, 1.4, 0.0));
    let patch = PatchFinder::new(&both).patch(middle, 0.7);
    assert!(patch.faces().iter().all(|(face, _)| *face < count));
    // Near the margin they do reach round it.
    let (margin, flat) = find(&sheet, DVec3::new(2.0, 0.1, 0.0));
    let patch = PatchFinder::new(&both).patch(margin, 0.7);
    let behind = patch.unfold(count + margin).expect("round the margin");
    let there = both.flat(&SurfacePoint {
        face: count + margin,
        barycentric: {
            let [u, v, w] = both.point(margin, flat).barycentric;
            [u, w, v]
        },
    });
    assert!((behind.apply(there).distance(flat) - 0.2).abs() < 1e-12);
}
