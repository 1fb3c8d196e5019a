//! Sources far from all veins, updated many at a time.
//!
//! A source is *lone* if its nearest node hides every other node (see [`super::horizon`]). A lone
//! source drives its nearest node only, in open and closed patterns and under either neighbourhood.
//! Most sources that wait for veins are lone, tens of thousands where growth is slow relative to
//! the net. A new node affects a lone source only if it is nearer than the nearest node or not
//! hidden by it. So lone sources are kept in *cells*, and within a cell in *basins* with the same
//! nearest node: one test decides for a whole basin whether any new node affects it.
//!
//! A node at `p` is hidden by the nearest node, at the origin, from a source at `s` if
//! `‖p‖ ≤ ‖p − s‖`, which is `2 p·s ≤ ‖s‖²`. The greatest `2 p·s − ‖s‖²` over a box of nodes and a
//! box of sources is a sum of one term for each axis.
//!
//! - **Always true**: a source stays lone only while its nearest node is nearest without a tie, by
//!   the same squared distances as elsewhere, and hides all others by a margin far above rounding.
//!   In doubtful cases the source is treated individually. So the veins do not depend on which
//!   sources are lone.
//! - **Left out**: tissue that moves, and curved blades.

mod cell;
#[cfg(test)]
mod tests;
mod view;

use std::collections::HashMap;

use glam::DVec2;
use rayon::prelude::*;

use self::cell::{Basin, Cell, UNNUMBERED};
pub(crate) use self::view::Lone;
use self::view::{Nearest, Node, sees_no_other};
use super::fresh_nodes::FreshNodes;
use super::point_tree::PointTree;

/// Side of a cell in birth distances of sources.
const CELL_SIDE: f64 = 9.0;

/// Cells are rebuilt when the birth distance has shrunk to this share.
const REFINEMENT: f64 = 0.6;

/// Number of cells from which several threads are used.
const MANY: usize = 64;

/// All lone sources, in square cells.
pub(crate) struct LoneSources {
    side: f64,
    cell_numbers: HashMap<(i32, i32), usize>,
    cells: Vec<Cell>,
    /// The node of each basin, by number.
    nodes: Vec<u32>,
    /// Numbers that are free for new basins.
    free: Vec<u32>,
}

impl LoneSources {
    /// No sources.
    pub(crate) fn new() -> Self {
        Self {
            side: f64::INFINITY,
            cell_numbers: HashMap::new(),
            cells: Vec::new(),
            nodes: Vec::new(),
            free: Vec::new(),
        }
    }

    /// The node that the sources of a basin drive.
    pub(crate) fn node(&self, basin: u32) -> u32 {
        self.nodes[basin as usize]
    }

    /// Adapts the size of cells to sources that are born `spacing` apart. Calls `settled` with each
    /// source whose basin has changed.
    pub(crate) fn fit_cells(&mut self, spacing: f64, mut settled: impl FnMut(Lone, u32)) {
        let side = CELL_SIDE * spacing;
        if side < REFINEMENT * self.side {
            let cells = std::mem::replace(self, Self::new()).cells;
            self.side = side;
            for basin in cells.into_iter().flat_map(|cell| cell.basins) {
                for lone in basin.lone {
                    self.insert(basin.node, lone, &mut settled);
                }
            }
        }
    }

    fn key(&self, place: DVec2) -> (i32, i32) {
        let key = (place / self.side).floor();
        (key.x as i32, key.y as i32)
    }

    /// Takes in the source at `place` with the number `slot`, if it is lone among the nodes of
    /// `tree` and not nearer than `near` to any of them; returns its basin.
    pub(crate) fn try_insert(
        &mut self,
        lone: Lone,
        near: f64,
        tree: &PointTree,
        settled: impl FnMut(Lone, u32),
    ) -> bool {
        if tree.any_within(lone.place, near) {
            return false;
        }
        let mut nearest = Nearest::new(lone.place);
        let _ = tree.visit(lone.place, &mut nearest);
        let node = nearest.unless_near(near);
        let Some(node) = node.filter(|&node| sees_no_other(lone.place, node, tree)) else {
            return false;
        };
        self.insert(node, lone, settled);
        true
    }

    fn insert(&mut self, node: Node, lone: Lone, mut settled: impl FnMut(Lone, u32)) {
        let next = self.cells.len();
        let number = *self
            .cell_numbers
            .entry(self.key(lone.place))
            .or_insert(next);
        if number == next {
            self.cells.push(Cell::default());
        }
        let basins = &mut self.cells[number].basins;
        if let Some(basin) = basins.iter_mut().find(|b| b.node.id == node.id) {
            basin.take_in(lone);
            basin.is_joined = false;
            settled(lone, basin.number);
        } else {
            let number = number_of_new(&mut self.nodes, &mut self.free);
            self.nodes[number as usize] = node.id;
            settled(lone, number);
            basins.push(Basin {
                number,
                has_changed: false,
                is_joined: false,
                ..Basin::new(node, lone)
            });
        }
    }

    /// Removes a source.
    pub(crate) fn remove(&mut self, lone: Lone) {
        if let Some(&number) = self.cell_numbers.get(&self.key(lone.place)) {
            for basin in &mut self.cells[number].basins {
                basin.lone.retain(|other| other.slot != lone.slot);
            }
        }
    }

    /// Takes in new nodes. Calls `settled` with each source whose basin has changed. Returns the
    /// sources that are no longer lone or have a node nearer than `near`.
    pub(crate) fn notice(
        &mut self,
        fresh: &FreshNodes,
        tree: &PointTree,
        near: f64,
        mut settled: impl FnMut(Lone, u32),
    ) -> Vec<Lone> {
        if self.cells.len() > MANY {
            let cells = self.cells.par_iter_mut().with_min_len(16);
            cells.for_each(|cell| cell.notice(fresh, tree, near));
        } else {
            for cell in &mut self.cells {
                cell.notice(fresh, tree, near);
            }
        }
        let mut leaving = Vec::new();
        for cell in &mut self.cells {
            if !std::mem::take(&mut cell.has_changed) {
                continue;
            }
            leaving.append(&mut cell.leaving);
            let freed = cell.freed.drain(..);
            self.free.extend(freed.filter(|&n| n != UNNUMBERED));
            for basin in &mut cell.basins {
                if basin.number == UNNUMBERED {
                    basin.number = number_of_new(&mut self.nodes, &mut self.free);
                }
                if std::mem::take(&mut basin.has_changed) {
                    self.nodes[basin.number as usize] = basin.node.id;
                }
                if std::mem::take(&mut basin.is_joined) {
                    basin
                        .lone
                        .iter()
                        .for_each(|&lone| settled(lone, basin.number));
                }
            }
        }
        leaving
    }

    /// Replaces each source's slot by the one that `slots` has for it.
    pub(crate) fn renumber(&mut self, slots: &[u32]) {
        let basins = self.cells.iter_mut().flat_map(|cell| &mut cell.basins);
        for lone in basins.flat_map(|basin| &mut basin.lone) {
            lone.slot = slots[lone.slot as usize];
        }
    }
}

/// A number for a new basin.
fn number_of_new(nodes: &mut Vec<u32>, free: &mut Vec<u32>) -> u32 {
    free.pop().unwrap_or_else(|| {
        nodes.push(0);
        nodes.len() as u32 - 1
    })
}
