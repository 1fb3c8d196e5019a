use glam::{Affine3A, Vec3};
use proptest::prelude::*;

use super::super::slab::SlabRay;
use super::super::testing::{Numbers, alone, blade, placed, ray_through, soup};
use super::super::triangle::ShearRay;
use super::super::{Ray, TriangleMesh};
use super::{Geometry, Hit};
use crate::simd::Level;
use properties::fixed;
use rayon::prelude::*;

mod joined;
mod limits;

/// The nearest hit, found without walking trees by testing every triangle of every instance with
/// the tracer's own test.
fn every_triangle(geometry: &Geometry, ray: &Ray) -> Option<Hit> {
    let mut hits = Vec::new();
    let world = SlabRay::among_widened(
        ray.origin().into(),
        ray.direction().into(),
        ray.t_min(),
        geometry.farthest,
    );
    for (carrier, bounds) in geometry.carriers.iter().zip(&geometry.boxes) {
        let traced = &geometry.trees[carrier.tree as usize];
        let enter = if geometry.carriers.len() == 1 {
            Some(0.0)
        } else {
            world.one(bounds)
        };
        let (origin, direction) = carrier.carry(ray);
        let slab = SlabRay::new(origin, direction, ray.t_min(), traced.tree.bounds());
        let for_walls = SlabRay::new(origin, direction, ray.t_min(), &traced.wall_bounds);
        let shear = ShearRay::new(origin, direction, ray.t_min());
        let mut in_tree = Vec::new();
        for (number, block) in (0..).zip(&traced.blocks) {
            let slab = if traced.walls().any(|(wall, _)| wall == number) {
                &for_walls
            } else {
                &slab
            };
            for lane in 0..8 {
                let place = number * 8 + lane as u32;
                if let Some(hit) = block.hit_alone(lane, &shear, slab) {
                    in_tree.push(Hit {
                        t: hit.t,
                        instance: traced.owner(place).unwrap_or(carrier.instance),
                        triangle: block.id(lane),
                        b1: hit.b1,
                        b2: hit.b2,
                        place,
                    });
                }
            }
        }
        if let (Some(mut hit), Some(enter)) = (nearest(in_tree), enter) {
            hit.t = hit.t.max(enter);
            hits.extend((hit.t <= ray.t_max()).then_some(hit));
        }
    }
    nearest(hits)
}

/// The nearest of some hits; of equal distances the smaller (instance, triangle).
fn nearest(hits: Vec<Hit>) -> Option<Hit> {
    hits.into_iter().min_by(|a, b| {
        let key = |hit: &Hit| (hit.instance, hit.triangle);
        a.t.total_cmp(&b.t).then(key(a).cmp(&key(b)))
    })
}

/// The nearest hit by Möller and Trumbore's test in `f64` on world positions, and how far (in
/// barycentrics) any triangle's edge is from deciding otherwise.
fn in_doubles(geometry: &Geometry, ray: &Ray) -> (Option<f64>, f64) {
    let (origin, direction) = (ray.origin().as_dvec3(), ray.direction().as_dvec3());
    let (mut nearest, mut margin): (Option<f64>, f64) = (None, f64::INFINITY);
    for placement in &geometry.placements {
        let mesh = &geometry.meshes[placement.instance.mesh as usize];
        let to_world = placement.instance.around(geometry.origin);
        let linear = [
            to_world.matrix3.x_axis,
            to_world.matrix3.y_axis,
            to_world.matrix3.z_axis,
        ];
        let linear =
            glam::DMat3::from_cols_slice(&linear.map(|axis| axis.as_dvec3().to_array()).concat());
        for triangle in 0..mesh.triangles().len() as u32 {
            let corners = mesh.corners(triangle);
            let [a, b, c] =
                corners.map(|p| linear * p.as_dvec3() + to_world.translation.as_dvec3());
            let (e1, e2) = (b - a, c - a);
            let p = direction.cross(e2);
            let determinant = e1.dot(p);
            let s = origin - a;
            let q = s.cross(e1);
            let (u, v) = (s.dot(p) / determinant, direction.dot(q) / determinant);
            let t = e2.dot(q) / determinant;
            let inside = u.min(v).min(1.0 - u - v);
            // Seen edge-on, single precision may decide either way.
            let edge_on = determinant.abs() / (e1.cross(e2).length() * direction.length());
            margin = margin
                .min(inside.abs())
                .min(if inside > -0.1 { edge_on } else { 1.0 });
            if inside >= 0.0 && t >= 0.0 {
                margin = margin.min(t * direction.length());
                nearest = Some(nearest.map_or(t, |nearest| nearest.min(t)));
            }
        }
    }
    (nearest, margin)
}

