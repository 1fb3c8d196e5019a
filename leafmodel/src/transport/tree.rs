//! A changing transport system, with every quantity of its cost kept up to date.
//!
//! Lengths and weights are in cells, so `h` is 1 here. In a **mirrored** tree only the cells with
//! `m ≥ 0` are kept: a cell off the axis stands for itself and its mirror image, and every change
//! applies to both.

use super::cells::{Cell, CellIndex, NONE};
use super::cost::turn;
use super::walls::{REACH, Walls};

/// The costs of turns between steps of up to this many columns and rows are tabulated.
const SHORT: i32 = 3;

/// Number of such steps, the zero step included.
const SHORT_STEPS: usize = (2 * SHORT as usize + 1) * (2 * SHORT as usize + 1);

/// Tables of both cost functions: turns between short steps, and `w^α` of integer weights.
#[derive(Clone, Debug)]
pub(crate) struct CostTables {
    alpha: f64,
    beta: f64,
    turns: Vec<f64>,
    powers: Vec<f64>,
}

impl CostTables {
    pub(crate) fn new(alpha: f64, beta: f64) -> Self {
        let reach = -SHORT..=SHORT;
        let steps: Vec<Cell> = reach
            .clone()
            .flat_map(|n| reach.clone().map(move |m| Cell::new(m, n)))
            .collect();
        let turns = steps
            .iter()
            .flat_map(|&u| steps.iter().map(move |&v| turn(beta, u, v)))
            .collect();
        Self {
            alpha,
            beta,
            turns,
            powers: vec![0.0],
        }
    }

    /// `H_β` of two steps.
    pub(crate) fn turn(&self, u: Cell, v: Cell) -> f64 {
        match (short(u), short(v)) {
            (Some(u), Some(v)) => self.turns[u * SHORT_STEPS + v],
            _ => turn(self.beta, u, v),
        }
    }

    /// Extends the table of powers to weights up to `most`.
    fn extend(&mut self, most: u32) {
        while self.powers.len() <= most as usize {
            self.powers
                .push(libm::pow(self.powers.len() as f64, self.alpha));
        }
    }

    /// `w^α`.
    pub(crate) fn power(&self, weight: u32) -> f64 {
        self.powers[weight as usize]
    }
}

fn short(step: Cell) -> Option<usize> {
    let (m, n) = (step.m + SHORT, step.n + SHORT);
    let within = 0..=2 * SHORT;
    (within.contains(&m) && within.contains(&n)).then(|| (n * (2 * SHORT + 1) + m) as usize)
}

/// A cell and the edge that leads to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) parent: u32,
    first_child: u32,
    next_sibling: u32,
    /// Number of edges between it and the root.
    pub(crate) depth: u32,
    /// `w(e_v)` in cells. In a mirrored tree, of this edge alone, without its mirror image.
    pub(crate) weight: u32,
    /// Number of cells of the leaf that it stands for: 2 off the axis of a mirrored tree, else 1.
    pub(crate) copies: u32,
    /// The step from its parent.
    pub(crate) step: Cell,
    /// Length of that step.
    pub(crate) length: f64,
    /// `m_β(v)`.
    pub(crate) multiple: f64,
    /// Cost of all edges beyond it, divided by `m_β(v)`: the paper's child(v)/`m_β(v)`. It does not
    /// depend on the way from the root.
    pub(crate) beyond: f64,
}

/// A growing transport system.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    pub(crate) cells: Vec<Cell>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) index: CellIndex,
    pub(crate) tables: CostTables,
    mirrored: bool,
    /// The given blade that cells must stay on, if any.
    walls: Option<Walls>,
}

impl Tree {
    /// The root alone (Eq. 3.7).
    pub(crate) fn new(alpha: f64, beta: f64, mirrored: bool) -> Self {
        let mut tree = Self {
            cells: Vec::new(),
            nodes: Vec::new(),
            index: CellIndex::new(),
            tables: CostTables::new(alpha, beta),
            mirrored,
            walls: None,
        };
        tree.push(Cell::ROOT);
        tree.refresh();
        tree
    }

