//! What veins are laid out on.

use glam::DVec2;

use super::Lots;
use super::margin::Margin;
use crate::shape::outline::Outline;

/// A blade whose base is the origin, its margin and chance.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'g> {
    pub(crate) blade: &'g Outline,
    pub(crate) margin: &'g Margin,
    pub(crate) lots: Lots,
}

impl Ground<'_> {
    /// How far the margin is from a place of the midrib, on one side.
    pub(super) fn half_width(self, on: DVec2, across: DVec2) -> f64 {
        let hit = self.margin.hit(on, across);
        hit.map_or(0.0, |hit| (hit.place - on).length())
    }
}
