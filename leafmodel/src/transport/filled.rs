//! Transport-optimal veins on an outline that is there already.
//!
//! The paper's leaf decides its shape itself. Here cells come only where the blade is, by the same
//! rule: each as soon as it earns what its transport costs, `ε` rising until all have come. Three
//! things are ours. Edges span at most two columns and rows and do not cross the margin. `ε` rises
//! by equal shares rather than equal steps, since where it will end is not known. And a cell that
//! no edge can reach without turning back by a right angle or more stays without supply; such cells
//! lie beside and behind the root.

use glam::DVec2;

use super::blade::Frame;
use super::cells::Cell;
use super::contour::place;
use super::growth::Outgrown;
use super::leaf::TransportLeaf;
use super::plan::{Ladder, TransportError, TransportPlan};
use super::vein_style::{VeinStyle, check};
use super::walls::Walls;
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// Cells that a blade may have.
const MOST_CELLS: usize = 20_000;

/// By what factor `ε` rises at a time, at least.
const RISE: f64 = 1.04;

/// How veins fill a blade as the cheapest transport network of its cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilledPlan {
    /// `α`: how little it saves to transport much together. 0 to 1, exclusive.
    pub alpha: f64,
    /// `β`: how dearly a change of direction is paid. Above 0, at most 20.
    pub beta: f64,
    /// Cells along the midrib, 4 to 200; the blade may have 20 000 in all.
    pub cells_along: u32,
    /// How veins are drawn.
    pub style: VeinStyle,
}

impl Default for FilledPlan {
    fn default() -> Self {
        Self {
            alpha: 0.6,
            beta: 0.5,
            cells_along: 80,
            style: VeinStyle {
                base_radius_mm: 0.6,
                least_cells: 3,
            },
        }
    }
}

/// A blade whose cells are supplied.
#[derive(Clone, Debug)]
pub struct FilledBlade {
    leaf: TransportLeaf,
    frame: Frame,
    unsupplied: Vec<Cell>,
}

impl PartialEq for FilledBlade {
    fn eq(&self, other: &Self) -> bool {
        // The frame is decided by the place of the root.
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
    /// [`TransportError::OutOfRange`].
    pub fn validate(&self) -> Result<(), TransportError> {
        self.growth_plan(1.0, true).validate()?;
        let along = f64::from(self.cells_along);
        check("cells_along", along, 4.0, 200.0, "4 to 200")?;
        self.style.validate()
    }

    /// Checks every number, and that the blade does not have too many cells.
    ///
    /// # Errors
    ///
    /// [`TransportError::OutOfRange`], [`TransportError::TooFine`].
    pub fn check(&self, outline: &Outline) -> Result<(), TransportError> {
        self.validate()?;
        self.grid(outline)?;
        Ok(())
    }

    /// Supplies the cells of a blade with its base at the origin and its midrib along +y: those
    /// whose centre lies on it and that hang together with the root, the lowest cell on the midrib.
    ///
    /// Both sides are grown as one where the cells are symmetric about the midrib.
    ///
    /// # Errors
    ///
    /// As [`FilledPlan::check`].
    pub fn fill(&self, outline: &Outline) -> Result<FilledBlade, TransportError> {
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
                // Rounding must not keep the cheapest cell away.
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
    fn grid(&self, outline: &Outline) -> Result<(Frame, Vec<Cell>), TransportError> {
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
        // A base may be too narrow for a cell.
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
    /// The cells with their tree, as of a leaf that has grown into this shape.
    pub fn leaf(&self) -> &TransportLeaf {
        &self.leaf
    }

    /// Cells of the blade that are left without supply, in a fixed order.
    pub fn unsupplied(&self) -> &[Cell] {
        &self.unsupplied
    }

    pub(crate) fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The veins on the outline that was filled. The first node is its base.
    ///
    /// # Errors
    ///
    /// [`TransportError::OutOfRange`] for the style.
    pub fn network(
        &self,
        outline: &Outline,
        style: VeinStyle,
    ) -> Result<VenationNetwork, TransportError> {
        style.validate()?;
        let widest = self.leaf.counts()[0];
        Ok(self.leaf.network_in(&self.frame, outline, style, widest))
    }

    /// The veins at each of some stages of the rise of `ε`; beyond the last they are complete.
    ///
    /// # Errors
    ///
    /// As [`FilledBlade::network`].
    pub fn networks_at(
        &self,
        outline: &Outline,
        style: VeinStyle,
        stages: &[usize],
    ) -> Result<Vec<VenationNetwork>, TransportError> {
        style.validate()?;
        let widest = self.leaf.counts()[0];
        let at = |&stage: &usize| {
            let young = self.leaf.at_stage(stage);
            young.network_in(&self.frame, outline, style, widest)
        };
        Ok(stages.iter().map(at).collect())
    }
}

fn too_fine(cells: usize) -> TransportError {
    let limit = MOST_CELLS;
    TransportError::TooFine { cells, limit }
}

#[cfg(test)]
mod tests;