    pub(crate) fn count(&self) -> u32 {
        self.nodes.len() as u32
    }

    pub(crate) fn is_mirrored(&self) -> bool {
        self.mirrored
    }

    /// `F` in units of `h^{2α+1}`; of the whole leaf if mirrored.
    pub(crate) fn cost(&self) -> f64 {
        self.nodes[0].beyond
    }

    /// The number of a cell, or of its mirror image in a mirrored tree.
    pub(crate) fn find(&self, cell: Cell) -> u32 {
        let kept = if self.mirrored && cell.m < 0 {
            cell.mirrored()
        } else {
            cell
        };
        self.index.get(kept)
    }

    /// Whether `u` may supply `v`. In a mirrored leaf no edge may cross the axis or lead to it from
    /// one side. On a given blade no edge may cross the margin.
    pub(crate) fn may_join(&self, u: Cell, v: Cell) -> bool {
        let keeps_sides = !self.mirrored || (u.m >= 0 && v.m >= 0 && (v.m > 0 || u.m == 0));
        keeps_sides && self.walls.as_ref().is_none_or(|walls| walls.allow(u, v))
    }

    /// Restricts cells from now on to a blade, on which all present cells must lie.
    pub(crate) fn enclose(&mut self, walls: Walls) {
        self.walls = Some(walls);
    }

    /// Greatest number of columns and rows that an edge may span, if limited.
    pub(crate) fn reach(&self) -> Option<i32> {
        self.walls.as_ref().map(|_| REACH)
    }

    /// Whether the leaf has a cell.
    pub(crate) fn has(&self, cell: Cell) -> bool {
        self.find(cell) != NONE
    }

    /// Whether a cell could be added here.
    pub(crate) fn is_free(&self, cell: Cell) -> bool {
        !self.has(cell) && self.walls.as_ref().is_none_or(|walls| walls.hold(cell))
    }

    fn push(&mut self, cell: Cell) {
        self.index.set(cell, self.count());
        self.cells.push(cell);
        self.nodes.push(Node {
            parent: NONE,
            first_child: NONE,
            next_sibling: NONE,
            depth: 0,
            weight: 1,
            copies: if self.mirrored && cell.m != 0 { 2 } else { 1 },
            step: Cell::UP,
            length: 1.0,
            multiple: 1.0,
            beyond: 0.0,
        });
    }

    /// Adds a cell at the end of an edge from `parent`. Costs are not valid until [`Tree::refresh`]
    /// is called.
    pub(crate) fn add(&mut self, cell: Cell, parent: u32) {
        let v = self.count();
        self.push(cell);
        self.link(v, parent);
        self.change_weights(parent, 1, self.nodes[v as usize].copies, true);
    }

    /// The children of a cell.
    pub(crate) fn children(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let mut next = self.nodes[v as usize].first_child;
        std::iter::from_fn(move || {
            let child = (next != NONE).then_some(next)?;
            next = self.nodes[child as usize].next_sibling;
            Some(child)
        })
    }

    /// A cell and all that it supplies, each after its parent.
    pub(crate) fn supplied_by(&self, v: u32, order: &mut Vec<u32>) {
        order.clear();
        order.push(v);
        let mut next = 0;
        while let Some(&v) = order.get(next) {
            next += 1;
            order.extend(self.children(v));
        }
    }

    /// Makes `parent` the parent of `v`, which has none.
    fn link(&mut self, v: u32, parent: u32) {
        let step = self.cells[v as usize] - self.cells[parent as usize];
        let sibling = std::mem::replace(&mut self.nodes[parent as usize].first_child, v);
        let node = &mut self.nodes[v as usize];
        node.parent = parent;
        node.next_sibling = sibling;
        node.step = step;
        node.length = step.length();
    }

    fn unlink(&mut self, v: u32) {
        let Node {
            parent,
            next_sibling,
            ..
        } = self.nodes[v as usize];
        let first = &mut self.nodes[parent as usize].first_child;
        if *first == v {
            *first = next_sibling;
            return;
        }
        let mut before = *first;
        while self.nodes[before as usize].next_sibling != v {
            before = self.nodes[before as usize].next_sibling;
        }
        self.nodes[before as usize].next_sibling = next_sibling;
    }

