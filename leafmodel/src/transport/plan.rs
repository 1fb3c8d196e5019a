//! The parameters of a transport leaf and their ranges.

use crate::document::{Declared, Flag, Integer, Keys, RangeError};
use crate::not_grown::{NotGrown, not_grown};

/// The steps in which the revenue `ε` rises (Definition 3.5 leaves them open).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ladder {
    /// A number of equal steps, 1 to 10 000, from the revenue at which the first cell is added.
    Equal(u32),
    /// Each step is the smallest that adds any cell.
    Events,
}

/// The parameters of a transport leaf.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct TransportPlan {
    /// α: how little it saves to transport much together; larger is rounder.
    ///
    /// `α`, exponent of the weight in the cost of an edge: the smaller, the more carrying water
    /// together saves. Above ½ every leaf stops growing; up to ½ some would stop
    /// only at `most_cells`, which is an error. Larger values give rounder leaves.
    #[key("alpha", required, open(0.0, 1.0))]
    pub alpha: f64,
    /// β: how dearly a change of direction is paid.
    ///
    /// `β`, exponent of the cost of a turn: the greater, the more a change of direction costs.
    /// Above 0, at most 20.
    #[key("beta", required, above(0.0, 20.0))]
    pub beta: f64,
    /// ε: what a full-grown leaf's cell earns per area: larger leaves have more cells.
    ///
    /// `ε`, revenue per area of the full-grown leaf. Above 0; `ε h^{1−2α}` is at most 100. The
    /// first cell is added at `ε = h^{2α−1}`.
    #[key("epsilon", required, above(0.0, 1e9))]
    pub epsilon: f64,
    /// h: edge of a cell in the leaf's own unit.
    ///
    /// `h`, edge of a cell, in the leaf's own unit, 10⁻⁶ to 10⁶. The length of the leaf in
    /// millimetres is chosen separately.
    #[key("cell", 1e-6..=1e6)]
    pub cell: f64,
    /// How `ε` rises to its final value.
    #[key(with = ladder)]
    pub ladder: Ladder,
    /// Both sides grow as one. Uneven light overrules it.
    ///
    /// Whether both sides are grown as one, so that they are exact mirror images. Ignored under
    /// uneven light.
    #[key("mirrored")]
    pub mirrored: bool,
    /// Uneven light: greatest departure of a cell's ε from its mean, as a share; the leaf's `seed`
    /// decides where.
    #[key("noise", 0.0..1.0)]
    pub noise: f64,
    /// cells: width of patches of light and shadow.
    #[key("noise_cells", 1.0..=1000.0)]
    pub noise_cells: f64,
    /// A leaf with more is an error.
    ///
    /// Greatest number of cells; a larger leaf is an error. 000 000.
    #[key("most_cells", 1..=1_000_000)]
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

/// The keys of the steps in which the revenue rises.
fn ladder(plan: &mut TransportPlan, keys: &mut Keys<'_>) {
    keys.exclude("steps", "events");
    let (mut steps, mut events) = match plan.ladder {
        Ladder::Equal(steps) => (steps, false),
        Ladder::Events => (STEPS, true),
    };
    if keys.reader().is_some() && keys.has("steps") {
        events = false;
    }
    let count = Integer::within(1, 10_000);
    let about = "Equal steps in which ε rises, from where the first cell comes.";
    if !events || keys.reader().is_some() {
        keys.key("steps", &mut steps, count, about);
    }
    let about = "Instead: one step for each rise that brings a cell, the smallest there are.";
    // Written alone: both would exclude each other.
    if events || keys.reader().is_some() || keys.is_description() {
        keys.key("events", &mut events, Flag, about);
    }
    plan.ladder = if events {
        Ladder::Events
    } else {
        Ladder::Equal(steps)
    };
}

/// Equal steps in which the revenue rises where nothing is said.
const STEPS: u32 = 80;

/// The error of cells that have no margin.
pub(super) fn no_outline(error: impl std::fmt::Display) -> NotGrown {
    let error = not_grown!("no outline comes of the cells: {error}");
    error.mend("epsilon", "let the leaf grow larger")
}

impl TransportPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming the parameter and its range.
    pub fn validate(&self) -> Result<(), NotGrown> {
        self.in_range()?;
        let value = self.in_cells(self.epsilon);
        let path = "epsilon · cell^(1 − 2 alpha)";
        RangeError::unless(value <= 100.0, path, value, "above 0 to 100").map_err(|error| {
            NotGrown::from(error).mend("epsilon", "use a lower revenue, or a larger cell")
        })
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
                "alpha is 1, outside the values between 0 and 1",
            ),
            (|p| p.alpha = 0.0, "alpha is 0, "),
            (|p| p.alpha = f64::NAN, "alpha is NaN, "),
            (
                |p| p.beta = 0.0,
                "beta is 0, outside the values above 0 and up to 20",
            ),
            (|p| p.beta = -1.0, "beta is -1, "),
            (
                |p| p.epsilon = 0.0,
                "epsilon is 0, outside the values above 0",
            ),
            (|p| p.cell = 0.0, "cell is 0, outside 1e-6 to 1000000"),
            (|p| p.cell = -2.0, "cell is -2, "),
            (|p| p.ladder = Ladder::Equal(0), "steps is 0, "),
            (|p| p.noise = 1.0, "noise is 1, outside 0 to below 1"),
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
