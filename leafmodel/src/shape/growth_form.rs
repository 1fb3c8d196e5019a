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
mod error;
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
use self::row_curve::RowCurve;
use self::rows::Rows;
use super::growth::RateCurve;
use super::outline::Outline;

/// Growth in length from primordium to maturity: 0.1 mm to 100 mm in the paper (section III).
pub(crate) const ENLARGEMENT: f64 = 1000.0;

/// Lateral growth rate of rows of cells, by where they start along their axis.
#[derive(Clone, Debug, PartialEq)]
pub enum LateralGrowth {
    /// Eq. 3 of the paper.
    Peak {
        /// `R = gy / gL0`, the axis' growth rate over its greatest lateral growth rate, 0.5 to 100.
        rate_ratio: f64,
        /// `yd`, the place along the axis where lateral growth is fastest, in (0, 1).
        widest_at: f64,
        /// `k`, exponent of the fall to both sides of `yd`, > 0 up to 100: the greater, the farther
        /// from `yd` growth stays fast.
        falloff: f64,
    },
    /// `gL` per step as a function of the place along the axis, 0 at its base, 1 at its tip. Rows
    /// with negative rates shrink.
    Curve(RateCurve),
}

/// A row of cells that is a secondary vein: it sets the direction of growth and bears a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinRow {
    /// Place along the axis, 0 at its base, 1 at its tip.
    pub position: f64,
    /// Slope `s` at the axis: rise along the axis per unit of distance from it, −20 to 20. Growth
    /// does not change it.
    pub slope: f64,
    /// Change of slope over a distance of one axis' length from the axis, −100 to 100. 0 gives a
    /// straight row; above 0 the vein curves towards the tip. The unit is the length of the axis at
    /// each age, so that rows keep their shape relative to it.
    pub bend: f64,
}

/// Parameters of one half of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfForm {
    /// How fast rows grow.
    pub lateral: LateralGrowth,
    /// `a`, how fast growth falls off away from a vein, 0 to 100; 0 gives an entire leaf (Eq. 4).
    /// Distance is counted in rows, so a value holds for one number of rows only.
    pub lobe_decay: f64,
    /// `n`, exponent of that fall, > 0 up to 10: 1 pointed lobes, 2 rounded ones (Eq. 4).
    pub lobe_exponent: f64,
    /// Secondary veins, from base to tip. Without any, rows are straight, of slope 0, and there are
    /// no lobes.
    pub veins: Vec<VeinRow>,
}

/// An axis with the rows of cells on both of its sides: the midrib, or one that repeats it.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// `N`, rows of cells along the axis, 3 to 10 000. The paper's typical value is 150.
    pub rows: usize,
    /// The right half, tip up.
    pub right: HalfForm,
    /// The left half; `None` means the mirror image of the right one.
    pub left: Option<HalfForm>,
    /// Secondary axes on this one.
    pub axes: Vec<SecondaryAxis>,
}

/// A secondary axis, which repeats the midrib.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondaryAxis {
    /// Where it starts along its parent, 0 at the parent's base to 1 at its tip; 0 in a palmate
    /// leaf.
    pub position: f64,
    /// Its direction, radians from the parent's towards the right, −π to π.
    pub angle: f64,
    /// Whether the axis has a twin: its mirror image about the parent, with the mirror images of
    /// all axes on it.
    pub paired: bool,
    /// Length at maturity, in lengths of the midrib, 0.01 to 100; [`SecondaryAxis::axial_rate`] is
    /// the rate of growth that leads to it.
    pub length: f64,
    /// Its rows, and the axes on it.
    pub axis: Axis,
}

/// Parameters of a leaf; the letters are the paper's.
///
/// # Source
///
/// \[young2010\], Eqs. 1–4, and the extensions that its section V names. For palmate leaves section
/// IV asks for "a self-similar organization in which the secondary veins replicate the midrib with
/// autonomous growth characteristics". How axes are placed is our choice.
/// `docs/src/theory/growth-shape.md` says where this departs from the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthForm {
    /// `gy`, growth of the midrib per step, 0.001 to 1. The paper's value is 0.1.
    pub axial_rate: f64,
    /// The midrib and all that grows on it.
    pub midrib: Axis,
}

/// Growth of one row of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowGrowth {
    /// Where it starts along the midrib, 0 at the petiole to 1 at the tip.
    pub place: f64,
    /// `gL`, rate of growth of its length per step.
    pub rate: f64,
    /// How far from the midrib it ends at maturity, as a share of the midrib's length.
    pub half_width: f64,
}

impl VeinRow {
    /// A vein that does not bend.
    pub const fn straight(position: f64, slope: f64) -> Self {
        Self {
            position,
            slope,
            bend: 0.0,
        }
    }

    fn curve(&self) -> RowCurve {
        RowCurve {
            slope: self.slope,
            bend: self.bend,
        }
    }
}

impl HalfForm {
    /// Half of an entire leaf, from `R`, `yd` and `k`.
    pub const fn entire(rate_ratio: f64, widest_at: f64, falloff: f64) -> Self {
        Self {
            lateral: LateralGrowth::Peak {
                rate_ratio,
                widest_at,
                falloff,
            },
            lobe_decay: 0.0,
            lobe_exponent: 2.0,
            veins: Vec::new(),
        }
    }
}

impl From<HalfForm> for Axis {
    /// A symmetrical axis of 150 rows that bears no others.
    fn from(right: HalfForm) -> Self {
        Self {
            rows: 150,
            right,
            left: None,
            axes: Vec::new(),
        }
    }
}

impl From<Axis> for GrowthForm {
    /// A leaf whose midrib grows by a tenth per step, as in the paper.
    fn from(midrib: Axis) -> Self {
        Self {
            axial_rate: 0.1,
            midrib,
        }
    }
}

impl From<HalfForm> for GrowthForm {
    /// A symmetrical leaf of 150 rows whose midrib grows by a tenth per step, as in the paper.
    fn from(half: HalfForm) -> Self {
        Axis::from(half).into()
    }
}

impl SecondaryAxis {
    /// The rate at which the axis grows on a midrib that grows at `main_rate`:
    /// `(1 + gy) length^(1/T) − 1`, as both grow for the same `T` steps from primordia of equal
    /// size.
    pub fn axial_rate(&self, main_rate: f64) -> f64 {
        let per_step = libm::log1p(main_rate) / libm::log(ENLARGEMENT);
        (1.0 + main_rate) * libm::pow(self.length, per_step) - 1.0
    }
}

impl GrowthForm {
    /// Grows the primordium until the midrib is 1000 times as long, then scales the outline so that
    /// the midrib measures `length_mm`, 0.001 to 100 000.
    ///
    /// The outline of a leaf without axes starts at the base (0, 0), goes up the right margin to
    /// the apex (0, `length_mm`) and down the left margin; that of a leaf with axes starts at its
    /// lowest point. The last step is cut short, so that the enlargement is exactly 1000 (the
    /// paper: "about 1000").
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
