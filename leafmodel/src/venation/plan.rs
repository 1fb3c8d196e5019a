//! What a venation simulation is told. Lengths are in vein segments, `D = 1`.

use glam::DVec2;
use thiserror::Error;

use crate::shape::growth::{GrowthError, RateCurve};
use crate::shape::outline::Outline;

/// Whether veins may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Veins branch and never meet (section 3).
    Open,
    /// Veins meet and enclose areoles (section 4).
    Closed(Neighbourhood),
}

/// Which vein nodes a source of a closed pattern drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbourhood {
    /// Its relative neighbours, exactly (Eq. 2).
    Relative,
    /// Those of its Delaunay neighbours that no other Delaunay neighbour excludes: Urquhart's approximation
    /// (section 5.2).
    Urquhart,
}

/// How the lamina grows while veins form.
#[derive(Clone, Debug, PartialEq)]
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
    /// Every part is stretched at rates of its own, unlike across and along the leaf; veins and sources move
    /// with the tissue (Appendix). Ends when the leaf has its final length.
    Anisotropic {
        /// Length of the leaf at the start, in segments, > 0, below the final length.
        initial_length: f64,
        /// `gx`: growth across the leaf per step by where tissue lies at the start; `RERGx = 1 + gx`.
        across: RateCurve,
        /// `gy`: growth along the leaf per step, likewise.
        along: RateCurve,
    },
}

/// Veinlets that end freely inside areoles: a last round of growth in which veins no longer meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeEndings {
    /// Least distance of its sources from each other and from veins, in segments, 0.01 to 10 000.
    pub birth_distance: f64,
    /// A source is used up when a veinlet comes nearer than this, in segments, 0.01 to 10 000.
    pub kill_distance: f64,
    /// Darts per unit area thrown at once, > 0 up to 1000.
    pub darts_per_area: f64,
}

/// Sources kept off the margin of the young leaf, so that secondary veins meet in arches before they get there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarginClearance {
    /// Least distance of sources from the margin as a share of the leaf's length, > 0 up to 0.5.
    pub distance: f64,
    /// The share of the final length at which the rule ends, 0 to 1.
    pub until: f64,
}

/// Parameters of Runions et al. 2005; the letters are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct VenationPlan {
    /// Open or closed.
    pub pattern: Pattern,
    /// Where veins start, as shares of the midrib's length: across it (to the right) and along it from the base.
    /// None means one node at the base; at most 1000.
    pub origins: Vec<[f64; 2]>,
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
    /// Veinlets that each node of a vein of order 1 or 2 bears unseen and is widened for, 0 to 1000; for models
    /// without a detailed pattern of tertiary veins (section 3.5).
    pub unseen_veinlets: f64,
    /// Veinlets that end freely, for closed patterns.
    pub free_endings: Option<FreeEndings>,
    /// Sources kept off the margin at first.
    pub margin_clearance: Option<MarginClearance>,
    /// `K L²`: Gaussian curvature of the blade times its length squared, −2 to 8; 0 is a flat or rolled blade. The
    /// outline is then that of the blade's conformal map.
    pub gaussian_curvature: f64,
}

impl FreeEndings {
    /// What the last round is told: an open pattern on the full-grown leaf.
    pub(crate) fn as_plan(&self, plan: &VenationPlan) -> VenationPlan {
        VenationPlan {
            pattern: Pattern::Open,
            kill_distance: self.kill_distance,
            source_birth_distance: self.birth_distance,
            vein_birth_distance: self.birth_distance,
            growth: Growth::None,
            free_endings: None,
            margin_clearance: None,
            ..plan.clone()
        }
    }
}

