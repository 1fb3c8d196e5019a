//! The cost of transport, computed from its definitions.
//!
//! [`TransportSystem`] computes everything from cells and parents, as the paper defines it. The
//! growing leaf keeps the same quantities up to date in a `Tree`; tests compare the two.

use super::cells::{Cell, NONE};
use crate::buckets::Buckets;

/// `H_β(u, v) = (u · v)^{−β}` of the directions of two steps, infinite from a right angle on.
///
/// Computed from integers, so that mirror images cost the same to the last bit.
pub(crate) fn turn(beta: f64, u: Cell, v: Cell) -> f64 {
    let dot = u.dot(v);
    if dot <= 0 {
        return f64::INFINITY;
    }
    let (dot, squares) = (dot as f64, u.squared() as f64 * v.squared() as f64);
    // For parallel steps the cosine is exactly 1; rounding could give a little less.
    if dot * dot == squares {
        return 1.0;
    }
    libm::pow(squares / (dot * dot), 0.5 * beta)
}

/// A transport system (Definition 2.1 of \[xia2007\]): cells, and for each the cell that supplies
/// it. Cell 0 is the root; its parent is ignored.
///
/// Lengths are in the unit of `h`; a cell has weight `h²`.
#[derive(Clone, Copy, Debug)]
pub struct TransportSystem<'a> {
    cells: &'a [Cell],
    parents: &'a [u32],
    alpha: f64,
    beta: f64,
    h: f64,
}

impl<'a> TransportSystem<'a> {
    /// A system of cells and the numbers of their parents, with the parameters of its cost. From
    /// every cell, parents must lead back to cell 0; [`crate::transport::TransportLeaf`] guarantees
    /// that.
    pub(crate) fn new(cells: &'a [Cell], parents: &'a [u32], [alpha, beta, h]: [f64; 3]) -> Self {
        Self {
            cells,
            parents,
            alpha,
            beta,
            h,
        }
    }

    /// The numbers of all cells, each after its parent.
    pub(crate) fn root_to_tip(&self) -> Vec<usize> {
        let children = (1..self.cells.len()).map(|v| (self.parents[v] as usize, v));
        let children = Buckets::new(self.cells.len(), children);
        let mut order = vec![0];
        let mut next = 0;
        while let Some(&v) = order.get(next) {
            next += 1;
            order.extend(children.list(v));
        }
        order
    }

    /// `w(e_v)` in cells: how many cells are supplied through each cell, itself included (Eq. 2.4).
    /// For the root it is the total number of cells.
    pub fn counts(&self) -> Vec<u32> {
        let mut counts = vec![1; self.cells.len()];
        for &v in self.root_to_tip().iter().rev() {
            if v != 0 {
                counts[self.parents[v] as usize] += counts[v];
            }
        }
        counts
    }

    /// `m_β(v)`, ≥ 1: the product of the costs of all turns on the way from the root (Eq. 2.6); 1
    /// at the root.
    pub fn multiples(&self) -> Vec<f64> {
        let mut multiples = vec![1.0; self.cells.len()];
        for v in self.root_to_tip() {
            if v != 0 {
                let p = self.parents[v] as usize;
                multiples[v] = multiples[p] * turn(self.beta, self.step(v), self.step(p));
            }
        }
        multiples
    }

    /// `F(G) = Σ_v m_β(v) w(e_v)^α length(e_v)` (Definition 2.2).
    pub fn cost(&self) -> f64 {
        let (counts, multiples) = (self.counts(), self.multiples());
        (1..self.cells.len())
            .map(|v| {
                let weight = f64::from(counts[v]) * self.h * self.h;
                multiples[v] * libm::pow(weight, self.alpha) * self.step(v).length() * self.h
            })
            .sum()
    }

