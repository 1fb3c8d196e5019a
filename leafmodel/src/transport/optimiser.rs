//! Better parents, cell by cell, until none has a better one (section 2.2 of \[xia2007\]).

use super::cells::{AROUND, Cell, NONE};
use super::tree::{Node, Tree};

/// A parent is better if it saves more than this share of what it costs to supply a cell from its parent. Less is rounding, and
/// could go round in circles.
const SAVING: f64 = 1e-11;

/// Passes over all cells. Every change of parent lowers the cost, so passes come to an end long before;
/// the bound only guards against rounding.
const MOST_PASSES: usize = 1000;

/// The local optimiser, with the memory that it uses again and again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Optimiser {
    /// Which cells may have a better parent.
    open: Vec<bool>,
    /// In which evaluation `relative` was last written.
    stamps: Vec<u32>,
    stamp: u32,
    /// `P_{G0}(weight, u)`, less the same for the present parent.
    relative: Vec<f64>,
    way: Vec<u32>,
    subtree: Vec<u32>,
    tried: Vec<u32>,
    /// Changes of parent so far.
    pub(crate) changes: u64,
}

/// What is known of a cell while its parents are compared.
struct Candidate<'a> {
    tree: &'a Tree,
    node: Node,
    v: u32,
    has_children: bool,
}

