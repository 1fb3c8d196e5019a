//! Why an instrument cannot measure.

use thiserror::Error;

use crate::geometry::GeometryError;

/// Why an instrument cannot measure.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{at}: {problem}")]
pub struct InstrumentError {
    /// Where the block stands.
    pub at: String,
    /// What is wrong.
    pub problem: Problem,
}

/// What keeps an instrument from measuring.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Problem {
    /// The middle of a spot is not on its object.
    #[error("the spot is off the object `{object}`: {place} is no point of its surface")]
    OffTheObject {
        /// The object.
        object: String,
        /// The key with its value.
        place: String,
    },
    /// A part of a spot is beside its object.
    #[error(
        "{share:.1} % of the spot is not covered by the object `{object}`: use a smaller \
         `diameter_mm` or another place"
    )]
    NotCovered {
        /// The object.
        object: String,
        /// Share of the spot where there is nothing, percent.
        share: f64,
    },
    /// No ray met the object.
    #[error("no light meets the object `{object}`: is it seen from this side?")]
    NothingLit {
        /// The object.
        object: String,
    },
    /// A canopy without leaves and without soil.
    #[error("nothing lies in `within_m`: move the box, or add soil or leaves to the scene")]
    NothingWithin,
    /// What stands in a box that repeats itself is too high for its width.
    #[error(
        "what stands in `within_m` reaches from z = {:.4e} to {:.4e} m, more than {most} times the \
         smaller side of the box ({side} m); the tallest is of the object `{object}`: widen the box, \
         or leave that object out of the scene", heights[0], heights[1]
    )]
    TooHigh {
        /// Least and greatest height, m.
        heights: [f64; 2],
        /// Smaller side of the box, m.
        side: f64,
        /// The most times that.
        most: f64,
        /// The object of the tallest part.
        object: String,
    },
    /// Soil that does not fill the box.
    #[error(
        "the soil `{object}` does not reach over the whole of `within_m`: widen it or \
         narrow the box"
    )]
    SoilTooSmall {
        /// The object.
        object: String,
    },
    /// An object whose inside scatters or absorbs what a figure does not count.
    #[error("the object `{object}` {problem}")]
    Inside {
        /// The object.
        object: String,
        /// What is not counted, and what to write.
        problem: &'static str,
    },
    /// A port that looks at its own object, as one within a closed body does.
    #[error(
        "the abaxial face of the object `{object}` cannot be lit through a port: the port \
         faces another part of the object, as within a closed body: write `faces = \"adaxial\"`"
    )]
    PortInside {
        /// The object.
        object: String,
    },
    /// An object without known contents.
    #[error("the object `{object}` {problem}")]
    NoContents {
        /// The object.
        object: String,
        /// What is wrong.
        problem: String,
    },
    /// More figures than there is memory for.
    #[error(
        "`instances` asks for {figures} figures of sets of eight wavelengths, more than \
         {most}: use fewer wavelengths, lights or leaves"
    )]
    TooManyInstances {
        /// How many there would be.
        figures: usize,
        /// How many there may be.
        most: usize,
    },
    /// One of several draws of the leaves cannot be made.
    #[error("`realisations`: draw {draw} of the leaves: {problem}")]
    NoDraw {
        /// Its number, from 1.
        draw: u32,
        /// What is wrong.
        problem: String,
    },
    /// Copies of a canopy's parts cannot be placed.
    #[error(transparent)]
    Geometry(GeometryError),
}

impl Problem {
    /// What is wrong with the block of an instrument.
    pub(super) fn at(self, at: &str) -> InstrumentError {
        InstrumentError {
            at: at.to_owned(),
            problem: self,
        }
    }
}
