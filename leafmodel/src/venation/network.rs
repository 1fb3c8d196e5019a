//! The graph that every venation algorithm builds.

use glam::DVec2;

/// A piece of vein between two neighbouring nodes, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinSegment {
    /// End nearer to the petiole.
    pub from: DVec2,
    /// End farther from the petiole.
    pub to: DVec2,
    /// Radius of the vein at `from`, > 0.
    pub radius_from: f64,
    /// Radius of the vein at `to`, > 0.
    pub radius_to: f64,
    /// Vein order: 1 for the midrib and other primaries, then upwards.
    pub order: u8,
}
