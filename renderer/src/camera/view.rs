//! The view of a scene.

use glam::{DMat3, DVec3};

use super::thin_lens::ThinLens;

/// The view of a scene, with everything known that rays need.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Middle of the lens, or of the plane from which parallel rays start, m.
    pub position: DVec3,
    /// Point at the centre of the picture, m.
    pub look_at: DVec3,
    /// Upward direction, any length.
    pub up: DVec3,
    /// How points come to the film.
    pub projection: Projection,
}

/// How points come to the film.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// Through a thin lens.
    Perspective(ThinLens),
    /// By parallel rays.
    Orthographic {
        /// Height of what the picture shows, m.
        height: f64,
    },
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

    /// Unit vectors to the right of the picture, up, and into the scene.
    pub fn axes(&self) -> DMat3 {
        let forward = (self.look_at - self.position).normalize_or(DVec3::NEG_Z);
        let right = forward
            .cross(self.up)
            .normalize_or(forward.any_orthonormal_vector());
        DMat3::from_cols(right, right.cross(forward), forward)
    }

    /// A point in the frame of the picture: to the right, up, and into the scene, m.
    pub fn in_picture(&self, point: DVec3) -> DVec3 {
        self.axes().transpose() * (point - self.position)
    }

    /// Distance of a point, m: from the middle of the lens, or along parallel rays.
    pub fn distance_of(&self, point: DVec3) -> f64 {
        match self.projection {
            Projection::Perspective(_) => (point - self.position).length(),
            Projection::Orthographic { .. } => self.in_picture(point).z,
        }
    }
}
