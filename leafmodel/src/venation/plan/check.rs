//! Ranges of a plan's numbers.

use glam::DVec2;

use super::young_size;
use super::{AuxinPlan, Growth, Pattern};
use crate::document::Declared;
use crate::not_grown::{NotGrown, not_grown};
use crate::shape::outline::Outline;
use crate::venation::veins::COINCIDENT;

/// Greatest number of darts in all steps of growth together, or in one step without growth. More
/// would take minutes and add nothing.
const MOST_DARTS: f64 = 1e8;

/// The block of the veins, whatever their kind, and keys in it.
const KEY: &str = "venation.*";
const ORIGINS: &str = "venation.*.origins";
const CURVATURE: &str = "venation.*.gaussian_curvature";

const CHANGE: &str = "change or leave out what the message names";
const FLATTER: &str = "use a value nearer to 0, or leave it out";

impl AuxinPlan {
    /// Checks every number by itself, and that growth ends.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming the parameter and its range.
    pub fn validate(&self) -> Result<(), NotGrown> {
        let checked = self.in_range();
        checked.map_err(|error| NotGrown::because(error).mend(KEY, CHANGE))?;
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
            return Err(incompatible(key, other));
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

    fn validate_growth(&self, initial_length: f64, length_step: f64) -> Result<(), NotGrown> {
        if initial_length > self.final_length {
            let error = not_grown!(
                "initial_length is {initial_length}, outside 0.001 to final_length (segments)"
            );
            return Err(error.mend(KEY, CHANGE));
        }
        let steps = ((self.final_length - initial_length) / length_step).ceil();
        if steps > 1e6 {
            let error = not_grown!(
                "growing in steps of {length_step} segments takes {steps} steps, more than 1000000"
            );
            let path = "venation.*.growth.*.length_step_segments";
            return Err(error.mend(path, "use larger steps"));
        }
        Ok(())
    }

    /// Checks what depends on the margin; `blade` is in segments, base at the origin.
    pub(crate) fn validate_on(&self, blade: &Outline) -> Result<(), NotGrown> {
        let origins = self.origins_in_segments();
        if let Some(index) = origins
            .iter()
            .position(|&p| !(p.is_finite() && blade.covers(p)))
        {
            let [x, y] = self.origins[index];
            let error = not_grown!(
                "origin {index} of the veins, ({x}, {y}) of the leaf's length, is not on the blade"
            );
            let help = "places are shares of the midrib's length across and along it: [0, 0] is the base, [0, 1] the apex";
            return Err(error.mend(&format!("{ORIGINS}.{index}"), help));
        }
        for (second, p) in origins.iter().enumerate() {
            let near = |q: &DVec2| (*q - *p).length() < COINCIDENT;
            if let Some(first) = origins[..second].iter().position(near) {
                let error =
                    not_grown!("origins {first} and {second} of the veins lie in one place");
                return Err(error.mend(ORIGINS, "veins start from different places"));
            }
        }
        if self.joined_origins && origins.iter().any(|p| p.length() < COINCIDENT) {
            let error = not_grown!("one of the joined origins of the veins lies at the base");
            return Err(error.mend(ORIGINS, "leave out joined_origins, or the place [0, 0]"));
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
            let error = not_grown!(
                "gaussian_curvature is {curvature}, outside what a blade so wide can have: above -3.6 over its half diagonal (in leaf lengths) squared"
            );
            return Err(error.mend(CURVATURE, FLATTER));
        }
        Ok(())
    }

    /// Checks the ratios of the young leaf's size to the full-grown one's, across and along.
    pub(crate) fn validate_young(ratios: DVec2) -> Result<(), NotGrown> {
        let (low, high) = (ratios.min_element(), ratios.max_element());
        if low >= 1e-6 && high <= 2.0 {
            return Ok(());
        }
        let times = if high <= 2.0 { low } else { high };
        let error = not_grown!(
            "with these growth functions the young leaf is {times} times as wide or as long as the full-grown one; 0.000001 to 2 is possible"
        );
        let help = "let tissue expand: rates above 0 across and along the leaf, of the same kind";
        Err(error.mend("venation.*.growth.*.across", help))
    }

    /// Refuses a total number of darts that would take too long.
    pub(crate) fn validate_darts(darts: f64) -> Result<(), NotGrown> {
        if darts <= MOST_DARTS {
            return Ok(());
        }
        let error = not_grown!(
            "the darts per area ask for {darts:.0} darts on this blade, more than 100000000"
        );
        let help = "use fewer darts, or larger segments or steps";
        Err(error.mend("venation.*.darts_per_segment2", help))
    }
}

/// The error of two rules that cannot be combined.
pub(crate) fn incompatible(key: &str, other: &str) -> NotGrown {
    let (path, help) = match key {
        "architecture" => (
            "venation.*.architecture",
            "leave out one of the two; growth may be none, isogonic or anisotropic",
        ),
        "gaussian_curvature" => (CURVATURE, FLATTER),
        _ => (KEY, CHANGE),
    };
    not_grown!("{key} does not go together with {other}").mend(path, help)
}
