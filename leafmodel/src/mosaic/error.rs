//! Errors of growing a mosaic.

use thiserror::Error;

use super::control::ControlError;
use super::surface::SurfaceError;
use crate::document::ranges::RangeError;

/// Why a plan cannot be grown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MosaicError {
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The plan has no cell types, or too many.
    #[error("there are {count} cell types; a mosaic has 1 to 1000")]
    Types {
        /// How many there are.
        count: usize,
    },
    /// A row does not have one number per type.
    #[error("{field} of type \"{name}\" has {length} numbers; there are {types} types")]
    RowLength {
        /// Which row.
        field: &'static str,
        /// The type to which it belongs.
        name: String,
        /// Its length.
        length: usize,
        /// What its length should be.
        types: usize,
    },
    /// Probabilities do not add up to 1.
    #[error("{field} sum to {}, not to 1", (1e9 * sum).round() / 1e9)]
    NotOne {
        /// Which ones.
        field: String,
        /// Their sum.
        sum: f64,
    },
    /// Adhesion is not symmetric.
    #[error(
        "adhesion of \"{first}\" to \"{second}\" is {there}, of \"{second}\" to \"{first}\" {back}; the two have to be equal"
    )]
    Asymmetric {
        /// One type.
        first: String,
        /// The other type.
        second: String,
        /// Adhesion of the first to the second.
        there: f64,
        /// Adhesion of the second to the first.
        back: f64,
    },
    /// A control is not valid.
    #[error("control {number} (from 0): {error}")]
    Control {
        /// Which of the plan's controls.
        number: usize,
        /// What is wrong with it.
        error: ControlError,
    },
    /// Blocked areas leave no room for cells.
    #[error("the blocked areas leave no room for cells: {tries} throws found none")]
    AllBlocked {
        /// How many throws were made.
        tries: u32,
    },
    /// There are more cells than allowed.
    #[error(
        "on day {day} there are more than {most} cells; make the days fewer or the divisions rarer"
    )]
    TooManyCells {
        /// The day on which the limit was passed.
        day: f64,
        /// The greatest number of cells.
        most: usize,
    },
    /// The cells crowd so much that growth would take hours.
    #[error(
        "cells would push each other apart {pairs:.1e} times, at most 1e10 are allowed, which takes an hour; make the days fewer, the \
         divisions rarer, or let `radius = \"daily\"` shrink their reach as they divide"
    )]
    TooManyPairs {
        /// How many pairs, in all relaxations together.
        pairs: f64,
    },
    /// A type divides so often that there would be more cells than allowed.
    #[error(
        "cells of type \"{name}\" divide every {division_days} days: after {days} days there would be more than {most}; make the days \
         fewer or the divisions rarer"
    )]
    Overcrowded {
        /// The type.
        name: String,
        /// Its mean time between divisions.
        division_days: f64,
        /// The days of the plan.
        days: f64,
        /// The greatest number of cells.
        most: usize,
    },
    /// The types blend over so much more than cells that it would take minutes to find the borders.
    #[error(
        "types blend over {blend_mm} mm on a surface of {faces} faces, which takes more than two minutes: make `blend_mm` (of \
         what is raised, `over_mm`) smaller, or the cells fewer"
    )]
    WideBlend {
        /// The width, mm.
        blend_mm: f64,
        /// The number of faces of the surface.
        faces: usize,
    },
    /// The surface is not valid.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The caller stopped the growth.
    #[error("stopped")]
    Stopped,
}
