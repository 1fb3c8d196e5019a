//! Ranges of a plan's numbers.

use glam::DVec2;

use super::error::PlanError;
use super::young_size;
use super::{AuxinPlan, Growth, Pattern};
use crate::document::Declared;
use crate::shape::outline::Outline;
use crate::venation::veins::COINCIDENT;

/// Greatest number of darts in all steps of growth together, or in one step without growth. More
/// would take minutes and add nothing.
const MOST_DARTS: f64 = 1e8;

impl AuxinPlan {
    /// Checks every number by itself, and that growth ends.
    ///
    /// # Errors
    ///
    /// [`PlanError`], naming the parameter and its range.
    pub fn validate(&self) -> Result<(), PlanError> {
        self.in_range()?;
        let is_anisotropic = matches!(self.growth, Growth::Anisotropic { .. });
        let has_arches = self.margin_clearance.is_some_and(|rule| rule.arches > 0);
        let has_architecture = self.architecture.is_some();
        let pairs = [
            (
                has_architecture && self.pattern == Pattern::Open,
                "architecture",
                "an open pattern",
            ),
            (
                has_architecture && matches!(self.growth, Growth::Marginal { .. }),
                "architecture",
                "marginal growth",
            ),
            (
                has_architecture && !self.origins.is_empty(),
                "architecture",
                "origins",
            ),
            (
                has_architecture && has_arches,
                "architecture",
                "margin_clearance.arches",
            ),
            (
                has_arches && self.pattern == Pattern::Open,
                "margin_clearance.arches",
                "an open pattern",
            ),
            (
                self.free_endings.is_some() && self.pattern == Pattern::Open,
                "free_endings",
                "an open pattern",
            ),
            (
                self.gaussian_curvature != 0.0 && is_anisotropic,
                "gaussian_curvature",
                "anisotropic growth",
            ),
        ];
        if let Some(&(_, key, other)) = pairs.iter().find(|(both, ..)| *both) {
            return Err(PlanError::Incompatible { key, other });
        }
        if let Some(architecture) = &self.architecture {
            architecture.validate()?;
        }
        match &self.growth {
            Growth::None => Ok(()),
            Growth::Marginal {
                initial_length,
                length_step,
            }
            | Growth::Isogonic {
                initial_length,
                length_step,
            } => self.validate_growth(*initial_length, *length_step),
            // The clock checks that it reaches the final length.
            Growth::Anisotropic { initial_length, .. } => {
                self.validate_growth(*initial_length, 1.0)
            }
        }
    }

    fn validate_growth(&self, initial_length: f64, length_step: f64) -> Result<(), PlanError> {
        if initial_length > self.final_length {
            return Err(PlanError::StartsLonger { initial_length });
        }
        let steps = ((self.final_length - initial_length) / length_step).ceil();
        if steps > 1e6 {
            return Err(PlanError::TooManySteps { length_step, steps });
        }
        Ok(())
    }

    /// Checks what depends on the margin; `blade` is in segments, base at the origin.
    pub(crate) fn validate_on(&self, blade: &Outline) -> Result<(), PlanError> {
        let origins = self.origins_in_segments();
        if let Some(index) = origins
            .iter()
            .position(|&p| !(p.is_finite() && blade.covers(p)))
        {
            let [x, y] = self.origins[index];
            return Err(PlanError::OriginOffBlade { index, x, y });
        }
        for (second, p) in origins.iter().enumerate() {
            let near = |q: &DVec2| (*q - *p).length() < COINCIDENT;
            if let Some(first) = origins[..second].iter().position(near) {
                return Err(PlanError::OriginsMeet { first, second });
            }
        }
        if self.joined_origins && origins.iter().any(|p| p.length() < COINCIDENT) {
            return Err(PlanError::OriginAtBase);
        }
        if let Some(architecture) = &self.architecture {
            let young = young_size(&self.growth, self.final_length);
            architecture.validate_on(blade, young)?;
        }
        // The map of a saddle ends where the enlargement is 0.
        let middle = (blade.base() + blade.apex()) * 0.5;
        let (low, high) = blade.bounds();
        let farthest = (low - middle).abs().max((high - middle).abs()).length() / self.final_length;
        if 1.0 + 0.25 * self.gaussian_curvature * farthest * farthest < 0.1 {
            let curvature = self.gaussian_curvature;
            return Err(PlanError::TooCurved { curvature });
        }
        Ok(())
    }

    /// Checks the ratios of the young leaf's size to the full-grown one's, across and along.
    pub(crate) fn validate_young(ratios: DVec2) -> Result<(), PlanError> {
        let (low, high) = (ratios.min_element(), ratios.max_element());
        if low >= 1e-6 && high <= 2.0 {
            return Ok(());
        }
        let times = if high <= 2.0 { low } else { high };
        Err(PlanError::YoungLeaf { times })
    }

    /// Refuses a total number of darts that would take too long.
    pub(crate) fn validate_darts(darts: f64) -> Result<(), PlanError> {
        if darts <= MOST_DARTS {
            Ok(())
        } else {
            Err(PlanError::TooManyDarts { darts })
        }
    }
}
