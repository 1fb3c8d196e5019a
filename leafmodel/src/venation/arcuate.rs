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
mod plan;
mod spline;
#[cfg(test)]
mod tests;

use glam::DVec2;

pub use self::fields::ArcuateFields;
pub use self::layout::ArcuateVeins;
use self::layout::{Frame, Sides, lay_out};
pub use self::plan::{ArcuatePlan, PalmateVeins};
use super::network::{NetworkError, VenationNetwork};
use crate::document::Declared;
use crate::not_grown::{NotGrown, not_grown};
use crate::shape::cubic_margin::CubicMargin;
use crate::shape::outline::Outline;

impl ArcuatePlan {
    /// The network on the article's margin, with places on the margin given by the spline's own
    /// parameter.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming the number that is out of range, or why the splines are not a valid
    /// margin.
    pub(crate) fn network_within(
        &self,
        margin: &CubicMargin,
        length_mm: f64,
    ) -> Result<VenationNetwork, NotGrown> {
        self.in_range()?;
        let outline = margin.grow(length_mm)?;
        let sides = Sides::mirrored(margin.flat());
        let veins = self.veins_between(Frame::upright(length_mm), &sides, Some(&outline));
        graph::network(&veins, &outline).map_err(|error| no_room(&error))
    }

    /// The network on any margin. Its two sides from base to apex, parametrised by arc length,
    /// replace the article's splines.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming the number that is out of range.
    pub fn network(&self, outline: &Outline) -> Result<VenationNetwork, NotGrown> {
        let veins = self.veins_on(outline)?;
        graph::network(&veins, outline).map_err(|error| no_room(&error))
    }

    /// The veins as splines on the article's margin, exactly as in its code.
    ///
    /// # Errors
    ///
    /// As [`ArcuatePlan::network_within`], except that the margin may cross itself.
    pub(crate) fn veins_within(
        &self,
        margin: &CubicMargin,
        length_mm: f64,
    ) -> Result<ArcuateVeins, NotGrown> {
        self.in_range()?;
        margin.in_range()?;
        let blade = margin.grow(length_mm).ok();
        let sides = Sides::Cubic(margin.spline());
        Ok(self.veins_between(Frame::upright(length_mm), &sides, blade.as_ref()))
    }

    /// The veins as splines on any margin.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub(crate) fn veins_on(&self, outline: &Outline) -> Result<ArcuateVeins, NotGrown> {
        self.in_range()?;
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
    /// [`NotGrown`].
    pub fn primaries_laid(&self, outline: &Outline) -> Result<Vec<f64>, NotGrown> {
        Ok(graph::primaries_laid(&self.veins_on(outline)?, outline))
    }
}

fn no_room(error: &NetworkError) -> NotGrown {
    not_grown!("no veins fit on this blade: {error}")
}
