//! Meshes that share one tree.

use glam::{Affine3A, Vec3};

use super::super::super::testing::{Numbers, blade, placed, placed_with, ray_through, soup};
use super::{Ray, every_triangle};

/// Meshes that stand once each above a wide floor, and one that stands twice, which has 40 triangles:
/// what is traced by one tree, beside it, and by trees of its own.
#[test]
fn joined_meshes_are_found_as_every_triangle_is() {
    let mut walls = 0;
    for (seed, scale) in (0..).zip([1e-4, 1.0, 1e3]) {
        let mut numbers = Numbers::new(seed + 50);
        let floor = blade(1, 1, 40.0 * scale, 40.0 * scale, Vec3::ZERO);
        let meshes = vec![
            floor,
            soup(seed + 30, 40, scale, Vec3::ZERO),
            blade(9, 7, scale, scale, Vec3::ZERO),
            soup(seed + 40, 30, scale, Vec3::ZERO),
            blade(5, 4, scale, scale, Vec3::ZERO),
        ];
        let mut instances = vec![(0, Affine3A::from_translation(Vec3::NEG_Z * scale))];
        instances.extend((1..4).map(|mesh| (mesh, numbers.affine(scale))));
        for (most_repeated, trees) in [(0, 1), (79, 3), (80, 1)] {
            // The floor and the leaf of two places are numbered between the others too.
            instances.rotate_left(1);
            if trees == 3 {
                instances.extend((0..2).map(|_| (4, numbers.affine(scale))));
            }
            let geometry = placed_with(meshes.clone(), &instances, most_repeated);
            assert_eq!(geometry.carriers.len(), trees);
            let joined = &geometry.trees[meshes.len()];
            walls += joined.walls().count();
            for _ in 0..1000 {
                let mut ray = ray_through(&mut numbers, &geometry);
                let number = numbers.below(instances.len());
                let (mesh, to_world) = instances[number];
                let mesh = &meshes[mesh as usize];
                let corners = mesh.corners(numbers.below(mesh.triangles().len()) as u32);
                let target = (corners[0] + corners[1] + corners[2]) / 3.0;
                ray = Ray::new(
                    ray.origin(),
                    to_world.transform_point3(target) - ray.origin(),
                );
                let hit = geometry.intersect(&ray);
                assert_eq!(
                    hit,
                    every_triangle(&geometry, &ray),
                    "scale {scale}, {ray:?}"
                );
                assert_eq!(hit.is_some(), geometry.occluded(&ray), "{ray:?}");
                let hit = hit.expect("the ray points at a triangle");
                let point = geometry.surface(&hit);
                let off = (point.position - ray.at(hit.t)).dot(point.geometric_normal);
                assert!(off.abs() < 1e-4 * scale, "{off} m off the plane");
                let (least, most) = geometry.bounds_of(hit.instance);
                let (position, room) = (point.position.as_dvec3(), f64::from(1e-4 * scale));
                assert!(position.cmpge(least - room).all());
                assert!(position.cmple(most + room).all());
                // From there on, away from the floor as often as not; the same as far as what it
                // meets, and half as far.
                let mut next = point.spawn(numbers.direction());
                let found = every_triangle(&geometry, &next);
                assert_eq!(geometry.intersect(&next), found, "{next:?}");
                for share in [1.0, 0.5] {
                    next = next.up_to(share * found.map_or(2.0 * scale, |hit| hit.t));
                    let found = every_triangle(&geometry, &next);
                    assert_eq!(geometry.intersect(&next), found, "{next:?}");
                    assert_eq!(geometry.occluded(&next), found.is_some(), "{next:?}");
                }
            }
        }
    }
    assert_eq!(walls, 9, "the floor stands beside the tree");
}