impl Candidate<'_> {
    /// The part of `K(u)` that lies beyond `u`: `v`'s own edge and all beyond it. Infinite if water cannot turn so far.
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

    /// What the weight of `v` costs on the edge to `z`: as it is there now, or if it came to it.
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
    /// Steps 2 to 4: goes through all cells, youngest first, giving each its best parent; then again through those about which
    /// something has changed, until nothing does; then through all once more, and so on until all have the best.
    pub(crate) fn run(&mut self, tree: &mut Tree) {
        let count = tree.nodes.len();
        self.stamps.resize(count, 0);
        self.relative.resize(count, 0.0);
        self.open.clear();
        self.open.resize(count, true);
        let mut all = true;
        for _ in 0..MOST_PASSES {
            let mut changed = false;
            for v in (1..count as u32).rev() {
                if !std::mem::replace(&mut self.open[v as usize], false) {
                    continue;
                }
                if let Some(u) = self.better_parent(tree, v) {
                    self.change(tree, v, u);
                    changed = true;
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

    /// The parent of `v` that minimises `K`, if that saves anything.
    ///
    /// The paper prints `K(u)` with the potential of the graph in which `u` already is the parent. It is meant in `G0`,
    /// from which `v` has been taken: only then is `K` what the cost rises by. Common terms are left out: all that lies above
    /// the cell where the ways of two parents part.
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
        let mut top = node.parent;
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
            let k = beyond + self.relative_potential(&candidate, u, &mut top);
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
        // What v supplies cannot supply v.
        self.know(v, f64::INFINITY);
        self.know(parent, 0.0);
    }

    fn know(&mut self, z: u32, value: f64) {
        self.stamps[z as usize] = self.stamp;
        self.relative[z as usize] = value;
    }

    /// `P_{G0}(weight, u)` less that of the present parent. `top` is how far up the way from that parent has been followed.
    fn relative_potential(&mut self, candidate: &Candidate, u: u32, top: &mut u32) -> f64 {
        let nodes = &candidate.tree.nodes;
        self.way.clear();
        let mut z = u;
        loop {
            while nodes[*top as usize].depth > nodes[z as usize].depth {
                let value = self.relative[*top as usize] - candidate.share(*top, true);
                *top = nodes[*top as usize].parent;
                self.know(*top, value);
            }
            if self.stamps[z as usize] == self.stamp {
                break;
            }
            self.way.push(z);
            z = nodes[z as usize].parent;
        }
        let mut value = self.relative[z as usize];
        while let Some(z) = self.way.pop() {
            value += candidate.share(z, false);
            self.know(z, value);
        }
        value
    }

    /// Changes the parent of `v`, and opens all cells whose choice that may alter most: about those it supplies,
    /// and about both ways to it.
    fn change(&mut self, tree: &mut Tree, v: u32, u: u32) {
        let old = tree.nodes[v as usize].parent;
        let mut subtree = std::mem::take(&mut self.subtree);
        tree.reparent(v, u, &mut subtree);
        for &z in &subtree {
            self.open_about(tree, z);
        }
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

#[cfg(test)]
mod tests {
    use super::super::cost::TransportSystem;
    use super::super::leaf::unfolded;
    use super::super::plan::TransportPlan;
    use super::*;

    fn grown(plan: &TransportPlan, epsilon: f64) -> Tree {
        let mut growth = plan.seedling(1);
        growth.settle(epsilon).expect("below the limit");
        growth.tree
    }

    /// `F` by definition of cells with these parents, in cells; infinite if the parents run in a circle.
    fn cost(plan: &TransportPlan, cells: &[Cell], parents: &[u32]) -> f64 {
        for start in 0..cells.len() {
            let (mut v, mut steps) = (start, 0);
            while v != 0 && steps <= cells.len() {
                v = parents[v] as usize;
                steps += 1;
            }
            if steps > cells.len() {
                return f64::INFINITY;
            }
        }
        TransportSystem::new(cells, parents, [plan.alpha, plan.beta, 1.0]).cost()
    }

    /// `Q_v`: the cells shorter than two cells away from `v` or its parent.
    fn admissible(cells: &[Cell], parents: &[u32], v: usize) -> Vec<u32> {
        let parent = cells[parents[v] as usize];
        let near = |u: Cell| (u - cells[v]).squared() < 4 || (u - parent).squared() < 4;
        (0..cells.len() as u32)
            .filter(|&u| u as usize != v && near(cells[u as usize]))
            .collect()
    }

    #[test]
    fn no_single_parent_can_be_changed_to_make_a_leaf_cheaper() {
        for (alpha, beta, epsilon) in [(0.55, 0.5, 3.0), (0.7, 0.1, 4.0), (0.85, 1.5, 9.0)] {
            let plan = TransportPlan {
                alpha,
                beta,
                mirrored: false,
                ..TransportPlan::default()
            };
            let (cells, parents, _) = unfolded(&grown(&plan, epsilon));
            let now = cost(&plan, &cells, &parents);
            assert!(cells.len() > 30);
            for v in 1..cells.len() {
                for u in admissible(&cells, &parents, v) {
                    let mut other = parents.clone();
                    other[v] = u;
                    let then = cost(&plan, &cells, &other);
                    assert!(then >= now * (1.0 - 1e-10), "{v} from {u}: {then} < {now}");
                }
            }
        }
    }

    #[test]
    fn no_pair_of_parents_can_be_changed_to_make_a_mirrored_leaf_cheaper() {
        let plan = TransportPlan {
            alpha: 0.6,
            ..TransportPlan::default()
        };
        let (cells, parents, _) = unfolded(&grown(&plan, 2.5));
        let image = |v: u32| {
            let cell = cells[v as usize].mirrored();
            cells.iter().position(|&c| c == cell).expect("an image") as u32
        };
        let now = cost(&plan, &cells, &parents);
        for v in (1..cells.len()).filter(|&v| cells[v].m > 0) {
            for u in admissible(&cells, &parents, v) {
                if cells[u as usize].m < 0 {
                    continue;
                }
                let mut other = parents.clone();
                other[v] = u;
                other[image(v as u32) as usize] = image(u);
                let then = cost(&plan, &cells, &other);
                assert!(then >= now * (1.0 - 1e-10), "{v} from {u}: {then} < {now}");
            }
        }
    }

    #[test]
    fn a_mirrored_leaf_is_hardly_dearer_than_changes_on_one_side_could_make_it() {
        for (alpha, beta, epsilon) in [(0.6, 0.5, 5.0), (0.64, 0.15, 4.0), (0.5, 0.8, 3.5)] {
            let plan = TransportPlan {
                alpha,
                beta,
                ..TransportPlan::default()
            };
            let mirrored = grown(&plan, epsilon);
            let (cells, parents, _) = unfolded(&mirrored);
            let mut free = Tree::new(alpha, beta, false);
            let system = TransportSystem::new(&cells, &parents, [alpha, beta, 1.0]);
            for v in system.root_to_tip().into_iter().skip(1) {
                free.add(cells[v], free.find(cells[parents[v] as usize]));
            }
            free.refresh();
            assert!((free.cost() / mirrored.cost() - 1.0).abs() < 1e-12);
            let mut optimiser = Optimiser::default();
            optimiser.run(&mut free);
            let saved = 1.0 - free.cost() / mirrored.cost();
            assert!((0.0..0.005).contains(&saved), "{saved}");
        }
    }

    #[test]
    fn every_change_of_parent_saves_what_the_definition_says() {
        for mirrored in [false, true] {
            let plan = TransportPlan {
                mirrored,
                ..TransportPlan::default()
            };
            let mut tree = grown(&plan, 3.0);
            // Spoil it: some cells get the parent of their parent, as far as water can turn so.
            let mut scratch = Vec::new();
            for v in (1..tree.count()).step_by(2) {
                let parent = tree.nodes[v as usize].parent;
                let before = tree.nodes[parent as usize].parent;
                if before != NONE
                    && tree.may_join(tree.cells[before as usize], tree.cells[v as usize])
                {
                    let spoilt = tree.clone();
                    tree.reparent(v, before, &mut scratch);
                    if tree.cost() == f64::INFINITY {
                        tree = spoilt;
                    }
                }
            }
            let mut optimiser = Optimiser::default();
            let spoilt = tree.cost();
            let definition = |tree: &Tree| {
                let (cells, parents, _) = unfolded(tree);
                cost(&plan, &cells, &parents)
            };
            assert!((definition(&tree) / spoilt - 1.0).abs() < 1e-12);
            optimiser.stamps.resize(tree.nodes.len(), 0);
            optimiser.relative.resize(tree.nodes.len(), 0.0);
            let mut changes = 0;
            for v in (1..tree.count()).rev() {
                let before = definition(&tree);
                if let Some(u) = optimiser.better_parent(&tree, v) {
                    tree.reparent(v, u, &mut scratch);
                    let after = definition(&tree);
                    assert!(after < before, "{v}: {after} is no saving on {before}");
                    assert!((tree.cost() / after - 1.0).abs() < 1e-12);
                    changes += 1;
                }
            }
            assert!(changes > 5);
        }
    }

    #[test]
    fn small_leaves_cost_little_more_than_the_cheapest_of_all_systems() {
        // Six cells and the root: all choices of parents, 6⁶ with the circles.
        let plan = TransportPlan {
            mirrored: false,
            ..TransportPlan::default()
        };
        let tree = {
            let mut growth = plan.seedling(1);
            growth.settle(1.5).expect("below the limit");
            growth.tree
        };
        let (cells, parents, _) = unfolded(&tree);
        let count = cells.len().min(7);
        let cells = &cells[..count];
        assert!(
            parents[..count]
                .iter()
                .skip(1)
                .all(|&p| (p as usize) < count)
        );
        let ours = cost(&plan, cells, &parents[..count]);
        let mut best = f64::INFINITY;
        for code in 0..(count as u32).pow(count as u32 - 1) {
            let digit = |v: u32| code / (count as u32).pow(v - 1) % count as u32;
            let others: Vec<u32> = (0..count as u32)
                .map(|v| if v == 0 { NONE } else { digit(v) })
                .collect();
            if (1..count).all(|v| others[v] as usize != v) {
                best = best.min(cost(&plan, cells, &others));
            }
        }
        assert!(ours >= best * (1.0 - 1e-12));
        assert!(ours <= best * 1.02, "{ours} against {best}");
    }
}
