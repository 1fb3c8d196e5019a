//! How large the lamina is at each step.
//!
//! All positions are kept in the frame of the full-grown leaf, base at the origin, in segments of
//! that leaf. There the growth of the paper's section 3.3 is a change of two numbers:
//!
//! - marginal: the margin of step `t` is the final one shrunk about the base by `σ_t / σ_final`;
//! - isogonic: lamina and veins keep their place while the unit of length shrinks,
//!   `λ_t = λ_final σ_final / σ_t`, and with it segment, kill distance and birth distances.

use super::plan::{Growth, VenationPlan};

/// The lamina at one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stage {
    /// The unit of length `λ`: a segment of this step, in segments of the full-grown leaf, ≥ 1.
    pub(crate) unit: f64,
    /// Whether a later step will find the lamina larger.
    pub(crate) still_growing: bool,
}

/// Growth of the lamina by step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaminaClock {
    final_length: f64,
    growth: Growth,
}

impl LaminaClock {
    /// The clock of a plan that has been checked.
    pub(crate) fn new(plan: &VenationPlan) -> Self {
        Self {
            final_length: plan.final_length,
            growth: plan.growth,
        }
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
        }
    }

    /// Length at a step over final length, in (0, 1]: `σ_t`, linear in time.
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
        }
    }

    /// The lamina at a step.
    pub(crate) fn stage(&self, step: u32) -> Stage {
        Stage {
            unit: match self.growth {
                Growth::None | Growth::Marginal { .. } => 1.0,
                Growth::Isogonic { .. } => 1.0 / self.size(step),
            },
            still_growing: step < self.last_growth_step(),
        }
    }
}
