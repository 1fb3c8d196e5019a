//! Closed patterns: a source drives all its relative neighbours, and is used up when every vein
//! that was on its way has come (section 4).
//!
//! The paper's rule for tags, made definite:
//!
//! - When a step leaves a relative neighbour of the source nearer than the kill distance, that node has
//!   *arrived* and the other relative neighbours are *tagged*. From then on the source drives tagged nodes only.
//! - A tagged node keeps its tag and hands it to its children. At the end of each step, tagged nodes
//!   that are no longer relative neighbours have left the zone of influence and lose the tag; those
//!   nearer than the kill distance arrive.
//! - With no tagged node left, the source is used up. Those that arrived are joined.

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::influence::{Fate, Influence, Surroundings};
use super::relative_neighbourhood::RelativeNeighbourhood;

/// The relative neighbours of a source, and the veins on their way to it.
#[derive(Clone, Debug)]
pub(crate) struct RelativeNeighbours {
    neighbourhood: RelativeNeighbourhood,
    /// Tagged nodes, once a vein has arrived.
    tagged: Option<Vec<u32>>,
    /// Nodes that have arrived.
    arrived: Vec<u32>,
}

impl Influence for RelativeNeighbours {
    fn new(place: DVec2, _id: u32, surroundings: &Surroundings) -> Self {
        Self {
            neighbourhood: RelativeNeighbourhood::find(place, surroundings.tree),
            tagged: None,
            arrived: Vec::new(),
        }
    }

    fn notice(&mut self, fresh: &FreshNodes, surroundings: &Surroundings) {
        self.neighbourhood.update(fresh, surroundings.tree);
    }

    fn each_driven(&self, visit: impl FnMut(u32)) {
        self.neighbourhood
            .members()
            .map(|(node, _)| node)
            .filter(|node| {
                self.tagged
                    .as_ref()
                    .is_none_or(|tagged| tagged.contains(node))
            })
            .for_each(visit);
    }

    fn inherit(&mut self, parent: u32, child: u32) {
        if let Some(tagged) = &mut self.tagged
            && tagged.contains(&parent)
        {
            tagged.push(child);
        }
    }

    fn judge(&mut self, kill: f64) -> Fate {
        let arrived = |&(_, squared): &(u32, f64)| squared < kill * kill;
        if self.tagged.is_none() && !self.neighbourhood.members().any(|n| arrived(&n)) {
            return Fate::Stays;
        }
        let heading = |node: u32| {
            self.tagged
                .as_ref()
                .is_none_or(|tagged| tagged.contains(&node))
        };
        let (come, coming): (Vec<_>, Vec<_>) = self
            .neighbourhood
            .members()
            .filter(|&(node, _)| heading(node))
            .partition(arrived);
        self.arrived.extend(come.into_iter().map(|(node, _)| node));
        let coming: Vec<u32> = coming.into_iter().map(|(node, _)| node).collect();
        let done = coming.is_empty();
        self.tagged = Some(coming);
        if done {
            Fate::UsedUp(self.give_up())
        } else {
            Fate::Stays
        }
    }

    fn give_up(&mut self) -> Vec<u32> {
        self.arrived.sort_unstable();
        std::mem::take(&mut self.arrived)
    }
}
