//! Transport-optimal veins inside a given outline.
//!
//! In the paper the shape of the leaf follows from its growth. Here cells are added only on the
//! given blade, by the same rule: each as soon as its revenue covers its transport, while `ε` rises
//! until all cells are supplied. Three rules are our own. Edges span at most two columns and rows
//! and do not cross the margin. `ε` rises by equal factors rather than equal steps, since its final
//! value is not known. A cell that no edge can reach without a turn of a right angle or more stays
//! without supply; such cells lie beside and behind the root.

use glam::DVec2;

use super::blade::Frame;
use super::cells::Cell;
use super::contour::place;
use super::growth::Outgrown;
use super::leaf::TransportLeaf;
use super::plan::{Ladder, TransportPlan};
use super::vein_style::VeinStyle;
use super::walls::Walls;
use crate::document::Declared;
use crate::not_grown::{NotGrown, not_grown};
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// Greatest number of cells of a blade.
const MOST_CELLS: usize = 20_000;

/// Least factor by which `ε` rises at a time.
const RISE: f64 = 1.04;

/// How veins fill a blade as the transport network of its cells.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct FilledPlan {
    /// α: how little it saves to transport much together.
    ///
    /// `α`, exponent of the weight in the cost of an edge: the smaller, the more carrying water
    /// together saves.
    #[key("alpha", open(0.0, 1.0))]
    pub alpha: f64,
    /// β: how dearly a change of direction is paid.
    ///
    /// `β`, exponent of the cost of a turn: the greater, the more a change of direction costs.
    /// Above 0, at most 20.
    #[key("beta", above(0.0, 20.0))]
    pub beta: f64,
    /// Cells along the midrib.
    ///
    /// Cells along the midrib; the whole blade may have 20 000.
    #[key("cells_along", 4..=200)]
    pub cells_along: u32,
    /// How veins are drawn.
    #[key(flat)]
    pub style: VeinStyle,
}

impl Default for FilledPlan {
    fn default() -> Self {
        Self {
            alpha: 0.6,
            beta: 0.5,
            cells_along: 80,
            style: VeinStyle::default(),
        }
    }
}

/// A blade with the transport network that supplies its cells.
#[derive(Clone, Debug)]
pub struct FilledBlade {
    leaf: TransportLeaf,
    frame: Frame,
    unsupplied: Vec<Cell>,
}

impl PartialEq for FilledBlade {
    fn eq(&self, other: &Self) -> bool {
        // The frame is left out: it follows from the place of the root.
        (&self.leaf, &self.unsupplied) == (&other.leaf, &other.unsupplied)
            && self.frame.base == other.frame.base
            && self.frame.scale == other.frame.scale
    }
}

