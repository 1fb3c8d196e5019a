//! Which tissue dies first, as a smooth field over the blade.

use glam::DVec2;

use super::blade::Frame;
use super::cells::Cell;
use super::contour::place;
use super::filled::FilledBlade;
use super::leaf::TransportLeaf;
use crate::not_grown::NotGrown;

/// Steps in which the revenue falls; deaths are resolved to a thousandth of it.
const STEPS: u32 = 1000;

/// Extra columns and rows of the grid around the cells, so that the field is smooth beyond them
/// too.
const AROUND: i32 = 3;

/// The share of the full-grown leaf's revenue at which tissue dies, as a field over the blade: 1
/// dies first, 0 last.
///
/// Coefficients are the values of [`TransportLeaf::deaths`] at the centres of cells and, beyond the
/// cells, means of the nearest ones. Between centres the field is a quadratic B-spline, continuous
/// with its first derivative. Far outside it has the value at the edge of the grid.
#[derive(Clone, Debug)]
pub struct DeathField {
    frame: Frame,
    low: Cell,
    width: usize,
    /// B-spline coefficients, row by row.
    values: Vec<f64>,
}

impl TransportLeaf {
    /// When the tissue of this leaf dies, in the frame of [`TransportLeaf::outline`] for the same
    /// length.
    ///
    /// # Errors
    ///
    /// As [`TransportLeaf::outline`].
    pub(crate) fn death_field(&self, length_mm: f64) -> Result<DeathField, NotGrown> {
        let (frame, _) = self.framed(length_mm)?;
        Ok(DeathField::new(self, frame))
    }
}

impl FilledBlade {
    /// When the tissue of the blade dies, in the frame of the outline that was filled.
    pub(crate) fn death_field(&self) -> DeathField {
        DeathField::new(self.leaf(), self.frame().clone())
    }
}

impl DeathField {
    fn new(leaf: &TransportLeaf, frame: Frame) -> Self {
        let deaths = leaf.deaths(STEPS).expect("a thousand steps are allowed");
        let (mut low, mut high) = (Cell::ROOT, Cell::ROOT);
        for cell in leaf.cells() {
            low = Cell::new(low.m.min(cell.m), low.n.min(cell.n));
            high = Cell::new(high.m.max(cell.m), high.n.max(cell.n));
        }
        let margin = Cell::new(AROUND, AROUND);
        (low, high) = (low - margin, high + margin);
        let width = (high.m - low.m + 1) as usize;
        let height = (high.n - low.n + 1) as usize;
        let mut known = vec![None; width * height];
        for (cell, death) in leaf.cells().iter().zip(deaths) {
            let at = *cell - low;
            known[at.n as usize * width + at.m as usize] = Some(death);
        }
        let values = outwards(known, width);
        Self {
            frame,
            low,
            width,
            values,
        }
    }

    /// The share at which the tissue at a point (mm) dies, 0 to 1.
    pub fn at(&self, point: DVec2) -> f64 {
        let p = self.frame.to_cells(point) - place(self.low);
        let height = self.values.len() / self.width;
        let (column, across) = spline(p.x, self.width);
        let (row, along) = spline(p.y, height);
        let mut sum = 0.0;
        for (j, along) in along.into_iter().enumerate() {
            let start = (row + j) * self.width + column;
            let row = &self.values[start..start + 3];
            let [a, b, c] = across;
            sum += along * (a * row[0] + b * row[1] + c * row[2]);
        }
        sum.clamp(0.0, 1.0)
    }
}

/// The first of three places out of `count`, and their weights.
fn spline(x: f64, count: usize) -> (usize, [f64; 3]) {
    let x = x.clamp(0.0, (count - 1) as f64);
    let nearest = x.round().clamp(1.0, (count - 2) as f64);
    // Clamping matters only beyond the edge of the grid, where the field stays constant.
    let t = (x - nearest).clamp(-0.5, 0.5);
    let (before, after) = (0.5 - t, 0.5 + t);
    let weights = [0.5 * before * before, 0.75 - t * t, 0.5 * after * after];
    (nearest as usize - 1, weights)
}

