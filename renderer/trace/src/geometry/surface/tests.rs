use glam::{Affine3A, Vec2, Vec3};
use proptest::prelude::*;

use super::super::testing::{Numbers, alone, blade, placed, ray_through, soup};
use super::super::{Geometry, Ray, TriangleMesh};
use properties::fixed;

/// Surface points that rays through the geometry find.
fn points(seed: u64, geometry: &Geometry, count: usize) -> Vec<super::SurfacePoint> {
    let mut numbers = Numbers::new(seed);
    (0..count)
        .filter_map(|_| {
            let ray = ray_through(&mut numbers, geometry);
            geometry.intersect(&ray).map(|hit| geometry.surface(&hit))
        })
        .collect()
}

proptest! {
    #![proptest_config(fixed(128))]

    #[test]
    fn a_ray_that_leaves_never_meets_its_own_triangle(
        seed in 0_u64..1 << 40, power in -4_i32..4, shift in prop::sample::select(vec![0.0_f32, 1.0, 1000.0]),
    ) {
        let scale = libm::powf(10.0, power as f32);
        let mut numbers = Numbers::new(seed);
        let geometry = placed(
            vec![soup(seed, 60, scale, Vec3::splat(scale)), blade(40, 40, scale, scale, Vec3::ZERO)],
            &[(0, numbers.affine(shift * scale)), (1, numbers.affine(shift * scale))],
        );
        for point in points(seed, &geometry, 60) {
            for _ in 0..8 {
                let mut direction = numbers.direction();
                // Also nearly along the surface.
                if numbers.unit() < 0.3 {
                    let normal = point.geometric_normal;
                    direction -= normal * normal.dot(direction) * (1.0 - 0.01 * numbers.unit());
                }
                let ray = point.spawn(direction);
                if let Some(hit) = geometry.intersect(&ray) {
                    prop_assert!(
                        (hit.instance, hit.triangle) != (point.instance, point.triangle),
                        "{ray:?} from {point:?} hits it again"
                    );
                }
            }
        }
    }

    #[test]
    fn a_sheet_a_hundredth_of_a_millimetre_away_is_never_missed(seed in 0_u64..1 << 40, turned in any::<bool>()) {
        let mut numbers = Numbers::new(seed);
        let turn = if turned { numbers.affine(0.2) } else { Affine3A::IDENTITY };
        let lifted = turn * Affine3A::from_translation(Vec3::Z * 1e-5);
        let geometry = placed(vec![blade(60, 40, 0.05, 0.03, Vec3::ZERO)], &[(0, turn), (0, lifted)]);
        for _ in 0..60 {
            let inner = Vec3::new(0.04 * (numbers.unit() - 0.5), 0.02 * (numbers.unit() - 0.5), 0.0);
            let below = turn.transform_point3(inner - Vec3::Z * 0.1);
            let above = turn.transform_point3(inner + Vec3::Z * 0.1);
            let ray = Ray::new(below, above - below);
            let hit = geometry.intersect(&ray).expect("the ray crosses both sheets");
            prop_assert_eq!(hit.instance, 0);
            let point = geometry.surface(&hit);
            prop_assert!(point.position_error < 1e-6, "error {}", point.position_error);
            let lift = turn.transform_vector3(Vec3::Z);
            let normal = point.geometric_normal * point.geometric_normal.dot(lift).signum();
            let up = (normal + 0.5 * numbers.cube()).normalize();
            let next = geometry.intersect(&point.spawn(up)).expect("the second sheet is above");
            prop_assert_eq!(next.instance, 1);
            prop_assert!(geometry.occluded(&point.spawn_to(point.position + normal * 0.01)));
        }
    }

    #[test]
    fn the_frame_is_orthonormal_and_the_position_is_on_the_ray(seed in 0_u64..1 << 40) {
        let mut numbers = Numbers::new(seed);
        let geometry = placed(
            vec![soup(seed, 30, 1.0, Vec3::ZERO), blade(5, 5, 2.0, 1.0, Vec3::ZERO)],
            &[(0, numbers.affine(2.0)), (1, numbers.affine(2.0))],
        );
        for _ in 0..40 {
            let ray = ray_through(&mut numbers, &geometry);
            let Some(hit) = geometry.intersect(&ray) else { continue };
            let point = geometry.surface(&hit);
            for unit in [point.geometric_normal, point.shading_normal, point.tangent] {
                prop_assert!((unit.length() - 1.0).abs() < 1e-6, "{unit}");
            }
            prop_assert!(point.tangent.dot(point.shading_normal).abs() < 1e-6);
            // Along the ray the point may be off where the triangle is seen edge-on; across the
            // triangle's plane not.
            let off = (point.position - ray.at(hit.t)).dot(point.geometric_normal).abs();
            prop_assert!(off < 1e-5, "{off} m off the plane");
        }
    }
}

