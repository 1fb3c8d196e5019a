//! The two veins that a source joins: loops close where two veins meet.
//!
//! A source has an *axis*. It draws the nearest node ahead along the axis and the nearest behind,
//! within a cone about it; so a new vein runs through the source from one side of an areole to the
//! other and divides it in two, where all relative neighbours would divide it in three or more from
//! its middle. The axis follows the vein nearest at the source's birth: chance decides whether it
//! runs along that vein or away from it.
//!
//! - **Always true**: the result depends on places, seed and number alone; a tie goes to the lower
//!   number.
//!
//! # Source
//!
//! Closed loops of the leaf come from two strands that meet in one *bipolar* cell, with PIN1 at
//! both of its ends \[scarpella2006\]. That a source is such a cell, and how its axis lies, is
//! ours; it brings forth areoles as long as measured ones.

use std::f64::consts::FRAC_PI_6;
use std::ops::ControlFlow;

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::influence::{Surroundings, Zone};
use super::point_tree::PointTree;
use super::probe::{Probe, SLACK};
use crate::plane::rectangle_distance_squared;
use crate::random::{Use, uniform};

/// Cosine of the cones' half-angle, 35°.
const CONE: f64 = 0.819_152_044_288_991_8;

/// How far chance turns the axis, radians.
const TURN: f64 = FRAC_PI_6;

/// The axis of source number `id`, a unit vector. `way` leads to the nearest vein; `along` is the
/// share of sources whose axis runs along that.
pub(crate) fn axis_of(way: DVec2, id: u32, along: f64, seed: u64) -> DVec2 {
    let away = way.normalize_or(DVec2::Y);
    let [lot, turn] = [0, 1].map(|what| uniform(seed, Use::Axis, u64::from(id) << 1 | what));
    let axis = if lot < along { away.perp() } else { away };
    let (sin, cos) = libm::sincos(TURN * (2.0 * turn - 1.0));
    DVec2::new(cos, sin).rotate(axis)
}

/// A node that a source may draw.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pole {
    id: u32,
    distance_squared: f64,
}

/// The poles of one source, kept up to date as nodes appear.
#[derive(Clone, Debug)]
pub(crate) struct Bipolar {
    source: DVec2,
    /// Unit vector.
    axis: DVec2,
    /// The nearest node ahead and the nearest behind, or the nearest of all if there is none.
    members: Vec<(u32, f64)>,
    poles: [Option<Pole>; 2],
    nearest: Option<(Pole, DVec2)>,
}

impl Zone for Bipolar {
    fn find(source: DVec2, id: u32, surroundings: &Surroundings) -> Self {
        let &Surroundings { tree, seed, .. } = surroundings;
        let mut vein = Nearest { source, node: None };
        let _ = tree.visit(source, &mut vein);
        let Some((_, place)) = vein.node else {
            return Self::about(source, DVec2::X);
        };
        let axis = axis_of(place - source, id, surroundings.axis_along_vein, seed);
        let mut found = Self {
            nearest: vein.node,
            ..Self::about(source, axis)
        };
        found.search(tree);
        found
    }

    fn refind(&mut self, source: DVec2, surroundings: &Surroundings) {
        *self = Self::about(source, self.axis);
        self.search(surroundings.tree);
    }

    fn update(&mut self, fresh: &FreshNodes, _surroundings: &Surroundings) {
        let _ = fresh.visit(&mut Search(self));
        self.choose();
    }

    fn members(&self) -> impl Iterator<Item = (u32, f64)> {
        self.members.iter().copied()
    }
}

impl Bipolar {
    fn search(&mut self, tree: &PointTree) {
        let _ = tree.visit(self.source, &mut Search(self));
        self.choose();
    }

    fn about(source: DVec2, axis: DVec2) -> Self {
        Self {
            source,
            axis,
            members: Vec::with_capacity(2),
            poles: [None; 2],
            nearest: None,
        }
    }

    fn choose(&mut self) {
        let lone = match self.poles {
            [None, None] => self.nearest.map(|(pole, _)| pole),
            _ => None,
        };
        let poles = self.poles.iter().flatten().copied().chain(lone);
        self.members.clear();
        self.members
            .extend(poles.map(|pole| (pole.id, pole.distance_squared)));
    }
}

