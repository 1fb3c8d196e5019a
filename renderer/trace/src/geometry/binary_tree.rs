//! The binary tree that a wide one is made from.

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
