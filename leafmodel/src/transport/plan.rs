//! The parameters of a transport leaf and their ranges.

use thiserror::Error;

use crate::shape::outline::OutlineError;

/// The greatest `most_cells`.
const MOST_CELLS: usize = 1_000_000;

/// A number to be checked: key, value, least and greatest value, and the range in words.
type Check = (&'static str, f64, f64, f64, &'static str);

/// The steps in which the revenue `ε` rises (Definition 3.5 leaves them open).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ladder {
    /// A number of equal steps, 1 to 10 000, from the revenue at which the first cell is added.
    Equal(u32),
    /// Each step is the smallest that adds any cell.
    Events,
}

/// The parameters of a transport leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct TransportPlan {
    /// `α`, exponent of the weight in the cost of an edge: the smaller, the more carrying water
    /// together saves. 0 to 1, both excluded. Above ½ every leaf stops growing; up to ½ some would
    /// stop only at `most_cells`, which is an error. Larger values give rounder leaves.
    pub alpha: f64,
    /// `β`, exponent of the cost of a turn: the greater, the more a change of direction costs.
    /// Above 0, at most 20.
    pub beta: f64,
    /// `ε`, revenue per area of the full-grown leaf. Above 0; `ε h^{1−2α}` is at most 100. The
    /// first cell is added at `ε = h^{2α−1}`.
    pub epsilon: f64,
    /// `h`, edge of a cell, in the leaf's own unit, 10⁻⁶ to 10⁶. The length of the leaf in
    /// millimetres is chosen separately.
    pub cell: f64,
    /// How `ε` rises to its final value.
    pub ladder: Ladder,
    /// Whether both sides are grown as one, so that they are exact mirror images. Ignored under
    /// uneven light.
    pub mirrored: bool,
    /// Uneven light: greatest deviation of a cell's `ε` from its mean, as a share of the mean. At
    /// least 0, below 1; 0 is even light.
    pub noise: f64,
    /// Width of patches of light and shadow, cells, 1 to 1000.
    pub noise_cells: f64,
    /// Greatest number of cells; a larger leaf is an error. 1 to 1 000 000.
    pub most_cells: usize,
}

impl Default for TransportPlan {
    fn default() -> Self {
        Self {
            alpha: 0.6,
            beta: 0.5,
            epsilon: 5.0,
            cell: 1.0,
            ladder: Ladder::Equal(80),
            mirrored: true,
            noise: 0.0,
            noise_cells: 4.0,
            most_cells: 20_000,
        }
    }
}

/// Why a plan gives no leaf.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TransportError {
    /// A number is outside the range in which the model holds.
    #[error("{key} is {value}, outside {range}")]
    OutOfRange {
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The leaf would have more cells than its plan allows.
    #[error(
        "the leaf has {cells} cells when most_cells is {limit}; only for alpha above 0.5 is it sure to stop growing (alpha is {alpha})"
    )]
    TooManyCells {
        /// How many it has so far.
        cells: usize,
        /// How many it may have.
        limit: usize,
        /// The plan's `α`.
        alpha: f64,
    },
    /// The grid is too fine for the blade that it is to fill.
    #[error("the blade takes {cells} cells, more than {limit}")]
    TooFine {
        /// About how many cells it would have.
        cells: usize,
        /// How many it may have.
        limit: usize,
    },
    /// The cells give no valid margin.
    #[error("no outline comes of the cells: {0}")]
    Outline(#[from] OutlineError),
}

impl TransportPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`TransportError::OutOfRange`], naming the parameter and its range.
    pub fn validate(&self) -> Result<(), TransportError> {
        // Excluded ends are replaced by the neighbouring floating-point numbers.
        let above_0 = f64::MIN_POSITIVE;
        let below_1 = 1.0 - f64::EPSILON / 2.0;
        let steps = match self.ladder {
            Ladder::Equal(steps) => f64::from(steps),
            Ladder::Events => 1.0,
        };
        let checks: [Check; 8] = [
            (
                "alpha",
                self.alpha,
                above_0,
                below_1,
                "0 to 1, both exclusive",
            ),
            ("beta", self.beta, above_0, 20.0, "0, exclusive, to 20"),
            ("cell", self.cell, 1e-6, 1e6, "0.000001 to 1000000"),
            ("epsilon", self.epsilon, above_0, f64::MAX, "above 0"),
            ("ladder", steps, 1.0, 10_000.0, "1 to 10000 steps"),
            ("noise", self.noise, 0.0, below_1, "0 to 1, exclusive"),
            (
                "noise_cells",
                self.noise_cells,
                1.0,
                1000.0,
                "1 to 1000 cells",
            ),
            (
                "most_cells",
                self.most_cells as f64,
                1.0,
                MOST_CELLS as f64,
                "1 to 1000000",
            ),
        ];
        for (key, value, low, high, range) in checks {
            if !(low..=high).contains(&value) {
                return Err(TransportError::OutOfRange { key, value, range });
            }
        }
        let (key, range) = ("epsilon · cell^(1 − 2 alpha)", "above 0 to 100");
        let value = self.in_cells(self.epsilon);
        if value > 100.0 {
            return Err(TransportError::OutOfRange { key, value, range });
        }
        Ok(())
    }

    /// Whether both sides are grown as one.
    pub(crate) fn is_mirrored(&self) -> bool {
        self.mirrored && self.noise == 0.0
    }

    /// `ε h^{1−2α}`: a revenue in the unit in which the edge of a cell is 1. The first cell is
    /// added at 1.
    pub(crate) fn in_cells(&self, epsilon: f64) -> f64 {
        epsilon * libm::pow(self.cell, 1.0 - 2.0 * self.alpha)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_bad_number_is_named_with_its_value_and_its_range() {
        type Spoil = fn(&mut TransportPlan);
        let spoils: [(Spoil, &str); 12] = [
            (
                |p| p.alpha = 1.0,
                "alpha is 1, outside 0 to 1, both exclusive",
            ),
            (|p| p.alpha = 0.0, "alpha is 0, "),
            (|p| p.alpha = f64::NAN, "alpha is NaN, "),
            (|p| p.beta = 0.0, "beta is 0, outside 0, exclusive, to 20"),
            (|p| p.beta = -1.0, "beta is -1, "),
            (|p| p.epsilon = 0.0, "epsilon is 0, outside above 0"),
            (|p| p.cell = 0.0, "cell is 0, outside 0.000001 to 1000000"),
            (|p| p.cell = -2.0, "cell is -2, "),
            (|p| p.ladder = Ladder::Equal(0), "ladder is 0, "),
            (|p| p.noise = 1.0, "noise is 1, outside 0 to 1, exclusive"),
            (|p| p.most_cells = 0, "most_cells is 0, "),
            (
                |p| p.epsilon = 101.0,
                "epsilon · cell^(1 − 2 alpha) is 101, ",
            ),
        ];
        assert_eq!(TransportPlan::default().validate(), Ok(()));
        for (spoil, start) in spoils {
            let mut plan = TransportPlan::default();
            spoil(&mut plan);
            let message = plan.validate().expect_err("out of range").to_string();
            assert!(message.starts_with(start), "{message}");
        }
    }
}
