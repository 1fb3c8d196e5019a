//! Growth: a cell is added where its revenue exceeds the cost of its transport (section 3 of
//! \[xia2007\]).

use super::cells::{Cell, CellIndex, NONE};
use super::optimiser::Optimiser;
use super::revenue::Revenue;
use super::tree::Tree;

/// Share by which a cell's revenue may fall short of its cost, to allow for rounding.
const BREAK_EVEN: f64 = 1e-12;

/// The leaf has grown beyond its greatest number of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Outgrown {
    /// Number of cells that it would have, at least.
    pub(crate) cells: usize,
}

/// A growing leaf. Lengths and weights are in cells, so `ε` stands for `ε h^{1−2α}`.
#[derive(Clone, Debug)]
pub(crate) struct Growth {
    pub(crate) tree: Tree,
    pub(crate) optimiser: Optimiser,
    revenue: Revenue,
    most_cells: usize,
    /// For each cell the number of the application of `L` that added it.
    pub(crate) generations: Vec<u32>,
    generation: u32,
    /// Steps in the order of their length, up to the greatest length needed so far.
    disc: Vec<(f64, Cell)>,
    disc_radius: f64,
    potentials: Vec<f64>,
    order: Vec<u32>,
    /// The cells added last, in the order of their numbers.
    pub(crate) offers: Vec<Offer>,
    offered: CellIndex,
}

/// A cell that could be supplied.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Offer {
    pub(crate) cell: Cell,
    /// `C_Ω(x)` in units of `h^{2α+1}`.
    pub(crate) expense: f64,
    /// `b(x)`, the cell that would supply it.
    pub(crate) parent: u32,
    step: Cell,
}

impl Growth {
    /// The growth of a leaf that consists of the root alone.
    pub(crate) fn new(
        [alpha, beta]: [f64; 2],
        mirrored: bool,
        revenue: Revenue,
        most_cells: usize,
    ) -> Self {
        Self {
            tree: Tree::new(alpha, beta, mirrored),
            optimiser: Optimiser::default(),
            revenue,
            most_cells,
            generations: vec![0],
            generation: 0,
            disc: Vec::new(),
            disc_radius: 0.0,
            potentials: Vec::new(),
            order: Vec::new(),
            offers: Vec::new(),
            offered: CellIndex::new(),
        }
    }

    /// Number of cells of the whole leaf.
    pub(crate) fn cells(&self) -> usize {
        self.tree.nodes[0].weight as usize
    }

    /// The map `L` (Eqs. 3.3, 3.4): adds all cells whose revenue covers their cost, each at the end
    /// of its cheapest edge, and optimises the network. Returns the number of cells added, counted
    /// in the whole leaf.
    pub(crate) fn apply(&mut self, epsilon: f64) -> Result<usize, Outgrown> {
        self.select(epsilon)?;
        let before = self.cells();
        if self.offers.is_empty() {
            return Ok(0);
        }
        self.generation += 1;
        let mut offers = std::mem::take(&mut self.offers);
        offers.sort_unstable_by(|a, b| {
            let place = |offer: &Offer| (offer.cell.squared(), offer.cell.n, offer.cell.m);
            a.expense
                .total_cmp(&b.expense)
                .then_with(|| place(a).cmp(&place(b)))
        });
        for offer in &offers {
            self.tree.add(offer.cell, offer.parent);
            self.generations.push(self.generation);
        }
        self.offers = offers;
        self.tree.refresh();
        self.optimiser.run(&mut self.tree);
        Ok(self.cells() - before)
    }

    /// The generation map `g` (Eq. 3.6): applies `L` until no cell is added.
    pub(crate) fn settle(&mut self, epsilon: f64) -> Result<(), Outgrown> {
        while self.apply(epsilon)? > 0 {}
        Ok(())
    }

    /// The smallest `ε` above which a cell would be added; `None` if it exceeds `most`.
    pub(crate) fn next_event(&mut self, most: f64) -> Option<f64> {
        self.tree.potentials(&mut self.potentials, &mut self.order);
        let greatest = self.revenue.greatest();
        let mut best = most * (1.0 + BREAK_EVEN);
        let mut found = false;
        for b in 0..self.tree.count() {
            let Some(room) = self.room(b, best * greatest) else {
                continue;
            };
            self.reach(room);
            let node = self.tree.nodes[b as usize];
            let from = self.tree.cells[b as usize];
            for &(length, step) in &self.disc {
                if node.multiple * length + self.potentials[b as usize] > best * greatest {
                    break;
                }
                if let Some(expense) = self.expense(b, from, step, length) {
                    let needed = expense / self.revenue.of(from + step);
                    if needed <= best {
                        best = needed;
                        found = true;
                    }
                }
            }
        }
        found.then_some(best.min(most))
    }

