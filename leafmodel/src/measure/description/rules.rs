//! Limits between the words of a description.

/// A vein that ends so near to the margin ends there, share of the leaf's length.
pub(super) const AT_MARGIN: f64 = 0.025;

/// A vein that ends so near to the tip of a tooth or lobe ends in it, likewise.
pub(super) const IN_TOOTH: f64 = 0.014;

/// A vein so much longer than its chord goes round.
pub(super) const ROUND: f64 = 1.25;
