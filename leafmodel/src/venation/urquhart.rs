//! The Urquhart neighbours of a source: the approximation of section 5.2.
//!
//! Node `v` is an Urquhart neighbour if it is a Delaunay neighbour of the source `s` in the set of
//! all nodes and the source, and no other Delaunay neighbour `u` has
//! `‖v − s‖ ≥ max(‖u − s‖, ‖v − u‖)`. All relative neighbours are Urquhart neighbours. Not all
//! Urquhart neighbours are relative ones, since a node that is not a Delaunay neighbour may exclude
//! them (Fig. 8).
//!
//! The Delaunay neighbours are those whose bisectors bound the source's Voronoi cell. New nodes
//! only shrink the cell, so each cuts it in turn. The cell starts as a square much larger than the
//! lamina: neighbours whose bisectors bound the cell only outside that square are far apart on the
//! hull of the veins and are ignored.

use std::ops::ControlFlow;

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::influence::{Surroundings, Zone};
use super::probe::{Probe, SLACK};
use crate::plane::rectangle_distance_squared;

/// Half the side of that square over the size of the lamina.
pub(crate) const SURROUNDINGS: f64 = 64.0;

/// A side of the cell: the node whose bisector it is, if any, and the corner at its
/// counter-clockwise end.
#[derive(Clone, Copy, Debug)]
struct Side {
    node: Option<(u32, DVec2)>,
    corner: DVec2,
}

/// The Urquhart neighbours of one source, kept up to date as nodes appear.
#[derive(Clone, Debug)]
pub(crate) struct UrquhartNeighbourhood {
    source: DVec2,
    /// Sides of the Voronoi cell, counter-clockwise; corners and nodes relative to the source.
    sides: Vec<Side>,
    /// Squared distance of the farthest corner.
    radius_squared: f64,
    /// Number and squared distance of each neighbour, by number.
    members: Vec<(u32, f64)>,
    /// Whether the cell has been cut since the members were chosen.
    is_cut: bool,
}

impl Zone for UrquhartNeighbourhood {
    fn find(source: DVec2, _id: u32, &Surroundings { tree, .. }: &Surroundings) -> Self {
        let (low, high) = tree.bounds();
        let far = SURROUNDINGS * (high - low).max_element();
        let corners = [(far, -far), (far, far), (-far, far), (-far, -far)];
        let side = |corner| Side {
            node: None,
            corner: DVec2::from(corner),
        };
        let mut found = Self {
            source,
            sides: corners.map(side).to_vec(),
            radius_squared: 2.0 * far * far,
            members: Vec::new(),
            is_cut: true,
        };
        let _ = tree.visit(source, &mut found);
        found.choose();
        found
    }

    fn update(&mut self, fresh: &FreshNodes, _surroundings: &Surroundings) {
        let _ = fresh.visit(self);
        self.choose();
    }

    fn members(&self) -> impl Iterator<Item = (u32, f64)> {
        self.members.iter().copied()
    }
}

