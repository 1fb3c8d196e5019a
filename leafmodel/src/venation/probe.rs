//! A question put to points in nested boxes.

use glam::DVec2;

/// Something that looks for points, and knows in which boxes there can be none for it.
pub(crate) trait Probe {
    /// Whether points between these corners matter.
    fn enters(&self, low: DVec2, high: DVec2) -> bool;

    /// Takes in a point, by number and place.
    fn meet(&mut self, id: u32, position: DVec2);
}
