//! Packing boxes into few, well-filled, small leaves.

use rayon::prelude::*;

use super::super::bounds::Bounds;
use super::super::hilbert;
use super::LeafItems;
use crate::simd::LANES;

/// Cost of a leaf besides its area, in areas of a mean box, for its memory and the tree above it.
///
/// Measured on blades of 5,000 and 500,000 triangles: values from 0.5 to 4 trace equally fast;
/// greater ones fill leaves better.
const COST_OF_A_LEAF: f64 = 2.0;

/// Number of boxes along the curve that one thread packs at a time.
const STRETCH: usize = 1 << 14;

/// Numbers of the boxes of each leaf, at most `leaf_size` (1 to 8) of them.
///
/// The boxes are sorted along a space-filling curve. The curve is cut into leaves so that the sum
/// of their areas, plus a constant for each leaf, is least.
pub(super) fn leaves(boxes: &[Bounds], leaf_size: u32) -> Vec<LeafItems> {
    if boxes.is_empty() {
        return Vec::new();
    }
    if leaf_size == 1 {
        return (0..boxes.len() as u32).map(|item| leaf(&[item])).collect();
    }
    let order = hilbert::order(boxes);
    let areas: f64 = boxes
        .iter()
        .map(|bounds| f64::from(bounds.half_area()))
        .sum();
    let cost_of_a_leaf = COST_OF_A_LEAF * areas / boxes.len() as f64;
    order
        .par_chunks(STRETCH)
        .flat_map_iter(|stretch| cut(stretch, boxes, leaf_size as usize, cost_of_a_leaf))
        .collect()
}

/// Cuts a stretch of the curve into leaves of the least cost.
fn cut(stretch: &[u32], boxes: &[Bounds], leaf_size: usize, cost_of_a_leaf: f64) -> Vec<LeafItems> {
    // Least cost of the first i boxes, and the size of the last leaf in that case.
    let mut least = vec![(0.0, 0); stretch.len() + 1];
    for end in 1..=stretch.len() {
        let mut best = (f64::INFINITY, 0);
        let mut bounds = Bounds::EMPTY;
        for size in 1..=leaf_size.min(end) {
            bounds = bounds.union(boxes[stretch[end - size] as usize]);
            let cost = least[end - size].0 + f64::from(bounds.half_area()) + cost_of_a_leaf;
            if cost < best.0 {
                best = (cost, size);
            }
        }
        // If areas overflow, leaves are filled.
        least[end] = if best.1 == 0 {
            (least[end - 1].0, leaf_size.min(end))
        } else {
            best
        };
    }
    let mut leaves = Vec::new();
    let mut end = stretch.len();
    while end > 0 {
        let start = end - least[end].1;
        leaves.push(leaf(&stretch[start..end]));
        end = start;
    }
    leaves.reverse();
    leaves
}

/// A leaf of at most eight boxes.
fn leaf(members: &[u32]) -> LeafItems {
    let mut items = [0; LANES];
    items[..members.len()].copy_from_slice(members);
    items[..members.len()].sort_unstable();
    LeafItems {
        items,
        count: members.len() as u32,
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn an_even_blade_fills_its_leaves_and_keeps_them_compact() {
        // 128 × 128 cells, two triangles each; a square of four cells, eight triangles, is the best
        // leaf.
        let boxes: Vec<_> = (0..128 * 128 * 2)
            .map(|triangle| {
                let (cell, side) = (triangle / 2, 0.01);
                let at = Vec3::new((cell % 128) as f32, (cell / 128) as f32, 0.0) * side;
                Bounds::around([at, at + Vec3::new(side, side, 0.0)])
            })
            .collect();
        let leaves = leaves(&boxes, 8);
        let filled = boxes.len() as f64 / leaves.len() as f64;
        assert!(filled > 7.5, "{filled} triangles a leaf");
        let area: f64 = leaves
            .iter()
            .map(|leaf| leaf.as_slice().iter().map(|&item| boxes[item as usize]))
            .map(|members| members.fold(Bounds::EMPTY, Bounds::union).half_area())
            .map(f64::from)
            .sum();
        let blade = 1.28 * 1.28;
        assert!(
            area < 1.05 * blade,
            "leaves cover {area}, the blade {blade}"
        );
    }

    #[test]
    fn every_box_is_in_one_leaf_also_where_areas_overflow() {
        let huge = |i: u32| {
            let at = Vec3::splat(i as f32 * 1e30);
            Bounds::around([-at, at])
        };
        let boxes: Vec<_> = (0..100).map(huge).collect();
        let mut seen: Vec<_> = leaves(&boxes, 8)
            .iter()
            .flat_map(|leaf| leaf.as_slice().to_vec())
            .collect();
        seen.sort_unstable();
        assert_eq!(seen, (0..100).collect::<Vec<_>>());
    }
}
