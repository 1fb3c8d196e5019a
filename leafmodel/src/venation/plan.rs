//! What a venation simulation is told. Lengths are in vein segments, `D = 1`.

use thiserror::Error;

/// Whether veins may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Veins branch and never meet (section 3).
    Open,
    /// Veins meet and enclose areoles (section 4).
    Closed,
}

/// How the lamina grows while veins form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growth {
    /// The lamina has its final size from the start.
    None,
    /// The margin moves outward, tissue inside stays where it is; `σ` is linear in time.
    Marginal {
        /// Length of the leaf at the start, in segments, > 0 up to the final length.
        initial_length: f64,
        /// What is added to the length each step, in segments, > 0; growth takes at most 10⁶ steps.
        length_step: f64,
    },
    /// The whole lamina is scaled, veins and sources with it.
    Isogonic {
        /// Length of the leaf at the start, in segments, > 0 up to the final length.
        initial_length: f64,
        /// What is added to the length each step, in segments, > 0; growth takes at most 10⁶ steps.
        length_step: f64,
    },
}

/// Parameters of Runions et al. 2005; the letters are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct VenationPlan {
    /// Open or closed.
    pub pattern: Pattern,
    /// Length of the full-grown leaf in vein segments, 2 to 100 000; fixes the segment's length in mm.
    pub final_length: f64,
    /// `dk`, a source is used up when a vein comes nearer than this, 0.01 to 10 000.
    pub kill_distance: f64,
    /// `bs`, least distance of a new source from other sources, 0.01 to 10 000.
    pub source_birth_distance: f64,
    /// `bv`, least distance of a new source from vein nodes, 0.01 to 10 000.
    pub vein_birth_distance: f64,
    /// `ρ`, darts per unit area (segments squared) per step, > 0 up to 1000.
    pub darts_per_area: f64,
    /// How the lamina grows.
    pub growth: Growth,
    /// Murray's exponent `n`, 0.5 to 10; 2 in most of the paper's leaves, 3 in Murray's law.
    pub murray_exponent: f64,
    /// Radius of the finest veins in mm, 10⁻⁶ to 10.
    pub veinlet_radius_mm: f64,
}

/// Darts that one step, or the whole of marginal growth, may throw. More would take minutes and add nothing.
const MOST_DARTS: f64 = 1e8;

/// Why a plan cannot be carried out.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlanError {
    /// A number outside the range in which the model holds.
    #[error("{key} is {value}, outside {range}")]
    OutOfRange {
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The lamina would grow for too many steps.
    #[error("growing in steps of {length_step} segments takes {steps} steps, more than 1000000")]
    TooManySteps {
        /// Growth per step, segments.
        length_step: f64,
        /// Steps that it takes.
        steps: f64,
    },
    /// The blade and `darts_per_area` together ask for too many darts.
    #[error("darts_per_area asks for {darts} darts on this blade, more than 100000000")]
    TooManyDarts {
        /// How many.
        darts: f64,
    },
}

impl VenationPlan {
    /// Checks every number by itself, and that growth comes to an end.
    ///
    /// # Errors
    ///
    /// [`PlanError`], naming the parameter and its range.
    pub fn validate(&self) -> Result<(), PlanError> {
        let distance = "0.01 to 10000 (segments)";
        let checks = [
            (
                "final_length",
                self.final_length,
                2.0,
                1e5,
                "2 to 100000 (segments)",
            ),
            ("kill_distance", self.kill_distance, 0.01, 1e4, distance),
            (
                "source_birth_distance",
                self.source_birth_distance,
                0.01,
                1e4,
                distance,
            ),
            (
                "vein_birth_distance",
                self.vein_birth_distance,
                0.01,
                1e4,
                distance,
            ),
            (
                "darts_per_area",
                self.darts_per_area,
                1e-12,
                1e3,
                "0 (excluded) to 1000",
            ),
            (
                "murray_exponent",
                self.murray_exponent,
                0.5,
                10.0,
                "0.5 to 10",
            ),
            (
                "veinlet_radius_mm",
                self.veinlet_radius_mm,
                1e-6,
                10.0,
                "0.000001 to 10 (millimetres)",
            ),
        ];
        for (key, value, low, high, range) in checks {
            if !(low..=high).contains(&value) {
                return Err(PlanError::OutOfRange { key, value, range });
            }
        }
        match self.growth {
            Growth::None => Ok(()),
            Growth::Marginal {
                initial_length,
                length_step,
            }
            | Growth::Isogonic {
                initial_length,
                length_step,
            } => self.validate_growth(initial_length, length_step),
        }
    }

    fn validate_growth(&self, initial_length: f64, length_step: f64) -> Result<(), PlanError> {
        if !(initial_length >= 1e-3 && initial_length <= self.final_length) {
            return Err(PlanError::OutOfRange {
                key: "initial_length",
                value: initial_length,
                range: "0.001 to final_length (segments)",
            });
        }
        if !(length_step > 0.0 && length_step.is_finite()) {
            return Err(PlanError::OutOfRange {
                key: "length_step",
                value: length_step,
                range: "above 0 (segments per step)",
            });
        }
        let steps = ((self.final_length - initial_length) / length_step).ceil();
        if steps > 1e6 {
            return Err(PlanError::TooManySteps { length_step, steps });
        }
        Ok(())
    }

    /// Checks what `darts` in one go would cost.
    pub(crate) fn validate_darts(darts: f64) -> Result<(), PlanError> {
        if darts <= MOST_DARTS {
            Ok(())
        } else {
            Err(PlanError::TooManyDarts { darts })
        }
    }
}
