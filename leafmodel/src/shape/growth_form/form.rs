//! The parameters of a leaf that grows from rows of cells.

use super::row_curve::RowCurve;
use crate::shape::growth::RateCurve;

/// Growth in length from primordium to maturity: 0.1 mm to 100 mm in the paper (section III).
pub(super) const MATURITY: f64 = 1000.0;

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
    /// Length when the midrib is 1000 times as long as its primordium, in lengths of the midrib,
    /// 0.01 to 100; [`SecondaryAxis::axial_rate`] is the rate of growth that leads to it.
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
    /// Length of the midrib at which growth ends, in lengths of the primordium, 1 to 1e6. The
    /// paper's value is about 1000; its section V: "changing the point of leaf maturation would
    /// produce allometric shape variation".
    pub maturity: f64,
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

    pub(super) fn curve(&self) -> RowCurve {
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
            maturity: MATURITY,
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
        let per_step = libm::log1p(main_rate) / libm::log(MATURITY);
        (1.0 + main_rate) * libm::pow(self.length, per_step) - 1.0
    }
}
