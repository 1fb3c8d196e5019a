//! What a growth form's numbers may be.

use std::ops::RangeInclusive;

use thiserror::Error;

use super::{GrowthForm, HalfForm, LateralGrowth};
use crate::shape::outline::OutlineError;

/// The least number above 0 that a parameter which excludes 0 may take, and the like below 1.
const ABOVE_0: f64 = 1e-6;
const BELOW_1: f64 = 1.0 - 1e-6;

/// Why no outline grows.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GrowthFormError {
    /// A number outside the range in which the model holds.
    #[error("{key} is {value}, outside {range}")]
    OutOfRange {
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Veins that are not in order from base to tip, or share a row.
    #[error("vein {index} lies in row {row}, not above the row of the vein before it")]
    VeinOrder {
        /// Which vein, from 0.
        index: usize,
        /// Its row, from 1 at the petiole.
        row: usize,
    },
    /// A row grows out of all proportion.
    #[error(
        "row {row} grows to {lengths} times the midrib's length, above 1000; lower its lateral growth rate"
    )]
    TooWide {
        /// Which row, from 1 at the petiole.
        row: usize,
        /// Length of the row in midribs.
        lengths: f64,
    },
    /// A secondary axis that lies apart from the rest of the blade.
    #[error(
        "secondary axis {axis} does not overlap the rest of the blade; widen its base or place it nearer"
    )]
    Apart {
        /// Number of the axis in the order in which axes are named, from 0, twins of pairs counted.
        axis: usize,
    },
    /// The rows sweep over something that is no blade.
    #[error("these growth rates and slopes bring forth no margin")]
    NoMargin(#[from] OutlineError),
}

/// Refuses lengths that no leaf has.
pub(in crate::shape) fn length(length_mm: f64) -> Result<(), GrowthFormError> {
    in_range(
        "length_mm",
        length_mm,
        1e-3..=1e5,
        "0.001 to 100000 (millimetres)",
    )
}

/// `value` must lie in `range`, which NaN never does.
pub(in crate::shape) fn in_range(
    key: &'static str,
    value: f64,
    range: RangeInclusive<f64>,
    words: &'static str,
) -> Result<(), GrowthFormError> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(GrowthFormError::OutOfRange {
            key,
            value,
            range: words,
        })
    }
}

impl GrowthForm {
    /// Checks every parameter.
    ///
    /// # Errors
    ///
    /// [`GrowthFormError`] of the first that is out of range.
    pub fn validate(&self) -> Result<(), GrowthFormError> {
        in_range("rows", self.rows as f64, 3.0..=1e4, "3 to 10000")?;
        in_range("axial_rate", self.axial_rate, 1e-3..=1.0, "0.001 to 1")?;
        self.validate_half(&self.right)?;
        self.left
            .as_ref()
            .map_or(Ok(()), |left| self.validate_half(left))
    }

    fn validate_half(&self, half: &HalfForm) -> Result<(), GrowthFormError> {
        match &half.lateral {
            LateralGrowth::Curve(_) => {}
            LateralGrowth::Peak {
                rate_ratio,
                widest_at,
                falloff,
            } => {
                in_range("rate_ratio", *rate_ratio, 0.5..=100.0, "0.5 to 100")?;
                let words = "0 to 1, both excluded";
                in_range("widest_at", *widest_at, ABOVE_0..=BELOW_1, words)?;
                in_range("falloff", *falloff, ABOVE_0..=100.0, "0 (excluded) to 100")?;
            }
        }
        in_range("lobe_decay", half.lobe_decay, 0.0..=100.0, "0 to 100")?;
        let words = "0 (excluded) to 10";
        in_range("lobe_exponent", half.lobe_exponent, ABOVE_0..=10.0, words)?;
        let mut before = None;
        for (index, vein) in half.veins.iter().enumerate() {
            in_range("veins.position", vein.position, 0.0..=1.0, "0 to 1")?;
            in_range("veins.slope", vein.slope, -20.0..=20.0, "-20 to 20")?;
            in_range("veins.bend", vein.bend, -100.0..=100.0, "-100 to 100")?;
            let row = self.row_at(vein.position);
            if before.is_some_and(|before| row <= before) {
                return Err(GrowthFormError::VeinOrder {
                    index,
                    row: row + 1,
                });
            }
            before = Some(row);
        }
        Ok(())
    }

    /// The row, from 0, at a place along the midrib, as [`crate::shape::growth_shape::GrowthShape`] has it.
    pub(super) fn row_at(&self, position: f64) -> usize {
        (position * (self.rows - 1) as f64).round_ties_even() as usize
    }
}
