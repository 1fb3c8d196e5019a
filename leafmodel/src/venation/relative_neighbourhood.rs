//! The exact relative neighbours of a source, found without comparing all pairs.
//!
//! Node `v` is a relative neighbour of source `s` if and only if every other node `u` satisfies
//! `‖v − s‖ < max(‖u − s‖, ‖v − u‖)` (Eq. 2). A node that fails is *hidden* by some `u`. A
//! [`Horizon`] bounds, in each direction, the distance up to which nodes are not hidden, so only
//! nodes before the horizon are candidates. A candidate is a relative neighbour if no other node
//! lies in its *lune*, the points within the distance `‖v − s‖` of both `s` and `v`. The tree of
//! nodes answers that.
//!
//! - **Always true**: the result equals that of the definition, evaluated in floating point on
//!   squared distances. The horizon only selects candidates, with a margin far above rounding.
//! - **Time coherence**: new nodes can only hide more. So of the new nodes only those before the
//!   horizon are candidates, and a relative neighbour remains one unless a new node lies in its
//!   lune.

use std::ops::ControlFlow;

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::horizon::Horizon;
use super::influence::{Surroundings, Zone};
use super::point_tree::PointTree;
use super::probe::{Probe, SLACK};
use crate::plane::rectangle_distance_squared;

/// A relative neighbour, or a node that may turn out to be one.
#[derive(Clone, Copy, Debug)]
struct Neighbour {
    position: DVec2,
    distance_squared: f64,
    id: u32,
    /// Whether its lune is known to be empty.
    is_certain: bool,
}

/// The relative neighbours of one source, kept up to date as nodes appear.
#[derive(Clone, Debug)]
pub(crate) struct RelativeNeighbourhood {
    source: DVec2,
    horizon: Horizon,
    neighbours: Vec<Neighbour>,
}

impl Zone for RelativeNeighbourhood {
    fn find(source: DVec2, _id: u32, &Surroundings { tree, .. }: &Surroundings) -> Self {
        let (low, high) = tree.bounds();
        let mut found = Self {
            source,
            horizon: Horizon::of_rectangle(low - source, high - source),
            neighbours: Vec::with_capacity(8),
        };
        let _ = tree.visit(source, &mut Search(&mut found));
        found.ascertain(tree);
        found
    }

    fn update(&mut self, fresh: &FreshNodes, surroundings: &Surroundings) {
        let _ = fresh.visit(&mut Update(self));
        self.ascertain(surroundings.tree);
    }

    /// In no particular order. The nearest node is always among them, unless another node close to
    /// it has exactly the same distance.
    fn members(&self) -> impl Iterator<Item = (u32, f64)> {
        self.neighbours
            .iter()
            .map(|node| (node.id, node.distance_squared))
    }
}

impl RelativeNeighbourhood {
    /// Keeps the neighbours whose lunes are empty.
    fn ascertain(&mut self, tree: &PointTree) {
        let source = self.source;
        self.neighbours.retain_mut(|node| {
            node.is_certain = node.is_certain
                || !tree.any_near_both(source, node.position, node.distance_squared, node.id);
            node.is_certain
        });
    }

    /// Takes in a node.
    fn meet(&mut self, id: u32, position: DVec2, offset: DVec2, distance_squared: f64) {
        let is_visible = self.horizon.shows(offset, distance_squared);
        let mut is_free = is_visible;
        self.neighbours.retain(|other| {
            let between = (other.position - position).length_squared();
            is_free &= distance_squared < other.distance_squared.max(between);
            other.distance_squared < distance_squared.max(between)
        });
        if is_visible {
            self.horizon.hide_behind(offset, distance_squared);
        }
        if is_free {
            self.neighbours.push(Neighbour {
                position,
                distance_squared,
                id,
                is_certain: false,
            });
        }
    }
}

/// Searches nodes before the horizon.
struct Search<'a>(&'a mut RelativeNeighbourhood);

impl Probe for Search<'_> {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        let source = self.0.source;
        self.0.horizon.shows_any_in(low - source, high - source)
    }

    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()> {
        let offset = position - self.0.source;
        let distance_squared = offset.length_squared();
        if self.0.horizon.shows(offset, distance_squared) {
            self.0.meet(id, position, offset, distance_squared);
        }
        ControlFlow::Continue(())
    }
}

