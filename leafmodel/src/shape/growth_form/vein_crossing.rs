//! Veins that would cross each other, and the slopes that keep them apart.

use super::error::{GrowthFormError, GrowthFormProblem, SlopeRange};
use super::form::VeinRow;
use super::row_curve::RowCurve;
use super::rows::Rows;
use crate::numeric::bisect;

/// Greatest slope of a vein, up or down.
const STEEPEST: f64 = 20.0;

/// A vein from the axis to its end.
#[derive(Clone, Copy, Debug)]
struct VeinLine {
    /// Where it starts along the axis.
    start: f64,
    curve: RowCurve,
    /// Growth of its length relative to that of the axis.
    allometry: f64,
    /// How far from the axis it ends.
    end: f64,
}

impl VeinLine {
    fn new(start: f64, curve: RowCurve, allometry: f64) -> Self {
        Self {
            start,
            curve,
            allometry,
            end: curve.reach(curve.length(1.0) * allometry),
        }
    }

    fn with_slope(self, slope: f64) -> Self {
        let curve = RowCurve {
            slope,
            ..self.curve
        };
        Self::new(self.start, curve, self.allometry)
    }

    /// Whether the line meets one that starts nearer to the tip.
    fn meets(&self, upper: &Self) -> bool {
        // At distance x from the axis the upper vein lies above the lower one by gap + slope x +
        // bend x²/2.
        let gap = upper.start - self.start;
        let slope = upper.curve.slope - self.curve.slope;
        let bend = upper.curve.bend - self.curve.bend;
        let above = |x: f64| gap + (slope + 0.5 * bend * x) * x;
        let end = self.end.min(upper.end);
        let lowest = -slope / bend;
        above(end) <= 0.0 || (bend > 0.0 && lowest > 0.0 && lowest < end && above(lowest) <= 0.0)
    }
}

impl Rows<'_> {
    /// Refuses a form in which two veins cross. The rows between them may cross: the blade is all
    /// that they sweep over together.
    pub(super) fn refuse_crossing_veins(&self) -> Result<(), GrowthFormError> {
        if self.veins_are_alike() {
            return Ok(());
        }
        let line = |&(row, vein): &(usize, VeinRow)| {
            VeinLine::new(self.start(row), vein.curve(), self.allometry(row))
        };
        let lines: Vec<VeinLine> = self.veins.iter().map(line).collect();
        for (number, line) in lines.iter().enumerate() {
            for lower in (0..number).rev() {
                if lines[lower].meets(line) {
                    return Err(self.error(GrowthFormProblem::VeinsCross {
                        lower,
                        upper: number,
                        allowed: slopes_apart(&lines[lower], line, [lower, number]),
                    }));
                }
            }
        }
        Ok(())
    }
}

/// The slopes of the upper vein at which it does not meet the lower one; if there are none, those
/// of the lower vein.
fn slopes_apart(lower: &VeinLine, upper: &VeinLine, [below, above]: [usize; 2]) -> SlopeRange {
    let upper_meets = |slope| lower.meets(&upper.with_slope(slope));
    if !upper_meets(STEEPEST) {
        return SlopeRange::Of {
            vein: above,
            from: first_apart(upper.curve.slope, STEEPEST, upper_meets),
            to: STEEPEST,
        };
    }
    let lower_meets = |slope: f64| lower.with_slope(slope).meets(upper);
    if !lower_meets(-STEEPEST) {
        return SlopeRange::Of {
            vein: below,
            from: -STEEPEST,
            to: first_apart(lower.curve.slope, -STEEPEST, lower_meets),
        };
    }
    SlopeRange::Nothing
}

/// The first slope, on the way from `meeting` to `apart`, at which the veins do not meet; rounded
/// to three decimals if a rounded slope keeps them apart too.
fn first_apart(meeting: f64, apart: f64, meets: impl Fn(f64) -> bool) -> f64 {
    let (meeting, apart) = bisect(meeting, apart, 60, &meets);
    let thousandths = apart * 1000.0;
    let short = if apart > meeting {
        thousandths.ceil() / 1000.0
    } else {
        thousandths.floor() / 1000.0
    };
    if short.abs() > STEEPEST || meets(short) {
        apart
    } else {
        short
    }
}