impl FilledPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub fn validate(&self) -> Result<(), NotGrown> {
        Ok(self.in_range()?)
    }

    /// Checks every number, and that the blade does not have too many cells.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for a number; [`NotGrown`] for too many cells.
    pub fn check(&self, outline: &Outline) -> Result<(), NotGrown> {
        self.validate()?;
        self.grid(outline)?;
        Ok(())
    }

    /// Supplies the cells of a blade with its base at the origin and its midrib along +y: those
    /// whose centre lies on the blade and that are connected to the root, the lowest cell on the
    /// midrib.
    ///
    /// Both sides are grown as one if the cells are symmetric about the midrib.
    ///
    /// # Errors
    ///
    /// As [`FilledPlan::check`].
    pub fn fill(&self, outline: &Outline) -> Result<FilledBlade, NotGrown> {
        self.validate()?;
        let (frame, all) = self.grid(outline)?;
        let is_crossed = |a, b| outline.is_crossed_by(frame.to_mm(a), frame.to_mm(b));
        let walls = Walls::around(&all, is_crossed);
        let cells = walls.connected(Cell::ROOT);
        let mut images: Vec<Cell> = cells.iter().map(|cell| cell.mirrored()).collect();
        let mut sorted = cells.clone();
        images.sort_unstable();
        sorted.sort_unstable();
        let is_mirrored = images == sorted;
        let mut plan = self.growth_plan(1.0, is_mirrored);
        plan.most_cells = cells.len();
        let mut growth = plan.seedling(0);
        growth.tree.enclose(walls);
        let mut stages = Vec::new();
        let mut epsilon = 1.0;
        loop {
            let settled = growth.settle(epsilon);
            settled.map_err(|Outgrown { cells }| too_fine(cells))?;
            stages.push(plan.stage(&growth, epsilon));
            match growth.next_event(f64::INFINITY) {
                // Slightly above the break-even value, so that rounding does not keep the cheapest
                // cell out.
                Some(next) => epsilon = (epsilon * RISE).max(next * (1.0 + 1e-9)),
                None => break,
            }
        }
        plan.epsilon = epsilon;
        plan.ladder = Ladder::Equal(stages.len() as u32);
        let unsupplied = cells.into_iter();
        let unsupplied = unsupplied.filter(|&cell| !growth.tree.has(cell)).collect();
        Ok(FilledBlade {
            leaf: plan.leaf_of(&growth, 0, stages),
            frame,
            unsupplied,
        })
    }

    fn growth_plan(&self, epsilon: f64, mirrored: bool) -> TransportPlan {
        TransportPlan {
            alpha: self.alpha,
            beta: self.beta,
            epsilon,
            mirrored,
            ..TransportPlan::default()
        }
    }

    /// The grid over a blade, and the cells whose centres lie on it; the first is the root.
    fn grid(&self, outline: &Outline) -> Result<(Frame, Vec<Cell>), NotGrown> {
        let scale = outline.length() / f64::from(self.cells_along);
        let estimate = outline.area() / (scale * scale);
        if estimate > 1.1 * MOST_CELLS as f64 {
            return Err(too_fine(estimate as usize));
        }
        let frame_with = |row: u32| {
            let base = DVec2::new(0.0, -0.5 - f64::from(row));
            Frame {
                margin: Vec::new(),
                base,
                apex: base + DVec2::Y * f64::from(self.cells_along),
                origin: base,
                up: DVec2::Y,
                scale,
                is_walled: true,
            }
        };
        let inside = |frame: &Frame, cell: Cell| outline.contains(frame.to_mm(place(cell)));
        // The base may be too narrow for a cell, so the root is looked for row by row.
        let mut rows = (0..self.cells_along).map(frame_with);
        let frame = rows
            .find(|frame| inside(frame, Cell::ROOT))
            .unwrap_or_else(|| frame_with(0));
        let (low, high) = outline.bounds();
        let (low, high) = (frame.to_cells(low).floor(), frame.to_cells(high).ceil());
        let mut cells = vec![Cell::ROOT];
        for n in low.y as i32..=high.y as i32 {
            let row = (low.x as i32..=high.x as i32).map(|m| Cell::new(m, n));
            cells.extend(row.filter(|&cell| cell != Cell::ROOT && inside(&frame, cell)));
        }
        if cells.len() > MOST_CELLS {
            return Err(too_fine(cells.len()));
        }
        Ok((frame, cells))
    }
}

impl FilledBlade {
    /// The cells with their network, as a transport leaf of this shape.
    pub fn leaf(&self) -> &TransportLeaf {
        &self.leaf
    }

    pub(crate) fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The veins on the outline that was filled. The first node is its base.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the style.
    pub fn network(
        &self,
        outline: &Outline,
        style: VeinStyle,
    ) -> Result<VenationNetwork, NotGrown> {
        style.in_range()?;
        let widest = self.leaf.counts()[0];
        Ok(self.leaf.network_in(&self.frame, outline, style, widest))
    }

    /// The veins at each of the given stages of the rise of `ε`. A stage beyond the last means all
    /// veins.
    ///
    /// # Errors
    ///
    /// As [`FilledBlade::network`].
    pub(crate) fn networks_at(
        &self,
        outline: &Outline,
        style: VeinStyle,
        stages: &[usize],
    ) -> Result<Vec<VenationNetwork>, NotGrown> {
        style.in_range()?;
        let widest = self.leaf.counts()[0];
        let at = |&stage: &usize| {
            let young = self.leaf.at_stage(stage);
            young.network_in(&self.frame, outline, style, widest)
        };
        Ok(stages.iter().map(at).collect())
    }
}

fn too_fine(cells: usize) -> NotGrown {
    let limit = MOST_CELLS;
    let error = not_grown!("the blade takes {cells} cells, more than {limit}");
    error.mend("cells_along", "use fewer cells along the midrib")
}

#[cfg(test)]
mod tests;
