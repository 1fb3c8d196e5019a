//! Why there is no blade.

use thiserror::Error;

/// Why there is no blade.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum BladeError {
    /// A number is outside its range.
    #[error("{field} is {value}, it must be {range}")]
    OutOfRange {
        /// Which field of [`super::BladeForm`].
        field: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
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

/// A field with its value, the values that it may have, and how a message tells them.
pub(super) type Field = (
    &'static str,
    f64,
    std::ops::RangeInclusive<f64>,
    &'static str,
);

impl BladeError {
    /// Checks that each field lies within its range.
    ///
    /// # Errors
    ///
    /// [`BladeError::OutOfRange`] for the first that does not.
    pub(super) fn unless_within(fields: impl IntoIterator<Item = Field>) -> Result<(), BladeError> {
        for (field, value, allowed, range) in fields {
            if !allowed.contains(&value) {
                return Err(BladeError::OutOfRange {
                    field,
                    value,
                    range,
                });
            }
        }
        Ok(())
    }
}