/// Searches new nodes before the horizon or in the lunes of neighbours.
struct Update<'a>(&'a mut RelativeNeighbourhood);

impl Probe for Update<'_> {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        let source = self.0.source;
        let from_source = rectangle_distance_squared(low, high, source);
        self.0.horizon.shows_any_in(low - source, high - source)
            || self.0.neighbours.iter().any(|node| {
                let reach = node.distance_squared * SLACK;
                from_source <= reach
                    && rectangle_distance_squared(low, high, node.position) <= reach
            })
    }

    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()> {
        let offset = position - self.0.source;
        self.0.meet(id, position, offset, offset.length_squared());
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::venation::plan::AuxinPlan;
    use properties::fixed;

    /// Eq. 2 as written.
    fn by_definition(source: DVec2, nodes: &[DVec2]) -> Vec<u32> {
        let neighbour = |i: usize| {
            let squared = |p: DVec2, q: DVec2| (p - q).length_squared();
            let v = nodes[i];
            (0..nodes.len())
                .filter(|&j| j != i)
                .all(|j| squared(v, source) < squared(nodes[j], source).max(squared(v, nodes[j])))
        };
        (0..nodes.len())
            .filter(|&i| neighbour(i))
            .map(|i| i as u32)
            .collect()
    }

    fn sorted(neighbourhood: &RelativeNeighbourhood) -> Vec<u32> {
        let mut ids: Vec<u32> = neighbourhood.members().map(|(id, _)| id).collect();
        ids.sort_unstable();
        ids
    }

    /// Points crowded along chains, as veins are, or on a lattice with its many equal distances.
    fn nodes(count: usize, kind: u8) -> impl Strategy<Value = Vec<DVec2>> {
        proptest::collection::vec((0.0..10.0, 0.0..10.0), count).prop_map(move |points| {
            let mut at = DVec2::splat(5.0);
            points
                .into_iter()
                .map(DVec2::from)
                .map(|p| match kind {
                    0 => p,
                    1 => p.floor(),
                    _ => {
                        let way = p - DVec2::splat(5.0);
                        at = (at + way * 0.1).clamp(DVec2::ZERO, DVec2::splat(10.0));
                        at
                    }
                })
                .collect()
        })
    }

    fn cases() -> impl Strategy<Value = (Vec<DVec2>, u8)> {
        (1_usize..150, 0_u8..3)
            .prop_flat_map(|(count, kind)| nodes(count, kind).prop_map(move |n| (n, kind)))
    }

    proptest! {
        #![proptest_config(fixed(1500))]

        #[test]
        fn neighbours_are_those_of_the_definition_at_every_stage(
            (nodes, kind) in cases(), x in 0.0..10.0, y in 0.0..10.0, steps in 1_usize..6,
        ) {
            let source = DVec2::new(x, y);
            // On the lattice, a source in the middle of a square or on a point has the most ties.
            let source = if kind == 1 { (source * 2.0).floor() * 0.5 } else { source };
            let (low, high) = (DVec2::ZERO, DVec2::splat(10.0));
            let mut tree = PointTree::new(low, high);
            let plan = AuxinPlan::default();
            let mut neighbourhood =
                RelativeNeighbourhood::find(source, 0, &Surroundings::new(&tree, 0, &plan));
            for step in 0..steps {
                let (from, to) = (nodes.len() * step / steps, nodes.len() * (step + 1) / steps);
                for (id, &p) in nodes.iter().enumerate().take(to).skip(from) {
                    tree.insert(id as u32, p);
                }
                let known = &nodes[..to];
                let surroundings = Surroundings::new(&tree, 0, &plan);
                neighbourhood.update(&FreshNodes::new(known, from as u32), &surroundings);
                let expected = by_definition(source, known);
                prop_assert_eq!(&sorted(&neighbourhood), &expected, "kept up to date");
                let anew = RelativeNeighbourhood::find(source, 0, &surroundings);
                prop_assert_eq!(&sorted(&anew), &expected, "found anew");
            }
        }
    }
}
