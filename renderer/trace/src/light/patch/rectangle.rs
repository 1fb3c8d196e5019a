//! Rectangles, sampled uniformly over the solid angle that they subtend.
//!
//! # Source
//!
//! \[urena2013\] for the parameters: first a line across the rectangle that cuts off a share of the
//! solid angle, then a point on it. The inversion is our own: it needs no arc cosines, and only one
//! arc tangent for the solid angle.
//!
//! Seen from height `h` over the plane, the solid angle of the rectangle between the foot of the
//! perpendicular and `(x, y)` is `a(x, y) = atan(x y / (h r))` with `r² = x² + y² + h²`, which is
//! `asin(t β)` with `t = x / √(x² + h²)` and `β = y / √(y² + h²)`. The part of
//! `[x₀, x₁] × [y₀, y₁]` up to `x` fills `φ(x) − φ(x₀)`, where `φ(x) = asin(t β₁) − asin(t β₀)`.
//! With `φ` given, the law of cosines yields `t = sin φ / √(β₀² + β₁² − 2 β₀ β₁ cos φ)`.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::light::sample::offset;

/// Tolerance of rectangles: for the distance of the fourth corner from its place by the other
/// three, as a share of the diagonal, and for the cosines of corners.
const TOLERANCE: f32 = 1e-5;

/// A rectangle in space.
#[derive(Clone, Debug)]
pub struct Rectangle {
    corner: Vec3,
    /// Edges from the corner.
    edges: [Vec3; 2],
    /// Unit vectors along the edges.
    axes: [Vec3; 2],
    lengths: [f32; 2],
    normal: Vec3,
}

/// A rectangle relative to a point over its bright side.
struct SeenRectangle {
    /// Borders along the first axis, relative to the foot of the perpendicular.
    x: [f64; 2],
    y: [f64; 2],
    /// Height over the plane, > 0.
    height: f64,
}

impl Rectangle {
    /// The rectangle formed by two counter-clockwise triangles that share an edge, if they form
    /// one.
    pub(crate) fn from_triangles(first: &[Vec3; 3], second: &[Vec3; 3]) -> Option<Self> {
        let rotations = |[a, b, c]: [Vec3; 3]| [[a, b, c], [b, c, a], [c, a, b]];
        for [corner, p, q] in rotations(*first) {
            for [opposite, r, s] in rotations(*second) {
                if r == q && s == p {
                    return Self::from_corners(corner, p, q, opposite);
                }
            }
        }
        None
    }

    /// From a corner, its two neighbours (counter-clockwise with it) and the corner opposite;
    /// `None` if the angles are not right angles or there is no area.
    fn from_corners(corner: Vec3, p: Vec3, q: Vec3, opposite: Vec3) -> Option<Self> {
        let edges = [p - corner, q - corner];
        let lengths = edges.map(Vec3::length);
        let diagonal = (p - q).length();
        let normal = edges[0].cross(edges[1]).try_normalize()?;
        let right = edges[0].dot(edges[1]).abs() <= TOLERANCE * lengths[0] * lengths[1];
        let closed = (edges[0] + edges[1] - (opposite - corner)).length() <= TOLERANCE * diagonal;
        let axes = [edges[0] / lengths[0], edges[1] / lengths[1]];
        (right && closed && lengths[0] * lengths[1] > 0.0).then_some(Self {
            corner,
            edges,
            axes,
            lengths,
            normal,
        })
    }

    /// Area, m².
    pub fn area(&self) -> f32 {
        self.lengths[0] * self.lengths[1]
    }

    /// Unit normal.
    pub fn normal(&self) -> Vec3 {
        self.normal
    }

    /// Middle.
    pub fn center(&self) -> Vec3 {
        self.at(Vec2::splat(0.5))
    }

    /// Half the diagonal.
    pub fn radius(&self) -> f32 {
        0.5 * Vec2::from(self.lengths).length()
    }

    /// The point at the shares `u` of both edges.
    pub fn at(&self, u: Vec2) -> Vec3 {
        self.corner + self.edges[0] * u.x + self.edges[1] * u.y
    }

    /// Solid angle seen from a point over the bright side, sr.
    pub fn solid_angle(&self, from: Vec3) -> f64 {
        self.seen(from).solid_angle().1
    }

    /// The vector from a point over the bright side to a sampled point of the rectangle, uniform
    /// over solid angle, and the density over solid angle, sr⁻¹.
    pub fn sample(&self, from: Vec3, u: Vec2) -> (DVec3, f32) {
        let seen = self.seen(from);
        let (place, solid_angle) = seen.sample(u);
        let [x_axis, y_axis] = self.axes.map(Vec3::as_dvec3);
        let way = x_axis * place.x + y_axis * place.y - self.normal.as_dvec3() * seen.height;
        (way, 1.0 / solid_angle as f32)
    }

    fn seen(&self, from: Vec3) -> SeenRectangle {
        let corner = offset(self.corner, from);
        let [x, y] = [0, 1].map(|i| {
            let first = corner.dot(self.axes[i].as_dvec3());
            [first, first + f64::from(self.lengths[i])]
        });
        SeenRectangle {
            x,
            y,
            height: -corner.dot(self.normal.as_dvec3()),
        }
    }
}

impl SeenRectangle {
    /// The complex number `(cos φ, sin φ)`, of any length, with the solid angle `φ` between the
    /// foot of the perpendicular's row `x` and the borders in y.
    fn turn(&self, x: f64) -> DVec2 {
        let [low, high] = self.y.map(|y| {
            let distance = (x * x + y * y + self.height * self.height).sqrt();
            DVec2::new(self.height * distance, x * y)
        });
        times_conjugate(high, low)
    }

    /// [`SeenRectangle::turn`] of the first border in x, and the solid angle.
    fn solid_angle(&self) -> (DVec2, f64) {
        let first = self.turn(self.x[0]);
        let whole = times_conjugate(self.turn(self.x[1]), first);
        let angle = libm::atan2(whole.y, whole.x);
        // It is below 2π, and negative only when atan2 has wrapped.
        let angle = if angle < 0.0 {
            angle + std::f64::consts::TAU
        } else {
            angle
        };
        (first, angle)
    }

    /// A place on the rectangle, uniform over solid angle: `u.x` is the share of the solid angle
    /// along x, `u.y` the share along y at that x.
    fn sample(&self, u: Vec2) -> (DVec2, f64) {
        let (first, solid_angle) = self.solid_angle();
        let (sin, cos) = libm::sincos(f64::from(u.x) * solid_angle);
        let turned = DVec2::new(first.x * cos - first.y * sin, first.x * sin + first.y * cos);
        let [sin, cos] = [turned.y, turned.x].map(|part| part / turned.length());
        let [b0, b1] = self
            .y
            .map(|y| y / (y * y + self.height * self.height).sqrt());
        // t² / (1 − t²) = sin² φ / under
        let under = b0 * b0 + b1 * b1 - 2.0 * b0 * b1 * cos - sin * sin;
        let x = self.height * sin / under.max(f64::MIN_POSITIVE).sqrt();
        let x = x.clamp(self.x[0], self.x[1]);
        let row2 = x * x + self.height * self.height;
        let [low, high] = self.y.map(|y| y / (y * y + row2).sqrt());
        let along = low + (high - low) * f64::from(u.y);
        let y = along * (row2 / (1.0 - along * along)).sqrt();
        (DVec2::new(x, y.clamp(self.y[0], self.y[1])), solid_angle)
    }
}

/// `a · b*` of complex numbers.
fn times_conjugate(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y)
}
