//! Solids of revolution about the z axis.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::{Shape, affordable, positive};
use crate::not_grown::{NotGrown, not_grown};

/// Distance between points of a ring over the longest edge allowed. With rings √3/2 of that
/// distance apart, no diagonal is too long.
const RING_STEP: f64 = 0.72;
/// Number of pieces of each span of the spline for the measurement of its length.
const PIECES: u32 = 64;
/// Radius below which, as a share of the greatest, an end lies on the axis.
const ON_AXIS: f64 = 1e-9;

/// A point of the curve with its tangent (unit length): radius and height, mm.
#[derive(Clone, Copy, Debug)]
struct CurvePoint {
    at: DVec2,
    tangent: DVec2,
}

/// A body of revolution about the z axis whose profile runs smoothly through `profile`'s points
/// (radius, height), mm.
///
/// The curve is a centripetal Catmull-Rom spline (\[yuksel2011\]): it has no loops between its
/// points. An end with radius 0 is closed there without a tip (the profile goes on as its mirror
/// image), so that dimples are smooth; an end off the axis is left open. The number of points of a
/// ring depends on its length.
///
/// # Errors
///
/// [`NotGrown`] for fewer than two points, points that are not finite or have a negative radius,
/// repeated points, curves that meet the axis between their ends, and for too many triangles.
pub fn lathe(profile: &[DVec2], max_edge_mm: f64) -> Result<Shape, NotGrown> {
    positive("max_edge_mm", max_edge_mm)?;
    let curve = curve(profile)?;
    let step = RING_STEP * max_edge_mm;
    let length: f64 = curve.windows(2).map(|w| w[0].at.distance(w[1].at)).sum();
    let area: f64 = curve
        .windows(2)
        .map(|w| PI * (w[0].at.x + w[1].at.x) * w[0].at.distance(w[1].at))
        .sum();
    // A triangle has half of the area of the step times the distance of the rings.
    affordable(area / (0.433 * step * step) + length / step)?;
    let count = libm::ceil(length / (0.75f64.sqrt() * step)).max(2.0) as usize;
    let rings = resampled(&curve, length, count);
    let widest = curve.iter().map(|p| p.at.x).fold(0.0, f64::max);

    let mut shape = Shape {
        positions: Vec::new(),
        normals: Vec::new(),
        faces: Vec::new(),
    };
    let mut last: Option<Ring> = None;
    for (number, point) in rings.iter().enumerate() {
        let end = number == 0 || number + 1 == rings.len();
        let points = if end && point.at.x <= ON_AXIS * widest {
            1
        } else {
            (libm::ceil(TAU * point.at.x / step) as u32).max(5)
        };
        let ring = Ring {
            first: shape.positions.len() as u32,
            points,
            turned: if number % 2 == 0 { 0.0 } else { 0.5 },
        };
        for i in 0..points {
            let angle = ring.angle(i);
            let across = DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
            let radius = if points == 1 { 0.0 } else { point.at.x };
            shape
                .positions
                .push(across * radius + DVec3::Z * point.at.y);
            let normal = if points == 1 {
                -DVec3::Z * point.tangent.x.signum()
            } else {
                across * point.tangent.y - DVec3::Z * point.tangent.x
            };
            shape.normals.push(normal.normalize());
        }
        if let Some(below) = last {
            stitch(&mut shape.faces, &below, &ring);
        }
        last = Some(ring);
    }
    Ok(shape)
}

/// Points at one height, evenly about the axis.
struct Ring {
    first: u32,
    points: u32,
    /// Angle of the first point from the x axis, as a share of a step.
    turned: f64,
}

impl Ring {
    /// Angle of a point; numbers may exceed that of the last point.
    fn angle(&self, i: u32) -> f64 {
        TAU * (f64::from(i) + self.turned) / f64::from(self.points)
    }

    fn vertex(&self, i: u32) -> u32 {
        self.first + i % self.points
    }
}

/// Triangles between two rings: each next one ends at the nearer of the two next points.
fn stitch(faces: &mut Vec<[u32; 3]>, below: &Ring, above: &Ring) {
    if below.points == 1 || above.points == 1 {
        let (centre, ring) = if below.points == 1 {
            (below, above)
        } else {
            (above, below)
        };
        for i in 0..ring.points {
            let (a, b) = (ring.vertex(i), ring.vertex(i + 1));
            faces.push(if below.points == 1 {
                [centre.first, b, a]
            } else {
                [centre.first, a, b]
            });
        }
        return;
    }
    let (mut i, mut j) = (0, 0);
    while i < below.points || j < above.points {
        let lower = j == above.points
            || (i < below.points
                && below.angle(i + 1) - above.angle(j) <= above.angle(j + 1) - below.angle(i));
        if lower {
            faces.push([below.vertex(i), below.vertex(i + 1), above.vertex(j)]);
            i += 1;
        } else {
            faces.push([below.vertex(i), above.vertex(j + 1), above.vertex(j)]);
            j += 1;
        }
    }
}

