//! Ranges of a plan's numbers.

use glam::DVec2;
use thiserror::Error;

use super::{AuxinPlan, Growth, Pattern};
use crate::document::declared::Declared;
use crate::document::ranges::RangeError;
use crate::not_grown::NotGrown;
use crate::shape::growth::GrowthError;
use crate::shape::outline::Outline;
use crate::venation::architecture::ArchitectureError;
use crate::venation::simulation::courses::young_size;
use crate::venation::veins::COINCIDENT;

/// Greatest number of darts in all steps of growth together, or in one step without growth. More
/// would take minutes and add nothing.
const MOST_DARTS: f64 = 1e8;

/// Why a plan cannot be carried out.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlanError {
    /// A number is outside the range in which the model holds.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The leaf starts longer than it ends.
    #[error("initial_length is {initial_length}, outside 0.001 to final_length (segments)")]
    StartsLonger {
        /// Its length at the start, segments.
        initial_length: f64,
    },
    /// A saddle that is too wide for its curvature.
    #[error(
        "gaussian_curvature is {curvature}, outside what a blade so wide can have: above -3.6 over its half diagonal (in leaf lengths) squared"
    )]
    TooCurved {
        /// Curvature times the length squared.
        curvature: f64,
    },
    /// The lamina would grow for too many steps.
    #[error("growing in steps of {length_step} segments takes {steps} steps, more than 1000000")]
    TooManySteps {
        /// Growth per step, segments.
        length_step: f64,
        /// Number of steps.
        steps: f64,
    },
    /// The young leaf would be far larger than the full-grown one or have no extent.
    #[error(
        "with these growth functions the young leaf is {times} times as wide or as long as the full-grown one; 0.000001 to 2 is possible"
    )]
    YoungLeaf {
        /// The worse of the two ratios.
        times: f64,
    },
    /// Two origins coincide.
    #[error("origins {first} and {second} of the veins lie in one place")]
    OriginsMeet {
        /// The first of the two, from 0.
        first: usize,
        /// The second.
        second: usize,
    },
    /// With joined origins, an origin lies at the base.
    #[error("one of the joined origins of the veins lies at the base")]
    OriginAtBase,
    /// Two rules cannot be combined.
    #[error("{key} does not go together with {other}")]
    Incompatible {
        /// One rule.
        key: &'static str,
        /// The other.
        other: &'static str,
    },
    /// An architecture that contradicts itself or its outline.
    #[error(transparent)]
    Architecture(#[from] ArchitectureError),
    /// A growth function is not valid.
    #[error(transparent)]
    Growth(#[from] GrowthError),
    /// An origin lies outside the blade.
    #[error("origin {index} of the veins, ({x}, {y}) of the leaf's length, is not on the blade")]
    OriginOffBlade {
        /// Which origin, from 0.
        index: usize,
        /// Its place across the midrib, shares of the midrib's length.
        x: f64,
        /// Its place along the midrib, likewise.
        y: f64,
    },
    /// The blade and `darts_per_area` together ask for too many darts.
    #[error("the darts per area ask for {darts:.0} darts on this blade, more than 100000000")]
    TooManyDarts {
        /// How many.
        darts: f64,
    },
}

impl From<PlanError> for NotGrown {
    /// The error at the key to change.
    fn from(error: PlanError) -> Self {
        let (index, key);
        let (path, help): (&[&str], &str) = match &error {
            PlanError::OriginOffBlade { index: number, .. } => {
                index = number.to_string();
                (
                    &["origins", &index],
                    "places are shares of the midrib's length across and along it: [0, 0] is the base, [0, 1] the apex",
                )
            }
            PlanError::TooManySteps { .. } => {
                (&["growth", "*", "length_step_segments"], "use larger steps")
            }
            PlanError::Growth(GrowthError::NeverArrives { .. }) => {
                (&["growth", "*", "along"], "use higher rates along the leaf")
            }
            PlanError::Growth(
                GrowthError::KnotCount { .. }
                | GrowthError::BadPlace { .. }
                | GrowthError::BadRate { .. },
            ) => (&["growth"], "mend the growth functions"),
            PlanError::Architecture(error) => {
                key = [&["architecture"], error.key].concat();
                (&key, error.help)
            }
            PlanError::Incompatible {
                key: "architecture",
                ..
            } => (
                &["architecture"],
                "leave out one of the two; growth may be none, isogonic or anisotropic",
            ),
            PlanError::TooManyDarts { .. } => (
                &["darts_per_segment2"],
                "use fewer darts, or larger segments or steps",
            ),
            PlanError::OriginAtBase => (
                &["origins"],
                "leave out joined_origins, or the place [0, 0]",
            ),
            PlanError::OriginsMeet { .. } => (&["origins"], "veins start from different places"),
            PlanError::YoungLeaf { .. } => (
                &["growth", "*", "across"],
                "let tissue expand: rates above 0 across and along the leaf, of the same kind",
            ),
            PlanError::TooCurved { .. }
            | PlanError::Incompatible {
                key: "gaussian_curvature",
                ..
            } => (
                &["gaussian_curvature"],
                "use a value nearer to 0, or leave it out",
            ),
            // Ranges of single numbers are checked where they are read, and only closed patterns have
            // `free_endings`.
            PlanError::Range(_)
            | PlanError::StartsLonger { .. }
            | PlanError::Incompatible { .. } => (&[], "change or leave out what the message names"),
        };
        let path = [&["venation", "*"], path].concat().join(".");
        Self::because(&error).mend(&path, help)
    }
}

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
