//! Measures of patterns on cells, on which the claims about clonal mosaics rest.
//!
//! All use a [`Voronoi`] tessellation and a label for each cell (its type or its clone), so that
//! patterns of any origin, noise for example, are measured in the same way.
//!
//! - **In**: the tessellation, labels.
//! - **Out**: shares, patches, widths, neighbourhoods against a null model, agreement of two
//!   patterns, stripe counts.
//! - **Left out**: significance beyond the mean and standard deviation of the null model.

mod rings;
#[cfg(test)]
mod tests;

pub(crate) use self::rings::{PatternClass, element_count, ring};
use crate::mosaic::surface::{Surface, SurfacePoint};
use crate::mosaic::voronoi::Voronoi;
use crate::random::bits_of;
use properties::uniform;

/// Separates the random numbers of the null model from others.
const SHUFFLE: u64 = 16;

/// A connected part of the surface whose cells have one label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LabelPatch {
    /// The label.
    pub(crate) label: u32,
    /// Its area, mm².
    pub(crate) area_mm2: f64,
    /// Number of its cells.
    pub(crate) cells: usize,
}

/// Similarity of neighbours, compared with chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Neighbourhood {
    /// Share of pairs of neighbouring cells that have the same label.
    pub(crate) alike: f64,
    /// Mean of that share when labels are shuffled among cells.
    pub(crate) by_chance: f64,
    /// Its standard deviation over the shuffles.
    pub(crate) deviation: f64,
}

/// Share of the tessellated area that each label below `labels` takes; sums to 1.
pub(crate) fn area_shares(voronoi: &Voronoi, labels_of: &[u32], labels: usize) -> Vec<f64> {
    let mut shares = vec![0.0; labels];
    for (&label, area) in labels_of.iter().zip(voronoi.areas()) {
        shares[label as usize] += area;
    }
    let total: f64 = voronoi.areas().iter().sum();
    shares.iter().map(|area| area / total).collect()
}

/// The patches of all labels: cells joined over common borders; in the order of their first cells.
pub(crate) fn patches(voronoi: &Voronoi, labels_of: &[u32]) -> Vec<LabelPatch> {
    let mut seen = vec![false; labels_of.len()];
    let mut patches = Vec::new();
    for first in 0..labels_of.len() {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let mut walk = vec![first];
        let mut patch = LabelPatch {
            label: labels_of[first],
            area_mm2: 0.0,
            cells: 0,
        };
        while let Some(cell) = walk.pop() {
            patch.area_mm2 += voronoi.areas()[cell];
            patch.cells += 1;
            for &(beside, _) in voronoi.neighbours(cell as u32) {
                let beside = beside as usize;
                if !seen[beside] && labels_of[beside] == patch.label {
                    seen[beside] = true;
                    walk.push(beside);
                }
            }
        }
        patches.push(patch);
    }
    patches
}

/// Length of the border between cells of `label` and all others, mm.
pub(crate) fn border_length(voronoi: &Voronoi, labels_of: &[u32], label: u32) -> f64 {
    let of_label = (0..labels_of.len()).filter(|&cell| labels_of[cell] == label);
    of_label
        .flat_map(|cell| voronoi.neighbours(cell as u32))
        .filter(|(beside, _)| labels_of[*beside as usize] != label)
        .map(|(_, length)| length)
        .sum()
}

/// Mean width of the stripes or blotches of a label, mm: area over half of the border. Infinite
/// without a border.
///
/// For a stripe much longer than wide that is its width, for a disc of radius r it is r.
pub(crate) fn mean_width_mm(voronoi: &Voronoi, labels_of: &[u32], label: u32) -> f64 {
    let area: f64 = labels_of
        .iter()
        .zip(voronoi.areas())
        .filter(|(of, _)| **of == label)
        .map(|(_, area)| area)
        .sum();
    2.0 * area / border_length(voronoi, labels_of, label)
}

