//! What an auxin source does to the veins: the part in which open and closed patterns differ.

use glam::DVec2;

use super::fresh_nodes::FreshNodes;
use super::point_tree::PointTree;

/// What sources share while they look at the veins.
pub(crate) struct Surroundings<'a> {
    /// All vein nodes.
    pub(crate) tree: &'a PointTree,
    /// Seed of the simulation, for ties.
    pub(crate) seed: u64,
}

/// What becomes of a source at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fate {
    /// It goes on drawing veins.
    Stays,
    /// It is used up; these veins have reached it and are to be joined.
    UsedUp(Vec<u32>),
}

/// A source's relation to the veins around it.
pub(crate) trait Influence: Send + Sized {
    /// The relation of a new source, number `id`, at `place`.
    fn new(place: DVec2, id: u32, surroundings: &Surroundings) -> Self;

    /// The source has moved to `place`, and all nodes with it: what it drives is found anew, but
    /// what it knows of tags stays.
    fn place_anew(&mut self, place: DVec2, surroundings: &Surroundings);

    /// Takes in nodes that have come since the last call.
    fn notice(&mut self, fresh: &FreshNodes, surroundings: &Surroundings);

    /// Whether no vein has reached the source yet: what it drives follows from the places of the
    /// nodes alone.
    fn is_untouched(&self) -> bool;

    /// Calls `visit` with each node that this source drives.
    fn each_driven(&self, visit: impl FnMut(u32));

    /// Tells that `child` has grown from the driven node `parent`.
    fn inherit(&mut self, parent: u32, child: u32);

    /// Decides at the end of a step, all its nodes noticed, for kill distance `kill`.
    fn judge(&mut self, kill: f64) -> Fate;

    /// The veins that have reached the source so far, if it has to give up.
    fn give_up(&mut self) -> Vec<u32>;
}
