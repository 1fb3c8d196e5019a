//! Cells that need not be looked at again: nothing that their comparison of parents has read has changed.
//!
//! A comparison reads the cells around a cell and its parent, and the ways from all possible parents up to
//! the cell where they meet, the **top**. All of these lie below the top, so a cell is settled until
//! something below its top changes.

use super::super::cells::NONE;
use super::super::tree::Tree;

/// Which cells are settled. It holds for one tree, all of whose changes it has to be shown.
#[derive(Clone, Debug, Default)]
pub(super) struct Settled {
    /// Number of the last change.
    change: u64,
    /// For each cell the last change below it, or of its own place in the tree.
    changed: Vec<u64>,
    /// For each cell the top of its last comparison, and the last change before it; [`NONE`] if there
    /// is no such comparison.
    compared: Vec<(u32, u64)>,
}

impl Settled {
    /// Whether a cell would keep its parent if it were compared again.
    pub(super) fn has(&self, v: u32) -> bool {
        let (top, change) = self.compared[v as usize];
        top != NONE && self.changed[top as usize] <= change
    }

    /// Notes that a cell keeps its parent.
    pub(super) fn insert(&mut self, v: u32, top: u32) {
        self.compared[v as usize] = (top, self.change);
    }

    /// Heeds the cells that a tree has gained.
    pub(super) fn take_in_new_cells(&mut self, tree: &Tree) {
        self.change += 1;
        let known = self.compared.len() as u32;
        self.changed.resize(tree.nodes.len(), self.change);
        self.compared.resize(tree.nodes.len(), (NONE, 0));
        for v in known..tree.count() {
            self.change_above(tree, tree.nodes[v as usize].parent);
            self.unsettle_about(tree, v);
        }
    }

    /// Heeds that `v`, which now supplies `subtree`, had the parent `old`.
    pub(super) fn heed_change(&mut self, tree: &Tree, old: u32, v: u32, subtree: &[u32]) {
        self.change += 1;
        for &z in subtree {
            self.changed[z as usize] = self.change;
        }
        self.change_above(tree, old);
        self.change_above(tree, tree.nodes[v as usize].parent);
        self.unsettle_about(tree, v);
    }

    /// Notes a change below `z` and all cells on its way to the root.
    fn change_above(&mut self, tree: &Tree, z: u32) {
        let mut z = z;
        while z != NONE && self.changed[z as usize] != self.change {
            self.changed[z as usize] = self.change;
            z = tree.nodes[z as usize].parent;
        }
    }

    /// Unsettles the cells that may have `v` as a parent, whether or not they could before.
    fn unsettle_about(&mut self, tree: &Tree, v: u32) {
        let cell = tree.cells[v as usize];
        for place in std::iter::once(cell).chain(cell.neighbours()) {
            let near = tree.index.get(place);
            if near != NONE {
                self.compared[near as usize].0 = NONE;
                for child in tree.children(near) {
                    self.compared[child as usize].0 = NONE;
                }
            }
        }
    }
}
