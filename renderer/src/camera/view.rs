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

/// Distance of a camera from the origin of its scene beyond which the world is traced around the
/// camera, m. Single precision resolves 0.01 mm there.
const FAR: f64 = 100.0;

impl View {
    /// The point of the scene around which rays are traced in single precision: the scene's own
    /// origin, or for a camera far from it the camera's place in whole metres.
    pub fn origin(&self) -> DVec3 {
        if self.position.length() <= FAR {
            DVec3::ZERO
        } else {
            self.position.round()
        }
    }

    /// This view, moved by an offset.
    pub fn moved(&self, by: DVec3) -> Self {
        Self {
            position: self.position + by,
            look_at: self.look_at + by,
            ..self.clone()
        }
    }
}
