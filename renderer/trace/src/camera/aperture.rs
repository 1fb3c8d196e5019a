//! Points of a lens's opening, and what vignetting takes from it.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{Vec2, Vec3};

use super::thin_lens::{Iris, ThinLens, lens_axes};
use super::view::View;
use crate::sampling::warp;

/// The opening of a lens whose focus is set.
#[derive(Clone, Debug)]
pub(super) struct Aperture {
    radius: f32,
    focus_distance: f32,
    /// Corners of the polygon, the first one repeated at the end; none for a disc.
    corners: Vec<Vec2>,
    /// Radius of the circle around the opening: that of the rim in front of it.
    rim: f32,
    /// Distance of that rim from the opening.
    rim_distance: f32,
    tilt: Option<LensTilt>,
}

/// A lens whose plane is not the film's.
#[derive(Clone, Debug)]
struct LensTilt {
    right: Vec3,
    up: Vec3,
    normal: Vec3,
    per_focal_length: f32,
    per_image_distance: f32,
}

impl Aperture {
    /// The opening of a lens; `half_extent` is half the picture's width and height at distance 1.
    pub(super) fn new(view: &View, lens: &ThinLens, half_extent: Vec2) -> Self {
        let Iris {
            blades,
            rotation,
            cats_eye,
        } = lens.iris;
        let around = lens.radius * circumference_factor(blades);
        let corner = |number: u32| {
            let turn = TAU * f64::from(number % blades.max(1)) / f64::from(blades.max(1));
            let (sin, cos) = libm::sincos(FRAC_PI_2 + rotation + turn);
            Vec2::new((around * cos) as f32, (around * sin) as f32)
        };
        let corners = if blades == 0 {
            Vec::new()
        } else {
            (0..=blades).map(corner).collect()
        };
        let tilt = (lens.tilt != [0.0; 2]).then(|| {
            let axes = view.axes() * lens_axes(lens.tilt);
            LensTilt {
                right: axes.x_axis.as_vec3(),
                up: axes.y_axis.as_vec3(),
                normal: axes.z_axis.as_vec3(),
                per_focal_length: (1.0 / lens.focal_length()) as f32,
                per_image_distance: (1.0 / lens.image_distance) as f32,
            }
        });
        Self {
            radius: lens.radius as f32,
            focus_distance: lens.focus_distance as f32,
            corners,
            rim: around as f32,
            rim_distance: (2.0 * cats_eye * around) as f32 / half_extent.length(),
            tilt,
        }
    }

    /// A point of the opening, uniform over its area, m.
    pub(super) fn point(&self, u: Vec2) -> Vec2 {
        if self.corners.is_empty() {
            return warp::disc(u) * self.radius;
        }
        let blades = self.corners.len() - 1;
        let along = u.x * blades as f32;
        let blade = (along as usize).min(blades - 1);
        let within = Vec2::new((along - blade as f32).clamp(0.0, 1.0), u.y);
        let share = warp::triangle(within);
        self.corners[blade] * share.x + self.corners[blade + 1] * share.y
    }

    /// Whether light that meets the film at `field` (to the right and up at distance 1) passes the
    /// rim in front of this point of the opening.
    pub(super) fn passes(&self, point: Vec2, field: Vec2) -> bool {
        self.rim_distance == 0.0 || (point + field * self.rim_distance).length() <= self.rim
    }

    /// From the middle of the lens to a point of its opening, and the direction from there in which
    /// the film sees the scene; `axes` are the picture's to the right and up, `direction` the one
    /// through the middle, 1 long along the axis. The last number is how squarely the film sees the
    /// lens, ≤ 0 from behind.
    pub(super) fn through(
        &self,
        point: Vec2,
        axes: [Vec3; 2],
        direction: Vec3,
    ) -> (Vec3, Vec3, f32) {
        let (offset, meeting, facing) = self.bending(point, axes, direction);
        if self.tilt.is_none() {
            return (offset, direction * self.focus_distance - offset, facing);
        }
        (offset, direction - offset * meeting, facing)
    }

    /// From the middle of the lens to a point of its opening, one over the distance at which the rays
    /// of a film point meet, in units of `direction`, and how squarely the film sees the lens. The
    /// distance is 0 or less where they never meet. The parameters are those of
    /// [`Aperture::through`].
    pub(super) fn bending(
        &self,
        point: Vec2,
        axes: [Vec3; 2],
        direction: Vec3,
    ) -> (Vec3, f32, f32) {
        let Some(tilt) = &self.tilt else {
            let offset = axes[0] * point.x + axes[1] * point.y;
            return (offset, 1.0 / self.focus_distance, 1.0);
        };
        let offset = tilt.right * point.x + tilt.up * point.y;
        let facing = direction.dot(tilt.normal);
        let meeting = facing * tilt.per_focal_length - tilt.per_image_distance;
        (offset, meeting, facing)
    }
}

/// Radius of the circle around a regular polygon over that of the circle of its area.
fn circumference_factor(corners: u32) -> f64 {
    if corners == 0 {
        return 1.0;
    }
    let turn = TAU / f64::from(corners);
    (turn / libm::sin(turn)).sqrt()
}
