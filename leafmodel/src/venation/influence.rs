//! The influence of an auxin source on veins, in which open and closed patterns differ.

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::plan::AuxinPlan;
use super::point_tree::PointTree;

/// The data that all sources use.
pub(crate) struct Surroundings<'a> {
    /// All vein nodes.
    pub(crate) tree: &'a PointTree,
    /// Seed of the simulation, which decides ties.
    pub(crate) seed: u64,
    /// Share of bipolar sources whose axis runs along the nearest vein.
    pub(crate) axis_along_vein: f64,
}

impl<'a> Surroundings<'a> {
    /// The nodes in `tree` under a plan.
    pub(crate) fn new(tree: &'a PointTree, seed: u64, plan: &AuxinPlan) -> Self {
        Self {
            tree,
            seed,
            axis_along_vein: plan.axis_along_vein,
        }
    }
}

/// The fate of a source at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fate {
    /// It remains.
    Stays,
    /// It is used up; these veins have reached it and are to be joined.
    UsedUp(Vec<u32>),
}

/// A source's relation to the veins around it.
pub(crate) trait Influence: Send + Sized {
    /// The influence of a new source, number `id`, at `place`.
    fn new(place: DVec2, id: u32, surroundings: &Surroundings) -> Self;

    /// Called when the source and all nodes have moved: the driven nodes are determined anew for
    /// `place`; tags are kept.
    fn relocate(&mut self, place: DVec2, surroundings: &Surroundings);

    /// Takes in the nodes added since the last call.
    fn notice(&mut self, fresh: &FreshNodes, surroundings: &Surroundings);

    /// Whether no vein has reached the source yet, so that the driven nodes follow from the places
    /// of the nodes alone.
    fn is_untouched(&self) -> bool;

    /// Calls `visit` with each node that this source drives.
    fn each_driven(&self, visit: impl FnMut(u32));

    /// Called when `child` has grown from the driven node `parent`.
    fn inherit(&mut self, parent: u32, child: u32);

    /// Decides the source's fate at the end of a step, after all new nodes were noticed; `kill` is
    /// the kill distance.
    fn judge(&mut self, kill: f64) -> Fate;

    /// Called when the source is given up: returns the veins that have reached it so far.
    fn give_up(&mut self) -> Vec<u32>;
}

/// The rule that decides which nodes are neighbours of a source.
pub(crate) trait Zone: Send + Sized {
    /// The neighbours of source number `id` at `place` among all nodes.
    fn find(place: DVec2, id: u32, surroundings: &Surroundings) -> Self;

    /// The neighbours of the same source when it and all nodes have moved.
    fn refind(&mut self, place: DVec2, surroundings: &Surroundings) {
        // Zones without a memory do not depend on the number.
        *self = Self::find(place, 0, surroundings);
    }

    /// Takes in the nodes added since the last call.
    fn update(&mut self, fresh: &FreshNodes, surroundings: &Surroundings);

    /// Number and squared distance of each neighbour.
    fn members(&self) -> impl Iterator<Item = (u32, f64)>;
}
