//! A distribution of inclinations by a table.

use thiserror::Error;

/// Densities at inclinations, linear between them, 0 outside.
#[derive(Clone, Debug, PartialEq)]
pub struct InclinationTable {
    /// Inclination in degrees and density as they are written.
    points: Vec<[f64; 2]>,
    /// Of the leaves, the share below each inclination.
    below: Vec<f64>,
    /// Integral of the densities over radians.
    total: f64,
}

/// What is wrong with a table of inclinations.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BadInclinations {
    /// An inclination that is none, or does not rise.
    #[error("row {row}: {degrees}° does not lie between 0 and 90°, above the row before")]
    NotRising {
        /// Its row, from 1.
        row: usize,
        /// What it has.
        degrees: f64,
    },
    /// A density below 0.
    #[error("row {row}: the density {density} is negative or no number")]
    Negative {
        /// Its row, from 1.
        row: usize,
        /// What it has.
        density: f64,
    },
    /// Nothing but zeros.
    #[error("no density between two rows is above 0")]
    Empty,
}

impl InclinationTable {
    /// One without rows, which stands for others where their kind alone counts.
    pub const NONE: Self = Self {
        points: Vec::new(),
        below: Vec::new(),
        total: 0.0,
    };

    /// The distribution of rows of an inclination in degrees and a density in any unit.
    ///
    /// # Errors
    ///
    /// [`BadInclinations`] for the first row that cannot be used.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self, BadInclinations> {
        let mut last = -1.0;
        for (number, &[degrees, density]) in points.iter().enumerate() {
            let row = number + 1;
            if !(0.0..=90.0).contains(&degrees) || degrees <= last {
                return Err(BadInclinations::NotRising { row, degrees });
            }
            if !(0.0..=f64::MAX).contains(&density) {
                return Err(BadInclinations::Negative { row, density });
            }
            last = degrees;
        }
        let areas = points.windows(2).map(|pair| {
            let [[from, low], [to, high]] = [pair[0], pair[1]];
            (to - from).to_radians() * 0.5 * (low + high)
        });
        let mut total = 0.0;
        let mut below = vec![0.0];
        for area in areas {
            total += area;
            below.push(total);
        }
        if !(total > 0.0 && total.is_finite()) {
            return Err(BadInclinations::Empty);
        }
        for share in &mut below {
            *share /= total;
        }
        Ok(Self {
            points,
            below,
            total,
        })
    }

    /// Its rows, as they were given.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The density at an inclination, rad⁻¹.
    pub(super) fn density(&self, theta: f64) -> f64 {
        self.at(theta).map_or(0.0, |(_, _, density)| density) / self.total
    }

    /// The share of the leaves below an inclination.
    pub(super) fn share_below(&self, theta: f64) -> f64 {
        let Some((row, gone, density)) = self.at(theta) else {
            let is_below = theta.to_degrees() < self.points[0][0];
            return if is_below { 0.0 } else { 1.0 };
        };
        self.below[row] + gone * 0.5 * (self.points[row][1] + density) / self.total
    }

    /// The row at or below an inclination, how far above that it lies in rad, and the density there as
    /// the table has it; `None` outside.
    fn at(&self, theta: f64) -> Option<(usize, f64, f64)> {
        let degrees = theta.to_degrees();
        let above = self.points.partition_point(|[own, _]| *own <= degrees);
        let row = above.checked_sub(1)?;
        let [from, low] = self.points[row];
        let [to, high] = *self.points.get(above)?;
        let along = (degrees - from) / (to - from);
        Some((
            row,
            (degrees - from).to_radians(),
            low + along * (high - low),
        ))
    }
}
