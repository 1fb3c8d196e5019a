//! Building a wide tree: neighbouring boxes are packed into leaves, a binary tree is built over the
//! leaves, and its nodes are combined into nodes of sixteen.

use numerics::memory;
use rayon::prelude::*;

use super::super::bounds::Bounds;
use super::super::{binary_tree, bvh};
use super::cut::{Cheapest, Cut, FourLevels};
use super::{LEAF, LeafItems, MAX_DEPTH, WideNode, WideTree, pack};
use crate::geometry::binary_tree::{BinaryNode, upwards};

impl WideTree {
    /// Builds the tree over `boxes`, and returns for each leaf the numbers of its boxes.
    ///
    /// Boxes must be finite and fewer than 2³⁰, leaves of at most eight.
    pub(in super::super) fn build(boxes: &[Bounds], leaf_size: u32) -> (Self, Vec<LeafItems>) {
        Self::build_parts(boxes, &[0, boxes.len()], leaf_size)
    }

    /// The same, with leaves of boxes of one part each. Part i has the boxes `borders[i]` up to
    /// `borders[i + 1]`.
    pub(in super::super) fn build_parts(
        boxes: &[Bounds],
        borders: &[usize],
        leaf_size: u32,
    ) -> (Self, Vec<LeafItems>) {
        if boxes.is_empty() {
            let tree = Self {
                nodes: Vec::new(),
                bounds: Bounds::EMPTY,
            };
            return (tree, Vec::new());
        }
        let packed: Vec<_> = borders
            .par_windows(2)
            .flat_map_iter(|part| {
                let first = part[0] as u32;
                let leaves = pack::leaves(&boxes[part[0]..part[1]], leaf_size);
                leaves
                    .into_iter()
                    .map(move |leaf| leaf.numbered_from(first))
            })
            .collect();
        let bounds: Vec<_> = packed
            .iter()
            .map(|leaf| leaf.as_slice().iter().map(|&item| boxes[item as usize]))
            .map(|members| members.fold(Bounds::EMPTY, Bounds::union))
            .collect();
        let (tree, order) = Self::over_leaves::<Cheapest>(&bvh::binary_tree(&bounds), &bounds)
            .or_else(|| Self::over_leaves::<FourLevels>(&binary_tree::by_halving(&bounds), &bounds))
            .expect("halving gives at most 30 binary levels, four of which make one level here");
        let leaves = order.into_iter().map(|leaf| packed[leaf as usize]);
        (tree, leaves.collect())
    }

    /// Combines the nodes of a binary tree over the leaves' boxes into wide nodes. Also returns the
    /// leaves in the order of their use by nodes. `None` if the tree is too deep.
    pub(super) fn over_leaves<C: Cut>(
        binary: &[BinaryNode],
        boxes: &[Bounds],
    ) -> Option<(Self, Vec<u32>)> {
        let bounds = bounds_of(binary, boxes);
        let cuts = C::new(binary, &bounds);
        let mut nodes = vec![WideNode::empty()];
        let mut order = Vec::with_capacity(boxes.len());
        // (binary node, wide node, level)
        let mut open = vec![(0_u32, 0_usize, 1_usize)];
        while let Some((root, place, level)) = open.pop() {
            if level > MAX_DEPTH {
                return None;
            }
            for (lane, &child) in cuts.children(binary, root).as_slice().iter().enumerate() {
                let code = if let BinaryNode::Leaf(leaf) = binary[child as usize] {
                    order.push(leaf);
                    LEAF | (order.len() - 1) as u32
                } else {
                    nodes.push(WideNode::empty());
                    open.push((child, nodes.len() - 1, level + 1));
                    (nodes.len() - 1) as u32
                };
                nodes[place].set(lane, &bounds[child as usize], code);
            }
        }
        let mut tree = Self {
            nodes: memory::room_for(nodes.len()),
            bounds: bounds[0],
        };
        tree.nodes.append(&mut nodes);
        Some((tree, order))
    }
}

/// Bounds of every binary node, computed from the true boxes, since a builder may have used others.
fn bounds_of(binary: &[BinaryNode], boxes: &[Bounds]) -> Vec<Bounds> {
    let mut bounds = vec![Bounds::EMPTY; binary.len()];
    for node in upwards(binary) {
        bounds[node as usize] = match binary[node as usize] {
            BinaryNode::Leaf(item) => boxes[item as usize],
            BinaryNode::Inner(children) => {
                let [left, right] = children.map(|child| bounds[child as usize]);
                left.union(right)
            }
        };
    }
    bounds
}
