//! The closed margin curve of a lamina.

use glam::DVec2;
use thiserror::Error;

/// The margin of a lamina as a simple polygon, in millimetres.
///
/// Coordinates: the petiole is attached at [`Outline::base`], the midrib runs from there along +y to
/// [`Outline::apex`]. The polygon is counter-clockwise, without a repeated last point, without
/// self-crossings, and encloses a positive area.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    points: Vec<DVec2>,
    base: DVec2,
    apex: DVec2,
}

/// Why a polygon is no margin.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OutlineError {
    /// Fewer than three points.
    #[error("an outline needs at least 3 points, it has {points}")]
    TooFewPoints {
        /// How many there are.
        points: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {index} of the outline is not finite")]
    NotFinite {
        /// Which point.
        index: usize,
    },
    /// Two edges cross or touch.
    #[error("edges {first} and {second} of the outline cross")]
    SelfCrossing {
        /// Number of the first edge.
        first: usize,
        /// Number of the second edge.
        second: usize,
    },
    /// No area.
    #[error("the outline encloses no area")]
    NoArea,
}

impl Outline {
    /// The margin, counter-clockwise, mm.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Where the petiole is attached, mm.
    pub fn base(&self) -> DVec2 {
        self.base
    }

    /// Where the midrib meets the margin, mm.
    pub fn apex(&self) -> DVec2 {
        self.apex
    }
}
