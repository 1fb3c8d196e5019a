//! A tree of boxes with eight children a node, and the walk of a ray through it.

use super::bounds::Bounds;
use super::bvh;
use super::median;
use super::slab::{BoxPlanes, SlabRay};
use crate::simd::{Eight, LANES, Row, Stack};

/// Levels of nodes that a tree may have; deeper ones are built anew by halving.
const MAX_DEPTH: usize = 18;

/// A node leaves at most seven children on the stack while the walk goes into the eighth.
const STACK: usize = MAX_DEPTH * (LANES - 1) + 1;

/// Marks a child that is a leaf; the rest of the number says which.
const LEAF: u32 = 1 << 31;

/// Eight children: their boxes, and what they are. Places without a child have an empty box, which no ray meets.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct WideNode {
    planes: BoxPlanes,
    children: [u32; LANES],
}

impl WideNode {
    fn empty() -> Self {
        let (low, high) = (Row([f32::INFINITY; LANES]), Row([f32::NEG_INFINITY; LANES]));
        Self {
            planes: [low, low, low, high, high, high],
            children: [LEAF; LANES],
        }
    }

    fn set(&mut self, lane: usize, bounds: &Bounds, child: u32) {
        for axis in 0..3 {
            self.planes[axis].0[lane] = bounds.min[axis];
            self.planes[axis + 3].0[lane] = bounds.max[axis];
        }
        self.children[lane] = child;
    }
}

/// What is done at the leaves of a tree.
pub(super) trait Visitor {
    /// Asks for the memory of a leaf that is likely to be visited soon.
    fn fetch(&self, leaf: u32);

    /// Visits a leaf whose box the ray enters at `enter`; gives the new limit, −∞ to end the walk.
    fn visit(&mut self, leaf: u32, enter: f32, limit: f32) -> f32;
}

/// A tree over boxes, up to `leaf_size` of them in a leaf.
#[derive(Clone, Debug)]
pub(super) struct WideTree {
    nodes: Vec<WideNode>,
    bounds: Bounds,
}

/// The boxes of one leaf, in rising order.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeafItems {
    items: [u32; LANES],
    count: u32,
}

impl LeafItems {
    /// Their numbers.
    pub(super) fn as_slice(&self) -> &[u32] {
        &self.items[..self.count as usize]
    }
}

/// A node of the binary tree that a [`WideTree`] is made from. The root is node 0.
#[derive(Clone, Copy, Debug)]
pub(super) enum BinaryNode {
    /// One box of the input.
    Leaf(u32),
    /// Two nodes.
    Inner([u32; 2]),
}

/// What the collapse has to know of a binary node.
#[derive(Clone, Copy, Debug)]
struct Summary {
    bounds: Bounds,
    count: u32,
}

impl WideTree {
    /// Builds the tree over `boxes`, and gives for each leaf the numbers of its boxes.
    ///
    /// Boxes must be finite and fewer than 2³⁰, leaves of at most eight.
    pub(super) fn build(boxes: &[Bounds], leaf_size: u32) -> (Self, Vec<LeafItems>) {
        if boxes.is_empty() {
            let tree = Self {
                nodes: Vec::new(),
                bounds: Bounds::EMPTY,
            };
            return (tree, Vec::new());
        }
        Self::collapse(&bvh::binary_tree(boxes), boxes, leaf_size)
            .or_else(|| Self::collapse(&median::binary_tree(boxes), boxes, leaf_size))
            .expect("halving gives at most 30 binary levels, three of which make one level here")
    }

