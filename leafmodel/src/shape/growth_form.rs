//! Outlines that emerge from local growth rates (the growth-algorithm model).
//!
//! Half a leaf is `N` rows of cells between midrib and margin. The midrib grows at one rate along
//! its whole length, each row at its own rate in its own direction. Growth is exponential over
//! three orders of magnitude, so small differences of rate shape the leaf. This module extends the
//! paper's model: the growth law may be any curve, the halves may differ, rows may bend, and the
//! midrib may bear secondary axes that repeat it, as in palmate leaves.
//!
//! - **In**: a [`GrowthForm`].
//! - **Out**: an [`Outline`], base at the origin, midrib along +y; axes, vein rows and rates of
//!   growth.
//! - **Always true**: the outline never crosses itself, and every axis ends on the blade. Holes
//!   between rows or lobes that meet again are filled. Vein rows of one half do not cross; a form
//!   whose vein rows would cross is refused.
//! - **Left out**: lobes do not push each other aside; where two overlap they become one. Lobes
//!   that meet below the petiole enclose its attachment, as in a peltate leaf. Compound leaves are
//!   in [`crate::compound`].

mod axes;
mod check;
mod course;
mod error;
mod form;
mod keys;
#[cfg(test)]
mod palmate_tests;
mod row_curve;
mod rows;
#[cfg(test)]
mod tests;
mod vein_crossing;

use glam::DVec2;

pub use self::error::{FormPart, GrowthFormError, GrowthFormProblem, Side, SlopeRange};
pub use self::form::{
    Axis, GrowthForm, HalfForm, LateralGrowth, RowGrowth, SecondaryAxis, VeinRow,
};
use self::rows::Rows;
use super::outline::Outline;

impl GrowthForm {
    /// Grows the primordium until the midrib is `maturity` times as long, then scales the outline so
    /// that the midrib measures `length_mm`, 0.001 to 100 000.
    ///
    /// The outline of a leaf without axes starts at the base (0, 0), goes up the right margin to
    /// the apex (0, `length_mm`) and down the left margin; that of a leaf with axes starts at its
    /// lowest point. The last step is cut short, so that the enlargement is exactly the
    /// maturity (the paper: "about 1000").
    ///
    /// # Errors
    ///
    /// [`GrowthFormError`], naming a parameter and its range, veins that cross, or an axis that
    /// lies apart.
    ///
    /// # Source
    ///
    /// \[young2010\], section III.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, GrowthFormError> {
        check::length(length_mm)?;
        let lobes = self.lobes()?;
        if let [(_, margin)] = lobes.as_slice() {
            let scaled = margin.iter().map(|p| p * length_mm).collect();
            let apex = DVec2::new(0.0, length_mm);
            return Outline::new(scaled, DVec2::ZERO, apex).map_err(GrowthFormError::from);
        }
        axes::union(&lobes, length_mm)
    }

    /// All axes from base to tip, mm, the midrib first, each before those on it.
    ///
    /// # Errors
    ///
    /// As [`GrowthForm::grow`], except that axes may lie apart.
    #[cfg(test)]
    pub(crate) fn axis_lines(&self, length_mm: f64) -> Result<Vec<[DVec2; 2]>, GrowthFormError> {
        check::length(length_mm)?;
        let lobes = self.lobes()?;
        let ends = |(place, _): &(axes::Place, Vec<DVec2>)| place.ends().map(|p| p * length_mm);
        Ok(lobes.iter().map(ends).collect())
    }

    /// The lines along which the vein rows of the midrib lie at maturity, from the midrib outwards:
    /// right ones from base to tip, then left ones, mm. Where rows pass over each other a line may
    /// end inside the blade.
    ///
    /// # Errors
    ///
    /// As [`GrowthForm::grow`].
    #[cfg(test)]
    pub(crate) fn vein_lines(&self, length_mm: f64) -> Result<Vec<Vec<DVec2>>, GrowthFormError> {
        check::length(length_mm)?;
        let mut lines = Vec::new();
        for (side, sign) in [(Side::Right, 1.0), (Side::Left, -1.0)] {
            for line in self.midrib_rows(side)?.vein_lines()? {
                let place = |p: DVec2| DVec2::new(sign * p.x, p.y) * length_mm;
                lines.push(line.into_iter().map(place).collect());
            }
        }
        Ok(lines)
    }

    /// Growth of each row on one side of the midrib, from base to tip (Fig. 2 shows the rate below
    /// and the width above).
    ///
    /// # Errors
    ///
    /// As [`GrowthForm::grow`].
    pub fn row_growth(&self, side: Side) -> Result<Vec<RowGrowth>, GrowthFormError> {
        self.midrib_rows(side)?.growth()
    }

    fn midrib_rows(&self, side: Side) -> Result<Rows<'_>, GrowthFormError> {
        let growth = self.checked()?;
        let part = FormPart {
            axes: Vec::new(),
            side,
        };
        Ok(Rows::new(&self.midrib, growth, part))
    }
}
