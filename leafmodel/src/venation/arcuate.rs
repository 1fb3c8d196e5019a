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

use std::ops::RangeInclusive;

use glam::DVec2;
use thiserror::Error;

pub use self::fields::ArcuateFields;
use self::layout::{Frame, Sides, Vein, lay_out};
use super::network::{NetworkError, VenationNetwork};
use crate::shape::cubic_margin::{CubicMargin, CubicMarginError};
use crate::shape::outline::Outline;

/// Primary veins that fan out from the petiole beside the midrib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PalmateVeins {
    /// Number per side, 1 to 12.
    pub per_side: u32,
    /// Distribution of their ends along the margin, 0.05 to 1: 1 spreads them evenly from base to
    /// tip, smaller values gather them towards the tip.
    pub spread: f64,
    /// How far they bow outwards, as a share of half their length, −0.8 to 0.8: 0 is straight;
    /// above 0 they follow the margin.
    pub bow: f64,
}

/// Parameters of the pattern. Lengths are in units of the leaf's length; the names are the
/// article's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcuatePlan {
    /// `Veins`: number of lateral veins on each side of each primary, 1 to 100.
    pub veins: u32,
    /// `Seed` of the variation.
    pub seed: u32,
    /// `Var`: irregularity of the starts of laterals, 0 to 1.
    pub variation: f64,
    /// `Width`: half width of the midrib at the base, 0.0001 to 0.5.
    pub width: f64,
    /// `NWidth`: distance from veins up to which the finer net reaches, 0 to 1.
    pub net_width: f64,
    /// `Squish`: distribution of end points over the margin, 0 (all at the tip) to 1 (even).
    pub squish: f64,
    /// `Squish2`: distribution of control points, 0 (all at the tip) to 1 (even).
    pub squish2: f64,
    /// `Squish3`: distribution of starting points over the midrib, 0 (all near the base) to 1
    /// (even).
    pub squish3: f64,
    /// `Up`: distance of control points from the midrib, as a share of the margin's distance, 0
    /// to 2.
    pub up: f64,
    /// Width of a vein at its tip as a share of that at its base, 0 to 1. Our extension; the
    /// article has 0.
    pub tip_width: f64,
    /// Primaries beside the midrib, if any. Our extension.
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
    #[error("{key} is {value}, outside {range}")]
    OutOfRange {
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
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
    /// [`ArcuateError::OutOfRange`] for the first number that is out of range.
    pub fn validate(&self) -> Result<(), ArcuateError> {
        in_range("veins", f64::from(self.veins), 1.0..=100.0, "1 to 100")?;
        in_range("variation", self.variation, 0.0..=1.0, "0 to 1")?;
        in_range("width", self.width, 1e-4..=0.5, "0.0001 to 0.5")?;
        in_range("net_width", self.net_width, 0.0..=1.0, "0 to 1")?;
        in_range("squish", self.squish, 0.0..=1.0, "0 to 1")?;
        in_range("squish2", self.squish2, 0.0..=1.0, "0 to 1")?;
        in_range("squish3", self.squish3, 0.0..=1.0, "0 to 1")?;
        in_range("up", self.up, 0.0..=2.0, "0 to 2")?;
        in_range("tip_width", self.tip_width, 0.0..=1.0, "0 to 1")?;
        if let Some(palmate) = &self.palmate {
            let per_side = f64::from(palmate.per_side);
            in_range("palmate.per_side", per_side, 1.0..=12.0, "1 to 12")?;
            in_range("palmate.spread", palmate.spread, 0.05..=1.0, "0.05 to 1")?;
            in_range("palmate.bow", palmate.bow, -0.8..=0.8, "-0.8 to 0.8")?;
        }
        Ok(())
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
            Err(error @ CubicMarginError::OutOfRange { .. }) => return Err(error.into()),
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
    /// [`ArcuateError::OutOfRange`].
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
    /// [`ArcuateError::OutOfRange`].
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

/// Refuses a `value` outside `range`; NaN is outside every range.
fn in_range(
    key: &'static str,
    value: f64,
    range: RangeInclusive<f64>,
    words: &'static str,
) -> Result<(), ArcuateError> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(ArcuateError::OutOfRange {
            key,
            value,
            range: words,
        })
    }
}
