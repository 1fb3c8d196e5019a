//! Open patterns: a source drives the one node nearest to it (section 3.3), and the first vein
//! within the kill distance uses it up.

use std::ops::ControlFlow;

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::influence::{Fate, Influence, Surroundings};
use super::probe::{Probe, SLACK};
use crate::plane::rectangle_distance_squared;
use crate::random::{Use, bits};

/// The node nearest to a source.
#[derive(Clone, Debug)]
pub(crate) struct NearestNode {
    place: DVec2,
    id: u32,
    node: u32,
    distance_squared: f64,
}

/// The random key that decides between equally near nodes: the source drives the one with the
/// smaller key.
pub(crate) fn lot(seed: u64, source: u32, node: u32) -> (u64, u32) {
    let counter = u64::from(source) << 32 | u64::from(node);
    (bits(seed, Use::Tie, counter), node)
}

/// Searches nodes that are at least as near as the nearest found so far.
struct Look<'a> {
    nearest: &'a mut NearestNode,
    seed: u64,
}

impl Probe for Look<'_> {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        rectangle_distance_squared(low, high, self.nearest.place)
            <= self.nearest.distance_squared * SLACK
    }

    fn meet(&mut self, node: u32, position: DVec2) -> ControlFlow<()> {
        let squared = (position - self.nearest.place).length_squared();
        self.nearest.consider(node, squared, self.seed);
        ControlFlow::Continue(())
    }
}

impl NearestNode {
    fn look(&mut self, seed: u64) -> Look<'_> {
        Look {
            nearest: self,
            seed,
        }
    }

    fn consider(&mut self, node: u32, distance_squared: f64, seed: u64) {
        let tied = distance_squared == self.distance_squared;
        if distance_squared < self.distance_squared
            || (tied && lot(seed, self.id, node) < lot(seed, self.id, self.node))
        {
            self.node = node;
            self.distance_squared = distance_squared;
        }
    }
}

impl Influence for NearestNode {
    fn new(place: DVec2, id: u32, surroundings: &Surroundings) -> Self {
        let mut nearest = Self {
            place,
            id,
            node: u32::MAX,
            distance_squared: f64::INFINITY,
        };
        let _ = surroundings
            .tree
            .visit(place, &mut nearest.look(surroundings.seed));
        nearest
    }

    fn relocate(&mut self, place: DVec2, surroundings: &Surroundings) {
        *self = Self::new(place, self.id, surroundings);
    }

    fn notice(&mut self, fresh: &FreshNodes, surroundings: &Surroundings) {
        let _ = fresh.visit(&mut self.look(surroundings.seed));
    }

    fn is_untouched(&self) -> bool {
        true
    }

    fn each_driven(&self, mut visit: impl FnMut(u32)) {
        visit(self.node);
    }

    fn inherit(&mut self, _parent: u32, _child: u32) {}

    fn judge(&mut self, kill: f64) -> Fate {
        if self.distance_squared < kill * kill {
            Fate::UsedUp(Vec::new())
        } else {
            Fate::Stays
        }
    }

    fn give_up(&mut self) -> Vec<u32> {
        Vec::new()
    }
}