    /// Collects the cells whose revenue covers their cost, each with its cheapest supply.
    fn select(&mut self, epsilon: f64) -> Result<(), Outgrown> {
        self.tree.potentials(&mut self.potentials, &mut self.order);
        for offer in self.offers.drain(..) {
            self.offered.set(offer.cell, NONE);
        }
        let earned = epsilon * (1.0 + BREAK_EVEN);
        let most = earned * self.revenue.greatest();
        let mut cells = self.cells();
        for b in 0..self.tree.count() {
            let Some(room) = self.room(b, most) else {
                continue;
            };
            self.reach(room);
            let from = self.tree.cells[b as usize];
            for i in 0..self.disc.len() {
                let (length, step) = self.disc[i];
                if length > room {
                    break;
                }
                let cell = from + step;
                let Some(expense) = self.expense(b, from, step, length) else {
                    continue;
                };
                if expense > earned * self.revenue.of(cell) {
                    continue;
                }
                let offer = Offer {
                    cell,
                    expense,
                    parent: b,
                    step,
                };
                let number = self.offered.get(cell);
                if number == NONE {
                    self.offered.set(cell, self.offers.len() as u32);
                    self.offers.push(offer);
                    cells += if self.tree.is_mirrored() && cell.m != 0 {
                        2
                    } else {
                        1
                    };
                    if cells > self.most_cells {
                        return Err(Outgrown { cells });
                    }
                } else {
                    let known = &mut self.offers[number as usize];
                    let key = (offer.expense, offer.step.squared());
                    if key < (known.expense, known.step.squared()) {
                        *known = offer;
                    }
                }
            }
        }
        Ok(())
    }

    /// Length of the longest edge from `b` that a revenue of `most` could pay for. `None` if no
    /// edge is that short, or if `b` is neither on the boundary nor the root.
    fn room(&self, b: u32, most: f64) -> Option<f64> {
        let room = (most - self.potentials[b as usize]) / self.tree.nodes[b as usize].multiple;
        let cell = self.tree.cells[b as usize];
        let is_free = |place: Cell| self.tree.is_free(place);
        // On a given blade a neighbouring cell may be behind the margin, so that a free cell can
        // only be supplied from a little farther away.
        let reach = self.tree.reach();
        let is_boundary = reach.is_some() || b == 0 || cell.neighbours().any(is_free);
        let longest = reach.map_or(f64::INFINITY, |reach| f64::from(2 * reach * reach).sqrt());
        (room >= 1.0 && is_boundary).then_some(room.min(longest))
    }

    /// `C_Ω(x, b)` (Eq. 3.2) for a cell outside that `b` may supply.
    fn expense(&self, b: u32, from: Cell, step: Cell, length: f64) -> Option<f64> {
        let cell = from + step;
        if self.tree.has(cell) || !self.tree.may_join(from, cell) {
            return None;
        }
        let node = &self.tree.nodes[b as usize];
        let turned = self.tree.tables.turn(step, node.step);
        (turned < f64::INFINITY)
            .then(|| length * node.multiple * turned + self.potentials[b as usize])
    }

    /// Extends the list of steps to length `radius`.
    fn reach(&mut self, radius: f64) {
        if radius <= self.disc_radius {
            return;
        }
        let wide = radius.ceil() as i32;
        let square = (-wide..=wide).flat_map(|n| (-wide..=wide).map(move |m| Cell::new(m, n)));
        self.disc = square
            .filter(|step| *step != Cell::ROOT)
            .map(|step| (step.length(), step))
            .filter(|&(length, _)| length <= f64::from(wide))
            .collect();
        let key = |step: Cell| (step.squared(), step.n, step.m);
        self.disc.sort_unstable_by_key(|&(_, step)| key(step));
        self.disc_radius = f64::from(wide);
    }
}
