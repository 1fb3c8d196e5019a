//! The view of a scene.

use glam::DVec3;

/// A perspective view through a thin lens.
#[derive(Clone, Debug)]
pub struct View {
    /// Middle of the lens, m.
    pub position: DVec3,
    /// Point at the centre of the picture, m.
    pub look_at: DVec3,
    /// Upward direction, any length.
    pub up: DVec3,
    /// Vertical field of view, rad.
    pub vertical_fov: f64,
    /// Radius of the lens, m; 0 is a pinhole.
    pub lens_radius: f64,
    /// Distance of the sharp plane along the axis, m.
    pub focus_distance: f64,
}
