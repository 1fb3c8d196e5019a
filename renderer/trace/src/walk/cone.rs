//! The width of a ray along its way, for filters of textures.

/// Opening of the cone of directions that a scattered ray stands for.
const SCATTERED_ANGLE: f32 = 0.2;
/// Width of a thin beam, m: below the texels of any map.
const BEAM_WIDTH: f32 = 1e-7;
/// Least cosine by which a ray's width grows on a surface that it meets at a slant.
const LEAST_FACING: f32 = 0.1;

/// A cone about a ray.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Width where it starts, m.
    width: f32,
    /// By how much it grows, m per m.
    angle: f32,
}

impl Cone {
    /// That of a camera's ray through a pixel: its width where the ray starts, m, and the angle by
    /// which it widens.
    pub fn of_pixel([width, angle]: [f32; 2]) -> Self {
        Self { width, angle }
    }

    /// That of a ray that leaves a surface where the one before was this wide, m.
    pub fn scattered(width: f32) -> Self {
        Self {
            width,
            angle: SCATTERED_ANGLE,
        }
    }

    /// That of a beam so thin that every detail of a texture shows.
    pub fn of_beam() -> Self {
        Self {
            width: BEAM_WIDTH,
            angle: 0.0,
        }
    }

    /// The same from a distance on, m.
    #[must_use]
    pub fn from(self, distance: f32) -> Self {
        Self {
            width: self.width_at(distance),
            ..self
        }
    }

    /// Its width at a distance, m.
    pub fn width_at(&self, distance: f32) -> f32 {
        self.width + self.angle * distance
    }
}

/// The width on a surface, m, of a ray that meets it at this cosine: the geometric mean of the
/// ellipse's axes.
pub(crate) fn footprint(width: f32, cosine: f32) -> f32 {
    width / cosine.abs().max(LEAST_FACING).sqrt()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::camera::Camera;
    use crate::camera::thin_lens::{Focus, Lens};
    use crate::camera::view::{Near, Projection, View};

    #[test]
    fn a_pixel_is_as_wide_on_a_surface_as_the_picture_shows() {
        let width = |projection| {
            let view = View {
                position: DVec3::ZERO,
                look_at: DVec3::Y,
                up: DVec3::Z,
                projection,
                near: Near::default(),
            };
            let camera = Camera::new(&view, 100, 50);
            [0.5, 2.0].map(|distance| Cone::of_pixel(camera.pixel_span()).width_at(distance))
        };
        // 2 m high at any distance: a fiftieth of that.
        assert_eq!(
            width(Projection::Orthographic { height: 2.0 }),
            [0.04, 0.04]
        );
        let right_angle = Lens::pinhole(std::f64::consts::FRAC_PI_2);
        let lens = right_angle.focused(Focus::Distance(1.0)).expect("an angle");
        // Twice the distance is seen.
        let [near, far] = width(Projection::Perspective(lens));
        assert!((near - 0.02).abs() < 1e-6 && (far - 0.08).abs() < 1e-6);
    }
}
