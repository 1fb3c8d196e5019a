//! Architectures that contradict themselves or their outline.

use thiserror::Error;

use super::ground::Ground;
use super::margin::Margin;
use super::primaries;
use super::secondaries;
use super::{Architecture, Lots, PrimaryPattern, SecondaryEnding, TertiaryCourse};
use crate::shape::outline::Outline;

/// Secondaries of one side are at least so many segments of the young leaf apart.
const CLOSEST: f64 = 4.0;

/// Why an architecture cannot be grown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ArchitectureError {
    /// A number outside its range.
    #[error("architecture: {key} is {value}, outside {range}")]
    OutOfRange {
        /// Which.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Lateral primaries where there are none, or none where there are some.
    #[error(
        "{pattern} venation has {wanted} lateral primaries a side; lateral_primary_angles_deg names {named}"
    )]
    LateralPrimaries {
        /// The pattern.
        pattern: &'static str,
        /// What it has.
        wanted: &'static str,
        /// How many are named.
        named: usize,
    },
    /// A number of lateral primaries that the pattern cannot have.
    #[error("{pattern} venation has {wanted} lateral_primaries a side, not {laterals}")]
    LateralCount {
        /// The pattern.
        pattern: &'static str,
        /// What it has.
        wanted: &'static str,
        /// How many are asked for.
        laterals: u32,
    },
    /// Secondaries between primaries that leave them no room.
    #[error("{pattern} venation has no secondaries between its primaries, not {pairs} pairs")]
    NoSecondaries {
        /// The pattern.
        pattern: &'static str,
        /// Pairs asked for.
        pairs: u32,
    },
    /// Primaries nearer to each other than vein segments are long.
    #[error(
        "primaries {apart:.2} segments of the young leaf apart, less than 3, cannot be told from each other"
    )]
    PrimariesTooClose {
        /// Segments between neighbours.
        apart: f64,
    },
    /// Angles or places that do not ascend.
    #[error("{key} does not ascend: {first} is followed by {second}")]
    NotAscending {
        /// Which list.
        key: &'static str,
        /// A number.
        first: f64,
        /// The next one.
        second: f64,
    },
    /// Secondaries that would run into teeth that are not there.
    #[error(
        "{ending} secondaries end in teeth or lobes: {pairs} pairs need as many a side, and the outline has {right} on the right and {left} on the left"
    )]
    TooFewTeeth {
        /// The ending.
        ending: &'static str,
        /// Pairs asked for.
        pairs: u32,
        /// Teeth and lobes on the right.
        right: usize,
        /// Teeth and lobes on the left.
        left: usize,
    },
    /// More secondaries than the young leaf has room for.
    #[error(
        "{pairs} pairs of secondaries lie {apart:.1} segments apart in the young leaf, less than 4; {fit} pairs fit"
    )]
    TooManyPairs {
        /// Pairs asked for.
        pairs: u32,
        /// Segments between neighbours.
        apart: f64,
        /// Pairs that fit.
        fit: u32,
    },
    /// Secondaries that lateral primaries or the margin leave no room for.
    #[error(
        "of {pairs} pairs of secondaries only {fit} on one side of the midrib have a way to the margin"
    )]
    NoWay {
        /// Pairs asked for.
        pairs: u32,
        /// Those that fit.
        fit: u32,
    },
    /// Tertiaries nearer to each other than vein segments are long.
    #[error(
        "tertiaries {apart:.2} segments of the young leaf apart, less than 2.5, cannot be told from each other; a spacing of {least:.4} or more can"
    )]
    TertiariesTooClose {
        /// Segments between neighbours.
        apart: f64,
        /// The least spacing that fits, share of the leaf's length.
        least: f64,
    },
    /// Lateral primaries that point away from the blade where they part from the midrib.
    #[error(
        "of {asked} lateral primaries only {fit} point into the blade where they part from the midrib"
    )]
    PrimariesOffBlade {
        /// Lateral primaries asked for.
        asked: usize,
        /// Those that fit.
        fit: usize,
    },
    /// A midrib that leaves the blade.
    #[error(
        "the straight way from base to apex leaves the blade: a midrib cannot be laid out on it"
    )]
    MidribOffBlade,
}

