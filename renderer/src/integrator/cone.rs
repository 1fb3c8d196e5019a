//! The width of a ray along its way, for filters of textures.

/// Opening of the cone of directions that a scattered ray stands for.
const SCATTERED_ANGLE: f32 = 0.2;
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
    /// That of a camera's ray through a pixel that spans this angle.
    pub fn of_pixel(angle: f32) -> Self {
        Self { width: 0.0, angle }
    }

    /// That of a ray that leaves a surface where the one before was this wide, m.
    pub fn scattered(width: f32) -> Self {
        Self {
            width,
            angle: SCATTERED_ANGLE,
        }
    }

    /// Its width at a distance, m.
    pub fn width_at(&self, distance: f32) -> f32 {
        self.width + self.angle * distance
    }
}

/// The width on a surface, m, of a ray that meets it at this cosine: the geometric mean of the
/// ellipse's axes.
pub fn footprint(width: f32, cosine: f32) -> f32 {
    width / cosine.abs().max(LEAST_FACING).sqrt()
}
