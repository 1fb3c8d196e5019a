//! How to mend what makes the margin of a leaf that of a specimen.

use crate::shape::specimen::SpecimenError;
use crate::shape::teeth::TeethError;

/// How to mend teeth.
pub(super) fn teeth_help(error: &TeethError) -> &'static str {
    match error {
        TeethError::NotNested { .. } => {
            "let per_side be a multiple of that of the wave before, or leave `nested` out"
        }
        TeethError::Range { .. }
        | TeethError::TooManyWaves { .. }
        | TeethError::NoSides
        | TeethError::NoMargin(_) => "make the teeth lower, or fewer",
    }
}

/// The key to change, and how, where a contour cannot have a base or apex.
pub(super) fn help(error: &SpecimenError) -> (&'static [&'static str], &'static str) {
    match error {
        SpecimenError::DeeperAlready { .. } => (
            &["outline", "base", "cordate", "depth"],
            "ask for a deeper sinus, or leave the base to the contour",
        ),
        SpecimenError::TooPointed { end: "base", .. } => (
            &["outline", "base", "cordate", "depth"],
            "ask for a shallower or wider sinus, or a contour with a rounder base",
        ),
        SpecimenError::TooPointed { .. } => (
            &["outline", "apex", "*", "depth"],
            "ask for a shallower or wider notch, or a contour with a rounder apex",
        ),
        SpecimenError::Range(_) => (&["outline"], "keep to the range"),
        SpecimenError::NoMargin(_) => (&["outline", "asymmetry"], "ask for smaller differences"),
    }
}
