//! The optics of a thin lens: from what a photographer sets to what rays need.
//!
//! With the focal length `f`, the distances `u` of the sharp plane and `v` of the film along the
//! axis, and the angle `τ` between the axes of lens and film,
//!
//! ```text
//! 1/u + 1/v = cos τ / f
//! ```
//!
//! which is the thin-lens law for `τ = 0`. `docs/src/theory/camera.md` derives it.

use document::declared::Declared;
use document::keys::Keys;
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Smallest and greatest angle from the lower to the upper edge of a picture, degrees.
pub const ANGLES_DEG: [f64; 2] = [0.01, 170.0];

/// What a photographer sets. Lengths are in metres, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Lens {
    /// What the picture shows.
    pub field: Field,
    /// Height of the recorded frame.
    pub sensor_height: f64,
    /// Size of the opening.
    pub opening: Opening,
    /// Shape of the opening.
    pub iris: Iris,
    /// Right-handed turns of the lens about the picture's axes to the right and up, in this order.
    pub tilt: [f64; 2],
}

/// What decides the angle of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// The angle from the lower to the upper edge of the picture.
    Angle(f64),
    /// The focal length; the angle then depends on the focus.
    FocalLength(f64),
}

/// What decides the size of the opening.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Opening {
    /// Its diameter, ≥ 0.
    Diameter(f64),
    /// The focal length over its diameter.
    FNumber(f64),
}

/// The shape of the opening.
#[derive(Clone, Copy, Debug, Declared, Default, Deserialize, PartialEq, Serialize)]
#[key(last = Self::check)]
pub struct Iris {
    /// Straight blades of the iris: light out of focus has so many corners; 0 is a circle, otherwise at
    /// least 3. The opening keeps its area.
    #[key("blades", 0..=32)]
    pub blades: u32,
    /// Turn of the blades in the picture's plane, against the clock; at 0 a corner is on top.
    #[key("blade_rotation_deg", degrees(-360.0..=360.0))]
    pub rotation: f64,
    /// Share of its diameter by which the lens's rim cuts the opening in the picture's corners, in
    /// proportion less towards the middle. Light out of focus looks like a cat's eye there, and corners
    /// get darker: at 1 they are black.
    #[key("cats_eye", 0.0..=1.0)]
    pub cats_eye: f64,
}

impl Iris {
    fn check(&mut self, keys: &mut Keys<'_>) {
        if let blades @ (1 | 2) = self.blades {
            let problem = format!("{blades} blades close no opening");
            keys.refuse(&["blades"], problem, "write 0 for a circle, or 3 to 32");
        }
    }
}

/// What is sharp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Focus {
    /// The plane at this distance along the axis, > 0.
    Distance(f64),
    /// The plane through this point, in the frame of the picture.
    Point(DVec3),
    /// The plane on the axis whose picture on the film is so many times its size, > 0. It needs a
    /// focal length.
    Magnification(f64),
    /// What is infinitely far away.
    Infinity,
}

/// A lens with its focus set. Lengths are in metres, angles in radians.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ThinLens {
    /// Angle from the lower to the upper edge of the picture.
    pub vertical_fov: f64,
    /// Distance of the film behind the lens along the axis.
    pub image_distance: f64,
    /// Distance of the sharp plane along the axis.
    pub focus_distance: f64,
    /// Radius of the opening, or of the circle of its area; 0 is a pinhole.
    pub radius: f64,
    /// Shape of the opening.
    pub iris: Iris,
    /// As in [`Lens::tilt`].
    pub tilt: [f64; 2],
}

/// Why a lens cannot be focused so.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LensError {
    /// There is no film distance for it.
    #[error(
        "the sharp plane is {} m from the lens, not farther than the focal length of {} m",
        short(*distance),
        short(*focal_length)
    )]
    TooNear {
        /// Distance of the sharp plane along the axis.
        distance: f64,
        /// Focal length along the axis, `f / cos τ`.
        focal_length: f64,
    },
    /// The point is not in front of the lens.
    #[error("the point that is to be sharp lies {} m behind the lens", short(*behind))]
    Behind {
        /// How far.
        behind: f64,
    },
    /// A tilted lens has its sharp plane along the axis or cuts it behind the camera.
    #[error(
        "the sharp plane through this point does not meet the axis in front of the tilted lens"
    )]
    OffAxis,
    /// The picture would show more or less than a camera can.
    #[error(
        "the picture spans {}° from its lower to its upper edge, outside 0.01 to 170",
        short(*degrees)
    )]
    Angle {
        /// The angle.
        degrees: f64,
    },
    /// The focal length is not known beforehand.
    #[error("a magnification needs a focal length")]
    NoFocalLength,
}

