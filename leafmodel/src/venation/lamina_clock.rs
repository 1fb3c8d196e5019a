//! The size of the lamina at each step.
//!
//! Positions are kept in segments, base at the origin. Under marginal and isogonic growth these are
//! positions in the full-grown leaf, and growth (section 3.3) changes one number:
//!
//! - marginal: the margin of step `t` is the final one shrunk about the base by `σ_t / σ_final`;
//! - isogonic: lamina and veins keep their places while the unit of length shrinks,
//!   `λ_t = λ_final σ_final / σ_t`, and with it the segment, the kill distance and the birth
//!   distances.
//!
//! Anisotropic growth has no such frame: positions are those of the current step and move.

use super::plan::{AuxinPlan, Growth};
use crate::not_grown::NotGrown;
use crate::shape::growth::{TissueMap, arrival};

/// The lamina at one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stage {
    /// The unit of length `λ`: a segment of this step, in segments of the frame, ≥ 1.
    pub(crate) unit: f64,
    /// Whether the lamina still grows after this step.
    pub(crate) still_growing: bool,
}

/// Growth of the lamina by step.
#[derive(Clone, Debug)]
pub(crate) struct LaminaClock {
    final_length: f64,
    growth: Growth,
    /// Time at which anisotropic growth ends, in steps, not rounded.
    arrival: f64,
}

impl LaminaClock {
    /// The clock of a checked plan.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] if anisotropic growth never reaches the final length.
    pub(crate) fn new(plan: &AuxinPlan) -> Result<Self, NotGrown> {
        let arrival = match &plan.growth {
            Growth::None | Growth::Marginal { .. } | Growth::Isogonic { .. } => 0.0,
            Growth::Anisotropic {
                initial_length,
                along,
                ..
            } => arrival(*initial_length, along, plan.final_length).map_err(|error| {
                let help = "use higher rates along the leaf";
                error.mend("venation.*.growth.*.along", help)
            })?,
        };
        Ok(Self {
            final_length: plan.final_length,
            growth: plan.growth.clone(),
            arrival,
        })
    }

    /// The step at which the lamina first has its final size; 0 without growth.
    pub(crate) fn last_growth_step(&self) -> u32 {
        match self.growth {
            Growth::None => 0,
            Growth::Marginal {
                initial_length,
                length_step,
            }
            | Growth::Isogonic {
                initial_length,
                length_step,
            } => ((self.final_length - initial_length) / length_step).ceil() as u32,
            Growth::Anisotropic { .. } => self.arrival.ceil() as u32,
        }
    }

    /// Length at a step over final length, in (0, 1]: `σ_t`, linear in time unless growth is
    /// anisotropic.
    pub(crate) fn size(&self, step: u32) -> f64 {
        match self.growth {
            Growth::None => 1.0,
            Growth::Marginal {
                initial_length,
                length_step,
            }
            | Growth::Isogonic {
                initial_length,
                length_step,
            } => {
                let length = initial_length + length_step * f64::from(step);
                length.min(self.final_length) / self.final_length
            }
            Growth::Anisotropic { .. } => self
                .tissue_map(step)
                .map_or(1.0, |map| map.length() / self.final_length),
        }
    }

    /// For anisotropic growth, the tissue map at a step.
    pub(crate) fn tissue_map(&self, step: u32) -> Option<TissueMap> {
        match &self.growth {
            Growth::None | Growth::Marginal { .. } | Growth::Isogonic { .. } => None,
            Growth::Anisotropic {
                initial_length,
                across,
                along,
            } => {
                let t = f64::from(step).min(self.arrival);
                Some(TissueMap::new(*initial_length, across, along, t))
            }
        }
    }

    /// The lamina at a step.
    pub(crate) fn stage(&self, step: u32) -> Stage {
        Stage {
            unit: match self.growth {
                Growth::None | Growth::Marginal { .. } | Growth::Anisotropic { .. } => 1.0,
                Growth::Isogonic { .. } => 1.0 / self.size(step),
            },
            still_growing: step < self.last_growth_step(),
        }
    }
}
