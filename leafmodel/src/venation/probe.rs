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

/// Safety factor on squared distances to boxes. Entering a box in vain costs little, whereas a
/// point in a skipped box would be missed.
pub(crate) const SLACK: f64 = 1.0 + 1e-9;