#[test]
fn the_trees_find_what_testing_every_triangle_finds() {
    let mut found = 0;
    for (seed, scale) in (0..).zip([1e-4, 1e-2, 1.0, 30.0, 1e3]) {
        let mut numbers = Numbers::new(seed);
        let meshes = vec![
            soup(seed + 10, 150, scale, Vec3::ZERO),
            soup(seed + 20, 40, scale, Vec3::splat(3.0 * scale)),
            blade(9, 7, scale, scale, Vec3::ZERO),
        ];
        let instances: Vec<_> = (0..12)
            .map(|i| (i % 3, numbers.affine(scale)))
            .chain([(2, Affine3A::IDENTITY), (2, Affine3A::IDENTITY)])
            .collect();
        let geometry = placed(meshes, &instances);
        for _ in 0..600 {
            let mut ray = ray_through(&mut numbers, &geometry);
            if numbers.unit() < 0.5 {
                // At a triangle, so that not all of them pass between.
                let number = numbers.below(instances.len()) as u32;
                let corners = geometry
                    .mesh(geometry.instance(number).mesh)
                    .corners(numbers.below(40) as u32);
                let target = geometry
                    .to_world(number)
                    .transform_point3((corners[0] + corners[1] + corners[2]) / 3.0);
                ray = Ray::new(ray.origin(), target - ray.origin());
            }
            if numbers.unit() < 0.3 {
                ray = ray.starting_at(numbers.unit());
                ray = ray.up_to(ray.t_min() + numbers.unit());
            }
            let hit = geometry.intersect(&ray);
            assert_eq!(
                hit,
                every_triangle(&geometry, &ray),
                "scale {scale}, {ray:?}"
            );
            assert_eq!(
                hit.is_some(),
                geometry.occluded(&ray),
                "scale {scale}, {ray:?}"
            );
            found += usize::from(hit.is_some());
        }
    }
    assert!(found > 1000, "only {found} of 3000 rays hit anything");
}

#[test]
fn every_level_of_instructions_finds_the_same_bits() {
    let mut numbers = Numbers::new(11);
    let meshes = vec![
        soup(31, 300, 1.0, Vec3::ZERO),
        blade(20, 9, 1.0, 1.0, Vec3::ZERO),
    ];
    let instances: Vec<_> = (0..20).map(|i| (i % 2, numbers.affine(2.0))).collect();
    let geometry = placed(meshes, &instances);
    let levels: Vec<_> = Level::all()
        .into_iter()
        .map(|level| geometry.clone().at_level(level))
        .collect();
    let mut found = 0;
    for _ in 0..4000 {
        let ray = ray_through(&mut numbers, &geometry);
        let hits = levels.iter().map(|geometry| {
            let hit = geometry.intersect(&ray);
            assert_eq!(hit.is_some(), geometry.occluded(&ray));
            hit.map(|hit| {
                let floats = [hit.t, hit.b1, hit.b2].map(f32::to_bits);
                (hit.instance, hit.triangle, floats)
            })
        });
        let hits: Vec<_> = hits.collect();
        assert!(hits.iter().all(|hit| *hit == hits[0]), "{ray:?}: {hits:?}");
        found += usize::from(hits[0].is_some());
    }
    assert!(found > 500, "only {found} of 4000 rays hit anything");
}