/// Share of pairs of neighbours with the same label, compared with `shuffles` random permutations
/// of the labels.
pub(crate) fn neighbourhood(
    voronoi: &Voronoi,
    labels_of: &[u32],
    shuffles: u32,
    seed: u64,
) -> Neighbourhood {
    let alike = alike_share(voronoi, labels_of);
    let by_chance: Vec<f64> = (0..u64::from(shuffles))
        .map(|round| {
            let mut shuffled = labels_of.to_vec();
            let key = bits_of(seed, SHUFFLE, round);
            for last in (1..shuffled.len()).rev() {
                let draw = uniform(key, SHUFFLE, last as u64);
                shuffled.swap(last, (draw * (last + 1) as f64) as usize);
            }
            alike_share(voronoi, &shuffled)
        })
        .collect();
    let count = by_chance.len().max(1) as f64;
    let mean = by_chance.iter().sum::<f64>() / count;
    let variance = by_chance
        .iter()
        .map(|x| (x - mean) * (x - mean))
        .sum::<f64>()
        / count;
    Neighbourhood {
        alike,
        by_chance: mean,
        deviation: variance.sqrt(),
    }
}

fn alike_share(voronoi: &Voronoi, labels_of: &[u32]) -> f64 {
    let (mut alike, mut pairs) = (0_u64, 0_u64);
    for (cell, label) in labels_of.iter().enumerate() {
        for &(beside, _) in voronoi.neighbours(cell as u32) {
            pairs += 1;
            alike += u64::from(labels_of[beside as usize] == *label);
        }
    }
    alike as f64 / pairs.max(1) as f64
}

/// Share of the cells that have a neighbour of the same label, among cells whose label is not
/// unique.
///
/// With clones as labels it measures how contiguous clones are. 1 if there is no such cell.
pub(crate) fn contiguity(voronoi: &Voronoi, labels_of: &[u32]) -> f64 {
    let most = labels_of.iter().max().map_or(0, |&label| label as usize);
    let mut members = vec![0_u32; most + 1];
    for &label in labels_of {
        members[label as usize] += 1;
    }
    let (mut joined, mut all) = (0_u64, 0_u64);
    for (cell, &label) in labels_of.iter().enumerate() {
        if members[label as usize] < 2 {
            continue;
        }
        all += 1;
        let neighbours = voronoi.neighbours(cell as u32);
        let with_own = neighbours
            .iter()
            .any(|(beside, _)| labels_of[*beside as usize] == label);
        joined += u64::from(with_own);
    }
    if all == 0 {
        1.0
    } else {
        joined as f64 / all as f64
    }
}

/// The labels of the cells nearest to points; 0 where there is no cell.
pub(crate) fn labels_at(
    surface: &Surface,
    voronoi: &Voronoi,
    labels_of: &[u32],
    points: &[SurfacePoint],
) -> Vec<u32> {
    points
        .iter()
        .map(|point| {
            let cell = voronoi.nearest(point.face, surface.flat(point));
            cell.map_or(0, |cell| labels_of[cell as usize])
        })
        .collect()
}

/// Cohen's kappa of two patterns sampled at the same points: 1 if they are equal, 0 if they agree
/// as often as independent patterns of these shares.
///
/// `κ = (p_o − p_e) / (1 − p_e)` \[cohen1960\], eq. 1. 1 if both consist of one and the same label.
///
/// # Panics
///
/// If the patterns have different numbers of points.
pub(crate) fn kappa(first: &[u32], second: &[u32]) -> f64 {
    assert_eq!(
        first.len(),
        second.len(),
        "both patterns at the same points"
    );
    let most = first
        .iter()
        .chain(second)
        .max()
        .map_or(0, |&label| label as usize);
    let mut shares = vec![[0.0; 2]; most + 1];
    let each = 1.0 / first.len().max(1) as f64;
    let mut observed = 0.0;
    for (&a, &b) in first.iter().zip(second) {
        shares[a as usize][0] += each;
        shares[b as usize][1] += each;
        if a == b {
            observed += each;
        }
    }
    let expected: f64 = shares.iter().map(|[a, b]| a * b).sum();
    if expected >= 1.0 - 1e-12 {
        1.0
    } else {
        (observed - expected) / (1.0 - expected)
    }
}

/// Share of the points with `label` in the older pattern that still have it in the newer. 1 if
/// there is none.
pub(crate) fn contained(older: &[u32], newer: &[u32], label: u32) -> f64 {
    let (mut kept, mut all) = (0_u64, 0_u64);
    for (&old, &new) in older.iter().zip(newer) {
        if old == label {
            all += 1;
            kept += u64::from(new == label);
        }
    }
    if all == 0 {
        1.0
    } else {
        kept as f64 / all as f64
    }
}