/// One triangle in the xy plane, counter-clockwise seen from +z.
fn triangle(normals: Option<Vec<Vec3>>, uvs: Option<Vec<Vec2>>) -> TriangleMesh {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    TriangleMesh::new(positions, normals, uvs, vec![[0, 1, 2]]).expect("a triangle is a mesh")
}

fn seen(mesh: TriangleMesh, to_world: Affine3A) -> super::SurfacePoint {
    let geometry = placed(vec![mesh], &[(0, to_world)]);
    let target = to_world.transform_point3(Vec3::new(0.25, 0.5, 0.0));
    let origin = to_world.transform_point3(Vec3::new(0.25, 0.5, 3.0));
    let ray = Ray::new(origin, target - origin);
    let hit = geometry
        .intersect(&ray)
        .expect("the ray points at the triangle");
    geometry.surface(&hit)
}

#[test]
fn normals_point_to_the_counter_clockwise_side_and_move_with_the_instance() {
    assert_eq!(
        seen(triangle(None, None), Affine3A::IDENTITY).geometric_normal,
        Vec3::Z
    );
    // A mirror in x keeps z: what was the outside of a closed mesh stays outside.
    let mirrored = seen(
        triangle(None, None),
        Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0)),
    );
    assert_eq!(mirrored.geometric_normal, Vec3::Z);
    let turned = seen(
        triangle(None, None),
        Affine3A::from_scale(Vec3::new(1.0, 1.0, -1.0)),
    );
    assert_eq!(turned.geometric_normal, Vec3::NEG_Z);
    // A shear leaves the plane where it is but not what is normal to another one.
    let mut numbers = Numbers::new(8);
    for _ in 0..50 {
        let to_world = numbers.affine(1.0);
        let point = seen(triangle(Some(vec![Vec3::Z; 3]), None), to_world);
        for edge in [Vec3::X, Vec3::Y] {
            assert!(
                point
                    .geometric_normal
                    .dot(to_world.transform_vector3(edge))
                    .abs()
                    < 1e-6
            );
        }
        assert!(
            point
                .geometric_normal
                .dot(to_world.transform_vector3(Vec3::Z))
                > 0.0
        );
        assert!((point.shading_normal - point.geometric_normal).length() < 1e-6);
    }
}

#[test]
fn shading_normals_are_interpolated_and_take_the_side_of_the_winding() {
    let tilted = vec![Vec3::Z, Vec3::new(2.0, 0.0, 2.0), Vec3::Z];
    let point = seen(triangle(Some(tilted.clone()), None), Affine3A::IDENTITY);
    let expected = Vec3::new(0.5, 0.0, 1.25).normalize();
    assert!(
        (point.shading_normal - expected).length() < 1e-6,
        "{}",
        point.shading_normal
    );
    let reversed = tilted.into_iter().map(|normal| -normal).collect();
    let same = seen(triangle(Some(reversed), None), Affine3A::IDENTITY);
    assert_eq!(same.shading_normal, point.shading_normal);
    for useless in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        let point = seen(triangle(Some(vec![useless; 3]), None), Affine3A::IDENTITY);
        assert_eq!(point.shading_normal, Vec3::Z);
    }
}