/// What stands far from all else, as a lamp in the sky does, is traced by a tree of its own.
#[test]
fn what_lies_apart_is_not_joined() {
    let lamp = blade(3, 2, 1e3, 1e3, Vec3::new(0.0, 0.0, 7e5));
    let leaves = (0..3).map(|seed| soup(seed, 30, 1.0, Vec3::ZERO));
    let meshes: Vec<_> = leaves.chain([lamp]).collect();
    let instances: Vec<_> = (0..4).map(|mesh| (mesh, Affine3A::IDENTITY)).collect();
    let geometry = placed_with(meshes, &instances, 0);
    assert_eq!(geometry.carriers.len(), 2);
    let mut numbers = Numbers::new(3);
    let mut lit = 0;
    for _ in 0..1000 {
        let target = Vec3::new(0.0, 0.0, 7e5) + numbers.cube() * Vec3::new(500.0, 500.0, 0.0);
        let from = numbers.cube() * 2.0;
        let ray = Ray::new(from, (target - from).normalize());
        let hit = geometry.intersect(&ray);
        assert_eq!(hit, every_triangle(&geometry, &ray), "{ray:?}");
        lit += usize::from(hit.is_some_and(|hit| hit.instance == 3));
    }
    assert!(lit > 300, "{lit} of 1000 rays meet the lamp");
}

/// Surfaces do not depend on whether their mesh is joined: places, sides, tangents and textures of
/// mirrored and sheared instances.
#[test]
fn a_joined_surface_is_that_of_the_mesh_alone() {
    let mut numbers = Numbers::new(77);
    let meshes = vec![
        blade(9, 7, 1.0, 1.0, Vec3::ZERO),
        soup(3, 40, 1.0, Vec3::ZERO),
    ];
    for _ in 0..40 {
        let places = [numbers.affine(1.0), numbers.affine(1.0)];
        let both = placed(meshes.clone(), &[(0, places[0]), (1, places[1])]);
        assert_eq!(both.carriers.len(), 1);
        for _ in 0..40 {
            let ray = ray_through(&mut numbers, &both);
            let Some(hit) = both.intersect(&ray) else {
                continue;
            };
            let mesh = both.instance(hit.instance).mesh;
            let own = placed(meshes.clone(), &[(mesh, both.to_world(hit.instance))]);
            let Some(mut same) = own
                .intersect(&ray)
                .filter(|own| own.triangle == hit.triangle)
            else {
                continue;
            };
            // A ray along the surface finds slightly different points of it.
            (same.b1, same.b2) = (hit.b1, hit.b2);
            let (a, b) = (both.surface(&hit), own.surface(&same));
            assert!((a.position - b.position).length() < 1e-5);
            for (a, b) in [
                (a.geometric_normal, b.geometric_normal),
                (a.shading_normal, b.shading_normal),
                (a.tangent, b.tangent),
            ] {
                assert!((a - b).length() < 1e-3, "{a} is not {b}");
            }
            let scales = [both.texture_scale(&hit), own.texture_scale(&same)];
            if let [Some(a), Some(b)] = scales {
                assert_eq!(a.is_mirrored, b.is_mirrored);
                assert!((a.metres_per_v / b.metres_per_v - 1.0).abs() < 1e-3);
            } else {
                assert_eq!(scales[0].is_some(), scales[1].is_some());
            }
        }
    }
}

/// A leaf far from the middle of a wide scene keeps its own frame: there its vertices would be
/// rounded to a hundredth of its triangles.
#[test]
fn a_small_leaf_far_away_is_not_joined() {
    let leaf = blade(125, 80, 0.05, 0.03, Vec3::ZERO);
    let far = |x: f32| (0, Affine3A::from_translation(Vec3::X * x));
    let hill = soup(1, 40, 5.0, Vec3::ZERO);
    for (x, trees) in [(0.1, 1), (100.0, 2)] {
        let geometry = placed(
            vec![leaf.clone(), hill.clone()],
            &[far(x), (1, Affine3A::IDENTITY)],
        );
        assert_eq!(geometry.carriers.len(), trees, "at {x} m");
    }
}
