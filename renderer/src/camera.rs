//! Rays from the film into the scene.
//!
//! ```
//! use glam::{DVec3, Vec2};
//! use renderer::camera::Camera;
//! use renderer::camera::view::View;
//!
//! let described = View {
//!     position: DVec3::new(0.0, -1.0, 0.0),
//!     look_at: DVec3::ZERO,
//!     up: DVec3::Z,
//!     vertical_fov: 0.7,
//!     lens_radius: 0.0,
//!     focus_distance: 1.0,
//! };
//! let camera = Camera::new(&described, 200, 100);
//! // The middle of the film looks along +y.
//! let ray = camera.ray(Vec2::new(100.0, 50.0), Vec2::splat(0.5));
//! assert!(ray.direction.distance(glam::Vec3::Y) < 1e-6);
//! ```

use glam::{DMat3, DVec3, Vec2, Vec3};

use crate::geometry::ray::Ray;
use crate::sampling::warp;

pub mod filter;
pub mod view;

use self::view::View;

/// A perspective camera with a thin lens.
#[derive(Clone, Debug)]
pub struct Camera {
    position: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Half the picture's width and height at distance 1.
    half_extent: Vec2,
    lens_radius: f32,
    focus_distance: f32,
    size: Vec2,
}

impl Camera {
    /// The camera for a film of `width` × `height` square pixels.
    pub fn new(camera: &View, width: u32, height: u32) -> Self {
        let axes = Self::axes(camera);
        let tan = libm::tan(0.5 * camera.vertical_fov) as f32;
        Self {
            position: camera.position.as_vec3(),
            right: axes.x_axis.as_vec3(),
            up: axes.y_axis.as_vec3(),
            forward: axes.z_axis.as_vec3(),
            half_extent: Vec2::new(tan * width as f32 / height as f32, tan),
            lens_radius: camera.lens_radius as f32,
            focus_distance: camera.focus_distance as f32,
            size: Vec2::new(width as f32, height as f32),
        }
    }

    /// Angle that a pixel in the middle of the picture spans, radians.
    pub fn pixel_angle(&self) -> f32 {
        2.0 * self.half_extent.y / self.size.y
    }

    /// Whether rays start from more than one point.
    pub fn has_lens(&self) -> bool {
        self.lens_radius > 0.0
    }

    /// Unit vectors to the right of the picture, up, and into the scene.
    pub fn axes(camera: &View) -> DMat3 {
        let forward = (camera.look_at - camera.position).normalize_or(DVec3::NEG_Z);
        let right = forward
            .cross(camera.up)
            .normalize_or(forward.any_orthonormal_vector());
        DMat3::from_cols(right, right.cross(forward), forward)
    }

    /// The ray through a point of the film in pixels, (0, 0) being the upper left corner, from a
    /// point of the lens given by `lens` in the unit square. Its direction is a unit vector.
    pub fn ray(&self, film: Vec2, lens: Vec2) -> Ray {
        let ndc = film / self.size * 2.0 - Vec2::ONE;
        let direction = self.forward + self.right * (ndc.x * self.half_extent.x)
            - self.up * (ndc.y * self.half_extent.y);
        if self.lens_radius == 0.0 {
            return Ray::new(self.position, direction.normalize());
        }
        let point = warp::disc(lens) * self.lens_radius;
        let offset = self.right * point.x + self.up * point.y;
        let focus = direction * self.focus_distance;
        Ray::new(self.position + offset, (focus - offset).normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(lens_radius: f64) -> Camera {
        let described = View {
            position: DVec3::new(0.0, -2.0, 0.0),
            look_at: DVec3::ZERO,
            up: DVec3::Z,
            vertical_fov: std::f64::consts::FRAC_PI_2,
            lens_radius,
            focus_distance: 2.0,
        };
        Camera::new(&described, 200, 100)
    }

    #[test]
    fn right_is_right_and_up_is_up() {
        let ray = camera(0.0).ray(Vec2::new(200.0, 0.0), Vec2::ZERO);
        let expected = Vec3::new(2.0, 1.0, 1.0).normalize();
        assert!(
            (ray.direction - expected).length() < 1e-6,
            "{}",
            ray.direction
        );
    }

    #[test]
    fn every_ray_of_a_pixel_meets_in_the_sharp_plane() {
        let camera = camera(0.1);
        let film = Vec2::new(33.0, 71.0);
        let at_focus =
            |ray: Ray| ray.origin + ray.direction * ((0.0 - ray.origin.y) / ray.direction.y);
        let first = at_focus(camera.ray(film, Vec2::new(0.1, 0.9)));
        for lens in [
            Vec2::new(0.5, 0.5),
            Vec2::new(0.99, 0.01),
            Vec2::new(0.3, 0.6),
        ] {
            assert!((at_focus(camera.ray(film, lens)) - first).length() < 1e-5);
        }
    }
}
