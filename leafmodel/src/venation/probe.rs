//! A question put to points in nested boxes.

use std::ops::ControlFlow;

use glam::DVec2;

/// Something that looks for points, and knows in which boxes there can be none for it.
pub(crate) trait Probe {
    /// Whether points between these corners, lower left and upper right, could matter.
    fn enters(&self, low: DVec2, high: DVec2) -> bool;

    /// Takes in a point, by number and place; a break says that nothing more is needed.
    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()>;
}

/// Squared distance from `p` to the nearest point between these corners, 0 if it lies there itself.
pub(crate) fn distance_squared(low: DVec2, high: DVec2, p: DVec2) -> f64 {
    (low - p).max(p - high).max(DVec2::ZERO).length_squared()
}

/// Squared distances to boxes are compared with this much to spare: a box that is entered in vain
/// costs little, and a point in one that is not would be missed.
pub(crate) const SLACK: f64 = 1.0 + 1e-9;