impl Default for VenationPlan {
    /// A closed pattern on a leaf of 350 segments that grows isogonically: the paper's poplar at ten units of
    /// its Table 1 to a segment.
    fn default() -> Self {
        Self {
            pattern: Pattern::Closed(Neighbourhood::Relative),
            origins: Vec::new(),
            final_length: 350.0,
            kill_distance: 1.0,
            source_birth_distance: 2.0,
            vein_birth_distance: 2.0,
            darts_per_area: 200e-6,
            growth: Growth::Isogonic {
                initial_length: 11.5,
                length_step: 0.9,
            },
            murray_exponent: 2.0,
            veinlet_radius_mm: 0.02,
            unseen_veinlets: 0.0,
            free_endings: None,
            margin_clearance: None,
            gaussian_curvature: 0.0,
        }
    }
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
    /// Two rules that do not go together.
    #[error("{key} does not go together with {other}")]
    Incompatible {
        /// One rule.
        key: &'static str,
        /// The other.
        other: &'static str,
    },
    /// A growth function that does not work.
    #[error(transparent)]
    Growth(#[from] GrowthError),
    /// A place where veins start that lies outside the blade.
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
        let mut checks = vec![
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
            (
                "unseen_veinlets",
                self.unseen_veinlets,
                0.0,
                1e3,
                "0 to 1000 (per node)",
            ),
            (
                "gaussian_curvature",
                self.gaussian_curvature,
                -2.0,
                8.0,
                "-2 to 8 (per leaf length squared)",
            ),
            (
                "origins",
                self.origins.len() as f64,
                0.0,
                1e3,
                "a list of at most 1000 places",
            ),
        ];
        if let Some(free) = &self.free_endings {
            checks.extend([
                (
                    "free_endings.birth_distance",
                    free.birth_distance,
                    0.01,
                    1e4,
                    distance,
                ),
                (
                    "free_endings.kill_distance",
                    free.kill_distance,
                    0.01,
                    1e4,
                    distance,
                ),
                (
                    "free_endings.darts_per_area",
                    free.darts_per_area,
                    1e-12,
                    1e3,
                    "0 (excluded) to 1000",
                ),
            ]);
        }
        if let Some(clearance) = &self.margin_clearance {
            let share = "0 (excluded) to 0.5 (of the leaf's length)";
            checks.extend([
                (
                    "margin_clearance.distance",
                    clearance.distance,
                    1e-6,
                    0.5,
                    share,
                ),
                (
                    "margin_clearance.until",
                    clearance.until,
                    0.0,
                    1.0,
                    "0 to 1 (of the final length)",
                ),
            ]);
        }
        for (key, value, low, high, range) in checks {
            if !(low..=high).contains(&value) {
                return Err(PlanError::OutOfRange { key, value, range });
            }
        }
        let is_anisotropic = matches!(self.growth, Growth::Anisotropic { .. });
        let pairs = [
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
            // That it arrives is found by the clock.
            Growth::Anisotropic { initial_length, .. } => {
                self.validate_growth(*initial_length, 1.0)
            }
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

    /// Where veins start, in segments, base at the origin.
    pub(crate) fn origins_in_segments(&self) -> Vec<DVec2> {
        if self.origins.is_empty() {
            return vec![DVec2::ZERO];
        }
        let place = |&[x, y]: &[f64; 2]| DVec2::new(x, y) * self.final_length;
        self.origins.iter().map(place).collect()
    }

    /// Checks what only the margin can tell; `blade` is in segments, base at the origin.
    pub(crate) fn validate_on(&self, blade: &Outline) -> Result<(), PlanError> {
        let origins = self.origins_in_segments();
        if let Some(index) = origins
            .iter()
            .position(|&p| !(p.is_finite() && blade.covers(p)))
        {
            let [x, y] = self.origins[index];
            return Err(PlanError::OriginOffBlade { index, x, y });
        }
        // The map of a saddle ends where lengths vanish.
        let middle = (blade.base() + blade.apex()) * 0.5;
        let (low, high) = blade.bounds();
        let farthest = (low - middle).abs().max((high - middle).abs()).length() / self.final_length;
        if 1.0 + 0.25 * self.gaussian_curvature * farthest * farthest < 0.1 {
            return Err(PlanError::OutOfRange {
                key: "gaussian_curvature",
                value: self.gaussian_curvature,
                range: "what a blade so wide can have: above -3.6 over its half diagonal (in leaf lengths) squared",
            });
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
