//! Counts of stripes along circles around an upright body.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::mosaic::surface::{Surface, SurfacePoint};

/// Share of the circles that must show the same count in a structured pattern.
const STRUCTURED_SHARE: f64 = 0.75;

/// The paper's taxonomy of visual patterns.
///
/// Structured patterns have elements that can be counted, the same number in every individual;
/// unstructured ones vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PatternClass {
    /// Most circles, at all heights and in all individuals, cross this many elements.
    Structured {
        /// How many.
        count: u32,
    },
    /// Counts differ from circle to circle.
    Unstructured,
}

impl PatternClass {
    /// Classifies a pattern by the numbers of elements along circles at several heights of several
    /// individuals.
    ///
    /// Structured if three quarters of the circles have the same count, and that is above 0. Ties
    /// go to the smaller count.
    pub(crate) fn of_counts(counts: &[u32]) -> Self {
        let mut sorted = counts.to_vec();
        sorted.sort_unstable();
        let mut best = (0, 0);
        for run in sorted.chunk_by(|a, b| a == b) {
            if run.len() > best.1 {
                best = (run[0], run.len());
            }
        }
        let (count, times) = best;
        if count > 0 && times as f64 >= STRUCTURED_SHARE * counts.len() as f64 {
            Self::Structured { count }
        } else {
            Self::Unstructured
        }
    }
}

/// Points of a surface around the z axis at a height (mm), at `count` equal angles from the x axis
/// on.
///
/// If a ray from the axis meets the surface several times, the outermost point is used; angles at
/// which it does not meet the surface are left out.
pub(crate) fn ring(surface: &Surface, height_mm: f64, count: u32) -> Vec<SurfacePoint> {
    // Where the plane at that height cuts faces, with the weights of both ends.
    let mut cuts: Vec<(u32, [[f64; 3]; 2], [DVec2; 2])> = Vec::new();
    for (ids, face) in surface.faces().iter().zip(0..) {
        let corners = ids.map(|id| surface.positions()[id as usize]);
        let mut ends = Vec::with_capacity(2);
        for edge in 0..3 {
            let (a, b) = (edge, (edge + 1) % 3);
            let (above, below) = (corners[a].z - height_mm, corners[b].z - height_mm);
            // A corner at the height itself counts as above.
            if (above >= 0.0) != (below >= 0.0) {
                let share = above / (above - below);
                let mut weights = [0.0; 3];
                weights[a] = 1.0 - share;
                weights[b] = share;
                ends.push((weights, corners[a].lerp(corners[b], share).truncate()));
            }
        }
        if let [(from, p), (to, q)] = ends[..] {
            cuts.push((face, [from, to], [p, q]));
        }
    }
    (0..count)
        .filter_map(|step| {
            let angle = TAU * f64::from(step) / f64::from(count);
            let ray = DVec2::new(libm::cos(angle), libm::sin(angle));
            let hits = cuts.iter().filter_map(|(face, weights, [p, q])| {
                let along = *q - *p;
                let share = -ray.perp_dot(*p) / ray.perp_dot(along);
                let away = ray.dot(*p + along * share);
                ((0.0..=1.0).contains(&share) && away > 0.0).then_some((away, face, weights, share))
            });
            let (_, face, weights, share) = hits.max_by(|a, b| a.0.total_cmp(&b.0))?;
            let [from, to] = weights;
            let barycentric = [0, 1, 2].map(|k| from[k] * (1.0 - share) + to[k] * share);
            Some(SurfacePoint {
                face: *face,
                barycentric,
            })
        })
        .collect()
}

/// Number of runs of `label` along a closed ring of labels, after runs shorter than `shortest`
/// points, of any label, have been merged into their surroundings.
pub(crate) fn element_count(labels: &[u32], label: u32, shortest: usize) -> u32 {
    let mut marked: Vec<bool> = labels.iter().map(|&l| l == label).collect();
    // Gaps are closed before specks are dropped, each from short to long, so that frayed edges
    // remain part of their stripe.
    for length in 1..shortest {
        for value in [false, true] {
            let runs = runs(&marked);
            if runs.len() < 2 {
                break;
            }
            for (start, run, of) in runs {
                if of == value && run <= length {
                    for k in 0..run {
                        marked[(start + k) % labels.len()] = !value;
                    }
                }
            }
        }
    }
    let runs = runs(&marked);
    runs.iter().filter(|(_, _, of)| *of).count() as u32
}

/// Runs of equal values along a closed ring: start, length, value.
fn runs(marked: &[bool]) -> Vec<(usize, usize, bool)> {
    let count = marked.len();
    let Some(first) = (0..count).find(|&i| marked[i] != marked[(i + count - 1) % count]) else {
        return marked
            .first()
            .map_or(Vec::new(), |&of| vec![(0, count, of)]);
    };
    let mut runs: Vec<(usize, usize, bool)> = Vec::new();
    for k in 0..count {
        let i = (first + k) % count;
        match runs.last_mut() {
            Some((_, length, of)) if *of == marked[i] => *length += 1,
            Some(_) | None => runs.push((i, 1, marked[i])),
        }
    }
    runs
}
