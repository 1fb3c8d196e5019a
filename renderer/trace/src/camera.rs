//! Rays from the film into the scene.
//!
//! - **In**: a [`View`]: where the camera stands, and a [thin lens](thin_lens) or parallel rays.
//! - **Out**: a ray for a point of the film and a point of the lens, and the share of light that
//!   comes through there.
//! - **Always true**: all rays of a film point meet in the sharp plane; directions are unit vectors;
//!   rays are as exact from a far camera as from a near one, since they start near what is seen.
//! - **Left out**: diffraction, aberrations, and exposure: radiance does not depend on the f-number.
//!
//! ```
//! use glam::{DVec3, Vec2};
//! use trace::camera::Camera;
//! use trace::camera::thin_lens::{Focus, Lens};
//! use trace::camera::view::{Near, Projection, View};
//!
//! let described = View {
//!     position: DVec3::new(0.0, -1.0, 0.0),
//!     look_at: DVec3::ZERO,
//!     up: DVec3::Z,
//!     projection: Projection::Perspective(Lens::pinhole(0.7).focused(Focus::Distance(1.0))?),
//!     near: Near::default(),
//! };
//! let camera = Camera::new(&described, 200, 100);
//! // The middle of the film looks along +y.
//! let ray = camera.ray(Vec2::new(100.0, 50.0), Vec2::splat(0.5)).ray;
//! assert!(ray.direction().distance(glam::Vec3::Y) < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use glam::{DMat3, DVec2, DVec3, Vec2, Vec3};

use crate::geometry::ray::Ray;

mod aperture;
pub mod filter;
pub mod frustum;
pub mod thin_lens;
pub mod view;

#[cfg(test)]
mod tests;

use self::aperture::Aperture;
use self::view::{Projection, View};

/// A camera with a thin lens, or with parallel rays.
#[derive(Clone, Debug)]
pub struct Camera {
    position: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Half the picture's width and height: at distance 1, or for parallel rays everywhere.
    half_extent: Vec2,
    optics: Optics,
    size: Vec2,
    /// For rays that start far from the camera.
    far: Option<Box<Far>>,
}

/// What rays need that start far from the camera, in double precision.
#[derive(Clone, Debug)]
struct Far {
    position: DVec3,
    axes: DMat3,
    half_extent: DVec2,
    /// How far in front of the camera rays start, along its axis, m.
    distance: f64,
}

#[derive(Clone, Debug)]
enum Optics {
    Pinhole,
    Lens(Aperture),
    Parallel,
}

/// A ray that reaches the film.
#[derive(Clone, Copy, Debug)]
pub struct FilmRay {
    /// From the lens into the scene.
    pub ray: Ray,
    /// Factor on the light along it: 1, or 0 if the lens's rim is in the way.
    pub weight: f32,
}

impl Camera {
    /// The camera for a film of `width` × `height` square pixels.
    pub fn new(view: &View, width: u32, height: u32) -> Self {
        let axes = view.axes();
        let exact_half_height = view.half_height();
        let half_height = exact_half_height as f32;
        let half_extent = Vec2::new(half_height * width as f32 / height as f32, half_height);
        let position = view.position - view.near.origin;
        let distance = view.near.distance;
        let far = (distance > 0.0).then(|| {
            let aspect = f64::from(width) / f64::from(height);
            Box::new(Far {
                position,
                axes,
                half_extent: DVec2::new(exact_half_height * aspect, exact_half_height),
                distance,
            })
        });
        Self {
            position: position.as_vec3(),
            right: axes.x_axis.as_vec3(),
            up: axes.y_axis.as_vec3(),
            forward: axes.z_axis.as_vec3(),
            half_extent,
            optics: match &view.projection {
                Projection::Perspective(lens) if lens.radius as f32 > 0.0 => {
                    Optics::Lens(Aperture::new(view, lens, half_extent))
                }
                Projection::Perspective(_) => Optics::Pinhole,
                Projection::Orthographic { .. } => Optics::Parallel,
            },
            size: Vec2::new(width as f32, height as f32),
            far,
        }
    }

    /// What a pixel in the middle of the picture spans: its width where rays start, m, and the
    /// angle by which it widens, radians.
    pub(crate) fn pixel_span(&self) -> [f32; 2] {
        let span = 2.0 * self.half_extent.y / self.size.y;
        match self.optics {
            Optics::Pinhole | Optics::Lens(_) => {
                let start = self.far.as_ref().map_or(0.0, |far| far.distance as f32);
                [span * start, span]
            }
            Optics::Parallel => [span, 0.0],
        }
    }

    /// Whether the rays of one point of the film start from more than one point.
    pub fn has_lens(&self) -> bool {
        matches!(self.optics, Optics::Lens(_))
    }

    /// The ray through a point of the film in pixels, (0, 0) being the upper left corner, from a
    /// point of the lens given by `lens` in the unit square. Its direction is a unit vector.
    pub fn ray(&self, film: Vec2, lens: Vec2) -> FilmRay {
        let ndc = film / self.size * 2.0 - Vec2::ONE;
        let (x, y) = (ndc.x * self.half_extent.x, ndc.y * self.half_extent.y);
        let direction = self.forward + self.right * x - self.up * y;
        if let Some(far) = &self.far {
            let (start, towards, weight) = self.far_ray(far, film, lens, direction);
            return FilmRay {
                ray: Ray::new(start.as_vec3(), towards.normalize().as_vec3()),
                weight,
            };
        }
        match &self.optics {
            Optics::Pinhole => FilmRay {
                ray: Ray::new(self.position, direction.normalize()),
                weight: 1.0,
            },
            Optics::Lens(aperture) => {
                let point = aperture.point(lens);
                let (offset, towards, facing) =
                    aperture.through(point, [self.right, self.up], direction);
                let is_open = facing > 0.0 && aperture.passes(point, Vec2::new(x, -y));
                FilmRay {
                    ray: Ray::new(self.position + offset, towards.normalize()),
                    weight: if is_open { 1.0 } else { 0.0 },
                }
            }
            Optics::Parallel => FilmRay {
                ray: Ray::new(self.position + (self.right * x - self.up * y), self.forward),
                weight: 1.0,
            },
        }
    }

    /// Where the ray of [`Camera::ray`] starts, its direction, and its weight, if it starts far from
    /// the camera; `direction` is the one through the middle of the lens.
    fn far_ray(&self, far: &Far, film: Vec2, lens: Vec2, direction: Vec3) -> (DVec3, DVec3, f32) {
        let ndc = film.as_dvec2() / self.size.as_dvec2() * 2.0 - DVec2::ONE;
        let place = ndc * far.half_extent;
        let [right, up, forward] = [far.axes.x_axis, far.axes.y_axis, far.axes.z_axis];
        let aside = right * place.x - up * place.y;
        let through_middle = forward + aside;
        let (offset, towards, weight) = match &self.optics {
            Optics::Pinhole => (DVec3::ZERO, through_middle, 1.0),
            Optics::Lens(aperture) => {
                let point = aperture.point(lens);
                let (offset, meeting, facing) =
                    aperture.bending(point, [self.right, self.up], direction);
                let field = Vec2::new(place.x as f32, -place.y as f32);
                let is_open = facing > 0.0 && aperture.passes(point, field);
                let offset = offset.as_dvec3();
                let towards = through_middle - offset * f64::from(meeting);
                (offset, towards, if is_open { 1.0 } else { 0.0 })
            }
            Optics::Parallel => (aside, forward, 1.0),
        };
        let start = far.position + offset + towards * far.distance;
        (start, towards, weight)
    }
}
