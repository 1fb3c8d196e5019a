//! Architectures that contradict themselves or their outline.

use super::error::ArchitectureError;
use super::ground::Ground;
use super::margin::Margin;
use super::primaries;
use super::secondaries::{self, agrophic};
use super::{
    Agrophic, Architecture, Lots, PrimaryPattern, QuaternaryCourse, SecondaryEnding, TertiaryCourse,
};
use crate::document::declared::Declared;
use crate::shape::outline::Outline;

/// Secondaries of one side are at least so many segments of the young leaf apart.
const CLOSEST: f64 = 4.0;

/// Tertiaries between which quaternaries can be laid out are at least so many segments of the young
/// leaf apart.
const LADDER: f64 = 5.0;

impl Architecture {
    /// Checks all that needs no outline.
    ///
    /// # Errors
    ///
    /// [`ArchitectureError`].
    pub fn validate(&self) -> Result<(), ArchitectureError> {
        self.in_range()?;
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
        self.check_bearers(pattern)?;
        if self.quaternaries.course != QuaternaryCourse::Reticulate
            && self.tertiaries.course == TertiaryCourse::Reticulate
        {
            return Err(ArchitectureError::NoTertiaries);
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

    /// Refuses agrophic veins where no secondary can bear them.
    fn check_bearers(&self, pattern: &'static str) -> Result<(), ArchitectureError> {
        let plan = &self.secondaries;
        let (kind, bearers) = match plan.agrophic {
            Agrophic::Absent => return Ok(()),
            Agrophic::Simple => ("simple", "lowest pair of secondaries"),
            Agrophic::Compound => ("compound", "two lowest pairs of secondaries"),
        };
        let there = if self.primaries.pattern != PrimaryPattern::Pinnate {
            format!("{pattern} venation has lateral primaries, whose outer secondaries they are")
        } else if (plan.pairs as usize) < plan.agrophic.combs() {
            format!("{} pairs are asked for", plan.pairs)
        } else {
            return Ok(());
        };
        Err(ArchitectureError::NoBearers {
            kind,
            bearers,
            there,
        })
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
        self.check_spacing(blade, young)?;
        let margin = Margin::new(blade);
        self.check_ends(&margin)?;
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
        let bearers = agrophic::bearers(plan, &laid.veins);
        let fit = laid.agrophic.poorest(&bearers);
        if plan.agrophic != Agrophic::Absent && fit < agrophic::LEAST {
            let (ending, to) = match plan.ending {
                SecondaryEnding::Craspedodromous => ("craspedodromous", "to a tooth"),
                SecondaryEnding::Sinus => ("sinus", "to a sinus"),
                SecondaryEnding::Semicraspedodromous => ("semicraspedodromous", "to the margin"),
                SecondaryEnding::Eucamptodromous => ("eucamptodromous", "to the margin"),
                SecondaryEnding::Brochidodromous => ("brochidodromous", "to the margin"),
                SecondaryEnding::Festooned => ("festooned", "to the margin"),
            };
            return Err(ArchitectureError::NoComb { ending, fit, to });
        }
        Ok(())
    }

    /// Refuses tertiaries, quaternaries and primaries too near to each other.
    fn check_spacing(&self, blade: &Outline, young: f64) -> Result<(), ArchitectureError> {
        let length = young * blade.length();
        let apart = self.tertiaries.spacing * length;
        if self.tertiaries.course != TertiaryCourse::Reticulate && apart < 2.5 {
            let least = 2.5 / length;
            return Err(ArchitectureError::TertiariesTooClose { apart, least });
        }
        if self.quaternaries.course != QuaternaryCourse::Reticulate {
            if apart < LADDER {
                let least = LADDER / length;
                return Err(ArchitectureError::NoRoomForQuaternaries { apart, least });
            }
            let apart = self.quaternaries.spacing * length;
            if apart < 2.5 {
                let least = 2.5 / length;
                return Err(ArchitectureError::QuaternariesTooClose { apart, least });
            }
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
        Ok(())
    }

    /// Refuses secondaries that run to teeth or sinuses which are not there.
    fn check_ends(&self, margin: &Margin) -> Result<(), ArchitectureError> {
        let plan = &self.secondaries;
        let ending = match plan.ending {
            SecondaryEnding::Craspedodromous => Some("craspedodromous"),
            SecondaryEnding::Semicraspedodromous => Some("semicraspedodromous"),
            SecondaryEnding::Sinus
            | SecondaryEnding::Eucamptodromous
            | SecondaryEnding::Brochidodromous
            | SecondaryEnding::Festooned => None,
        };
        if plan.ending == SecondaryEnding::Sinus {
            let [right, left] = margin.sinuses_a_side();
            if right.min(left) < plan.pairs as usize {
                return Err(ArchitectureError::TooFewSinuses {
                    pairs: plan.pairs,
                    right,
                    left,
                });
            }
        }
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
        Ok(())
    }
}