#[test]
#[ignore = "deep: 10⁸ rays, 40 s on two cores"]
fn no_ray_of_a_hundred_million_leaves_a_closed_curved_leaf() {
    // Two curved blades that share their margin, 5 cm long: a closed surface around the rays'
    // origins.
    let (side, length) = (60_u32, 0.05);
    let count = side + 1;
    let mut positions = Vec::new();
    for face in [1.0, -1.0] {
        for j in 0..count {
            for i in 0..count {
                let (u, v) = (i as f32 / side as f32, j as f32 / side as f32);
                let bulge = 16.0 * u * (1.0 - u) * v * (1.0 - v);
                let bend = 0.004 * libm::cosf(5.0 * v) + 0.003 * u * u;
                let at = Vec3::new((u - 0.5) * 0.6, v - 0.5, 0.0) * length;
                positions.push(at + Vec3::Z * (bend + face * 0.002 * bulge));
            }
        }
    }
    // On the margin both faces use the first one's vertices.
    let vertex = |face: u32, i: u32, j: u32| {
        let inner = i > 0 && j > 0 && i < side && j < side;
        if inner {
            face * count * count + j * count + i
        } else {
            j * count + i
        }
    };
    let mut triangles = Vec::new();
    for (face, i, j) in
        (0..2).flat_map(|face| (0..side).flat_map(move |i| (0..side).map(move |j| (face, i, j))))
    {
        let [a, b, c, d] =
            [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| vertex(face, i, j));
        // The corners' diagonals turn so that no face lies in the margin alone, where the faces
        // would coincide.
        let across = (i == 0) == (j == 0) && (i + 1 == side) == (j + 1 == side);
        let across = across || (i == 0 && j == 0) || (i + 1 == side && j + 1 == side);
        if across {
            triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            triangles.extend([[a, b, d], [b, c, d]]);
        }
    }
    let mesh = TriangleMesh::new(positions, None, None, triangles).expect("a closed leaf");
    assert_eq!(mesh.dropped().total(), 0);
    let geometry = alone(mesh);
    let escaped: u32 = (0..1000_u64)
        .into_par_iter()
        .map(|chunk| {
            let mut numbers = Numbers::new(chunk);
            let mut escaped = 0;
            for _ in 0..100_000 {
                let (u, v) = (0.2 + 0.6 * numbers.unit(), 0.2 + 0.6 * numbers.unit());
                let bend = 0.004 * libm::cosf(5.0 * v) + 0.003 * u * u;
                let origin = Vec3::new((u - 0.5) * 0.6, v - 0.5, 0.0) * length + Vec3::Z * bend;
                let ray = Ray::new(origin, numbers.direction());
                escaped += u32::from(geometry.intersect(&ray).is_none());
            }
            escaped
        })
        .sum();
    assert_eq!(escaped, 0, "rays left a closed leaf");
}

#[test]
fn hits_agree_with_double_precision_away_from_edges() {
    let mut compared = 0;
    for (seed, scale) in (0..).zip([1e-4_f32, 1.0, 1e3]) {
        let mut numbers = Numbers::new(seed + 70);
        let instances: Vec<_> = (0..6).map(|_| (0, numbers.affine(3.0 * scale))).collect();
        let geometry = placed(
            vec![soup(seed + 90, 60, scale, Vec3::ONE * scale)],
            &instances,
        );
        for _ in 0..700 {
            let ray = ray_through(&mut numbers, &geometry);
            let (expected, margin) = in_doubles(&geometry, &ray);
            // Distances in units of the scene, so that the margin is comparable at every scale.
            if margin / f64::from(scale).min(1.0) < 1e-3 {
                continue;
            }
            compared += 1;
            let hit = geometry.intersect(&ray).map(|hit| f64::from(hit.t));
            match (hit, expected) {
                (Some(hit), Some(expected)) => {
                    assert!(
                        (hit - expected).abs() < 2e-3 * expected,
                        "{hit} is not {expected}: {ray:?}"
                    );
                }
                (hit, expected) => assert_eq!(hit, expected, "{ray:?}"),
            }
        }
    }
    assert!(
        compared > 500,
        "only {compared} rays were clear enough to compare"
    );
}