    /// `P_G(x, v)` for all `v` (Definition 2.3): the extra cost, on the way from the root to `v`,
    /// of an additional weight `x` at `v`; 0 at the root.
    #[cfg(test)]
    pub(crate) fn potentials(&self, x: f64) -> Vec<f64> {
        let (counts, multiples) = (self.counts(), self.multiples());
        let mut potentials = vec![0.0; self.cells.len()];
        for v in self.root_to_tip() {
            if v != 0 {
                let weight = f64::from(counts[v]) * self.h * self.h;
                let more = libm::pow(weight + x, self.alpha) - libm::pow(weight, self.alpha);
                potentials[v] = potentials[self.parents[v] as usize]
                    + multiples[v] * more * self.step(v).length() * self.h;
            }
        }
        potentials
    }

    /// `C_Ω(x)` by brute force over all cells that have a neighbour outside and the root (Eq. 3.2);
    /// infinite if no cell can supply it.
    #[cfg(test)]
    pub(crate) fn expense(&self, x: Cell) -> f64 {
        let has = |cell: Cell| self.cells.contains(&cell);
        let (multiples, potentials) = (self.multiples(), self.potentials(self.h * self.h));
        let mass = libm::pow(self.h * self.h, self.alpha);
        (0..self.cells.len())
            .filter(|&b| b == 0 || !self.cells[b].neighbours().all(has))
            .map(|b| {
                let step = x - self.cells[b];
                let turned = turn(self.beta, step, self.step(b));
                mass * step.length() * self.h * multiples[b] * turned + potentials[b]
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// The step that leads to a cell; for the root, the direction in which water leaves it.
    fn step(&self, v: usize) -> Cell {
        match self.parents.get(v) {
            Some(&p) if v != 0 && p != NONE => self.cells[v] - self.cells[p as usize],
            _ => Cell::UP,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_costs_nothing_straight_on_and_everything_from_a_right_angle_on() {
        assert_eq!(turn(0.7, Cell::new(2, 4), Cell::new(1, 2)), 1.0);
        assert_eq!(turn(0.7, Cell::UP, Cell::new(3, 0)), f64::INFINITY);
        assert_eq!(turn(0.7, Cell::UP, Cell::new(3, -1)), f64::INFINITY);
        let half_right = turn(0.7, Cell::UP, Cell::new(-1, 1));
        assert!((half_right - libm::pow(2.0, 0.35)).abs() < 1e-15);
        assert_eq!(half_right, turn(0.7, Cell::UP, Cell::new(1, 1)));
    }

    #[test]
    fn a_forked_system_costs_what_pencil_and_paper_say() {
        // A stem of two cells, with a cell on either side of its end.
        let cells = [(0, 0), (0, 1), (-1, 2), (1, 2)].map(|(m, n)| Cell::new(m, n));
        let parents = [NONE, 0, 1, 1];
        let system = TransportSystem::new(&cells, &parents, [0.5, 1.0, 2.0]);
        assert_eq!(system.counts(), [4, 3, 1, 1]);
        let (root_2, root_12) = (2.0_f64.sqrt(), 12.0_f64.sqrt());
        assert!((system.multiples()[2] - root_2).abs() < 1e-15);
        // Stem: 12^½ · 2; sides: √2 · 4^½ · 2√2 each.
        assert!((system.cost() - (2.0 * root_12 + 2.0 * 8.0)).abs() < 1e-12);
        let stem = 2.0 * (4.0 - root_12);
        let side = 4.0 * (8.0_f64.sqrt() - 2.0);
        assert_eq!(system.potentials(4.0)[0], 0.0);
        assert!((system.potentials(4.0)[1] - stem).abs() < 1e-12);
        assert!((system.potentials(4.0)[3] - (stem + side)).abs() < 1e-12);
        // The cell ahead is supplied from the stem: 4^½ · 2 more than the stem's own potential.
        assert!((system.expense(Cell::new(0, 2)) - (4.0 + stem)).abs() < 1e-12);
        assert_eq!(system.expense(Cell::new(0, -1)), f64::INFINITY);
    }
}