impl Architecture {
    /// Checks all that needs no outline.
    ///
    /// # Errors
    ///
    /// [`ArchitectureError`].
    pub fn validate(&self) -> Result<(), ArchitectureError> {
        for (key, value, low, high, range) in self.numbers() {
            if !(low..=high).contains(&value) {
                return Err(ArchitectureError::OutOfRange { key, value, range });
            }
        }
        let angles = &self.primaries.lateral_angles_deg;
        let named = angles.len();
        let (pattern, wanted, fits) = match self.primaries.pattern {
            PrimaryPattern::Pinnate => ("pinnate", "no", named == 0),
            PrimaryPattern::Actinodromous => ("actinodromous", "1 to 6", (1..=6).contains(&named)),
            PrimaryPattern::Palinactinodromous => {
                ("palinactinodromous", "2 to 6", (2..=6).contains(&named))
            }
            PrimaryPattern::Acrodromous => ("acrodromous", "1 to 3", (1..=3).contains(&named)),
            PrimaryPattern::Flabellate => ("flabellate", "1 to 6", (1..=6).contains(&named)),
            PrimaryPattern::Parallelodromous => ("parallelodromous", "no angles of", named == 0),
            PrimaryPattern::Campylodromous => ("campylodromous", "no angles of", named == 0),
        };
        if !fits {
            return Err(ArchitectureError::LateralPrimaries {
                pattern,
                wanted,
                named,
            });
        }
        let many = match self.primaries.pattern {
            PrimaryPattern::Parallelodromous | PrimaryPattern::Campylodromous => true,
            PrimaryPattern::Pinnate
            | PrimaryPattern::Actinodromous
            | PrimaryPattern::Palinactinodromous
            | PrimaryPattern::Acrodromous
            | PrimaryPattern::Flabellate => false,
        };
        if many != (self.primaries.laterals > 0) {
            return Err(ArchitectureError::LateralCount {
                pattern,
                wanted: if many { "1 to 30" } else { "0" },
                laterals: self.primaries.laterals,
            });
        }
        let has_secondaries = !many && self.primaries.pattern != PrimaryPattern::Flabellate;
        if !has_secondaries && self.secondaries.pairs > 0 {
            return Err(ArchitectureError::NoSecondaries {
                pattern,
                pairs: self.secondaries.pairs,
            });
        }
        let span = ("span", &self.secondaries.span[..]);
        for (key, list) in [("lateral_primary_angles_deg", &angles[..]), span] {
            if let Some(pair) = list.windows(2).find(|pair| pair[0] >= pair[1]) {
                return Err(ArchitectureError::NotAscending {
                    key,
                    first: pair[0],
                    second: pair[1],
                });
            }
        }
        Ok(())
    }

    fn numbers(&self) -> Vec<(&'static str, f64, f64, f64, &'static str)> {
        let plan = &self.secondaries;
        let share = "0 to 1 (of the midrib)";
        let mut numbers = vec![
            (
                "part_at",
                self.primaries.part_at,
                0.0,
                0.3,
                "0 to 0.3 (of the midrib)",
            ),
            ("pairs", f64::from(plan.pairs), 0.0, 40.0, "0 to 40"),
            (
                "lateral_primaries",
                f64::from(self.primaries.laterals),
                0.0,
                30.0,
                "0 to 30",
            ),
            (
                "fork_spacing",
                self.primaries.fork_spacing,
                0.004,
                0.2,
                "0.004 to 0.2 (of the length)",
            ),
            ("span", plan.span[0], 0.0, 1.0, share),
            ("span", plan.span[1], 0.0, 1.0, share),
            (
                "inset",
                plan.inset,
                0.005,
                0.2,
                "0.005 to 0.2 (of the length)",
            ),
            (
                "intersecondaries",
                plan.intersecondaries,
                0.0,
                3.0,
                "0 to 3",
            ),
            (
                "tertiaries.spacing",
                self.tertiaries.spacing,
                0.004,
                0.2,
                "0.004 to 0.2 (of the length)",
            ),
            (
                "tertiaries.angle_deg",
                self.tertiaries.angle_deg,
                40.0,
                140.0,
                "40 to 140 (degrees)",
            ),
            ("irregularity", self.irregularity, 0.0, 1.0, "0 to 1"),
        ];
        numbers.extend(
            plan.angles_deg
                .map(|angle| ("angles_deg", angle, 10.0, 120.0, "10 to 120 (degrees)")),
        );
        let primaries = self.primaries.lateral_angles_deg.iter();
        numbers.extend(primaries.map(|&angle| {
            (
                "lateral_primary_angles_deg",
                angle,
                5.0,
                175.0,
                "5 to 175 (degrees)",
            )
        }));
        numbers
    }

