//! Local optimisation: gives each cell its best parent until no cell has a better one (section 2.2
//! of \[xia2007\]).

mod settled;
#[cfg(test)]
mod tests;

use self::settled::Settled;
use super::cells::{AROUND, Cell, NONE};
use super::tree::{Node, Tree};

/// A parent is better if it saves more than this share of the cost of supply from the present
/// parent. Smaller savings may be rounding errors and could repeat without end.
const SAVING: f64 = 1e-11;

/// Greatest number of passes over all cells. Every change of parent lowers the cost, so passes end
/// much earlier; the bound guards against rounding.
const MOST_PASSES: usize = 1000;

/// The local optimiser, with buffers that are kept for reuse.
#[derive(Clone, Debug, Default)]
pub(crate) struct Optimiser {
    /// Which cells may have a better parent.
    open: Vec<bool>,
    /// For each cell the evaluation in which `relative` was last written.
    stamps: Vec<u32>,
    stamp: u32,
    /// `P_{G0}(weight, u)` minus that of the present parent.
    relative: Vec<f64>,
    /// The cell up to which the way from the present parent to the root has been followed.
    top: u32,
    settled: Settled,
    way: Vec<u32>,
    subtree: Vec<u32>,
    tried: Vec<u32>,
    /// Number of changes of parent so far.
    pub(crate) changes: u64,
}

/// The cell whose possible parents are compared.
struct Candidate<'a> {
    tree: &'a Tree,
    node: Node,
    v: u32,
    has_children: bool,
}

impl Candidate<'_> {
    /// The part of `K(u)` that lies beyond `u`: the edge to `v` and all beyond it. Infinite if a
    /// turn is a right angle or more.
    fn beyond(&self, u: u32, step: Cell) -> f64 {
        let parent = &self.tree.nodes[u as usize];
        let turned = self.tree.tables.turn(step, parent.step);
        if turned == f64::INFINITY {
            return turned;
        }
        let further = if self.has_children {
            self.tree.beyond_after(self.v, step)
        } else {
            0.0
        };
        let edge = self.tree.tables.power(self.node.weight) * step.length();
        f64::from(self.node.copies) * parent.multiple * turned * (further + edge)
    }

    /// The share of the weight of `v` in the cost of the edge to `z`: if `there`, of the weight
    /// that already includes it, else if it were added.
    fn share(&self, z: u32, there: bool) -> f64 {
        let node = &self.tree.nodes[z as usize];
        let weight = self.node.weight * self.node.copies / node.copies;
        let (more, less) = if there {
            (node.weight, node.weight - weight)
        } else {
            (node.weight + weight, node.weight)
        };
        let saved = self.tree.tables.power(more) - self.tree.tables.power(less);
        f64::from(node.copies) * node.multiple * node.length * saved
    }
}

impl Optimiser {
    /// Steps 2 to 4: gives each cell its best parent, youngest first; then repeats that for cells
    /// whose surroundings have changed, until nothing changes; then goes through all cells again,
    /// until every cell has its best parent.
    pub(crate) fn run(&mut self, tree: &mut Tree) {
        let count = tree.nodes.len();
        self.stamps.resize(count, 0);
        self.relative.resize(count, 0.0);
        self.open.clear();
        self.open.resize(count, true);
        self.settled.take_in_new_cells(tree);
        let mut all = true;
        for _ in 0..MOST_PASSES {
            let mut changed = false;
            for v in (1..count as u32).rev() {
                let is_open = std::mem::replace(&mut self.open[v as usize], false);
                if !is_open || self.settled.has(v) {
                    continue;
                }
                if let Some(u) = self.better_parent(tree, v) {
                    self.change(tree, v, u);
                    changed = true;
                } else {
                    self.settled.insert(v, self.top);
                }
            }
            if !changed {
                if all {
                    break;
                }
                self.open.fill(true);
            }
            all = !changed;
        }
    }