    /// Opens the widest binary nodes first until eight children are there; `None` if the tree gets too deep.
    fn collapse(
        binary: &[BinaryNode],
        boxes: &[Bounds],
        leaf_size: u32,
    ) -> Option<(Self, Vec<LeafItems>)> {
        let summaries = summarise(binary, boxes);
        let is_leaf = |node: u32| summaries[node as usize].count <= leaf_size;
        let mut nodes = vec![WideNode::empty()];
        let mut leaves = Vec::new();
        // (binary node, wide node, level)
        let mut open = vec![(0_u32, 0_usize, 1_usize)];
        while let Some((root, place, level)) = open.pop() {
            if level > MAX_DEPTH {
                return None;
            }
            let (mut children, mut areas) = ([root; LANES], [0.0; LANES]);
            // A leaf is never opened.
            let area = |node: u32| {
                if is_leaf(node) {
                    f32::NEG_INFINITY
                } else {
                    summaries[node as usize].bounds.half_area()
                }
            };
            areas[0] = area(root);
            let mut count = 1;
            while count < LANES {
                let mut widest = 0;
                for i in 1..count {
                    if areas[i] > areas[widest] {
                        widest = i;
                    }
                }
                let BinaryNode::Inner([left, right]) = binary[children[widest] as usize] else {
                    break;
                };
                if areas[widest] == f32::NEG_INFINITY {
                    break;
                }
                children.copy_within(widest + 1..count, widest + 2);
                areas.copy_within(widest + 1..count, widest + 2);
                (children[widest], children[widest + 1]) = (left, right);
                (areas[widest], areas[widest + 1]) = (area(left), area(right));
                count += 1;
            }
            for (lane, &child) in children[..count].iter().enumerate() {
                let code = if is_leaf(child) {
                    leaves.push(members(binary, child));
                    LEAF | (leaves.len() - 1) as u32
                } else {
                    nodes.push(WideNode::empty());
                    open.push((child, nodes.len() - 1, level + 1));
                    (nodes.len() - 1) as u32
                };
                nodes[place].set(lane, &summaries[child as usize].bounds, code);
            }
        }
        let bounds = summaries[0].bounds;
        Some((Self { nodes, bounds }, leaves))
    }

    /// The box around everything.
    pub(super) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<WideNode>()
    }

    /// Lets `visitor` visit the leaves whose boxes the ray enters no later than `limit`.
    ///
    /// With `NEAREST_FIRST` leaves come in the order of their boxes where that is known. Which leaves are visited
    /// beyond those within the final limit depends on that order, so nothing but the limit may depend on it.
    #[inline(always)]
    pub(super) fn walk<const NEAREST_FIRST: bool, E: Eight>(
        &self,
        e: E,
        ray: &SlabRay,
        mut limit: f32,
        visitor: &mut impl Visitor,
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let mut stack = Stack::<(f32, u32), STACK>::new();
        let (mut enter, mut child) = (0.0_f32, 0_u32);
        loop {
            if child & LEAF == 0 {
                let node = &self.nodes[child as usize];
                let (enters, mut met) = ray.eight(e, &node.planes, limit);
                if met != 0 {
                    let enters = e.store(enters);
                    let base = stack.height();
                    loop {
                        let lane = met.trailing_zeros() as usize % LANES;
                        met &= met - 1;
                        (enter, child) = (enters.0[lane], node.children[lane]);
                        if met == 0 && stack.height() == base {
                            break;
                        }
                        if child & LEAF == 0 {
                            e.prefetch(&self.nodes, child as usize);
                        } else {
                            visitor.fetch(child & !LEAF);
                        }
                        if NEAREST_FIRST {
                            stack.push_in_order(base, (enter, child));
                        } else {
                            stack.push((enter, child));
                        }
                        if met == 0 {
                            if let Some(next) = stack.pop() {
                                (enter, child) = next;
                            }
                            break;
                        }
                    }
                    continue;
                }
            } else {
                limit = visitor.visit(child & !LEAF, enter, limit);
                if limit == f32::NEG_INFINITY {
                    return;
                }
            }
            loop {
                let Some(next) = stack.pop() else { return };
                (enter, child) = next;
                if enter <= limit {
                    break;
                }
            }
        }
    }
}

/// Bounds and size of every binary node, from the boxes themselves: a builder may have worked with others.
fn summarise(binary: &[BinaryNode], boxes: &[Bounds]) -> Vec<Summary> {
    let nothing = Summary {
        bounds: Bounds::EMPTY,
        count: 0,
    };
    let mut summaries = vec![nothing; binary.len()];
    let mut order = Vec::with_capacity(binary.len());
    let mut open = vec![0_u32];
    while let Some(node) = open.pop() {
        order.push(node);
        if let BinaryNode::Inner(children) = binary[node as usize] {
            open.extend(children);
        }
    }
    for &node in order.iter().rev() {
        summaries[node as usize] = match binary[node as usize] {
            BinaryNode::Leaf(item) => Summary {
                bounds: boxes[item as usize],
                count: 1,
            },
            BinaryNode::Inner(children) => {
                let [left, right] = children.map(|child| summaries[child as usize]);
                Summary {
                    bounds: left.bounds.union(right.bounds),
                    count: left.count + right.count,
                }
            }
        };
    }
    summaries
}