impl UrquhartNeighbourhood {
    /// Takes in one new node. [`Self::choose`] must be called after the last one.
    fn cut(&mut self, id: u32, position: DVec2) {
        let offset = position - self.source;
        if offset.length_squared() > self.reach_squared() {
            return;
        }
        let half = 0.5 * offset.length_squared();
        let beyond = |side: &Side| side.corner.dot(offset) - half;
        if half == 0.0 {
            self.give_all_to(id, offset);
            return;
        }
        let Some(first) = self.sides.iter().position(|side| beyond(side) > 0.0) else {
            return;
        };
        // The corners beyond the bisector follow one another; they begin at the end of the list if
        // it ends with some.
        let count = self.sides.len();
        let at_end = self
            .sides
            .iter()
            .rev()
            .take_while(|side| beyond(side) > 0.0);
        let at_end = at_end.count();
        let start = if first == 0 {
            (count - at_end) % count
        } else {
            first
        };
        self.sides.rotate_left(start);
        let cut = self.sides.iter().take_while(|side| beyond(side) > 0.0);
        let cut = cut.count();
        if cut == count {
            // By rounding only, since the source is on this side.
            self.sides.clear();
        } else {
            let crossing = |from: &Side, to: &Side| {
                let (before, after) = (beyond(from), beyond(to));
                from.corner + (to.corner - from.corner) * (before / (before - after))
            };
            // Where the old boundary crosses the bisector outwards, its side is cut short; where it
            // comes back, the new side ends.
            let sides = &mut self.sides;
            let shortened = crossing(&sides[count - 1], &sides[0]);
            let new = Side {
                node: Some((id, offset)),
                corner: crossing(&sides[cut - 1], &sides[cut]),
            };
            sides[0].corner = shortened;
            if cut == 1 {
                sides.insert(1, new);
            } else {
                sides[1] = new;
                sides.drain(2..cut);
            }
        }
        self.note_cut();
    }

    /// Gives the whole cell to a node at the place of the source.
    fn give_all_to(&mut self, id: u32, offset: DVec2) {
        self.sides.clear();
        self.sides.push(Side {
            node: Some((id, offset)),
            corner: DVec2::ZERO,
        });
        self.note_cut();
    }

    fn note_cut(&mut self) {
        self.is_cut = true;
        self.radius_squared = self
            .sides
            .iter()
            .fold(0.0, |far, side| side.corner.length_squared().max(far));
    }

    /// Squared distance beyond which no node cuts the cell.
    fn reach_squared(&self) -> f64 {
        4.0 * self.radius_squared * SLACK
    }

    /// Tests the Delaunay neighbours against each other, if the cell has been cut.
    fn choose(&mut self) {
        if !std::mem::take(&mut self.is_cut) {
            return;
        }
        let delaunay = self.sides.iter().filter_map(|side| side.node);
        // Distances are computed as in the other modules: squares of differences of positions.
        let is_excluded = |v: (u32, DVec2), squared: f64| {
            delaunay.clone().any(|u| {
                u.0 != v.0
                    && squared >= u.1.length_squared()
                    && squared >= (v.1 - u.1).length_squared()
            })
        };
        self.members.clear();
        for v in delaunay.clone() {
            let squared = v.1.length_squared();
            if !is_excluded(v, squared) {
                self.members.push((v.0, squared));
            }
        }
        self.members.sort_unstable_by_key(|&(id, _)| id);
        // By rounding a node may have two sides.
        self.members.dedup_by_key(|&mut (id, _)| id);
    }
}

