//! Ranges of a growth form's numbers.

use super::error::{FormPart, GrowthFormError, GrowthFormProblem, Side};
use super::form::{Axis, GrowthForm, HalfForm};
use super::rows::{AxisGrowth, Rows, row_at};
use crate::document::{Declared, RangeError};

/// Greatest depth of axes on axes.
const DEEPEST: usize = 8;

/// Refuses lengths outside 0.001 to 100 000 mm.
pub(super) fn length(length_mm: f64) -> Result<(), GrowthFormError> {
    let valid = (1e-3..=1e5).contains(&length_mm);
    let checked = RangeError::unless(valid, "length_mm", length_mm, "0.001 to 100000");
    Ok(checked.map_err(GrowthFormProblem::Range)?)
}

impl GrowthForm {
    /// Checks every parameter.
    ///
    /// # Errors
    ///
    /// [`GrowthFormError`] for the first parameter that is out of range, or for veins that cross.
    pub fn validate(&self) -> Result<(), GrowthFormError> {
        self.checked().map(|_| ())
    }

    /// Checks every parameter and returns the growth of the midrib.
    pub(super) fn checked(&self) -> Result<AxisGrowth, GrowthFormError> {
        self.in_range().map_err(GrowthFormProblem::Range)?;
        let growth = AxisGrowth::of_midrib(self);
        check_axis(&self.midrib, growth, &mut Vec::new())?;
        Ok(growth)
    }
}

/// Checks an axis and all on it; `path` leads to it.
fn check_axis(
    axis: &Axis,
    growth: AxisGrowth,
    path: &mut Vec<usize>,
) -> Result<(), GrowthFormError> {
    let part = |side| FormPart {
        axes: path.clone(),
        side,
    };
    let right = check_half(axis.rows, &axis.right);
    right.map_err(|problem| part(Side::Right).error(problem))?;
    Rows::new(axis, growth, part(Side::Right)).refuse_crossing_veins()?;
    if let Some(left) = &axis.left {
        check_half(axis.rows, left).map_err(|problem| part(Side::Left).error(problem))?;
        Rows::new(axis, growth, part(Side::Left)).refuse_crossing_veins()?;
    }
    for (number, secondary) in axis.axes.iter().enumerate() {
        path.push(number);
        let depth = path.len() as f64;
        let valid = path.len() <= DEEPEST;
        RangeError::unless(valid, "depth", depth, "0 to 8").map_err(|error| {
            let part = FormPart {
                axes: path.clone(),
                side: Side::Right,
            };
            part.error(error.into())
        })?;
        check_axis(&secondary.axis, growth.of_secondary(secondary), path)?;
        path.pop();
    }
    Ok(())
}

fn check_half(rows: usize, half: &HalfForm) -> Result<(), GrowthFormProblem> {
    let mut before = None;
    for (index, vein) in half.veins.iter().enumerate() {
        let row = row_at(rows, vein.position);
        if let Some(before) = before.filter(|&before| row <= before) {
            return Err(GrowthFormProblem::VeinOrder {
                index,
                row: row + 1,
                before: before + 1,
                rows,
            });
        }
        before = Some(row);
    }
    Ok(())
}
