//! Veins as splines: pinnate to arcuate patterns in closed form, without a simulation.
//!
//! Each lateral vein is a quadratic spline from the midrib to the margin. Its control point lies on
//! a copy of the margin that is narrowed towards the midrib. The distributions of start, control
//! and end points along the leaf decide between straight pinnate veins and arcuate ones that sweep
//! along the margin to the tip.
//!
//! - **In**: an [`ArcuatePlan`], and any [`Outline`] or the article's own, a [`CubicMargin`].
//! - **Out**: a [`VenationNetwork`]; or [`ArcuateVeins`], which give the fields Vein, Net and Fac
//!   at any point.
//! - **Always true**: every vein of the network starts on the midrib or a primary and ends on the
//!   margin, or where it meets another vein; no vein crosses the margin or another vein.
//! - **Left out**: veins of the third order and above. Net marks where they would be.
//!
//! # Source
//!
//! \[oslveins\]; `docs/src/theory/arcuate-veins.md` says where this departs from its code.

mod cell_noise;
mod fields;
mod graph;
mod layout;
mod spline;
#[cfg(test)]
mod tests;

use glam::DVec2;
use thiserror::Error;

pub use self::fields::ArcuateFields;
use self::layout::{Frame, Sides, Vein, lay_out};
use super::network::{NetworkError, VenationNetwork};
use crate::document::declared::Declared;
use crate::document::ranges::RangeError;
use crate::shape::cubic_margin::{CubicMargin, CubicMarginError};
use crate::shape::outline::Outline;

/// Primary veins that fan out from the petiole beside the midrib.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct PalmateVeins {
    /// Primaries a side.
    #[key("per_side", required, 1..=12)]
    pub per_side: u32,
    /// How far down the margin they end: 1 spreads them evenly from base to tip.
    ///
    /// Distribution of their ends along the margin: 1 spreads them evenly from base to tip, smaller
    /// values gather them towards the tip.
    #[key("spread", required, 0.05..=1.0)]
    pub spread: f64,
    /// How much they bow outwards, in shares of half their length.
    #[key("bow", -0.8..=0.8)]
    pub bow: f64,
}

/// Parameters of the pattern. Lengths are in units of the leaf's length; the names are the
/// article's.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct ArcuatePlan {
    /// Veins: lateral veins a side of each primary.
    #[key("laterals", 1..=100)]
    pub veins: u32,
    /// Seed of their irregularity.
    #[key("seed", 0..=u32::MAX as u64)]
    pub seed: u32,
    /// How irregular they are.
    #[key("variation", 0.0..=1.0)]
    pub variation: f64,
    /// Width: half width of the midrib at the base. The default is the article's, where veins
    /// merge; a leaf's is about 0.006.
    #[key("width", 1e-4..=0.5)]
    pub width: f64,
    /// How far from veins the finer net reaches (field `net` only).
    #[key(
        "net_width",
        0.0..=1.0,
        about = "NWidth: how far from veins the finer net reaches (field `net` only)."
    )]
    pub net_width: f64,
    /// Squish: how end points are spread over the margin: 1 evenly (pinnate), 0 all at the tip
    /// (arcuate).
    #[key("squish", 0.0..=1.0)]
    pub squish: f64,
    /// Squish2: the same of control points.
    #[key("squish2", 0.0..=1.0)]
    pub squish2: f64,
    /// Squish3: the same of starting points on the midrib; 0 all near the base.
    #[key("squish3", 0.0..=1.0)]
    pub squish3: f64,
    /// Up: how far control points are from the midrib, over the margin's distance.
    #[key("up", 0.0..=2.0)]
    pub up: f64,
    /// Share of a vein's width that is left at its tip.
    ///
    /// Width of a vein at its tip as a share of that at its base Our extension; the article has 0.
    #[key("tip_width", 0.0..=1.0)]
    pub tip_width: f64,
    /// Primary veins from the base, beside the midrib.
    #[key("palmate", block, default = PalmateVeins { per_side: 1, spread: 0.5, bow: 0.0 })]
    pub palmate: Option<PalmateVeins>,
}

impl Default for ArcuatePlan {
    /// The article's defaults.
    fn default() -> Self {
        Self {
            veins: 7,
            seed: 42,
            variation: 0.0,
            width: 0.05,
            net_width: 0.25,
            squish: 0.5,
            squish2: 0.5,
            squish3: 0.5,
            up: 0.5,
            tip_width: 0.0,
            palmate: None,
        }
    }
}