/// Takes the nodes near enough to cut the cell.
impl Probe for UrquhartNeighbourhood {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        let (low, high) = (low - self.source, high - self.source);
        // A node cuts off the corners that are nearer to it than to the source.
        let cuts = |corner: DVec2| {
            rectangle_distance_squared(low, high, corner) <= corner.length_squared() * SLACK
        };
        rectangle_distance_squared(low, high, DVec2::ZERO) <= self.reach_squared()
            && self.sides.iter().any(|side| cuts(side.corner))
    }

    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()> {
        self.cut(id, position);
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::venation::plan::AuxinPlan;
    use crate::venation::point_tree::PointTree;
    use crate::venation::relative_neighbourhood::RelativeNeighbourhood;
    use properties::fixed;

    fn surroundings(tree: &PointTree) -> Surroundings<'_> {
        Surroundings::new(tree, 0, &AuxinPlan::default())
    }

    fn tree(nodes: &[(f64, f64)]) -> PointTree {
        let mut tree = PointTree::new(DVec2::splat(-16.0), DVec2::splat(16.0));
        for (id, &node) in nodes.iter().enumerate() {
            tree.insert(id as u32, DVec2::from(node));
        }
        tree
    }

    fn ids(neighbourhood: &UrquhartNeighbourhood) -> Vec<u32> {
        neighbourhood.members().map(|(id, _)| id).collect()
    }

    fn relative(source: DVec2, tree: &PointTree) -> Vec<u32> {
        let found = RelativeNeighbourhood::find(source, 0, &surroundings(tree));
        let mut ids: Vec<u32> = found.members().map(|(id, _)| id).collect();
        ids.sort_unstable();
        ids
    }

    #[test]
    fn a_node_that_is_no_delaunay_neighbour_can_exclude_a_relative_neighbour() {
        // As in Fig. 8: node 1 lies behind the short bisector of node 2, so it is no Delaunay
        // neighbour of the source, yet it is nearer to the source and to node 0 than these are to
        // each other.
        let nodes = [(10.0, 0.0), (5.4, -7.0), (1.5, -6.5), (5.6, -2.6)];
        let nodes = &nodes[..];
        let mut seen = None;
        for dx in -20..=20 {
            for dy in -20..=0 {
                let a = (5.0 + 0.2 * f64::from(dx), -5.0 + 0.2 * f64::from(dy));
                let tree = tree(&[nodes[0], a, nodes[2]]);
                let urquhart = ids(&UrquhartNeighbourhood::find(
                    DVec2::ZERO,
                    0,
                    &surroundings(&tree),
                ));
                let exact = relative(DVec2::ZERO, &tree);
                if urquhart.contains(&0) && !exact.contains(&0) {
                    seen = Some(a);
                }
                assert!(exact.iter().all(|id| urquhart.contains(id)));
            }
        }
        assert!(seen.is_some(), "no such configuration");
    }

    /// `v` is a Delaunay neighbour of the source if part of their bisector is nearer to them than
    /// to all others.
    fn is_delaunay(source: DVec2, nodes: &[DVec2], v: usize, size: f64) -> bool {
        let offset = nodes[v] - source;
        let (foot, along) = (offset * 0.5, offset.perp().normalize());
        let far = SURROUNDINGS * size;
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        // Keeps the part where `normal · (foot + t along) ≤ limit`.
        let mut clip = |normal: DVec2, limit: f64| {
            let (slope, rest) = (normal.dot(along), limit - normal.dot(foot));
            if slope > 0.0 {
                high = high.min(rest / slope);
            } else if slope < 0.0 {
                low = low.max(rest / slope);
            } else if rest < 0.0 {
                high = f64::NEG_INFINITY;
            }
        };
        for normal in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y] {
            clip(normal, far);
        }
        for (u, &node) in nodes.iter().enumerate() {
            if u != v {
                clip(node - source, 0.5 * (node - source).length_squared());
            }
        }
        low < high
    }

    proptest! {
        #![proptest_config(fixed(500))]

        #[test]
        fn neighbours_are_those_of_the_definition_and_hold_the_relative_ones(
            points in proptest::collection::vec((-10.0..10.0, -10.0..10.0), 1..80),
            x in -10.0..10.0, y in -10.0..10.0,
        ) {
            let source = DVec2::new(x, y);
            let nodes: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
            let delaunay: Vec<usize> = (0..nodes.len())
                .filter(|&v| is_delaunay(source, &nodes, v, 32.0))
                .collect();
            let squared = |p: DVec2, q: DVec2| (p - q).length_squared();
            let expected: Vec<u32> = delaunay
                .iter()
                .copied()
                .filter(|&v| delaunay.iter().all(|&u| u == v
                    || squared(nodes[v], source) < squared(nodes[u], source).max(squared(nodes[v], nodes[u]))))
                .map(|v| v as u32)
                .collect();
            let tree = tree(&points);
            let found = UrquhartNeighbourhood::find(source, 0, &surroundings(&tree));
            prop_assert_eq!(ids(&found), expected.clone());
            let exact = relative(source, &tree);
            prop_assert!(exact.iter().all(|id| expected.contains(id)));
        }
    }
}