/// The checked profile as a dense polyline, upwards: the body lies to the left.
fn curve(profile: &[DVec2]) -> Result<Vec<CurvePoint>, NotGrown> {
    if profile.len() < 2 {
        let points = profile.len();
        return Err(not_grown!(
            "a profile needs at least 2 points, it has {points}"
        ));
    }
    let widest = profile.iter().map(|p| p.x).fold(0.0, f64::max);
    for (index, p) in profile.iter().enumerate() {
        if !(p.is_finite() && p.x >= 0.0) {
            let DVec2 {
                x: radius,
                y: height,
            } = p;
            return Err(not_grown!(
                "point {index} of the profile is ({radius}, {height}) mm: both must be finite and the radius at least 0"
            ));
        }
        if index > 0 && profile[index - 1].distance(*p) <= ON_AXIS * widest {
            let before = index - 1;
            return Err(not_grown!(
                "points {before} and {index} of the profile coincide"
            ));
        }
    }
    let beyond = |end: DVec2, next: DVec2| {
        if end.x <= ON_AXIS * widest {
            DVec2::new(2.0 * end.x - next.x, next.y)
        } else {
            2.0 * end - next
        }
    };
    let n = profile.len();
    let mut points = vec![beyond(profile[0], profile[1])];
    points.extend(profile);
    points.push(beyond(profile[n - 1], profile[n - 2]));
    let mut curve = Vec::new();
    for (index, span) in points.windows(4).enumerate() {
        let first = u32::from(index > 0);
        for piece in first..=PIECES {
            let point = spline(span, f64::from(piece) / f64::from(PIECES));
            let end = (index == 0 && piece == 0) || (index + 2 == n && piece == PIECES);
            if point.at.x <= ON_AXIS * widest && !end {
                let (height, after) = (point.at.y, index + 1);
                return Err(not_grown!(
                    "the profile meets the axis at height {height} mm, between points {index} and {after}: only its ends may lie on the axis"
                ));
            }
            curve.push(point);
        }
    }
    // Twice the area between profile and axis, positive if the profile runs upwards.
    let area: f64 = curve
        .windows(2)
        .map(|w| (w[0].at.x + w[1].at.x) * (w[1].at.y - w[0].at.y))
        .sum();
    if area < 0.0 {
        curve.reverse();
        for point in &mut curve {
            point.tangent = -point.tangent;
        }
    }
    Ok(curve)
}

/// Point and tangent of the centripetal Catmull-Rom span between the middle two of four points, at
/// `u` in 0 to 1.
fn spline(p: &[DVec2], u: f64) -> CurvePoint {
    let knot = |a: DVec2, b: DVec2| a.distance(b).sqrt();
    let (before, span, after) = (knot(p[0], p[1]), knot(p[1], p[2]), knot(p[2], p[3]));
    // Tangents of the cubic in Hermite form, scaled to the span.
    let tangent = |a: DVec2, b: DVec2, c: DVec2, ab: f64, bc: f64| {
        span * ((b - a) / ab - (c - a) / (ab + bc) + (c - b) / bc)
    };
    let m1 = tangent(p[0], p[1], p[2], before, span);
    let m2 = tangent(p[1], p[2], p[3], span, after);
    let (u2, u3) = (u * u, u * u * u);
    let at = p[1] * (2.0 * u3 - 3.0 * u2 + 1.0)
        + m1 * (u3 - 2.0 * u2 + u)
        + p[2] * (3.0 * u2 - 2.0 * u3)
        + m2 * (u3 - u2);
    let along = (p[2] - p[1]) * (6.0 * (u - u2))
        + m1 * (3.0 * u2 - 4.0 * u + 1.0)
        + m2 * (3.0 * u2 - 2.0 * u);
    CurvePoint {
        at,
        tangent: along.normalize_or(p[2] - p[1]).normalize(),
    }
}

/// `count` + 1 points at equal distances along the curve.
fn resampled(curve: &[CurvePoint], length: f64, count: usize) -> Vec<CurvePoint> {
    let mut rings = Vec::with_capacity(count + 1);
    rings.push(curve[0]);
    let mut passed = 0.0;
    for pair in curve.windows(2) {
        let piece = pair[0].at.distance(pair[1].at);
        while rings.len() < count && passed + piece >= length * rings.len() as f64 / count as f64 {
            let share = (length * rings.len() as f64 / count as f64 - passed) / piece;
            rings.push(CurvePoint {
                at: pair[0].at.lerp(pair[1].at, share),
                tangent: pair[0].tangent.lerp(pair[1].tangent, share).normalize(),
            });
        }
        passed += piece;
    }
    rings.push(curve[curve.len() - 1]);
    rings
}
