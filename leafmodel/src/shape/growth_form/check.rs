//! Ranges of a growth form's numbers.

use std::ops::{Bound, RangeBounds};

use super::rows::{AxisGrowth, Rows, row_at};
use super::{
    Axis, FormPart, GrowthForm, GrowthFormError, GrowthFormProblem, HalfForm, LateralGrowth, Side,
};

/// Greatest depth of axes on axes.
const DEEPEST: usize = 8;

/// Above 0, up to `most`.
fn above_0(most: f64) -> impl RangeBounds<f64> {
    (Bound::Excluded(0.0), Bound::Included(most))
}

/// Refuses lengths outside 0.001 to 100 000 mm.
pub(super) fn length(length_mm: f64) -> Result<(), GrowthFormError> {
    let words = "0.001 to 100000 (millimetres)";
    Ok(in_range("length_mm", length_mm, 1e-3..=1e5, words)?)
}

/// Refuses a `value` outside `range`; NaN is outside every range.
pub(super) fn in_range(
    key: &'static str,
    value: f64,
    range: impl RangeBounds<f64>,
    words: &'static str,
) -> Result<(), GrowthFormProblem> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(GrowthFormProblem::OutOfRange {
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
    /// [`GrowthFormError`] for the first parameter that is out of range, or for veins that cross.
    pub fn validate(&self) -> Result<(), GrowthFormError> {
        self.checked().map(|_| ())
    }

    /// Checks every parameter and returns the growth of the midrib.
    pub(super) fn checked(&self) -> Result<AxisGrowth, GrowthFormError> {
        in_range("axial_rate", self.axial_rate, 1e-3..=1.0, "0.001 to 1")?;
        let growth = AxisGrowth::of_midrib(self.axial_rate);
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
    let at = |side| {
        move |problem| GrowthFormError {
            part: part(side),
            problem,
        }
    };
    in_range("rows", axis.rows as f64, 3.0..=1e4, "3 to 10000").map_err(at(Side::Right))?;
    check_half(axis.rows, &axis.right).map_err(at(Side::Right))?;
    Rows::new(axis, growth, part(Side::Right)).refuse_crossing_veins()?;
    if let Some(left) = &axis.left {
        check_half(axis.rows, left).map_err(at(Side::Left))?;
        Rows::new(axis, growth, part(Side::Left)).refuse_crossing_veins()?;
    }
    for (number, secondary) in axis.axes.iter().enumerate() {
        path.push(number);
        let at = |problem| GrowthFormError {
            part: FormPart {
                axes: path.clone(),
                side: Side::Right,
            },
            problem,
        };
        let depth = path.len() as f64;
        in_range("depth", depth, 0.0..=DEEPEST as f64, "0 to 8").map_err(at)?;
        in_range("position", secondary.position, 0.0..=1.0, "0 to 1").map_err(at)?;
        let half_turn = std::f64::consts::PI;
        in_range(
            "angle",
            secondary.angle,
            -half_turn..=half_turn,
            "-pi to pi",
        )
        .map_err(at)?;
        let words = "0.01 to 100 of the midrib's length";
        in_range("length", secondary.length, 0.01..=100.0, words).map_err(at)?;
        check_axis(&secondary.axis, growth.of_secondary(secondary), path)?;
        path.pop();
    }
    Ok(())
}

fn check_half(rows: usize, half: &HalfForm) -> Result<(), GrowthFormProblem> {
    match &half.lateral {
        LateralGrowth::Curve(_) => {}
        LateralGrowth::Peak {
            rate_ratio,
            widest_at,
            falloff,
        } => {
            in_range("rate_ratio", *rate_ratio, 0.5..=100.0, "0.5 to 100")?;
            let words = "0 to 1, both excluded";
            let between = (Bound::Excluded(0.0), Bound::Excluded(1.0));
            in_range("widest_at", *widest_at, between, words)?;
            in_range("falloff", *falloff, above_0(100.0), "0 (excluded) to 100")?;
        }
    }
    in_range("lobe_decay", half.lobe_decay, 0.0..=100.0, "0 to 100")?;
    let words = "0 (excluded) to 10";
    in_range("lobe_exponent", half.lobe_exponent, above_0(10.0), words)?;
    let mut before = None;
    for (index, vein) in half.veins.iter().enumerate() {
        in_range("veins.position", vein.position, 0.0..=1.0, "0 to 1")?;
        in_range("veins.slope", vein.slope, -20.0..=20.0, "-20 to 20")?;
        in_range("veins.bend", vein.bend, -100.0..=100.0, "-100 to 100")?;
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
