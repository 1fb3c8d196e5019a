//! Lone sources that are close together, grouped by their nearest node.

use std::ops::ControlFlow;

use glam::DVec2;

use super::view::Lone;
use super::view::{MARGIN, Nearest, Node, View, find_seeing};
use crate::plane::rectangle_distance_squared;
use crate::venation::fresh_nodes::FreshNodes;
use crate::venation::point_tree::PointTree;
use crate::venation::probe::{Probe, SLACK};

/// Placeholder for the number of a basin that has none yet.
pub(super) const UNNUMBERED: u32 = u32::MAX;

/// The lone sources of a cell that share their nearest node.
#[derive(Clone, Debug)]
pub(super) struct Basin {
    pub(super) number: u32,
    pub(super) node: Node,
    /// Lower corner of a rectangle that holds the sources.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
    pub(super) lone: Vec<Lone>,
    /// Whether its node has changed since the last update.
    pub(super) has_changed: bool,
    /// Whether sources have joined it since the last update.
    pub(super) is_joined: bool,
}

impl Basin {
    pub(super) fn new(node: Node, lone: Lone) -> Self {
        Self {
            number: UNNUMBERED,
            node,
            low: lone.place,
            high: lone.place,
            lone: vec![lone],
            has_changed: true,
            is_joined: true,
        }
    }

    /// Removes the sources to which a node other than the basin's is visible.
    pub(super) fn remove_seeing(&mut self, tree: &PointTree, leaving: &mut Vec<Lone>) {
        let before = leaving.len();
        let mut seen = Vec::new();
        find_seeing(&mut self.lone, self.node, tree, &mut seen, leaving);
        for gone in &leaving[before..] {
            self.lone.retain(|lone| lone.slot != gone.slot);
        }
    }

    pub(super) fn take_in(&mut self, lone: Lone) {
        self.is_joined = true;
        self.low = self.low.min(lone.place);
        self.high = self.high.max(lone.place);
        self.lone.push(lone);
    }

    pub(super) fn view(&self) -> View {
        View::new(self.low, self.high, self.node.place)
    }

    /// Whether `node` is nearer than `other` to all sources of the basin, by the safety margin.
    pub(super) fn is_nearer(&self, node: Node, other: Node) -> bool {
        let (low, high) = (self.low - node.place, self.high - node.place);
        let way = other.place - node.place;
        // All sources are on the near side of the bisector: 2 s·w < ‖w‖².
        let most = (low * way).max(high * way);
        let size_squared = low.abs().max(high.abs()).length_squared() + way.length_squared();
        2.0 * (most.x + most.y) < way.length_squared() - MARGIN * size_squared
    }

    /// The node, among those found and its own, that is nearest to all sources of the basin, if
    /// there is one.
    pub(super) fn common_nearest(&self, found: &[Node]) -> Option<Node> {
        let centre = 0.5 * (self.low + self.high);
        let distance = |node: &Node| (node.place - centre).length_squared();
        let all = || found.iter().chain([&self.node]).copied();
        let nearest = all().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        all()
            .all(|node| node.id == nearest.id || self.is_nearer(nearest, node))
            .then_some(nearest)
    }
}

/// Gathers the new nodes that may be nearer to sources of a basin than its node, or not hidden by
/// it.
pub(super) struct Concern<'a> {
    pub(super) basin: &'a Basin,
    pub(super) view: View,
    /// Squared distance to the farthest corner from the node.
    pub(super) reach_squared: f64,
    pub(super) found: &'a mut Vec<Node>,
}

impl Probe for Concern<'_> {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        let gap = (low - self.basin.high).max(self.basin.low - high);
        gap.max(DVec2::ZERO).length_squared() <= self.reach_squared * SLACK
            || self.view.shows_any_in(low, high)
    }

    fn meet(&mut self, id: u32, place: DVec2) -> ControlFlow<()> {
        let node = Node { id, place };
        // Nodes that are nearer to no source and hidden from all do not matter.
        if self.view.shows_any_in(place, place) || !self.basin.is_nearer(self.basin.node, node) {
            self.found.push(node);
        }
        ControlFlow::Continue(())
    }
}

/// Lone sources that are close together.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    pub(super) basins: Vec<Basin>,
    /// Numbers of removed basins.
    pub(super) freed: Vec<u32>,
    /// Sources that are no longer lone.
    pub(super) leaving: Vec<Lone>,
    pub(super) has_changed: bool,
    /// New nodes that affect the basin being updated.
    pub(super) found: Vec<Node>,
    /// Sources that need a new basin, with their nearest nodes unless these are too near.
    pub(super) split: Vec<(Lone, Option<Node>)>,
}

impl Cell {
    /// Finds the sources whose nearest node has changed and those that are no longer lone.
    pub(super) fn notice(&mut self, fresh: &FreshNodes, tree: &PointTree, near: f64) {
        let mut at = 0;
        while at < self.basins.len() {
            let basin = &self.basins[at];
            let view = basin.view();
            self.found.clear();
            let _ = fresh.visit(&mut Concern {
                basin,
                reach_squared: view.size_squared,
                view,
                found: &mut self.found,
            });
            if self.found.is_empty() {
                at += 1;
                continue;
            }
            self.has_changed = true;
            let basin = &mut self.basins[at];
            match basin.common_nearest(&self.found) {
                Some(node)
                    if rectangle_distance_squared(basin.low, basin.high, node.place)
                        > near * near =>
                {
                    let is_new = node.id != basin.node.id;
                    basin.node = node;
                    basin.has_changed |= is_new;
                    let view = basin.view();
                    let shown = |f: &Node| f.id != node.id && view.shows_any_in(f.place, f.place);
                    if is_new || self.found.iter().any(shown) {
                        basin.remove_seeing(tree, &mut self.leaving);
                    }
                    if basin.lone.is_empty() {
                        self.freed.push(self.basins.swap_remove(at).number);
                    } else {
                        at += 1;
                    }
                }
                Some(_) | None => {
                    let basin = self.basins.swap_remove(at);
                    self.freed.push(basin.number);
                    self.split.extend(basin.lone.into_iter().map(|lone| {
                        let mut nearest = Nearest::new(lone.place);
                        nearest.consider(basin.node);
                        for &node in &self.found {
                            nearest.consider(node);
                        }
                        (lone, nearest.unless_near(near))
                    }));
                }
            }
        }
        if !self.split.is_empty() {
            self.settle(tree);
        }
    }

    /// Assigns sources with known nearest nodes to basins, if they are lone.
    pub(super) fn settle(&mut self, tree: &PointTree) {
        let mut pieces: Vec<Basin> = Vec::new();
        for (lone, node) in self.split.drain(..) {
            match node {
                None => self.leaving.push(lone),
                Some(node) => match pieces.iter_mut().find(|b| b.node.id == node.id) {
                    Some(piece) => piece.take_in(lone),
                    None => pieces.push(Basin::new(node, lone)),
                },
            }
        }
        for mut piece in pieces {
            piece.remove_seeing(tree, &mut self.leaving);
            if piece.lone.is_empty() {
                continue;
            }
            match self.basins.iter_mut().find(|b| b.node.id == piece.node.id) {
                Some(basin) => piece.lone.iter().for_each(|&lone| basin.take_in(lone)),
                None => self.basins.push(piece),
            }
        }
    }
}
