//! A tree of boxes with sixteen children per node, and its traversal by a ray.

use glam::Vec3;

use super::bounds::Bounds;
use super::slab::{BoxPlanes, SlabRay};
use crate::simd::{self, LANES, Sixteen, Stack, WIDE, WideRow};

mod build;
mod cut;
mod pack;

/// Greatest number of levels of nodes; deeper trees are rebuilt by halving.
const MAX_DEPTH: usize = 18;

/// A node leaves all its children but one on the stack while the walk goes into that one.
const STACK: usize = MAX_DEPTH * (WIDE - 1) + 1;

/// Marks a child that is a leaf; the rest of the number says which.
const LEAF: u32 = 1 << 31;

/// Sixteen children: their boxes and codes. Places without a child have an empty box, which no
/// ray hits.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct WideNode {
    planes: BoxPlanes,
    children: [u32; WIDE],
}

impl WideNode {
    fn empty() -> Self {
        let sides = [f32::INFINITY, f32::NEG_INFINITY];
        Self {
            planes: [sides.map(WideRow::splat); 3],
            children: [LEAF; WIDE],
        }
    }

    fn set(&mut self, lane: usize, bounds: &Bounds, child: u32) {
        for axis in 0..3 {
            self.planes[axis][0].set(lane, bounds.min[axis]);
            self.planes[axis][1].set(lane, bounds.max[axis]);
        }
        self.children[lane] = child;
    }

    /// The box in a lane.
    fn bounds_of(&self, lane: usize) -> Bounds {
        let corner = |side: usize| Vec3::from_array(self.planes.map(|sides| sides[side].get(lane)));
        Bounds {
            min: corner(0),
            max: corner(1),
        }
    }

    /// Boxes and codes of the existing children.
    fn present(&self) -> impl Iterator<Item = (Bounds, u32)> + '_ {
        (0..WIDE)
            .map(|lane| self.bounds_of(lane))
            .zip(self.children)
            .filter(|(bounds, _)| !bounds.is_empty())
    }
}

/// The operation at the leaves of a tree.
pub(super) trait Visitor {
    /// Prefetches the memory of a leaf that is likely to be visited soon.
    fn fetch(&self, leaf: u32);

    /// Visits a leaf; returns the new limit, −∞ to end the traversal.
    fn visit(&mut self, leaf: u32, limit: f32) -> f32;
}

/// A child on its way to be visited: the distance at which the ray enters its box, then its code.
/// Distances are at least +0, so they are ordered as their bits are.
fn waiting(enter: f32, child: u32) -> u64 {
    u64::from(enter.to_bits()) << 32 | u64::from(child)
}

/// The distance of a child that waits.
fn enter_of(waiting: u64) -> f32 {
    f32::from_bits((waiting >> 32) as u32)
}

/// The code of a child that waits.
fn child_of(waiting: u64) -> u32 {
    waiting as u32
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

    /// The same boxes, numbered from `first` on.
    fn numbered_from(mut self, first: u32) -> Self {
        for item in &mut self.items[..self.count as usize] {
            *item += first;
        }
        self
    }
}

impl WideTree {
    /// The box around everything.
    pub(super) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// At most `most` (≥ 1) boxes that together enclose everything: those of the lowest nodes of
    /// the tree that are few enough.
    pub(super) fn hull(&self, most: usize) -> Vec<Bounds> {
        // (box, code of the node or leaf)
        let mut hull = vec![(self.bounds, if self.nodes.is_empty() { LEAF } else { 0 })];
        loop {
            let widest = (0..hull.len())
                .filter(|&place| hull[place].1 & LEAF == 0)
                .max_by(|&a, &b| {
                    let area = |place: usize| hull[place].0.half_area();
                    area(a).total_cmp(&area(b))
                });
            let Some(widest) = widest else { break };
            let node = &self.nodes[hull[widest].1 as usize];
            if hull.len() - 1 + node.present().count() > most {
                break;
            }
            hull.swap_remove(widest);
            hull.extend(node.present());
        }
        hull.into_iter().map(|(bounds, _)| bounds).collect()
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<WideNode>()
    }