    /// Checks what only the outline can tell; `blade` is full-grown in segments, base at the
    /// origin, `young` the length of the leaf when veins are laid out, over its full length.
    pub(crate) fn validate_on(&self, blade: &Outline, young: f64) -> Result<(), ArchitectureError> {
        let plan = &self.secondaries;
        let apex = blade.apex();
        if blade.is_crossed_by(apex * 0.01, apex * 0.99) {
            return Err(ArchitectureError::MidribOffBlade);
        }
        let length = young * blade.length();
        let reach = (plan.span[1] - plan.span[0]) * length;
        let apart = reach / f64::from(plan.pairs.max(1));
        if plan.pairs > 0 && apart < CLOSEST {
            return Err(ArchitectureError::TooManyPairs {
                pairs: plan.pairs,
                apart,
                fit: (reach / CLOSEST) as u32,
            });
        }
        let apart = self.tertiaries.spacing * length;
        if self.tertiaries.course != TertiaryCourse::Reticulate && apart < 2.5 {
            let least = 2.5 / length;
            return Err(ArchitectureError::TertiariesTooClose { apart, least });
        }
        let (low, high) = blade.bounds();
        let apart = if self.primaries.pattern == PrimaryPattern::Flabellate {
            self.primaries.fork_spacing * length
        } else if self.primaries.laterals > 0 {
            let width = young * (high.x - low.x);
            0.5 * width / f64::from(self.primaries.laterals + 1)
        } else {
            f64::INFINITY
        };
        if apart < 3.0 {
            return Err(ArchitectureError::PrimariesTooClose { apart });
        }
        let margin = Margin::new(blade);
        let ending = match plan.ending {
            SecondaryEnding::Craspedodromous => Some("craspedodromous"),
            SecondaryEnding::Semicraspedodromous => Some("semicraspedodromous"),
            SecondaryEnding::Eucamptodromous
            | SecondaryEnding::Brochidodromous
            | SecondaryEnding::Festooned => None,
        };
        if let Some(ending) = ending {
            let [right, left] = margin.tips_a_side();
            if right.min(left) < plan.pairs as usize {
                return Err(ArchitectureError::TooFewTeeth {
                    ending,
                    pairs: plan.pairs,
                    right,
                    left,
                });
            }
        }
        let lots = Lots::new(0, 0.0);
        let ground = Ground {
            blade,
            margin: &margin,
            lots,
        };
        let axes = primaries::lay_out(self, ground);
        let asked = 1 + 2 * self.primaries.lateral_angles_deg.len();
        if axes.len() < asked {
            return Err(ArchitectureError::PrimariesOffBlade {
                asked: asked - 1,
                fit: axes.len() - 1,
            });
        }
        let site = secondaries::Site {
            blade,
            margin: &margin,
            axes: &axes,
            lots,
        };
        let laid = secondaries::lay_out(self, site);
        let of = |side: f64| {
            let on = laid.veins.iter().filter(|v| v.axis == 0 && v.side == side);
            on.count() as u32
        };
        let fit = of(1.0).min(of(-1.0));
        if fit < plan.pairs {
            return Err(ArchitectureError::NoWay {
                pairs: plan.pairs,
                fit,
            });
        }
        Ok(())
    }
}
