//! Open patterns: a source drives the one node nearest to it (section 3.3), and the first vein
//! within the kill distance uses it up.

use glam::DVec2;

use super::chance::{Use, bits};
use super::fresh_nodes::FreshNodes;
use super::influence::{Fate, Influence, Surroundings};

/// The node nearest to a source.
#[derive(Clone, Debug)]
pub(crate) struct NearestNode {
    place: DVec2,
    id: u32,
    node: u32,
    distance_squared: f64,
}

/// Which of two equally near nodes the source drives: the one with the smaller draw.
pub(crate) fn lot(seed: u64, source: u32, node: u32) -> (u64, u32) {
    let counter = u64::from(source) << 32 | u64::from(node);
    (bits(seed, Use::Tie, counter), node)
}

impl NearestNode {
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
        let seed = surroundings.seed;
        surroundings.tree.approach(place, |entry| {
            let squared = (entry.position - place).length_squared();
            nearest.consider(entry.id, squared, seed);
            nearest.distance_squared
        });
        nearest
    }

    fn notice(&mut self, fresh: &FreshNodes, surroundings: &Surroundings) {
        let mut nearest = self.clone();
        let reach = self.distance_squared;
        fresh.each(
            |node_box| node_box.distance_squared(self.place) <= reach,
            |node, position| {
                let squared = (position - self.place).length_squared();
                nearest.consider(node, squared, surroundings.seed);
            },
        );
        *self = nearest;
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
