//! Where the tissue of a grown leaf was when the leaf was younger.

use glam::DVec2;

use super::error::{FormPart, GrowthFormError, Side};
use super::form::GrowthForm;
use super::row_curve::RowCurve;
use super::rows::Rows;

/// A row of cells at maturity and earlier.
#[derive(Clone, Copy, Debug)]
struct Row {
    start: f64,
    curve: RowCurve,
    /// Length earlier, over that at maturity, both in lengths of the midrib at the time.
    ratio: f64,
}

impl Row {
    /// How high the row lies at a distance from the midrib.
    fn height(&self, x: f64) -> f64 {
        self.start + self.curve.rise(x)
    }

    /// Where a cell is earlier that ends up at a distance from the midrib.
    fn earlier(&self, x: f64) -> DVec2 {
        let x = self.curve.reach(self.curve.length(x) * self.ratio);
        DVec2::new(x, self.height(x))
    }
}

/// The map from a leaf at maturity to the same leaf earlier: the allometric course of Eqs. 1 and 2
/// of \[young2010\].
///
/// Every cell keeps its row and its fraction of that row's length. Lengths are in units of the
/// midrib at the time. Between rows the map is linear.
#[derive(Debug)]
pub(crate) struct Course {
    right: Vec<Row>,
    left: Vec<Row>,
}

impl GrowthForm {
    /// The map to the time at which the midrib had a fraction of its length, in (0, 1]; none for a
    /// palmate leaf, whose lobes overlap.
    ///
    /// # Errors
    ///
    /// As [`GrowthForm::grow`].
    pub(crate) fn course(&self, fraction: f64) -> Result<Option<Course>, GrowthFormError> {
        if !self.midrib.axes.is_empty() {
            return Ok(None);
        }
        // The primordium has the form with which growth starts.
        let fraction = fraction.clamp(1.0 / self.maturity, 1.0);
        let rows = |side| -> Result<Vec<Row>, GrowthFormError> {
            let growth = self.checked()?;
            let part = FormPart {
                axes: Vec::new(),
                side,
            };
            let rows = Rows::new(&self.midrib, growth, part);
            let row = |j| Row {
                start: rows.start(j),
                curve: rows.curve(j),
                ratio: rows.earlier_allometry(j, fraction) / rows.allometry(j),
            };
            Ok((0..self.midrib.rows).map(row).collect())
        };
        Ok(Some(Course {
            right: rows(Side::Right)?,
            left: rows(Side::Left)?,
        }))
    }
}

impl Course {
    /// Where the tissue at a point of the mature leaf was, with the base at the origin and the apex
    /// at (0, 1).
    pub(crate) fn earlier(&self, p: DVec2) -> DVec2 {
        let (rows, side) = if p.x < 0.0 {
            (&self.left, -1.0)
        } else {
            (&self.right, 1.0)
        };
        let x = p.x.abs();
        let above = rows.partition_point(|row| row.height(x) < p.y);
        let above = above.clamp(1, rows.len() - 1);
        let pair = [&rows[above - 1], &rows[above]];
        let [low, high] = pair.map(|row| row.height(x));
        // Outside the outermost rows the map continues as between the two next to the point.
        let between = (p.y - low) / (high - low);
        let [from, to] = pair.map(|row| row.earlier(x));
        let earlier = from + (to - from) * between;
        DVec2::new(side * earlier.x, earlier.y)
    }
}