    /// Adds `weight` times `copies` to all edges from the root to `v` if `more`, else subtracts it.
    fn change_weights(&mut self, v: u32, weight: u32, copies: u32, more: bool) {
        let mut z = v;
        while z != NONE {
            let node = &mut self.nodes[z as usize];
            let share = weight * copies / node.copies;
            if more {
                node.weight += share;
            } else {
                node.weight -= share;
            }
            z = node.parent;
        }
        self.tables.extend(self.nodes[0].weight + 1);
    }

    /// Computes depths, multiples and costs of the whole tree anew.
    pub(crate) fn refresh(&mut self) {
        self.tables.extend(self.nodes[0].weight + 1);
        let mut order = Vec::with_capacity(self.nodes.len());
        self.supplied_by(0, &mut order);
        for &v in &order {
            self.inherit(v);
        }
        for &v in order.iter().rev() {
            self.add_up(v);
        }
    }

    /// Depth and multiple of `v` from its parent's.
    fn inherit(&mut self, v: u32) {
        let node = self.nodes[v as usize];
        if node.parent != NONE {
            let parent = self.nodes[node.parent as usize];
            let turned = self.tables.turn(node.step, parent.step);
            self.nodes[v as usize].depth = parent.depth + 1;
            self.nodes[v as usize].multiple = parent.multiple * turned;
        }
    }

    /// Cost beyond `v` from its children's.
    fn add_up(&mut self, v: u32) {
        let node = self.nodes[v as usize];
        self.nodes[v as usize].beyond = self.beyond_after(v, node.step);
    }

    /// The cost beyond `v` divided by its multiple, if `step` led to it.
    pub(crate) fn beyond_after(&self, v: u32, step: Cell) -> f64 {
        let copies = self.nodes[v as usize].copies;
        self.children(v)
            .map(|child| {
                let child = &self.nodes[child as usize];
                let times = if child.copies == copies { 1.0 } else { 2.0 };
                let edge = self.tables.power(child.weight) * child.length;
                times * self.tables.turn(child.step, step) * (edge + child.beyond)
            })
            .sum()
    }

    /// Supplies `v` from `u` instead of its parent; `scratch` is a buffer kept for reuse.
    pub(crate) fn reparent(&mut self, v: u32, u: u32, scratch: &mut Vec<u32>) {
        let Node {
            parent: old,
            weight,
            copies,
            ..
        } = self.nodes[v as usize];
        self.change_weights(old, weight, copies, false);
        self.unlink(v);
        self.link(v, u);
        self.change_weights(u, weight, copies, true);
        self.supplied_by(v, scratch);
        for &z in scratch.iter() {
            self.inherit(z);
        }
        self.add_up(v);
        // Both ways to the root, up to the cell where they meet; the common part is counted once.
        let (mut a, mut b) = (old, u);
        while a != b {
            if self.nodes[a as usize].depth >= self.nodes[b as usize].depth {
                self.add_up(a);
                a = self.nodes[a as usize].parent;
            } else {
                self.add_up(b);
                b = self.nodes[b as usize].parent;
            }
        }
        while a != NONE {
            self.add_up(a);
            a = self.nodes[a as usize].parent;
        }
    }

    /// `P_G(h², v)` of all cells in units of `h^{2α+1}`: the extra cost, on the way to `v`, of one
    /// more cell at `v`.
    pub(crate) fn potentials(&self, potentials: &mut Vec<f64>, order: &mut Vec<u32>) {
        self.supplied_by(0, order);
        potentials.clear();
        potentials.resize(self.nodes.len(), 0.0);
        for &v in &order[1..] {
            let node = &self.nodes[v as usize];
            let more = self.tables.power(node.weight + 1) - self.tables.power(node.weight);
            potentials[v as usize] =
                potentials[node.parent as usize] + node.multiple * node.length * more;
        }
    }
}