/// Gives every place a value, ring by ring: the mean of the neighbours that have one.
fn outwards(mut known: Vec<Option<f64>>, width: usize) -> Vec<f64> {
    let height = known.len() / width;
    loop {
        let mut ring = Vec::new();
        for row in 0..height {
            for column in 0..width {
                if known[row * width + column].is_some() {
                    continue;
                }
                let (mut sum, mut count) = (0.0, 0);
                for j in row.saturating_sub(1)..(row + 2).min(height) {
                    for i in column.saturating_sub(1)..(column + 2).min(width) {
                        if let Some(value) = known[j * width + i] {
                            sum += value;
                            count += 1;
                        }
                    }
                }
                if count > 0 {
                    ring.push((row * width + column, sum / f64::from(count)));
                }
            }
        }
        if ring.is_empty() {
            return known.into_iter().map(Option::unwrap_or_default).collect();
        }
        for (at, value) in ring {
            known[at] = Some(value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::{FilledPlan, example};

    fn leaf() -> TransportLeaf {
        let plan = example(1).expect("there is one");
        plan.grow(1).expect("a good plan")
    }

    #[test]
    fn the_field_is_that_of_the_cells_but_for_its_smoothness() {
        let leaf = leaf();
        let field = leaf.death_field(60.0).expect("a margin");
        let deaths = leaf.deaths(STEPS).expect("a good number");
        let (mut sum, mut most) = (0.0, 0.0_f64);
        for (cell, death) in leaf.cells().iter().zip(&deaths) {
            let error = (field.at(field.frame.to_mm(place(*cell))) - death).abs();
            sum += error;
            most = most.max(error);
        }
        // A cell has 0.56 of the weight at its centre; neighbours differ by tenths at most along
        // veins.
        assert!(
            sum / (deaths.len() as f64) < 0.03 && most < 0.5,
            "{sum} {most}"
        );
    }

    #[test]
    fn the_field_is_defined_everywhere_and_steady() {
        let leaf = leaf();
        let field = leaf.death_field(60.0).expect("a margin");
        let cell = field.frame.scale;
        let mut steepest = 0.0_f64;
        for i in -400..400 {
            for j in -200..400 {
                let p = DVec2::new(f64::from(i), f64::from(j)) * 0.2;
                let here = field.at(p);
                assert!((0.0..=1.0).contains(&here));
                steepest = steepest.max((field.at(p + DVec2::splat(1e-3)) - here).abs());
            }
        }
        // Neighbours differ by 1 at most; a quadratic B-spline is at most that steep along each
        // axis.
        assert!(steepest <= 2.0 * 1e-3 / cell * 1.001, "{steepest}");
        assert!(field.at(DVec2::splat(1e9)).is_finite());
    }

    #[test]
    fn a_symmetric_leaf_dies_symmetrically_and_from_the_tips() {
        let leaf = leaf();
        let field = leaf.death_field(60.0).expect("a margin");
        for (x, y) in [(3.0, 10.0), (12.5, 30.0), (20.0, 25.0)] {
            let (right, left) = (field.at(DVec2::new(x, y)), field.at(DVec2::new(-x, y)));
            assert!((right - left).abs() < 1e-12);
        }
        assert!(field.at(DVec2::new(0.0, 1.0)) < field.at(DVec2::new(0.0, 30.0)));
        assert!(field.at(DVec2::new(0.0, 30.0)) < field.at(DVec2::new(0.0, 59.0)));
    }

    #[test]
    fn a_filled_blade_has_a_field_in_its_own_frame() {
        let outline = leaf().outline(60.0).expect("a margin");
        let plan = FilledPlan {
            cells_along: 40,
            ..FilledPlan::default()
        };
        let field = plan.fill(&outline).expect("a good plan").death_field();
        assert!(field.at(DVec2::new(0.0, 2.0)) < 0.5);
        assert!(field.at(DVec2::new(0.0, 59.0)) > field.at(DVec2::new(0.0, 30.0)));
    }
}
