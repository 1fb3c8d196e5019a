//! A leaf with what a fit has found.

use leafmodel::optics::inversion::Found;

use crate::measured::spectra::Leaf;

/// A leaf and what it was found to hold.
pub(crate) struct Fitted<'a> {
    pub(crate) leaf: &'a Leaf,
    pub(crate) found: Found,
}

/// A leaf's name in messages and tables.
pub(crate) fn shown(leaf: &Leaf) -> &str {
    if leaf.name.is_empty() {
        "the leaf"
    } else {
        &leaf.name
    }
}
