//! Triangles, sampled uniformly over the solid angle that they subtend.
//!
//! # Source
//!
//! \[arvo1995\] for the parameters: first a point `C'` on the arc `AC` such that `ABC'` has a share
//! of the solid angle, then a point on the arc `BC'`. The inversion is our own, without arc
//! cosines: by \[oosterom1983\] the solid angle `S'` of `ABC'` has
//! `tan(S'/2) = det(A, B, C') / (1 + A·B + B·C' + C'·A)`. With `C' = A cos b + T sin b`, where `T`
//! is the unit tangent at `A` towards `C`, and `τ = tan(b/2)` this is
//! `τ det(A, B, T) / (1 + A·B + τ B·T)`, so `τ = (1 + A·B) sin(S'/2) / (det(A, B, T) cos(S'/2) −
//! B·T sin(S'/2))`.

use glam::{DVec3, Vec2, Vec3};

use crate::light::sample::offset;
use crate::sampling::warp;

/// A triangle in space.
#[derive(Clone, Debug)]
pub struct Triangle {
    corners: [Vec3; 3],
    normal: Vec3,
    area: f32,
}

impl Triangle {
    /// Counter-clockwise seen from the bright side; `None` if it has no area.
    pub fn new(corners: [Vec3; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let cross = offset(b, a).cross(offset(c, a));
        let normal = cross.try_normalize()?.as_vec3();
        let area = 0.5 * cross.length() as f32;
        (area > 0.0).then_some(Self {
            corners,
            normal,
            area,
        })
    }

    /// Area, m².
    pub fn area(&self) -> f32 {
        self.area
    }

    /// Unit normal.
    pub fn normal(&self) -> Vec3 {
        self.normal
    }

    /// Centroid.
    pub fn center(&self) -> Vec3 {
        (self.corners[0] + self.corners[1] + self.corners[2]) / 3.0
    }

    /// Greatest distance from the centre.
    pub fn radius(&self) -> f32 {
        let center = self.center();
        let distances = self.corners.map(|corner| (corner - center).length());
        distances.into_iter().fold(0.0, f32::max)
    }

    /// A point, uniform over area.
    pub fn at(&self, u: Vec2) -> Vec3 {
        let [a, b, c] = self.corners;
        let weights = warp::triangle(u);
        a + (b - a) * weights.x + (c - a) * weights.y
    }

    /// Solid angle seen from a point over the bright side, sr.
    pub fn solid_angle(&self, from: Vec3) -> f64 {
        solid_angle(&self.corners.map(|corner| offset(corner, from)))
    }

    /// The vector from a point over the bright side to a sampled point of the triangle, uniform
    /// over solid angle, and the density over solid angle, sr⁻¹.
    ///
    /// `None` if by rounding the direction misses the plane.
    pub fn sample(&self, from: Vec3, u: Vec2) -> Option<(DVec3, f32)> {
        let offsets = self.corners.map(|corner| offset(corner, from));
        let solid_angle = solid_angle(&offsets);
        let [a, b, c] = offsets.map(DVec3::normalize);
        let tangent = (c - a * a.dot(c)).try_normalize()?;
        let (sin, cos) = libm::sincos(0.5 * solid_angle * f64::from(u.x));
        let tan_half =
            (1.0 + a.dot(b)) * sin / (b.cross(a).dot(tangent).abs() * cos - b.dot(tangent) * sin);
        let scale = 1.0 / (1.0 + tan_half * tan_half);
        let on_ac = a * ((1.0 - tan_half * tan_half) * scale) + tangent * (2.0 * tan_half * scale);
        // 1 − cos of the arc from B, which is accurate for short arcs.
        let fall = 0.5 * (on_ac - b).length_squared() * f64::from(u.y);
        let across = (on_ac - b * b.dot(on_ac)).try_normalize()?;
        let way = b * (1.0 - fall) + across * (fall * (2.0 - fall)).max(0.0).sqrt();
        let normal = self.normal.as_dvec3();
        let length = offsets[0].dot(normal) / way.dot(normal);
        (length.is_finite() && length > 0.0).then_some((way * length, 1.0 / solid_angle as f32))
    }
}

/// Solid angle of the triangle with these corners seen from the origin, sr.
fn solid_angle(corners: &[DVec3; 3]) -> f64 {
    let [a, b, c] = *corners;
    let [ra, rb, rc] = corners.map(DVec3::length);
    let volume = (b - a).cross(c - a).dot(a).abs();
    let rest = ra * rb * rc + a.dot(b) * rc + b.dot(c) * ra + c.dot(a) * rb;
    2.0 * libm::atan2(volume, rest)
}
