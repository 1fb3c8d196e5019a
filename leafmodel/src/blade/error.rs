//! Why there is no blade.

use thiserror::Error;

use crate::document::RangeError;

/// Why there is no blade.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BladeError {
    /// A number is outside its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The mesh would be too large (greatest number of triangles).
    #[error(
        "the blade would take more than {0} triangles: raise max_edge_mm or meshed_vein_radius_mm"
    )]
    TooFine(usize),
    /// Fold, curl and ruffle bend the blade so much that it turns inside out (how many triangles
    /// face the wrong way).
    #[error(
        "{0} triangles of the blade are turned over: fold, curl, ruffle or relief are too strong together"
    )]
    TurnedOver(usize),
}
