//! Charts: faces of similar orientation, projected onto a plane.

use std::collections::VecDeque;
use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use crate::mosaic::surface::Surface;
use crate::plane;

/// Number of directions within a right angle that are tried for the smallest box around a chart.
const TURNS: u32 = 16;
/// Least weight of a centre that counts as inside a face, not on its edge.
const INSIDE: f64 = 1e-6;

/// A connected part of a surface seen along one direction, mm.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    /// Its faces.
    pub(super) faces: Vec<u32>,
    /// Projected corners of the faces.
    pub(super) corners: Vec<[DVec2; 3]>,
    /// Lower corner of the box around it, which is no taller than wide.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

/// Cuts a surface into charts. The normals of a chart's faces differ from that of the first by at
/// most acos(`agree`).
///
/// Faces whose projection, at `texels_per_mm`, would overlap others of the chart (a ramp that winds
/// back over itself) are left for other charts.
pub(super) fn charts(surface: &Surface, agree: f64, texels_per_mm: f64) -> Vec<Chart> {
    let count = surface.faces().len() as u32;
    let normals: Vec<DVec3> = (0..count).map(|face| surface.normal(face)).collect();
    let mut taken = vec![false; count as usize];
    let mut charts = Vec::new();
    for seed in 0..count {
        if taken[seed as usize] {
            continue;
        }
        let first = normals[seed as usize];
        let mut faces = Vec::new();
        let mut next = VecDeque::from([seed]);
        taken[seed as usize] = true;
        while let Some(face) = next.pop_front() {
            faces.push(face);
            for edge in 0..3 {
                if let Some(beyond) = surface.neighbour(face, edge)
                    && !taken[beyond as usize]
                    && normals[beyond as usize].dot(first) >= agree
                {
                    taken[beyond as usize] = true;
                    next.push_back(beyond);
                }
            }
        }
        let along = first.any_orthonormal_vector();
        let across = first.cross(along);
        let drawn: Vec<[DVec2; 3]> = faces
            .iter()
            .map(|&face| {
                surface.faces()[face as usize].map(|vertex| {
                    let p = surface.positions()[vertex as usize];
                    DVec2::new(p.dot(along), p.dot(across))
                })
            })
            .collect();
        let kept = without_overlaps(&drawn, texels_per_mm);
        for (&face, &kept) in faces.iter().zip(&kept) {
            taken[face as usize] = kept;
        }
        let keep = |i: &usize| kept[*i];
        let corners = (0..faces.len()).filter(keep).map(|i| drawn[i]).collect();
        let faces = (0..faces.len()).filter(keep).map(|i| faces[i]).collect();
        // Rejected faces have higher numbers than the seed, so the loop reaches them later.
        charts.push(turned(faces, corners));
    }
    charts
}

/// The chart turned to a small box that is no taller than wide.
fn turned(faces: Vec<u32>, corners: Vec<[DVec2; 3]>) -> Chart {
    let bounds = |turn: DVec2| {
        let points = corners.iter().flatten();
        plane::bounds(points.map(|p| turn.rotate(*p)))
    };
    let best = (0..TURNS)
        .map(|i| {
            let angle = FRAC_PI_2 * f64::from(i) / f64::from(TURNS);
            let turn = DVec2::new(libm::cos(angle), libm::sin(angle));
            let (low, high) = bounds(turn);
            (turn, (high - low).element_product())
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(DVec2::X, |(turn, _)| turn);
    let (low, high) = bounds(best);
    let size = high - low;
    let turn = if size.y > size.x { best.perp() } else { best };
    let (low, high) = bounds(turn);
    Chart {
        faces,
        corners: corners
            .into_iter()
            .map(|corners| corners.map(|p| turn.rotate(p)))
            .collect(),
        low,
        high,
    }
}

/// For each face whether it stays, if no face may cover a texel's centre that an earlier one
/// covers.
fn without_overlaps(drawn: &[[DVec2; 3]], texels_per_mm: f64) -> Vec<bool> {
    let (low, high) = plane::bounds(drawn.iter().flatten().copied());
    let size = ((high - low) * texels_per_mm).ceil();
    let (columns, rows) = (size.x as usize + 1, size.y as usize + 1);
    let mut owned = vec![false; columns * rows];
    drawn
        .iter()
        .map(|corners| {
            let scaled = corners.map(|p| (p - low) * texels_per_mm);
            let mut covered = Vec::new();
            each_texel(&scaled, INSIDE, |x, y, _| {
                covered.push(y as usize * columns + x as usize);
            });
            let free = covered.iter().all(|&texel| !owned[texel]);
            if free {
                for texel in covered {
                    owned[texel] = true;
                }
            }
            free
        })
        .collect()
}

/// Calls `visit(column, row, weights of the second and third corner)` for each texel whose centre
/// lies in a triangle.
///
/// `margin` is the least weight that counts as inside: slightly above 0, points on shared edges
/// belong to neither face; below 0, to both. Coordinates are texels.
pub(super) fn each_texel(
    corners: &[DVec2; 3],
    margin: f64,
    mut visit: impl FnMut(i64, i64, [f64; 2]),
) {
    let [a, b, c] = *corners;
    let twice = (b - a).perp_dot(c - a);
    let low = a.min(b).min(c) - 0.5;
    let high = a.max(b).max(c) - 0.5;
    for y in low.y.ceil() as i64..=high.y.floor() as i64 {
        for x in low.x.ceil() as i64..=high.x.floor() as i64 {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - a;
            let v = p.perp_dot(c - a) / twice;
            let w = (b - a).perp_dot(p) / twice;
            if v >= margin && w >= margin && 1.0 - v - w >= margin {
                visit(x, y, [v, w]);
            }
        }
    }
}