    /// The parent of `v` that minimises `K`; `None` if the present one is as good.
    ///
    /// The paper prints `K(u)` with the potential of the graph in which `u` already is the parent.
    /// The potential must be that of `G0`, the graph without `v`: only then is `K` the increase of
    /// the cost. Common terms are left out, namely everything above the cell where the ways to two
    /// parents part.
    pub(crate) fn better_parent(&mut self, tree: &Tree, v: u32) -> Option<u32> {
        let cell = tree.cells[v as usize];
        let node = tree.nodes[v as usize];
        let candidate = Candidate {
            tree,
            node,
            v,
            has_children: tree.children(v).next().is_some(),
        };
        self.start(v, node.parent);
        self.top = node.parent;
        let current = candidate.beyond(node.parent, node.step);
        let mut best = (current * (1.0 - SAVING), None);
        let parent_cell = tree.cells[node.parent as usize];
        self.tried.clear();
        let near = AROUND.iter().map(|&step| (cell + step, false));
        let near_parent = AROUND.iter().map(|&step| (parent_cell + step, true));
        for (place, by_parent) in near.chain(near_parent) {
            let step = cell - place;
            if by_parent && step.squared() < 4 || !tree.may_join(place, cell) {
                continue;
            }
            let u = tree.index.get(place);
            if u == NONE || u == node.parent {
                continue;
            }
            let beyond = candidate.beyond(u, step);
            if beyond == f64::INFINITY {
                continue;
            }
            let k = beyond + self.relative_potential(&candidate, u);
            if k < best.0 {
                best = (k, Some(u));
            }
        }
        best.1
    }

    fn start(&mut self, v: u32, parent: u32) {
        if self.stamp == u32::MAX {
            self.stamps.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        // The cells that v supplies cannot supply v.
        self.know(v, f64::INFINITY);
        self.know(parent, 0.0);
    }

    fn know(&mut self, z: u32, value: f64) {
        self.stamps[z as usize] = self.stamp;
        self.relative[z as usize] = value;
    }

    /// `P_{G0}(weight, u)` minus that of the present parent.
    fn relative_potential(&mut self, candidate: &Candidate, u: u32) -> f64 {
        let nodes = &candidate.tree.nodes;
        self.way.clear();
        let mut z = u;
        loop {
            while nodes[self.top as usize].depth > nodes[z as usize].depth {
                let top = self.top;
                let value = self.relative[top as usize] - candidate.share(top, true);
                self.top = nodes[top as usize].parent;
                self.know(self.top, value);
            }
            if self.stamps[z as usize] == self.stamp {
                break;
            }
            self.way.push(z);
            z = nodes[z as usize].parent;
        }
        let mut value = self.relative[z as usize];
        while let Some(z) = self.way.pop() {
            // Cells that v supplies are no candidates, so nothing is computed for them.
            if value < f64::INFINITY {
                value += candidate.share(z, false);
            }
            self.know(z, value);
        }
        value
    }

    /// Changes the parent of `v`, and marks as open the cells whose best parent this affects most:
    /// those around the cells that `v` supplies and around the old and the new way to `v`.
    fn change(&mut self, tree: &mut Tree, v: u32, u: u32) {
        let old = tree.nodes[v as usize].parent;
        let mut subtree = std::mem::take(&mut self.subtree);
        tree.reparent(v, u, &mut subtree);
        for &z in &subtree {
            self.open_about(tree, z);
        }
        self.settled.heed_change(tree, old, v, &subtree);
        self.subtree = subtree;
        let (mut a, mut b) = (old, u);
        while a != b {
            let deeper = if tree.nodes[a as usize].depth >= tree.nodes[b as usize].depth {
                &mut a
            } else {
                &mut b
            };
            self.open_about(tree, *deeper);
            *deeper = tree.nodes[*deeper as usize].parent;
        }
        self.changes += 1;
    }

    fn open_about(&mut self, tree: &Tree, z: u32) {
        let cell = tree.cells[z as usize];
        for place in std::iter::once(cell).chain(cell.neighbours()) {
            let near = tree.index.get(place);
            if near != NONE {
                self.open[near as usize] = true;
            }
        }
    }
}