/// Why no veins can be laid out.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ArcuateError {
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The article's margin is not valid.
    #[error(transparent)]
    Margin(#[from] CubicMarginError),
    /// No veins fit on the blade.
    #[error("no veins fit on this blade: {0}")]
    Network(#[from] NetworkError),
}

/// Veins laid out on a blade.
#[derive(Clone, Debug, PartialEq)]
pub struct ArcuateVeins {
    frame: Frame,
    plan: ArcuatePlan,
    /// Midrib first, then the primaries beside it.
    axes: Vec<Vein>,
    /// In the order of the article's code: from base to tip, upper side before lower side.
    laterals: Vec<Vein>,
}

impl ArcuatePlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`ArcuateError::Range`] for the first number that is out of range.
    pub fn validate(&self) -> Result<(), ArcuateError> {
        Ok(self.in_range()?)
    }

    /// The network on the article's margin, with places on the margin given by the spline's own
    /// parameter.
    ///
    /// # Errors
    ///
    /// [`ArcuateError`], naming the number that is out of range, or why the splines are not a valid
    /// margin.
    pub fn network_within(
        &self,
        margin: &CubicMargin,
        length_mm: f64,
    ) -> Result<VenationNetwork, ArcuateError> {
        self.validate()?;
        let outline = margin.grow(length_mm)?;
        let sides = Sides::mirrored(margin.flat());
        let veins = self.veins_between(Frame::upright(length_mm), &sides, Some(&outline));
        Ok(graph::network(&veins, &outline)?)
    }

    /// The network on any margin. Its two sides from base to apex, parametrised by arc length,
    /// replace the article's splines.
    ///
    /// # Errors
    ///
    /// [`ArcuateError`], naming the number that is out of range.
    pub fn network(&self, outline: &Outline) -> Result<VenationNetwork, ArcuateError> {
        let veins = self.veins_on(outline)?;
        Ok(graph::network(&veins, outline)?)
    }

    /// The veins as splines on the article's margin, exactly as in its code.
    ///
    /// # Errors
    ///
    /// As [`ArcuatePlan::network_within`], except that the margin may cross itself.
    pub fn veins_within(
        &self,
        margin: &CubicMargin,
        length_mm: f64,
    ) -> Result<ArcuateVeins, ArcuateError> {
        self.validate()?;
        let blade = match margin.grow(length_mm) {
            Err(error @ CubicMarginError::Range(_)) => return Err(error.into()),
            Err(CubicMarginError::Margin(_)) => None,
            Ok(outline) => Some(outline),
        };
        let sides = Sides::Cubic(margin.spline());
        Ok(self.veins_between(Frame::upright(length_mm), &sides, blade.as_ref()))
    }

    /// The veins as splines on any margin.
    ///
    /// # Errors
    ///
    /// [`ArcuateError::Range`].
    pub fn veins_on(&self, outline: &Outline) -> Result<ArcuateVeins, ArcuateError> {
        self.validate()?;
        let frame = Frame::of(outline);
        Ok(self.veins_between(frame, &Sides::of(outline, frame), Some(outline)))
    }

    /// Veins between two sides. If a blade is given, primaries stay on it.
    fn veins_between(&self, frame: Frame, sides: &Sides, blade: Option<&Outline>) -> ArcuateVeins {
        let on_blade = |p: DVec2| blade.is_none_or(|blade| blade.contains(frame.to_mm(p)));
        let (axes, laterals) = lay_out(self, sides, &on_blade);
        ArcuateVeins {
            frame,
            plan: *self,
            axes,
            laterals,
        }
    }
}

impl ArcuatePlan {
    /// For each primary beside the midrib the share of its length, 0 to 1, that has room on the
    /// blade: a sinus of the margin or another vein may cut it short. Primaries come in pairs, left
    /// before right, those nearest the base first. Empty if `palmate` is `None`.
    ///
    /// # Errors
    ///
    /// [`ArcuateError::Range`].
    pub fn primaries_laid(&self, outline: &Outline) -> Result<Vec<f64>, ArcuateError> {
        Ok(graph::primaries_laid(&self.veins_on(outline)?, outline))
    }
}

impl ArcuateVeins {
    /// Number of lateral veins of both sides.
    #[cfg(test)]
    pub(crate) fn laterals(&self) -> usize {
        self.laterals.len()
    }

    /// Start, control and end point of a lateral, mm. Laterals of the midrib come first, from base
    /// to tip, left before right.
    #[cfg(test)]
    pub(crate) fn lateral(&self, index: usize) -> Option<[DVec2; 3]> {
        let vein = self.laterals.get(index)?;
        Some(vein.curve.0.map(|p| self.frame.to_mm(p)))
    }
}
