//! Why veins do not grow towards auxin, and how to mend their plan.

use thiserror::Error;

use crate::document::RangeError;
use crate::not_grown::NotGrown;
use crate::shape::growth::GrowthError;
use crate::venation::architecture::ArchitectureError;

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