/// Whether a node takes the place of another.
fn is_better(node: Pole, than: Option<Pole>) -> bool {
    than.is_none_or(|than| {
        node.distance_squared < than.distance_squared
            || node.distance_squared == than.distance_squared && node.id < than.id
    })
}

/// Searches the nearest node.
struct Nearest {
    source: DVec2,
    node: Option<(Pole, DVec2)>,
}

impl Probe for Nearest {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        let squared = rectangle_distance_squared(low, high, self.source);
        self.node
            .is_none_or(|(node, _)| squared <= node.distance_squared * SLACK)
    }

    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()> {
        let node = Pole {
            id,
            distance_squared: (position - self.source).length_squared(),
        };
        if is_better(node, self.node.map(|(nearest, _)| nearest)) {
            self.node = Some((node, position));
        }
        ControlFlow::Continue(())
    }
}

/// Searches nodes that are nearer than the poles.
struct Search<'a>(&'a mut Bipolar);

impl Probe for Search<'_> {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        let Bipolar { source, axis, .. } = *self.0;
        let squared = rectangle_distance_squared(low, high, source);
        let within =
            |node: Option<Pole>| node.is_none_or(|node| squared <= node.distance_squared * SLACK);
        // How far the box reaches along the axis and against it.
        let reach = |axis: DVec2| {
            let corner = DVec2::select(axis.cmpgt(DVec2::ZERO), high, low);
            (corner - source).dot(axis)
        };
        let in_cone = |axis: DVec2| {
            let reach = reach(axis);
            reach >= 0.0 && reach * reach * SLACK >= CONE * CONE * squared
        };
        let [ahead, behind] = self.0.poles;
        within(self.0.nearest.map(|(nearest, _)| nearest))
            || within(ahead) && in_cone(axis)
            || within(behind) && in_cone(-axis)
    }

    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()> {
        let offset = position - self.0.source;
        let node = Pole {
            id,
            distance_squared: offset.length_squared(),
        };
        if is_better(node, self.0.nearest.map(|(nearest, _)| nearest)) {
            self.0.nearest = Some((node, position));
        }
        let along = offset.dot(self.0.axis);
        if along.abs() >= CONE * node.distance_squared.sqrt() {
            let pole = &mut self.0.poles[usize::from(along < 0.0)];
            if is_better(node, *pole) {
                *pole = Some(node);
            }
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEED: u64 = 5;

    fn tree(nodes: &[DVec2]) -> PointTree {
        let mut tree = PointTree::new(DVec2::splat(-20.0), DVec2::splat(20.0));
        for (id, &node) in (0..).zip(nodes) {
            tree.insert(id, node);
        }
        tree
    }

    /// Two parallel veins, 6 apart.
    fn ladder() -> Vec<DVec2> {
        let rail = |x: f64| (-15..=15).map(move |i| DVec2::new(x, f64::from(i)));
        rail(-2.0).chain(rail(4.0)).collect()
    }

    fn found(along: f64, id: u32) -> Vec<DVec2> {
        let nodes = ladder();
        let tree = tree(&nodes);
        let surroundings = Surroundings {
            tree: &tree,
            seed: SEED,
            axis_along_vein: along,
        };
        let poles = Bipolar::find(DVec2::ZERO, id, &surroundings);
        poles.members().map(|(id, _)| nodes[id as usize]).collect()
    }

    #[test]
    fn veins_are_drawn_from_both_sides() {
        for id in 0..50 {
            let mut xs: Vec<f64> = found(0.0, id).iter().map(|p| p.x).collect();
            xs.sort_by(f64::total_cmp);
            assert_eq!(xs, [-2.0, 4.0], "source {id}");
        }
    }

    #[test]
    fn the_share_along_the_nearest_vein_is_as_asked() {
        let along = (0..2000).filter(|&id| {
            let axis = axis_of(DVec2::X, id, 0.3, SEED);
            axis.y.abs() > axis.x.abs()
        });
        assert!((along.count() as f64 / 2000.0 - 0.3).abs() < 0.04);
    }

    #[test]
    fn a_source_with_one_vein_in_sight_draws_that() {
        let nodes = [DVec2::new(3.0, 9.0)];
        let tree = tree(&nodes);
        let surroundings = Surroundings {
            tree: &tree,
            seed: SEED,
            axis_along_vein: 1.0,
        };
        let poles = Bipolar::find(DVec2::ZERO, 1, &surroundings);
        assert_eq!(poles.members, [(0, 90.0)]);
    }
}
