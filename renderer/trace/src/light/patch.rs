//! Flat patches of emitting surfaces, and sampling of points on them from an illuminated point.
//!
//! - **In**: triangles, counter-clockwise seen from the bright side.
//! - **Out**: [`Patch`]es, with sampled points and the density over solid angle of any point.
//! - **Always true**: [`Patch::pdf`] is the density of [`Patch::sample`]: in both, the receiver
//!   alone decides whether points are uniform over solid angle or over area.
//! - **Left out**: occlusion.

use glam::{Vec2, Vec3};

pub mod rectangle;
pub mod triangle;

use crate::light::sample::Receiver;
use crate::light::tree::Emitter;
use rectangle::Rectangle;
use triangle::Triangle;

/// A patch is sampled by area if `size² < FAR · distance²`: then solid angle is nearly proportional
/// to area, which is cheaper. Below this value no difference in the error could be measured.
const FAR: f32 = 0.3;

/// A patch is sampled by area if the receiver is closer to its plane than the root of this share of
/// its size, since the solid angle would be lost in rounding.
const GRAZING: f32 = 1e-6;

/// A flat piece of an emitting surface, which emits on the side of its normal.
#[derive(Clone, Debug)]
pub enum Patch {
    /// Four right angles.
    Rectangle(Rectangle),
    /// Three corners.
    Triangle(Triangle),
}

/// A point on a patch.
#[derive(Clone, Copy, Debug)]
pub struct PatchSample {
    /// Unit direction from the receiver to the point.
    pub wi: Vec3,
    /// The point, world.
    pub point: Vec3,
    /// Density over solid angle, sr⁻¹.
    pub pdf: f32,
}

/// How a patch is sampled from a receiver.
enum PatchMeasure {
    /// Not at all: the receiver is on the dark side or in the plane.
    Dark,
    /// Uniform over area.
    Area,
    /// Uniform over solid angle.
    SolidAngle,
}

impl Patch {
    /// Samples a point of the patch that illuminates the receiver; `None` if none does.
    pub fn sample(&self, receiver: &Receiver, u: Vec2) -> Option<PatchSample> {
        let (point, pdf) = match self.measure(receiver.position) {
            PatchMeasure::Dark => return None,
            PatchMeasure::Area => {
                let point = self.at(u);
                (point, self.pdf_by_area(receiver.position, point))
            }
            PatchMeasure::SolidAngle => {
                let (offset, pdf) = match self {
                    Self::Rectangle(rectangle) => rectangle.sample(receiver.position, u),
                    Self::Triangle(triangle) => triangle.sample(receiver.position, u)?,
                };
                let point = receiver.position.as_dvec3() + offset;
                (point.as_vec3(), pdf)
            }
        };
        let wi = (point - receiver.position).try_normalize()?;
        (pdf > 0.0 && pdf.is_finite()).then_some(PatchSample { wi, point, pdf })
    }

    /// Density over solid angle with which [`Patch::sample`] draws the direction to `point`, a
    /// point of the patch.
    pub fn pdf(&self, receiver: &Receiver, point: Vec3) -> f32 {
        match self.measure(receiver.position) {
            PatchMeasure::Dark => 0.0,
            PatchMeasure::Area => self.pdf_by_area(receiver.position, point),
            PatchMeasure::SolidAngle => 1.0 / self.solid_angle(receiver.position) as f32,
        }
    }

    /// Solid angle that the patch subtends at `position` on its bright side, sr.
    pub fn solid_angle(&self, position: Vec3) -> f64 {
        match self {
            Self::Rectangle(rectangle) => rectangle.solid_angle(position),
            Self::Triangle(triangle) => triangle.solid_angle(position),
        }
    }

    /// A point of the patch, uniform over its area.
    pub fn at(&self, u: Vec2) -> Vec3 {
        match self {
            Self::Rectangle(rectangle) => rectangle.at(u),
            Self::Triangle(triangle) => triangle.at(u),
        }
    }

    /// Area, m².
    pub fn area(&self) -> f32 {
        match self {
            Self::Rectangle(rectangle) => rectangle.area(),
            Self::Triangle(triangle) => triangle.area(),
        }
    }

    /// Unit normal, on the bright side.
    pub fn normal(&self) -> Vec3 {
        match self {
            Self::Rectangle(rectangle) => rectangle.normal(),
            Self::Triangle(triangle) => triangle.normal(),
        }
    }

    /// The patch as an emitter for the light tree: its intensity falls with the cosine from the
    /// normal.
    pub fn emitter(&self, mean_radiance: f32) -> Emitter {
        let (center, radius) = match self {
            Self::Rectangle(rectangle) => (rectangle.center(), rectangle.radius()),
            Self::Triangle(triangle) => (triangle.center(), triangle.radius()),
        };
        Emitter {
            center,
            radius,
            axis: self.normal(),
            spread: 0.0,
            reach: std::f32::consts::FRAC_PI_2,
            intensity: mean_radiance * self.area(),
        }
    }

    fn measure(&self, position: Vec3) -> PatchMeasure {
        let (center, radius) = match self {
            Self::Rectangle(rectangle) => (rectangle.center(), rectangle.radius()),
            Self::Triangle(triangle) => (triangle.center(), triangle.radius()),
        };
        let offset = position - center;
        let height = offset.dot(self.normal());
        let size2 = 4.0 * radius * radius;
        if height <= 0.0 {
            PatchMeasure::Dark
        } else if size2 < FAR * offset.length_squared() || height * height < GRAZING * size2 {
            PatchMeasure::Area
        } else {
            PatchMeasure::SolidAngle
        }
    }

    fn pdf_by_area(&self, position: Vec3, point: Vec3) -> f32 {
        let offset = point - position;
        let distance2 = offset.length_squared();
        let cos = -offset.dot(self.normal()) / distance2.sqrt();
        if cos > 0.0 {
            distance2 / (cos * self.area())
        } else {
            0.0
        }
    }
}

/// Combines triangles into patches; also returns the patch of each triangle, `None` for triangles
/// without area.
///
/// Two consecutive triangles that form a rectangle become one patch.
pub fn patches(triangles: &[[Vec3; 3]]) -> (Vec<Patch>, Vec<Option<u32>>) {
    patches_if(triangles, |_| true)
}

/// As [`patches`], but two triangles become one patch only if `may_join` allows it, which gets the
/// number of the first.
pub(crate) fn patches_if(
    triangles: &[[Vec3; 3]],
    may_join: impl Fn(usize) -> bool,
) -> (Vec<Patch>, Vec<Option<u32>>) {
    let mut patches = Vec::new();
    let mut patch_of = Vec::with_capacity(triangles.len());
    let mut rest = triangles;
    while let [first, others @ ..] = rest {
        let number = patches.len() as u32;
        let rectangle = others
            .first()
            .and_then(|second| Rectangle::from_triangles(first, second))
            .filter(|_| may_join(patch_of.len()));
        if let Some(rectangle) = rectangle {
            patches.push(Patch::Rectangle(rectangle));
            patch_of.extend([Some(number); 2]);
            rest = &others[1..];
        } else {
            let triangle = Triangle::new(*first);
            patch_of.push(triangle.is_some().then_some(number));
            patches.extend(triangle.map(Patch::Triangle));
            rest = others;
        }
    }
    (patches, patch_of)
}

#[cfg(test)]
mod tests;
