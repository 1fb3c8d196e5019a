//! A query over points in nested boxes.

use std::ops::ControlFlow;

use glam::DVec2;

/// A query that collects points and can rule out whole boxes.
pub(crate) trait Probe {
    /// Whether the box between these corners, lower left and upper right, may hold points that
    /// matter.
    fn enters(&self, low: DVec2, high: DVec2) -> bool;

    /// Takes a point, by number and place. A break ends the query.
    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()>;
}

/// Squared distance from `p` to the nearest point between these corners, 0 if it lies there itself.
pub(crate) fn distance_squared(low: DVec2, high: DVec2, p: DVec2) -> f64 {
    (low - p).max(p - high).max(DVec2::ZERO).length_squared()
}

/// Safety factor on squared distances to boxes. Entering a box in vain costs little, whereas a
/// point in a skipped box would be missed.
pub(crate) const SLACK: f64 = 1.0 + 1e-9;
