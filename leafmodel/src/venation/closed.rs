//! Closed patterns: a source drives all its neighbours and is used up when every vein on its way to
//! the source has arrived (section 4).
//!
//! The paper's rule for tags, made precise:
//!
//! - When a step leaves a neighbour of the source nearer than the kill distance, that node has
//!   *arrived* and the other neighbours are *tagged*. From then on the source drives tagged nodes
//!   only.
//! - A tagged node keeps its tag and passes it on to its children. At the end of each step, tagged
//!   nodes that are no longer neighbours have left the zone of influence and lose the tag; those
//!   nearer than the kill distance have arrived.
//! - When no tagged node is left, the source is used up, and the arrived nodes are joined.
//!
//! Neighbours are relative neighbours, Urquhart's approximation of them, or one on either side.

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::influence::{Fate, Influence, Surroundings, Zone};

/// The neighbours of a source, and the veins on their way to it.
#[derive(Clone, Debug)]
pub(crate) struct Anastomosis<Z> {
    zone: Z,
    /// Tagged nodes, once a vein has arrived.
    tagged: Option<Vec<u32>>,
    /// Nodes that have arrived.
    arrived: Vec<u32>,
}

impl<Z: Zone> Influence for Anastomosis<Z> {
    fn new(place: DVec2, id: u32, surroundings: &Surroundings) -> Self {
        Self {
            zone: Z::find(place, id, surroundings),
            tagged: None,
            arrived: Vec::new(),
        }
    }

    fn relocate(&mut self, place: DVec2, surroundings: &Surroundings) {
        self.zone.refind(place, surroundings);
    }

    fn notice(&mut self, fresh: &FreshNodes, surroundings: &Surroundings) {
        self.zone.update(fresh, surroundings);
    }

    fn is_untouched(&self) -> bool {
        self.tagged.is_none()
    }

    fn each_driven(&self, visit: impl FnMut(u32)) {
        self.zone
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
        if self.tagged.is_none() && !self.zone.members().any(|n| arrived(&n)) {
            return Fate::Stays;
        }
        let heading = |node: u32| {
            self.tagged
                .as_ref()
                .is_none_or(|tagged| tagged.contains(&node))
        };
        let (come, coming): (Vec<_>, Vec<_>) = self
            .zone
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
