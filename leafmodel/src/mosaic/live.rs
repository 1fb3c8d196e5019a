//! A cell in a mosaic that grows.

use glam::DVec2;

/// A cell while it lives: its place is in the frame of a face of the surface worked on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Live {
    pub(super) face: u32,
    pub(super) at: DVec2,
    pub(super) kind: u16,
    pub(super) clone: u32,
    pub(super) parent: u32,
    /// Its identifier, from which its random numbers derive.
    pub(super) id: u64,
    /// Number of its divisions so far.
    pub(super) divisions: u64,
    /// The relaxation event at which it divides next.
    pub(super) divides_at: u64,
}
