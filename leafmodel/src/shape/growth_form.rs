//! Growth-algorithm outlines without the first model's simplifications: any growth law, unlike halves, curved veins.
//!
//! Everything is as in [`super::growth_shape`], but that the two halves of the leaf may differ, that lateral growth may follow
//! any curve along the midrib, and that rows of cells may bend: their slope changes with the distance from the midrib.
//!
//! - **In**: a [`GrowthForm`].
//! - **Out**: an [`Outline`], base at the origin, midrib along +y; the lines along which vein rows lie.
//! - **Always true**: the outline never crosses itself. With equal halves, straight rows and the paper's growth law it is that of
//!   [`super::growth_shape::GrowthShape`].
//! - **Left out**: axes that bear rows of their own, which is [`super::palmate`].

mod check;
mod rows;
#[cfg(test)]
mod tests;

use glam::DVec2;

pub use self::check::GrowthFormError;
pub(super) use self::check::{in_range, length as check_length};
use super::cell_rows::ENLARGEMENT;
use super::growth::RateCurve;
use super::outer_boundary::outer_boundary;
use super::outline::Outline;

/// How fast rows of cells grow sideways, by where they start along the midrib.
#[derive(Clone, Debug, PartialEq)]
pub enum LateralGrowth {
    /// Eq. 3 of the paper.
    Peak {
        /// `R = gy / gL0`, axial over greatest lateral growth rate, 0.5 to 100.
        rate_ratio: f64,
        /// `yd`, where lateral growth is fastest, in (0, 1).
        widest_at: f64,
        /// `k`, how late it falls off away from there, > 0 up to 100.
        falloff: f64,
    },
    /// `gL` per step over the place along the midrib, 0 at the petiole and 1 at the tip. Negative rates shrink.
    Curve(RateCurve),
}

/// A row of cells that is a secondary vein.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvedVein {
    /// Place along the midrib, 0 at the petiole, 1 at the tip.
    pub position: f64,
    /// Slope at the midrib: rise along it per unit away from it, −20 to 20.
    pub slope: f64,
    /// Change of slope per midrib's length away from it, −100 to 100; 0 is a straight row, above 0 the vein curves
    /// towards the tip. It belongs to the leaf at every age, so that rows keep their shape relative to it.
    pub bend: f64,
}

/// Parameters of one half of a leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfForm {
    /// How fast rows grow.
    pub lateral: LateralGrowth,
    /// `a`, how fast growth falls off away from a vein, 0 to 100; counts rows (Eq. 4).
    pub lobe_decay: f64,
    /// `n`, shape of that fall, > 0 up to 10 (Eq. 4).
    pub lobe_exponent: f64,
    /// Secondary veins, from base to tip; none means straight rows of slope 0 and no lobes.
    pub veins: Vec<CurvedVein>,
}

/// Parameters of a leaf.
///
/// # Source
///
/// \[young2010\], Eqs. 1–4, and the extensions that its section V names.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthForm {
    /// `N`, rows of cells along the midrib, 3 to 10 000.
    pub rows: usize,
    /// `gy`, growth of the midrib per step, 0.001 to 1.
    pub axial_rate: f64,
    /// The right half, apex up.
    pub right: HalfForm,
    /// The left half; none is the right one's mirror image.
    pub left: Option<HalfForm>,
}

impl GrowthForm {
    /// Grows the primordium until the midrib is a thousand times longer, and scales the outcome so that the midrib measures
    /// `length_mm`, 0.001 to 100 000.
    ///
    /// # Errors
    ///
    /// [`GrowthFormError`], naming the parameter and its range.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, GrowthFormError> {
        check::length(length_mm)?;
        let steps = self.checked_steps()?;
        let points = self.margin(steps, ENLARGEMENT)?;
        let scaled = points.into_iter().map(|p| p * length_mm).collect();
        let apex = DVec2::new(0.0, length_mm);
        Ok(Outline::new(scaled, DVec2::ZERO, apex)?)
    }

    /// The lines along which the vein rows lie at maturity, from the midrib outwards: right ones from base to tip, then
    /// left ones, mm. Where rows pass over each other a line may end inside the blade.
    ///
    /// # Errors
    ///
    /// As [`GrowthForm::grow`].
    pub fn vein_lines(&self, length_mm: f64) -> Result<Vec<Vec<DVec2>>, GrowthFormError> {
        check::length(length_mm)?;
        let steps = self.checked_steps()?;
        let mut lines = Vec::new();
        for (half, side) in [(&self.right, 1.0), (self.left_half(), -1.0)] {
            for line in self.half_lines(half, steps, ENLARGEMENT)? {
                let place = |p: DVec2| DVec2::new(side * p.x, p.y) * length_mm;
                lines.push(line.into_iter().map(place).collect());
            }
        }
        Ok(lines)
    }

    /// Steps after which the midrib has grown a thousandfold, for checked parameters.
    pub(super) fn checked_steps(&self) -> Result<f64, GrowthFormError> {
        self.validate()?;
        Ok(libm::log(ENLARGEMENT) / libm::log(1.0 + self.axial_rate))
    }

    /// The margin after `steps`, when the midrib is `enlargement` times its first length, in units of the midrib:
    /// from the base (0, 0) up the right half, over the apex (0, 1), down the left one.
    pub(super) fn margin(
        &self,
        steps: f64,
        enlargement: f64,
    ) -> Result<Vec<DVec2>, GrowthFormError> {
        let mut points = self.half(&self.right, steps, enlargement)?;
        let left = match &self.left {
            None => points.clone(),
            Some(left) => self.half(left, steps, enlargement)?,
        };
        let inner = &left[1..left.len() - 1];
        points.extend(inner.iter().rev().map(|p| DVec2::new(-p.x, p.y)));
        Ok(points)
    }

    /// Base, margin of one half and apex, on the side of positive x.
    fn half(
        &self,
        half: &HalfForm,
        steps: f64,
        enlargement: f64,
    ) -> Result<Vec<DVec2>, GrowthFormError> {
        let mut points = vec![DVec2::ZERO];
        points.extend(self.row_ends(half, steps, enlargement)?);
        points.push(DVec2::Y);
        // Rows of one slope and bend are the same curve moved along the midrib and cannot cross.
        let alike =
            |pair: &[CurvedVein]| (pair[0].slope, pair[0].bend) == (pair[1].slope, pair[1].bend);
        if half.veins.windows(2).all(alike) {
            return Ok(points);
        }
        Ok(outer_boundary(&points))
    }

    fn left_half(&self) -> &HalfForm {
        self.left.as_ref().unwrap_or(&self.right)
    }
}