    /// Lets `visitor` visit the leaves whose boxes the ray enters no later than `limit`, in the order
    /// of their boxes where that is known.
    ///
    /// Leaves beyond the final limit may be visited or not, so results must not depend on them.
    #[inline(always)]
    pub(super) fn walk_nearest<E: Sixteen>(
        &self,
        e: E,
        ray: &SlabRay,
        mut limit: f32,
        visitor: &mut impl Visitor,
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let mut stack = Stack::<u64, STACK>::new();
        let mut child = 0_u32;
        loop {
            if child & LEAF == 0 {
                let node = &self.nodes[child as usize];
                // Codes lie in the last line of a node: without this they are waited for only once
                // it is known which child is met.
                simd::prefetch(&node.children, 0);
                let (enters, mut met) = ray.sixteen(e, &node.planes, limit);
                if met != 0 {
                    let one = take_lane(&mut met);
                    child = node.children[one];
                    if met == 0 {
                        continue;
                    }
                    let enters = e.store_wide(enters);
                    let mut first = waiting(enters.get(one), child);
                    self.ask_for(child, visitor);
                    let lane = take_lane(&mut met);
                    let other = waiting(enters.get(lane), node.children[lane]);
                    self.ask_for(child_of(other), visitor);
                    let second = first.max(other);
                    first = first.min(other);
                    if met == 0 {
                        stack.push(second);
                    } else {
                        let base = stack.height();
                        while met != 0 {
                            let lane = take_lane(&mut met);
                            let other = waiting(enters.get(lane), node.children[lane]);
                            self.ask_for(child_of(other), visitor);
                            stack.push_in_order(base, first.max(other));
                            first = first.min(other);
                        }
                        stack.push_in_order(base, second);
                    }
                    // The nearest is visited at once, the others wait on the stack.
                    child = child_of(first);
                    continue;
                }
            } else {
                limit = visitor.visit(child & !LEAF, limit);
                if limit == f32::NEG_INFINITY {
                    return;
                }
            }
            loop {
                let Some(next) = stack.pop() else { return };
                if enter_of(next) <= limit {
                    child = child_of(next);
                    break;
                }
            }
        }
    }

    /// Lets `visitor` visit the leaves whose boxes the ray enters no later than `limit`, in any
    /// order, until it returns −∞.
    #[inline(always)]
    pub(super) fn walk_any<E: Sixteen>(
        &self,
        e: E,
        ray: &SlabRay,
        limit: f32,
        visitor: &mut impl Visitor,
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let mut stack = Stack::<u32, STACK>::new();
        let mut child = 0_u32;
        loop {
            if child & LEAF == 0 {
                let node = &self.nodes[child as usize];
                simd::prefetch(&node.children, 0);
                let (_, mut met) = ray.sixteen(e, &node.planes, limit);
                if met != 0 {
                    child = node.children[take_lane(&mut met)];
                    if met != 0 {
                        self.ask_for(child, visitor);
                    }
                    while met != 0 {
                        let other = node.children[take_lane(&mut met)];
                        self.ask_for(other, visitor);
                        stack.push(other);
                    }
                    continue;
                }
            } else if visitor.visit(child & !LEAF, limit) == f32::NEG_INFINITY {
                return;
            }
            let Some(next) = stack.pop() else { return };
            child = next;
        }
    }

    /// Prefetches the memory of a child that is likely to be visited soon.
    #[inline(always)]
    fn ask_for(&self, child: u32, visitor: &impl Visitor) {
        if child & LEAF == 0 {
            simd::prefetch(&self.nodes, child as usize);
        } else {
            visitor.fetch(child & !LEAF);
        }
    }
}

/// Removes the lowest lane from a mask that is not empty, and returns it.
#[inline(always)]
fn take_lane(mask: &mut u32) -> usize {
    let lane = mask.trailing_zeros() as usize % WIDE;
    *mask &= *mask - 1;
    lane
}

#[cfg(test)]
mod tests;