/// The boxes below a binary node, at most eight, in rising order.
fn members(binary: &[BinaryNode], root: u32) -> LeafItems {
    let mut leaf = LeafItems {
        items: [0; LANES],
        count: 0,
    };
    // Of nodes with at most eight leaves below them no more than eight are open at a time.
    let mut open = Stack::<u32, LANES>::new();
    open.push(root);
    while let Some(node) = open.pop() {
        match binary[node as usize] {
            BinaryNode::Leaf(item) => {
                leaf.items[leaf.count as usize] = item;
                leaf.count += 1;
            }
            BinaryNode::Inner([left, right]) => {
                open.push(left);
                open.push(right);
            }
        }
    }
    leaf.items[..leaf.count as usize].sort_unstable();
    leaf
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::testing::Numbers;
    use super::*;

    fn boxes(count: usize) -> Vec<Bounds> {
        let mut numbers = Numbers::new(count as u64);
        (0..count)
            .map(|_| {
                let at = numbers.cube();
                Bounds::around([at, at + numbers.cube() * 0.1])
            })
            .collect()
    }

    /// Visits every node and checks that it lies in the box that its parent has for it; gives the levels.
    fn check(tree: &WideTree, leaves: &[LeafItems], boxes: &[Bounds]) -> usize {
        let mut open = vec![(0_u32, tree.bounds, 1)];
        let mut levels = 0;
        let mut seen = vec![0; boxes.len()];
        while let Some((node, bounds, level)) = open.pop() {
            levels = levels.max(level);
            let node = &tree.nodes[node as usize];
            for lane in 0..LANES {
                let corner = |first: usize| {
                    Vec3::from_array([0, 1, 2].map(|axis| node.planes[first + axis].0[lane]))
                };
                let child = Bounds {
                    min: corner(0),
                    max: corner(3),
                };
                if child.is_empty() {
                    continue;
                }
                assert_eq!(
                    bounds.union(child),
                    bounds,
                    "a child reaches out of its parent"
                );
                let code = node.children[lane];
                if code & LEAF == 0 {
                    open.push((code, child, level + 1));
                    continue;
                }
                let members = leaves[(code & !LEAF) as usize].as_slice();
                let around = members
                    .iter()
                    .fold(Bounds::EMPTY, |all, &item| all.union(boxes[item as usize]));
                assert_eq!(around, child, "a leaf's box is not that of its members");
                for &item in members {
                    seen[item as usize] += 1;
                }
            }
        }
        assert!(
            seen.iter().all(|&times| times == 1),
            "not every box is in one leaf"
        );
        levels
    }

    #[test]
    fn every_box_is_in_one_leaf_and_every_node_in_its_parent() {
        for (count, leaf_size) in [
            (1, 8),
            (2, 1),
            (8, 8),
            (9, 8),
            (100, 1),
            (5000, 8),
            (5000, 1),
        ] {
            let boxes = boxes(count);
            let (tree, leaves) = WideTree::build(&boxes, leaf_size);
            assert!(leaves.iter().all(|leaf| leaf.count <= leaf_size));
            check(&tree, &leaves, &boxes);
        }
    }

    #[test]
    fn a_tree_too_deep_for_the_stack_is_not_taken_and_halving_is_shallow() {
        let boxes = boxes(5000);
        // A binary tree that is one long chain.
        let mut chain = Vec::new();
        for item in 0..4999_u32 {
            chain.push(BinaryNode::Inner([2 * item + 1, 2 * item + 2]));
            chain.push(BinaryNode::Leaf(item));
        }
        chain.push(BinaryNode::Leaf(4999));
        assert!(WideTree::collapse(&chain, &boxes, 8).is_none());
        let (tree, leaves) = WideTree::collapse(&median::binary_tree(&boxes), &boxes, 8)
            .expect("halves are shallow");
        assert!(
            check(&tree, &leaves, &boxes) <= 5,
            "5000 boxes, 8 a leaf, 8 a node"
        );
    }

    #[test]
    fn builds_are_the_same_every_time() {
        let boxes = boxes(3000);
        let ((one, _), (other, _)) = (WideTree::build(&boxes, 8), WideTree::build(&boxes, 8));
        assert_eq!(format!("{one:?}"), format!("{other:?}"));
    }
}
