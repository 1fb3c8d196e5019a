//! The view of a scene.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use super::thin_lens::ThinLens;

/// The view of a scene, with everything known that rays need.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct View {
    /// Middle of the lens, or of the plane from which parallel rays start, m.
    pub position: DVec3,
    /// Point at the centre of the picture, m.
    pub look_at: DVec3,
    /// Upward direction, any length.
    pub up: DVec3,
    /// How points come to the film.
    pub projection: Projection,
    /// Where its rays are traced.
    pub near: Near,
}

/// Where the rays of a view are traced in single precision: near what is seen, wherever the camera
/// is. The world that is seen decides it.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Near {
    /// The point of the scene that is the origin of rays, m.
    pub origin: DVec3,
    /// How far in front of the camera rays start, along its axis, m. Nothing that is seen is nearer.
    pub distance: f64,
}

/// How points come to the film.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub enum Projection {
    /// Through a thin lens.
    Perspective(ThinLens),
    /// By parallel rays.
    Orthographic {
        /// Height of what the picture shows, m.
        height: f64,
    },
}

impl View {
    /// Half the height of what the picture shows: at distance 1, or for parallel rays everywhere.
    pub fn half_height(&self) -> f64 {
        match &self.projection {
            Projection::Perspective(lens) => libm::tan(0.5 * lens.vertical_fov),
            Projection::Orthographic { height } => 0.5 * height,
        }
    }

    /// Where the ray in the middle of the picture starts, m.
    pub fn start(&self) -> DVec3 {
        self.position + self.axes().z_axis * self.near.distance
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
    pub(crate) fn distance_of(&self, point: DVec3) -> f64 {
        match self.projection {
            Projection::Perspective(_) => (point - self.position).length(),
            Projection::Orthographic { .. } => self.in_picture(point).z,
        }
    }
}
