//! Closed bodies around an axis: pots and ovaries.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::blade::stalk::StalkMesh;

/// Vertices around a body.
const AROUND: usize = 96;
/// Cosine between two pieces of a profile up to which their corner is rounded in shading.
const CREASE: f64 = 0.8;

/// The surface that a profile of points [radius, height] sweeps around z, mm.
///
/// The profile starts and ends on the axis or meets itself, and has the body on its left: it runs
/// up on the outside.
pub(super) fn turned(profile: &[[f64; 2]]) -> StalkMesh {
    let mut body = StalkMesh::default();
    let points: Vec<DVec2> = profile.iter().copied().map(DVec2::from_array).collect();
    let pieces: Vec<[DVec2; 2]> = points
        .windows(2)
        .filter(|pair| pair[0].distance(pair[1]) > 1e-9)
        .map(|pair| [pair[0], pair[1]])
        .collect();
    let outward = |[from, to]: [DVec2; 2]| {
        let along = (to - from).normalize();
        DVec2::new(along.y, -along.x)
    };
    for (number, piece) in pieces.iter().enumerate() {
        let own = outward(*piece);
        let shared = |beside: Option<&[DVec2; 2]>| {
            let other = beside.map_or(own, |piece| outward(*piece));
            if other.dot(own) > CREASE {
                (other + own).normalize()
            } else {
                own
            }
        };
        let before = number.checked_sub(1).and_then(|before| pieces.get(before));
        let normals = [shared(before), shared(pieces.get(number + 1))];
        let first = body.positions.len() as u32;
        for side in 0..=AROUND {
            let (sin, cos) = libm::sincos(TAU * side as f64 / AROUND as f64);
            for (point, normal) in piece.iter().zip(normals) {
                body.positions
                    .push(DVec3::new(point.x * cos, point.x * sin, point.y));
                body.normals
                    .push(DVec3::new(normal.x * cos, normal.x * sin, normal.y));
                body.uvs.push(DVec2::new(side as f64 / AROUND as f64, 0.5));
                body.thickness_mm.push(1.0);
            }
        }
        for side in 0..AROUND as u32 {
            let [a, b] = [first + 2 * side, first + 2 * side + 2];
            if piece[0].x > 1e-9 {
                body.triangles.push([a, b, a + 1]);
            }
            if piece[1].x > 1e-9 {
                body.triangles.push([b, b + 1, a + 1]);
            }
        }
    }
    body
}

/// A closed body along an axis with ribs: a profile of points [height, radius], mm, whose radius
/// falls by the share `depth` in the furrows between `ribs` ribs. The frame is its foot, a direction
/// to a rib, and that of its axis, both of unit length.
pub(super) fn ribbed(
    profile: &[[f64; 2]],
    [foot, rib, along]: [DVec3; 3],
    ribs: u32,
    depth: f64,
) -> StalkMesh {
    let side = along.cross(rib);
    let place = |height: f64, radius: f64, angle: f64| {
        let wave = 0.5 - 0.5 * libm::cos(f64::from(ribs) * angle);
        let radius = radius * (1.0 - depth * wave);
        let (sin, cos) = libm::sincos(angle);
        foot + along * height + (rib * cos + side * sin) * radius
    };
    let mut body = StalkMesh::default();
    let mut push = |position: DVec3, height: f64| {
        body.positions.push(position);
        body.normals.push(DVec3::ZERO);
        body.uvs.push(DVec2::new(0.5, height));
        body.thickness_mm.push(1.0);
    };
    let [first, last] = [profile[0], profile[profile.len() - 1]];
    push(foot + along * first[0], 0.0);
    for [height, radius] in profile {
        for step in 0..AROUND {
            let angle = TAU * step as f64 / AROUND as f64;
            push(place(*height, *radius, angle), height / last[0].max(1e-9));
        }
    }
    push(foot + along * last[0], 1.0);
    let at = |ring: usize, step: usize| (1 + ring * AROUND + step % AROUND) as u32;
    let end = (body.positions.len() - 1) as u32;
    for step in 0..AROUND {
        body.triangles.push([0, at(0, step + 1), at(0, step)]);
        for ring in 1..profile.len() {
            let [a, b] = [at(ring - 1, step), at(ring - 1, step + 1)];
            let [c, d] = [at(ring, step), at(ring, step + 1)];
            body.triangles.extend([[a, b, d], [a, d, c]]);
        }
        let ring = profile.len() - 1;
        body.triangles
            .push([end, at(ring, step), at(ring, step + 1)]);
    }
    // Normals are the mean of the triangles around, by area.
    for triangle in &body.triangles {
        let [a, b, c] = triangle.map(|vertex| body.positions[vertex as usize]);
        let normal = (b - a).cross(c - a);
        for vertex in triangle {
            body.normals[*vertex as usize] += normal;
        }
    }
    for normal in &mut body.normals {
        *normal = normal.normalize_or(along);
    }
    body
}

/// A level direction at right angles to another; of an upright one, +x.
pub(crate) fn level(along: DVec3) -> DVec3 {
    let level = along.cross(DVec3::Z);
    if level.length() < 1e-6 {
        return (DVec3::X - along * along.x).normalize();
    }
    level.normalize()
}