/// A number as messages show it, with at most six decimals.
fn short(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

impl Lens {
    /// A pinhole that sees this angle.
    pub fn pinhole(vertical_fov: f64) -> Self {
        Self {
            field: Field::Angle(vertical_fov),
            sensor_height: 0.024,
            opening: Opening::Diameter(0.0),
            iris: Iris::default(),
            tilt: [0.0; 2],
        }
    }

    /// The lens with its focus set.
    ///
    /// # Errors
    ///
    /// [`LensError`] if no place of the film makes that sharp.
    pub fn focused(&self, focus: Focus) -> Result<ThinLens, LensError> {
        let axes = lens_axes(self.tilt);
        let cos = axes.z_axis.z;
        let per_distance = self.per_distance(focus, axes.z_axis)?;
        // The exact number where it was given.
        let focus_distance = match focus {
            Focus::Distance(distance) => distance,
            Focus::Point(_) | Focus::Magnification(_) | Focus::Infinity => 1.0 / per_distance,
        };
        let (vertical_fov, image_distance, focal_length) = match self.field {
            Field::Angle(angle) => {
                let per_image = self.per_image(angle);
                (angle, 1.0 / per_image, cos / (per_distance + per_image))
            }
            Field::FocalLength(length) => {
                let per_image = cos / length - per_distance;
                // Nearer than this, `per_image` would consist of rounding errors.
                if per_image <= 1e-9 * cos / length {
                    return Err(LensError::TooNear {
                        distance: focus_distance,
                        focal_length: length / cos,
                    });
                }
                let angle = 2.0 * libm::atan(0.5 * self.sensor_height * per_image);
                (angle, 1.0 / per_image, length)
            }
        };
        let degrees = vertical_fov.to_degrees();
        let [least, most] = ANGLES_DEG;
        // Angles that were written have been judged where they stand.
        if matches!(self.field, Field::FocalLength(_)) && !(least..=most).contains(&degrees) {
            return Err(LensError::Angle { degrees });
        }
        Ok(ThinLens {
            vertical_fov,
            image_distance,
            focus_distance,
            radius: match self.opening {
                Opening::Diameter(diameter) => 0.5 * diameter,
                Opening::FNumber(number) => 0.5 * focal_length / number,
            },
            iris: self.iris,
            tilt: self.tilt,
        })
    }

    /// One over the film's distance for an angle.
    fn per_image(&self, angle: f64) -> f64 {
        2.0 * libm::tan(0.5 * angle) / self.sensor_height
    }

    /// One over the distance of the sharp plane along the axis, ≥ 0; `normal` is that of the lens.
    fn per_distance(&self, focus: Focus, normal: DVec3) -> Result<f64, LensError> {
        match focus {
            Focus::Infinity => Ok(0.0),
            Focus::Distance(distance) => Ok(1.0 / distance),
            Focus::Magnification(times) => match self.field {
                Field::FocalLength(length) => Ok(normal.z / length * times / (1.0 + times)),
                Field::Angle(_) => Err(LensError::NoFocalLength),
            },
            Focus::Point(point) => {
                let along = point.dot(normal);
                let least = point.z.min(along);
                if least <= 0.0 {
                    return Err(LensError::Behind { behind: -least });
                }
                if normal.z == 1.0 {
                    return Ok(1.0 / point.z);
                }
                // The sharp plane is where P·n/f − P_z/v = 1.
                let per_distance = match self.field {
                    Field::FocalLength(length) => {
                        (1.0 - along / length) / point.z + normal.z / length
                    }
                    Field::Angle(angle) => {
                        let per_image = self.per_image(angle);
                        normal.z * (1.0 + point.z * per_image) / along - per_image
                    }
                };
                if per_distance > 0.0 {
                    Ok(per_distance)
                } else {
                    Err(LensError::OffAxis)
                }
            }
        }
    }
}

impl ThinLens {
    /// The focal length, m: by the thin-lens law from the distances of sharp plane and film.
    pub fn focal_length(&self) -> f64 {
        lens_axes(self.tilt).z_axis.z / (1.0 / self.focus_distance + 1.0 / self.image_distance)
    }
}

/// The axes of a tilted lens in the frame of the picture (right, up, into the scene): two in its
/// plane, then its normal into the scene.
pub(crate) fn lens_axes([about_right, about_up]: [f64; 2]) -> DMat3 {
    let (sin_a, cos_a) = libm::sincos(about_right);
    let (sin_b, cos_b) = libm::sincos(about_up);
    // A right-handed frame is right, up, and out of the scene.
    DMat3::from_cols(
        DVec3::new(cos_b, 0.0, sin_b),
        DVec3::new(sin_a * sin_b, cos_a, -sin_a * cos_b),
        DVec3::new(-cos_a * sin_b, sin_a, cos_a * cos_b),
    )
}
