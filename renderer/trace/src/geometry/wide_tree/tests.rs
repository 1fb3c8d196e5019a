use crate::geometry::binary_tree::BinaryNode;

use super::super::testing::Numbers;
use super::super::{binary_tree, bvh};
use super::cut::{Cheapest, FourLevels};
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

/// Visits every node and checks that it lies in the box that its parent has for it; gives the
/// levels.
fn check(tree: &WideTree, leaves: &[LeafItems], boxes: &[Bounds]) -> usize {
    let mut open = vec![(0_u32, tree.bounds, 1)];
    let mut levels = 0;
    let mut seen = vec![0; boxes.len()];
    while let Some((node, bounds, level)) = open.pop() {
        levels = levels.max(level);
        let node = &tree.nodes[node as usize];
        for lane in 0..WIDE {
            let child = node.bounds_of(lane);
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
    assert!(WideTree::over_leaves::<Cheapest>(&chain, &boxes).is_none());
    let binary = binary_tree::by_halving(&boxes);
    let (tree, order) =
        WideTree::over_leaves::<FourLevels>(&binary, &boxes).expect("halves are shallow");
    assert!(
        check(&tree, &alone(order), &boxes) <= 4,
        "5000 boxes, one a leaf, 16 a node"
    );
}

/// Leaves of one box each.
fn alone(order: Vec<u32>) -> Vec<LeafItems> {
    let leaf = |item| LeafItems {
        items: [item; LANES],
        count: 1,
    };
    order.into_iter().map(leaf).collect()
}

#[test]
fn the_cheapest_cut_has_less_area_and_fewer_nodes_than_one_of_four_levels() {
    let boxes = boxes(5000);
    let binary = bvh::binary_tree(&boxes);
    let area = |tree: &WideTree| -> f32 {
        let inner = |node: &WideNode| {
            let present = node.present().filter(|(_, code)| code & LEAF == 0);
            present.map(|(bounds, _)| bounds.half_area()).sum::<f32>()
        };
        tree.nodes.iter().map(inner).sum()
    };
    let (cheapest, order) = WideTree::over_leaves::<Cheapest>(&binary, &boxes).expect("shallow");
    check(&cheapest, &alone(order), &boxes);
    let (even, _) = WideTree::over_leaves::<FourLevels>(&binary, &boxes).expect("shallow");
    let ratio = area(&cheapest) / area(&even);
    assert!(ratio < 0.96, "area {ratio} of that of four levels a node");
    let ratio = cheapest.nodes.len() as f64 / even.nodes.len() as f64;
    assert!(ratio < 0.9, "{ratio} of the nodes");
}

#[test]
fn a_hull_holds_every_box_with_no_more_boxes_than_asked_for() {
    let boxes = boxes(3000);
    let (tree, _) = WideTree::build(&boxes, 8);
    for most in [1, 8, 100, 100_000] {
        let hull = tree.hull(most);
        assert!(
            !hull.is_empty() && hull.len() <= most,
            "{} boxes",
            hull.len()
        );
        let held = |item: &Bounds| hull.iter().any(|bounds| bounds.union(*item) == *bounds);
        assert!(boxes.iter().all(held), "a box reaches out of all of {most}");
    }
    let (nothing, _) = WideTree::build(&[], 8);
    assert!(nothing.hull(8).iter().all(|bounds| bounds.is_empty()));
}

#[test]
fn builds_are_the_same_every_time() {
    let boxes = boxes(3000);
    let ((one, _), (other, _)) = (WideTree::build(&boxes, 8), WideTree::build(&boxes, 8));
    assert_eq!(format!("{one:?}"), format!("{other:?}"));
}
