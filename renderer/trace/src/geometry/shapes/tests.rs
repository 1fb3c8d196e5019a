use std::f64::consts::PI;

use glam::DVec3;

use super::*;
use crate::geometry::TriangleMesh;

/// Volume between a mesh and z = 0, by the divergence theorem.
fn volume(mesh: &TriangleMesh) -> f64 {
    let corner = |index: u32| mesh.positions()[index as usize].as_dvec3();
    let of = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(corner);
        a.dot(b.cross(c)) / 6.0
    };
    mesh.triangles().iter().map(of).sum()
}

#[test]
fn a_drop_has_its_volume_and_its_contact_angle() {
    for degrees in [20.0_f64, 60.0, 90.0, 120.0, 155.0] {
        let drop = Drop {
            volume: 2e-9,
            contact_angle: degrees.to_radians(),
            segments: 256,
        };
        let mesh = drop.mesh().expect("a drop");
        // The skirt below the foot is a short cylinder nearly, of 3 % of the foot's radius.
        let foot = drop.radius() * libm::sin(drop.contact_angle);
        let ratio = volume(&mesh) / 2e-9;
        let skirt = 0.03 * PI * foot.powi(3) / 2e-9;
        assert!(
            ratio > 0.995 && ratio < 1.005 + 1.3 * skirt,
            "{degrees} {ratio} {skirt}"
        );
        // Where the side passes through z = 0 its normal makes the contact angle with the vertical.
        let lowest = mesh
            .positions()
            .iter()
            .zip(mesh.normals().expect("normals"));
        let (position, normal) = lowest
            .min_by(|(a, _), (b, _)| a.z.abs().total_cmp(&b.z.abs()))
            .expect("vertices");
        let found = libm::acos(f64::from(normal.z)).to_degrees();
        assert!((found - degrees).abs() < 3.0, "{degrees} {found}");
        let across = f64::from(position.truncate().length());
        assert!(
            (across / foot - 1.0).abs() < 0.04,
            "{degrees} {across} {foot}"
        );
    }
}

#[test]
fn a_lump_is_closed_and_its_normals_are_those_of_its_faces() {
    for (angularity, seed) in [(0.0, 1), (0.5, 2), (1.0, 3)] {
        let lump = Lump {
            radius: 0.01,
            angularity,
            irregularity: 0.4,
            segments: 96,
            seed,
        };
        let mesh = lump.mesh().expect("a lump");
        let ball = 4.0 / 3.0 * PI * 1e-6;
        let share = volume(&mesh) / ball;
        assert!((0.2..1.3).contains(&share), "{share}");
        let normals = mesh.normals().expect("normals");
        let mut off = 0.0;
        for triangle in mesh.triangles() {
            let [a, b, c] = triangle.map(|index| mesh.positions()[index as usize].as_dvec3());
            let flat = (b - a).cross(c - a).normalize_or_zero();
            let smooth: DVec3 = triangle
                .iter()
                .map(|&i| normals[i as usize].as_dvec3())
                .sum();
            off += 1.0 - flat.dot(smooth.normalize());
        }
        let mean = off / mesh.triangles().len() as f64;
        assert!(mean < 0.01, "{angularity} {mean}");
    }
    let of = |seed| Lump {
        radius: 1.0,
        angularity: 0.3,
        irregularity: 0.4,
        segments: 16,
        seed,
    };
    let [one, other] = [of(1), of(2)].map(|lump| lump.mesh().expect("a lump"));
    assert_ne!(one.positions(), other.positions());
}

#[test]
fn ground_is_as_uneven_as_it_should_be() {
    let terrain = Terrain {
        size: [0.6, 0.5],
        deviation: 0.003,
        waves: [0.1, 0.01],
        exponent: 0.7,
        seed: 4,
    };
    let mesh = terrain.mesh().expect("ground");
    let heights = mesh
        .positions()
        .iter()
        .map(|position| f64::from(position.z));
    let count = mesh.positions().len() as f64;
    let mean = heights.clone().sum::<f64>() / count;
    let variance = heights.map(|height| (height - mean).powi(2)).sum::<f64>() / count;
    assert!(
        (variance.sqrt() / 0.003 - 1.0).abs() < 0.15,
        "{}",
        variance.sqrt()
    );
    let (least, most) = mesh.bounds();
    assert!(
        (least.x + 0.3).abs() < 1e-6 && (most.y - 0.25).abs() < 1e-6,
        "{least} {most}"
    );
}

fn wall() -> Masonry {
    Masonry {
        size: [0.9, 0.45],
        part: MasonryPart::Bricks,
        brick: [0.215, 0.065],
        joint: 0.01,
        recess: 0.006,
        roughness: 0.6,
        kind: [1, 1],
        seed: 3,
    }
}

#[test]
fn bricks_lie_before_their_mortar_and_within_the_wall() {
    let bricks = wall().mesh().expect("a good wall");
    let mortar = Masonry {
        part: MasonryPart::Mortar,
        ..wall()
    };
    let mortar = mortar.mesh().expect("a good wall");
    let (least, most) = bricks.bounds();
    // Faces at x = 0 within their unevenness, backs behind the mortar.
    assert!(most.x > -0.001 && most.x < 0.006, "{most}");
    assert!(least.x < mortar.bounds().0.x, "{least}");
    assert!(mortar.bounds().1.x < -0.003);
    // Displaced by up to 1.2 mm.
    assert!(least.y > -0.452 && most.y < 0.452 && least.z > -0.002 && most.z < 0.452);
    // The joints take a sixth of the wall.
    let front: f64 = bricks
        .triangles()
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|corner| bricks.positions()[corner as usize].as_dvec3());
            0.5 * (b - a).cross(c - a).x.max(0.0)
        })
        .sum();
    assert!((0.78..0.9).contains(&(front / (0.9 * 0.45))), "{front}");
    assert_eq!(bricks.dropped().total(), 0);
}

#[test]
fn the_kinds_of_bricks_are_together_the_wall() {
    let count = |kind: [u32; 2]| {
        let wall = Masonry { kind, ..wall() };
        wall.mesh().map_or(0, |mesh| mesh.triangles().len())
    };
    let kinds = [1, 2, 3].map(|kind| count([kind, 3]));
    assert_eq!(kinds.iter().sum::<usize>(), count([1, 1]));
    assert!(kinds.iter().all(|kind| *kind > 0), "{kinds:?}");
}
