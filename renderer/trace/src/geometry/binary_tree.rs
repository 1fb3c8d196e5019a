//! The binary tree that a wide one is made from.

use super::bounds::Bounds;

/// A node of the binary tree that a wide tree is made from. The root is node 0.
#[derive(Clone, Copy, Debug)]
pub(super) enum BinaryNode {
    /// One box of the input.
    Leaf(u32),
    /// Two nodes.
    Inner([u32; 2]),
}

/// The nodes of a binary tree, children before their parents.
pub(super) fn upwards(binary: &[BinaryNode]) -> impl Iterator<Item = u32> + use<> {
    let mut order = Vec::with_capacity(binary.len());
    let mut open = vec![0_u32];
    while let Some(node) = open.pop() {
        order.push(node);
        if let BinaryNode::Inner(children) = binary[node as usize] {
            open.extend(children);
        }
    }
    order.into_iter().rev()
}

/// A binary tree over finite boxes, at least one, of depth ⌈log₂ n⌉, by halving: slower to trace than one by
/// clustering, but its depth is bounded. Sets are split at the median
/// centre along the longest side of the box around the centres, ties by number.
pub(super) fn by_halving(boxes: &[Bounds]) -> Vec<BinaryNode> {
    let centers: Vec<_> = boxes.iter().map(|bounds| bounds.center()).collect();
    let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = vec![BinaryNode::Leaf(0)];
    let mut open = vec![(0_usize, 0_usize, items.len())];
    while let Some((node, start, end)) = open.pop() {
        let part = &mut items[start..end];
        if let [item] = part {
            nodes[node] = BinaryNode::Leaf(*item);
            continue;
        }
        let spread = Bounds::around(part.iter().map(|&item| centers[item as usize]));
        let side = spread.max - spread.min;
        let axis = if side.x >= side.y && side.x >= side.z {
            0
        } else if side.y >= side.z {
            1
        } else {
            2
        };
        let middle = part.len() / 2;
        part.select_nth_unstable_by(middle, |&a, &b| {
            let (x, y) = (centers[a as usize][axis], centers[b as usize][axis]);
            x.total_cmp(&y).then(a.cmp(&b))
        });
        let first = nodes.len();
        nodes.extend([BinaryNode::Leaf(0); 2]);
        nodes[node] = BinaryNode::Inner([first as u32, first as u32 + 1]);
        open.push((first, start, start + middle));
        open.push((first + 1, start + middle, end));
    }
    nodes
}