#[test]
fn a_leaf_in_metres_loses_no_ray() {
    // 5 cm × 3 cm, 20 000 triangles, seen from half a metre, from 2 mm, and far from the origin.
    for center in [
        Vec3::ZERO,
        Vec3::new(0.3, -2.0, 1.1),
        Vec3::new(40.0, 70.0, 2.0),
    ] {
        let geometry = alone(blade(125, 80, 0.05, 0.03, center));
        let mut numbers = Numbers::new(5);
        for _ in 0..20_000 {
            let inner = Vec3::new(
                0.0249 * (2.0 * numbers.unit() - 1.0),
                0.0149 * (2.0 * numbers.unit() - 1.0),
                0.0,
            );
            let lean = Vec3::new(numbers.unit() - 0.5, numbers.unit() - 0.5, 0.0) * 0.001;
            let height = if numbers.unit() < 0.5 { 0.5 } else { 0.004 };
            let origin = center + inner * 0.9 + lean + Vec3::Z * height;
            let ray = Ray::new(origin, center + inner * 0.9 - Vec3::Z * 0.01 - origin);
            assert!(geometry.intersect(&ray).is_some(), "{ray:?} slips through");
            assert!(geometry.occluded(&ray), "{ray:?} is not blocked");
        }
    }
}

proptest! {
    #![proptest_config(fixed(128))]

    #[test]
    fn no_ray_slips_through_an_edge_or_a_corner(seed in 0_u64..1 << 40, scale in -4_i32..4, turned in any::<bool>()) {
        let scale = libm::powf(10.0, scale as f32);
        let mut numbers = Numbers::new(seed);
        let mesh = blade(12, 12, scale, scale, Vec3::ZERO);
        let to_world = if turned { numbers.affine(scale) } else { Affine3A::IDENTITY };
        let (vertices, triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
        let geometry = placed(vec![mesh], &[(0, to_world)]);
        for _ in 0..40 {
            let triangle = triangles[numbers.below(triangles.len())];
            let [a, b] = [triangle[0], triangle[1 + numbers.below(2)]].map(|i| vertices[i as usize]);
            let inner = |p: Vec3| p.x.abs() < 0.49 * scale && p.y.abs() < 0.49 * scale;
            if !inner(a) || !inner(b) {
                continue;
            }
            // A corner, the middle of an edge, or anywhere along it.
            let along = [0.0, 0.5, numbers.unit()][numbers.below(3)];
            let target = to_world.transform_point3(a + (b - a) * along);
            let lean = Vec3::new(numbers.unit() - 0.5, numbers.unit() - 0.5, 2.0) * 2.0;
            // Half of them straight down: rays along an axis have zeros in their direction.
            let lean = if numbers.unit() < 0.5 { Vec3::Z * 2.0 } else { lean };
            let origin = target + to_world.transform_vector3(lean * scale);
            let ray = Ray::new(origin, target - origin);
            prop_assert!(geometry.intersect(&ray).is_some(), "{ray:?} slips through");
            prop_assert!(geometry.occluded(&ray));
        }
    }

    #[test]
    fn scaling_by_a_power_of_two_scales_every_hit_exactly(seed in 0_u64..1 << 40, power in -12_i32..12) {
        let factor = libm::exp2f(power as f32);
        let [one, other] = [1.0, factor].map(|scale| alone(soup(seed, 50, scale, Vec3::ZERO)));
        let mut numbers = Numbers::new(seed);
        for _ in 0..20 {
            let ray = ray_through(&mut numbers, &one);
            let scaled = Ray::new(ray.origin() * factor, ray.direction() * factor);
            prop_assert_eq!(one.intersect(&ray), other.intersect(&scaled));
        }
    }
}
