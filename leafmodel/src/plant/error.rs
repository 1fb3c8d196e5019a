//! Why no plant grows.

use thiserror::Error;

use super::foot::NotBorne;
use crate::blade::stalk::StalkError;
use crate::document::RangeError;

/// Most leaves of a plant.
pub const MOST_LEAVES: usize = 100_000;

/// Most vertices of its axes and buds.
pub const MOST_VERTICES: usize = 1 << 23;

/// Why a plant cannot be grown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlantError {
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// Nodes have no room.
    #[error(
        "an internode of an axis of {length:.3} mm with {nodes} nodes is {internode:.3} mm long, \
         less than the radius there, {radius:.3} mm"
    )]
    NoRoom {
        /// Length of the axis, mm.
        length: f64,
        /// Its nodes.
        nodes: u32,
        /// The first internode that is too short, mm.
        internode: f64,
        /// The axis' radius there, mm.
        radius: f64,
    },
    /// There is too much of it.
    #[error(
        "the plant has more than {MOST_LEAVES} leaves, or {MOST_VERTICES} vertices of axes and buds"
    )]
    TooLarge,
    /// An axis bends so sharply that it is no tube.
    #[error("an axis cannot be built: {0}")]
    Bent(#[from] StalkError),
    /// No leaf is given, or with a flower no sepal or no petal.
    #[error("a plant bears one leaf at least, and with a flower a sepal and a petal")]
    NoLeaf,
    /// A pot has no inside.
    #[error("the walls of the pot leave no room for soil")]
    NoPot,
    /// A leaf cannot be borne.
    #[error(transparent)]
    NotBorne(#[from] NotBorne),
}
