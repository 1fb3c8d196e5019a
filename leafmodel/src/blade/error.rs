//! Why there is no blade.

use thiserror::Error;

use crate::document::ranges::RangeError;

/// Why there is no blade.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BladeError {
    /// A number is outside its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The mesh would be too large.
    #[error(
        "the blade would take more than {limit} triangles: raise max_edge_mm or meshed_vein_radius_mm"
    )]
    TooFine {
        /// Greatest number of triangles.
        limit: usize,
    },
    /// Fold, curl and ruffle bend the blade so much that it turns inside out.
    #[error(
        "{faces} triangles of the blade are turned over: fold, curl, ruffle or relief are too strong together"
    )]
    TurnedOver {
        /// How many triangles face the wrong way.
        faces: usize,
    },
}
