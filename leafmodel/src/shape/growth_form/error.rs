//! What can be wrong with a growth form, and where.

use std::fmt;

use thiserror::Error;

use crate::document::RangeError;
use crate::shape::outline::OutlineError;

/// A side of an axis, seen with its tip up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// The right half.
    #[default]
    Right,
    /// The left half.
    Left,
}

/// A part of a growth form: one half of one axis. It is displayed as the keys that lead to it, such
/// as `axes[0].left.`, with numbers from 0. The right half of the midrib displays as nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FormPart {
    /// Which axis: the number of one on the midrib, then of one on that, and so on. Empty for the
    /// midrib.
    pub axes: Vec<usize>,
    /// Which half of it.
    pub side: Side,
}

impl fmt::Display for FormPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for number in &self.axes {
            write!(f, "axes[{number}].")?;
        }
        match self.side {
            Side::Right => Ok(()),
            Side::Left => write!(f, "left."),
        }
    }
}

/// Why no outline grows.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{part}{problem}")]
pub struct GrowthFormError {
    /// Where in the form.
    pub part: FormPart,
    /// What is wrong there.
    #[source]
    pub problem: GrowthFormProblem,
}

/// What is wrong with a part of a form.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GrowthFormProblem {
    /// A number outside the range in which the model holds.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// Veins are not in order from base to tip, or share a row.
    #[error(
        "veins[{index}] lies in row {row} of {rows}, where it must lie above row {before} of the vein before it"
    )]
    VeinOrder {
        /// Which vein, from 0.
        index: usize,
        /// Its row, from 1 at the base.
        row: usize,
        /// The row of the vein before it.
        before: usize,
        /// How many rows there are.
        rows: usize,
    },
    /// Veins cross each other before they end.
    #[error("veins[{lower}] and veins[{upper}] cross; {allowed}")]
    VeinsCross {
        /// The vein nearer to the base, from 0.
        lower: usize,
        /// The vein nearer to the tip, from 0.
        upper: usize,
        /// The slopes that would keep them apart.
        allowed: SlopeRange,
    },
    /// A row grows to more than 50 lengths of its axis.
    #[error(
        "rows: row {row} grows to {lengths:.0} times the length of its axis, above 50; lower its lateral growth rate"
    )]
    TooWide {
        /// Which row, from 1 at the base.
        row: usize,
        /// Length of the row in lengths of its axis.
        lengths: f64,
    },
    /// A secondary axis lies apart from the rest of the blade.
    #[error(
        "position: this axis does not overlap the rest of the blade; widen its base or place it nearer"
    )]
    Apart,
    /// The area that the rows sweep over has no valid margin.
    #[error("these growth rates and slopes bring forth no margin: {0}")]
    NoMargin(#[source] OutlineError),
}

/// The slopes of one of two veins at which they do not cross, all else unchanged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SlopeRange {
    /// A range of slopes for one of the veins.
    Of {
        /// Which vein, from 0.
        vein: usize,
        /// Its least slope.
        from: f64,
        /// Its greatest slope.
        to: f64,
    },
    /// No slope of either keeps them apart.
    Nothing,
}

impl fmt::Display for SlopeRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Of { vein, from, to } => write!(
                f,
                "they do not if the slope of veins[{vein}] is within {from} to {to}"
            ),
            Self::Nothing => write!(f, "no slope keeps them apart: let them bend less"),
        }
    }
}

impl FormPart {
    /// The error of a problem in this part.
    pub(super) fn error(self, problem: GrowthFormProblem) -> GrowthFormError {
        GrowthFormError {
            part: self,
            problem,
        }
    }
}

impl From<GrowthFormProblem> for GrowthFormError {
    /// What is wrong with the right half of the midrib, or with the leaf as a whole.
    fn from(problem: GrowthFormProblem) -> Self {
        FormPart::default().error(problem)
    }
}

impl From<OutlineError> for GrowthFormError {
    fn from(error: OutlineError) -> Self {
        GrowthFormProblem::NoMargin(error).into()
    }
}