#[test]
fn the_tangent_is_where_v_grows() {
    let uvs = vec![
        Vec2::new(0.0, 1.0),
        Vec2::new(1.0, 1.0),
        Vec2::new(0.0, 0.0),
    ];
    let point = seen(triangle(None, Some(uvs.clone())), Affine3A::IDENTITY);
    assert_eq!(point.tangent, Vec3::NEG_Y);
    assert!((point.uv - Vec2::new(0.25, 0.5)).length() < 1e-6);
    let turned = seen(
        triangle(None, Some(uvs)),
        Affine3A::from_rotation_z(core::f32::consts::FRAC_PI_2),
    );
    assert!(
        (turned.tangent - Vec3::X).length() < 1e-6,
        "{}",
        turned.tangent
    );
    // Without uvs the weights stand in for them.
    let bare = seen(triangle(None, None), Affine3A::IDENTITY);
    assert!((bare.uv - Vec2::new(0.25, 0.5)).length() < 1e-6);
    let collapsed = seen(triangle(None, Some(vec![Vec2::ONE; 3])), Affine3A::IDENTITY);
    assert!((collapsed.tangent.length() - 1.0).abs() < 1e-6 && collapsed.tangent.z.abs() < 1e-6);
}

#[test]
fn uvs_follow_the_position_on_a_blade() {
    let geometry = alone(blade(20, 20, 2.0, 2.0, Vec3::ZERO));
    for point in points(4, &geometry, 500) {
        let expected = Vec2::new(point.position.x, point.position.y) * 0.5 + 0.5;
        assert!(
            (point.uv - expected).length() < 1e-5,
            "{} is not {expected}",
            point.uv
        );
        assert!(
            point.tangent.y > 0.7,
            "v grows along +y, not along {}",
            point.tangent
        );
    }
}

#[test]
fn a_ray_to_a_target_stops_short_of_it() {
    let geometry = placed(
        vec![blade(4, 4, 1.0, 1.0, Vec3::ZERO)],
        &[
            (0, Affine3A::IDENTITY),
            (0, Affine3A::from_translation(Vec3::Z)),
        ],
    );
    let ray = Ray::new(Vec3::new(0.1, 0.1, -1.0), Vec3::Z);
    let near = geometry
        .intersect(&ray)
        .expect("the lower blade is in the way");
    let point = geometry.surface(&near);
    let far = geometry
        .intersect(&point.spawn(Vec3::Z))
        .expect("the upper blade is above");
    let target = geometry.surface(&far).position;
    assert!(
        !geometry.occluded(&point.spawn_to(target)),
        "the target hides itself"
    );
    assert!(
        geometry.occluded(&point.spawn_to(target + Vec3::Z)),
        "what is behind the upper blade is hidden"
    );
}

proptest! {
    #![proptest_config(fixed(128))]

    #[test]
    fn a_ray_between_the_planes_starts_on_its_side_and_passes_over_the_triangle(seed in 0_u64..1 << 40) {
        let mut numbers = Numbers::new(seed);
        let normals = (0..3).map(|_| Vec3::Z + 0.8 * numbers.cube()).collect();
        let to_world = numbers.affine(1.0);
        let mesh = triangle(Some(normals), None);
        let geometry = placed(vec![mesh.clone()], &[(0, to_world)]);
        let point = seen(mesh, to_world);
        for _ in 0..400 {
            let direction = numbers.direction();
            // The very edge of the plane is at the mercy of rounding.
            let along = direction.dot(point.shading_normal);
            if !point.is_between_planes(direction) || along.abs() < 1e-3 {
                continue;
            }
            let height = (point.raised(direction) - point.position).dot(point.geometric_normal);
            prop_assert!(height * along > 0.0, "{height} on the wrong side");
            prop_assert!(!geometry.occluded(&point.way_up(direction)));
            prop_assert!(!geometry.occluded(&Ray::new(point.raised(direction), direction)), "{point:?}");
        }
    }
}

#[test]
fn a_point_of_a_mesh_without_normals_never_rises() {
    let point = seen(triangle(None, None), Affine3A::IDENTITY);
    assert_eq!(point.rise, [0.0, 0.0]);
    let mut numbers = Numbers::new(3);
    assert!((0..1000).all(|_| !point.is_between_planes(numbers.direction())));
    // Even along the plane.
    assert!(!point.is_between_planes(Vec3::X));
}
