//! The middle and the radius of a vein at each point of its line, to fractions of a pixel.
//!
//! The distance of a pixel from the nearest pixel outside tells the radius to about half a pixel.
//! Finer: across the line, the ink is read between pixels on both sides until it falls below the
//! level. Half the sum of both ways is the radius, half their difference how far the line is off
//! the middle. Near a node the vein that is joined there is in the way; the values of the nearest
//! point of the same line that is clear of it are taken.

use glam::DVec2;

use super::graph::{Chain, Graph};
use super::grid::Raster;
use crate::plane::polyline;

/// Points before and after over which directions across are taken.
const LOOK: usize = 4;

/// How far from a junction, in its reaches, other veins are in the way.
const SHADOW: f64 = 1.25;

/// Distance of the centre of a pixel at the edge from the edge itself, pixels, in the mean.
pub(super) const HALF_PIXEL: f64 = 0.5;

/// Greatest shift of a line towards the middle of its vein, pixels.
const FARTHEST_SHIFT: f64 = 1.5;

/// How far from a junction of a reach other veins are in the way, pixels.
pub(super) fn shadow_of(reach: f64) -> f64 {
    SHADOW * reach + 1.0
}

/// What is measured at a point.
#[derive(Clone, Copy)]
struct Section {
    radius: f64,
    shift: DVec2,
}

/// Moves the points of a chain to the middle of its vein and gives their radii, pixels.
///
/// `is_junction` tells for each end whether veins meet there.
pub(super) fn measured(
    chain: &mut Chain,
    graph_nodes: &Graph,
    ink: &Raster,
    is_junction: [bool; 2],
) -> Vec<f64> {
    let count = chain.points.len();
    let passed = polyline::lengths(&chain.points);
    let length = passed[count - 1];
    let shadow = |end: usize| {
        let node = &graph_nodes.nodes[chain.ends[end] as usize];
        if is_junction[end] {
            shadow_of(node.reach)
        } else {
            0.0
        }
    };
    let (before, after) = (shadow(0), shadow(1));
    // Between two junctions with shadows that meet, the middle is the least covered.
    let (low, high) = if before + after <= length {
        (before, length - after)
    } else {
        let middle = length * before / (before + after);
        (middle - 1.0, middle + 1.0)
    };
    let sections: Vec<Option<Section>> = (0..count)
        .map(|i| {
            let clear = (low..=high).contains(&passed[i]);
            clear.then(|| section(chain, i, ink))
        })
        .collect();
    let radii = filled(&sections, chain);
    for (i, section) in sections.iter().enumerate() {
        let is_end = i == 0 || i == count - 1;
        if let Some(section) = section
            && !(is_end && is_junction[usize::from(i > 0)])
        {
            chain.points[i] += section.shift;
        }
    }
    averaged(&radii)
}

/// The radius at every point: its own, or that of the nearest point that has one.
fn filled(sections: &[Option<Section>], chain: &Chain) -> Vec<f64> {
    let mut radii = vec![f64::NAN; sections.len()];
    let mut nearest = vec![usize::MAX; sections.len()];
    for forwards in [true, false] {
        let mut last: Option<usize> = None;
        for step in 0..sections.len() {
            let i = if forwards {
                step
            } else {
                sections.len() - 1 - step
            };
            if sections[i].is_some() {
                last = Some(i);
            }
            if let Some(at) = last
                && at.abs_diff(i) < nearest[i]
            {
                nearest[i] = at.abs_diff(i);
                radii[i] = sections[at].map_or(f64::NAN, |section| section.radius);
            }
        }
    }
    let least = chain.reaches.iter().copied().fold(f64::INFINITY, f64::min);
    let fallback = (least - HALF_PIXEL).max(HALF_PIXEL);
    for radius in &mut radii {
        if radius.is_nan() {
            *radius = fallback;
        }
    }
    radii
}

/// What is measured across a chain at one of its points.
fn section(chain: &Chain, i: usize, ink: &Raster) -> Section {
    let (points, reach) = (&chain.points, chain.reaches[i]);
    let (back, ahead) = (i.saturating_sub(LOOK), (i + LOOK).min(points.len() - 1));
    let across = (points[ahead] - points[back]).perp().normalize_or_zero();
    let by_distance = Section {
        radius: (reach - HALF_PIXEL).max(HALF_PIXEL),
        shift: DVec2::ZERO,
    };
    if across == DVec2::ZERO {
        return by_distance;
    }
    match (
        edge(points[i], across, reach, ink),
        edge(points[i], -across, reach, ink),
    ) {
        (Some(left), Some(right)) => {
            let shift = (0.5 * (left - right)).clamp(-FARTHEST_SHIFT, FARTHEST_SHIFT);
            Section {
                radius: 0.5 * (left + right),
                shift: across * shift,
            }
        }
        _ => by_distance,
    }
}

/// How far it is from `start` to where the ink ends; `None` if that is far from what the distance
/// to the edge tells.
fn edge(start: DVec2, way: DVec2, reach: f64, ink: &Raster) -> Option<f64> {
    const STEP: f64 = 0.5;
    let mut last = ink.at(start);
    if last <= 0.0 {
        return None;
    }
    let most = 1.4 * reach + 2.0;
    let mut far = 0.0;
    while far < most {
        let here = ink.at(start + way * (far + STEP));
        if here <= 0.0 {
            return Some(far + STEP * last / (last - here));
        }
        (last, far) = (here, far + STEP);
    }
    None
}

/// Means over about as many points before and after as the radius has pixels.
fn averaged(radii: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; radii.len() + 1];
    for (i, radius) in radii.iter().enumerate() {
        sums[i + 1] = sums[i] + radius;
    }
    let mean = |i: usize| {
        let most = (radii[i] as usize).max(3);
        // As many on both sides, so that a taper stays what it is.
        let half = most.min(i).min(radii.len() - 1 - i);
        (sums[i + half + 1] - sums[i - half]) / (2 * half + 1) as f64
    };
    (0..radii.len()).map(mean).collect()
}
