//! Binary trees built by the crate obvhs, with a workaround for equal boxes.

use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use super::binary_tree::BinaryNode;
use super::bounds::Bounds;
use crate::sampling::mixer::scramble;

/// Share of the nodes that are reinserted at another place after clustering.
const REINSERTION: f32 = 0.02;

/// Greatest widening of the boxes given to the builder, as a share of their longest side.
const JITTER: f32 = 1.0 / 64.0;

/// A box as given to the builder.
#[derive(Clone, Copy)]
struct Jittered(Aabb);

impl Boundable for Jittered {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// A binary tree over finite boxes, at least one: locally ordered clustering and a little
/// reinsertion.
///
/// Clustering merges neighbours that choose each other. Among equal boxes, as on an evenly spaced
/// blade or a fan around one point, all choose the same side. Then only one pair is merged per
/// pass, and the time is quadratic. So the builder gets boxes widened by small amounts that differ
/// from box to box. This affects only the structure of the tree; its bounds come from the true
/// boxes.
pub(super) fn binary_tree(boxes: &[Bounds]) -> Vec<BinaryNode> {
    let jittered: Vec<_> = boxes
        .iter()
        .zip(0_u64..)
        .map(|(bounds, number)| {
            let bits = scramble(number);
            let unit = |shift: u32| ((bits >> shift) & 0xffff) as f32 / 65536.0;
            let side = (bounds.max - bounds.min).max_element() * JITTER;
            Jittered(Aabb::new(
                (bounds.min - side * unit(0)).into(),
                (bounds.max + side * unit(16)).into(),
            ))
        })
        .collect();
    let mut tree = PlocBuilder::with_capacity(jittered.len()).build(
        PlocSearchDistance::Low,
        &jittered,
        (0..jittered.len() as u32).collect(),
        SortPrecision::U64,
        0,
    );
    ReinsertionOptimizer::default().run(&mut tree, REINSERTION, None);
    tree.nodes
        .iter()
        .map(|node| {
            if node.is_leaf() {
                BinaryNode::Leaf(tree.primitive_indices[node.first_index as usize])
            } else {
                BinaryNode::Inner([node.first_index, node.first_index + 1])
            }
        })
        .collect()
}
