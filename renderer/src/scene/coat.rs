//! Conversion of coats from the description.

use super::description;
use crate::bsdf::leaf::Coat;

/// A coat with its tables.
pub(in crate::scene) fn coat_of(coat: description::Coat) -> Coat {
    Coat::new(
        coat.eta as f32,
        coat.alpha_across as f32,
        coat.alpha_along as f32,
    )
}
