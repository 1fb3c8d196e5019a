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
        let foot = drop.foot_radius();
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
