//! Ties, intervals, rays and instances that are none, and meshes that are hard to build.

use glam::{Affine3A, DVec3, Vec3};

use super::super::super::testing::{Numbers, alone, blade, placed, ray_through};
use super::super::super::{Instance, Ray, TriangleMesh};
use super::super::{Geometry, GeometryError};
use super::every_triangle;

#[test]
fn equal_distances_go_to_the_smaller_instance_and_triangle() {
    let mesh = blade(3, 3, 1.0, 1.0, Vec3::ZERO);
    let geometry = placed(
        vec![mesh.clone(), mesh],
        &[(1, Affine3A::IDENTITY), (0, Affine3A::IDENTITY)],
    );
    let mut numbers = Numbers::new(1);
    for _ in 0..200 {
        let ray = Ray::new(
            Vec3::new(numbers.unit() - 0.5, numbers.unit() - 0.5, 2.0),
            Vec3::NEG_Z,
        );
        assert_eq!(geometry.intersect(&ray).map(|hit| hit.instance), Some(0));
    }
}

#[test]
fn an_interval_bounds_what_is_hit() {
    let geometry = alone(blade(1, 1, 1.0, 1.0, Vec3::ZERO));
    let ray = Ray::new(Vec3::new(0.1, 0.2, 4.0), Vec3::NEG_Z * 2.0);
    let t = geometry
        .intersect(&ray)
        .expect("the ray points at the blade")
        .t;
    for (t_min, t_max, hit) in [
        (0.0, t, true),
        (t, t, true),
        (0.0, t.next_down(), false),
        (t.next_up(), f32::INFINITY, false),
        (3.0, 1.0, false),
    ] {
        let ray = ray.starting_at(t_min).up_to(t_max);
        assert_eq!(geometry.intersect(&ray).is_some(), hit, "{t_min}..{t_max}");
        assert_eq!(geometry.occluded(&ray), hit, "{t_min}..{t_max}");
    }
}

#[test]
fn rays_that_are_none_hit_nothing() {
    let geometry = alone(blade(2, 2, 1.0, 1.0, Vec3::ZERO));
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(
            geometry.intersect(&Ray::new(Vec3::new(0.0, 0.0, bad), Vec3::NEG_Z)),
            None
        );
        assert_eq!(
            geometry.intersect(&Ray::new(Vec3::Z, Vec3::new(0.0, bad, -1.0))),
            None
        );
    }
    assert_eq!(geometry.intersect(&Ray::new(Vec3::Z, Vec3::ZERO)), None);
    let nothing = Geometry::build(Vec::new(), Vec::new()).expect("nothing can be built");
    assert_eq!(nothing.intersect(&Ray::new(Vec3::Z, Vec3::NEG_Z)), None);
    assert_eq!(nothing.bounds(), (Vec3::ZERO, Vec3::ZERO));
}

#[test]
fn bad_instances_are_refused() {
    let build = |mesh, to_world: Affine3A| {
        let instance = Instance::new(mesh, &to_world.as_daffine3());
        Geometry::build(vec![blade(1, 1, 1.0, 1.0, Vec3::ZERO)], vec![instance])
    };
    let refused = build(3, Affine3A::IDENTITY).expect_err("there is no mesh 3");
    assert_eq!(
        refused,
        GeometryError::NoSuchMesh {
            instance: 0,
            mesh: 3,
            meshes: 1
        }
    );
    for to_world in [
        Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0)),
        Affine3A::from_translation(Vec3::new(f32::NAN, 0.0, 0.0)),
        Affine3A::from_scale(Vec3::splat(f32::INFINITY)),
        Affine3A::from_scale(Vec3::splat(1e-39)),
        Affine3A::ZERO,
    ] {
        let refused = build(0, to_world)
            .map(|_| ())
            .expect_err("this transform has no inverse");
        assert!(
            matches!(refused, GeometryError::Transform { instance: 0, .. }),
            "{refused}"
        );
    }
}

/// Sheets that the builder's clustering would take quadratic time for, or that make deep trees.
#[test]
fn many_equal_or_nested_boxes_are_built_in_time_and_traced_right() {
    let fan = |radius: fn(f32) -> f32| {
        let mut positions = Vec::new();
        for i in 0..10_000 {
            // Turned about the z axis and tilted: different triangles about one centroid.
            let turn = DVec3::new(libm::cos(f64::from(i)), libm::sin(f64::from(i)), 0.0).as_vec3();
            let radius = radius(i as f32 / 10_000.0);
            positions.extend([
                (turn + Vec3::Z) * radius,
                (Vec3::new(-turn.y, turn.x, 0.0) - Vec3::Z * 0.5) * radius,
                -(turn + Vec3::new(-turn.y, turn.x, 0.5)) * radius,
            ]);
        }
        positions
    };
    let strip: Vec<_> = (0..60_000_u16)
        .flat_map(|i| [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| corner + Vec3::X * f32::from(i)))
        .collect();
    for positions in [
        fan(|_| 1.0),
        fan(|i| 1.0 + i),
        fan(|i| libm::expf(60.0 * (i - 1.0))),
        strip,
    ] {
        let triangles = (0..positions.len() as u32 / 3)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect();
        let mesh =
            TriangleMesh::new(positions, None, None, triangles).expect("no two are the same");
        // Threads of the shared pool may be busy with another test.
        let pool = rayon::ThreadPoolBuilder::new().build().expect("threads");
        let start = std::time::Instant::now();
        let geometry = pool.install(|| alone(mesh));
        // This is not a benchmark: a build in quadratic time takes minutes, a correct one a
        // fraction of a second on the slowest machine.
        assert!(
            start.elapsed().as_secs_f32() < 30.0,
            "the build took {:?}",
            start.elapsed()
        );
        let mut numbers = Numbers::new(3);
        for _ in 0..20 {
            let ray = ray_through(&mut numbers, &geometry);
            assert_eq!(
                geometry.intersect(&ray),
                every_triangle(&geometry, &ray),
                "{ray:?}"
            );
        }
    }
}
