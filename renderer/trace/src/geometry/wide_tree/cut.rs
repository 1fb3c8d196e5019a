//! The choice of nodes of a binary tree as children of a wide node.

use super::super::bounds::Bounds;
use crate::geometry::binary_tree::{BinaryNode, upwards};
use crate::simd::{Stack, WIDE};

/// At most sixteen binary nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Children {
    nodes: [u32; WIDE],
    count: usize,
}

impl Children {
    pub(super) fn as_slice(&self) -> &[u32] {
        &self.nodes[..self.count]
    }

    fn push(&mut self, node: u32) {
        self.nodes[self.count] = node;
        self.count += 1;
    }
}

/// A choice of the children of each wide node.
pub(super) trait Cut {
    /// Prepares the choice; `bounds` are those of the binary nodes.
    fn new(binary: &[BinaryNode], bounds: &[Bounds]) -> Self;

    /// The binary nodes that become children of the wide node at binary node `root`.
    fn children(&self, binary: &[BinaryNode], root: u32) -> Children;
}

/// The choice with the least expected number of visited nodes, estimated from their areas.
///
/// Dynamic programming over the least cost of representing a subtree by at most i children.
///
/// # Source
///
/// \[ylitie2017\], section 3.1, with given leaves.
pub(super) struct Cheapest {
    /// For each node and each `i`: how many of `i + 1` children its left side gets; 0 if the node
    /// stays whole. The last entry is for the node as a wide node, which is always opened.
    left: Vec<[u8; WIDE]>,
}

impl Cut for Cheapest {
    fn new(binary: &[BinaryNode], bounds: &[Bounds]) -> Self {
        let mut left = vec![[0; WIDE]; binary.len()];
        // Sum of the areas of wide nodes in a subtree that is represented by at most i + 1
        // children.
        let mut cost = vec![[0.0_f32; WIDE]; binary.len()];
        for node in upwards(binary) {
            let node = node as usize;
            let BinaryNode::Inner([l, r]) = binary[node] else {
                continue;
            };
            let (of_left, of_right) = (cost[l as usize], cost[r as usize]);
            // Where sums of areas overflow, any choice will do.
            let (mut least, mut share) = ([f32::INFINITY; WIDE], [1; WIDE]);
            for most in 1..WIDE {
                for left in 0..most {
                    let sum = of_left[left] + of_right[most - 1 - left];
                    if sum < least[most] {
                        (least[most], share[most]) = (sum, left as u8 + 1);
                    }
                }
            }
            let whole = least[WIDE - 1] + bounds[node].half_area();
            (least[0], share[0]) = (whole, 0);
            for most in 1..WIDE - 1 {
                if whole < least[most] {
                    (least[most], share[most]) = (whole, 0);
                }
            }
            (cost[node], left[node]) = (least, share);
        }
        Self { left }
    }

    fn children(&self, binary: &[BinaryNode], root: u32) -> Children {
        let mut children = Children {
            nodes: [0; WIDE],
            count: 0,
        };
        // (node, children it may take)
        let mut open = Stack::<(u32, usize), WIDE>::new();
        open.push((root, WIDE));
        while let Some((node, most)) = open.pop() {
            let left = usize::from(self.left[node as usize][most - 1]);
            match binary[node as usize] {
                BinaryNode::Inner([l, r]) if left > 0 => {
                    open.push((r, most - left));
                    open.push((l, left));
                }
                BinaryNode::Leaf(_) | BinaryNode::Inner(_) => children.push(node),
            }
        }
        children
    }
}

/// Combines four levels of the binary tree into one, which gives the least depth for any boxes.
pub(super) struct FourLevels;

impl Cut for FourLevels {
    fn new(_: &[BinaryNode], _: &[Bounds]) -> Self {
        Self
    }

    fn children(&self, binary: &[BinaryNode], root: u32) -> Children {
        let mut level = Children {
            nodes: [root; WIDE],
            count: 1,
        };
        for _ in 0..WIDE.ilog2() {
            let mut below = Children { count: 0, ..level };
            for &node in level.as_slice() {
                match binary[node as usize] {
                    BinaryNode::Inner(children) => {
                        for child in children {
                            below.push(child);
                        }
                    }
                    BinaryNode::Leaf(_) => below.push(node),
                }
            }
            level = below;
        }
        level
    }
}
