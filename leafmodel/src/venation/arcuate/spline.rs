//! Quadratic splines and the distance to them.

use glam::DVec2;

/// A quadratic Bézier curve by start, control and end point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quadratic(pub(super) [DVec2; 3]);

/// The point of a curve nearest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nearest {
    /// Its distance.
    pub(super) distance: f64,
    /// Its parameter, 0 to 1.
    pub(super) t: f64,
}

impl Quadratic {
    /// The straight line between two points.
    pub(super) fn line(a: DVec2, b: DVec2) -> Self {
        Self([a, (a + b) * 0.5, b])
    }

    pub(super) fn at(&self, t: f64) -> DVec2 {
        let [a, b, c] = self.0;
        let u = 1.0 - t;
        a * (u * u) + b * (2.0 * u * t) + c * (t * t)
    }

    /// The foot of the shortest perpendicular from `p`; `None` if no perpendicular meets the curve
    /// between its ends, since ends have no caps.
    pub(super) fn nearest(&self, p: DVec2) -> Option<Nearest> {
        let [p0, p1, p2] = self.0;
        let (a, b, m) = (p1 - p0, p2 - 2.0 * p1 + p0, p0 - p);
        // A quarter of the derivative of the squared distance: a cubic in t.
        let cubic = [
            m.dot(a),
            2.0 * a.dot(a) + m.dot(b),
            3.0 * a.dot(b),
            b.dot(b),
        ];
        let mut best: Option<Nearest> = None;
        for t in roots(cubic).into_iter().flatten() {
            if (0.0..=1.0).contains(&t) {
                let distance = (self.at(t) - p).length();
                if best.is_none_or(|best| distance < best.distance) {
                    best = Some(Nearest { distance, t });
                }
            }
        }
        best
    }
}

/// Real roots of `c0 + c1 t + c2 t² + c3 t³`, each polished by Newton's method. A cubic term too
/// small to matter for `t` in [0, 1] enters only through the polishing.
fn roots([c0, c1, c2, c3]: [f64; 4]) -> [Option<f64>; 3] {
    let polished = |mut t: f64| {
        for _ in 0..3 {
            let slope = c1 + (2.0 * c2 + 3.0 * c3 * t) * t;
            let step = (c0 + (c1 + (c2 + c3 * t) * t) * t) / slope;
            if !step.is_finite() {
                break;
            }
            t -= step;
        }
        t
    };
    let largest = c0.abs().max(c1.abs()).max(c2.abs());
    let raw = if c3.abs() > 1e-9 * largest {
        depressed(c0 / c3, c1 / c3, c2 / c3)
    } else if c2.abs() > 1e-9 * c0.abs().max(c1.abs()) {
        let root = (c1 * c1 - 4.0 * c0 * c2).sqrt();
        // The root without cancellation comes first; the other follows from it.
        let q = -0.5 * (c1 + root.copysign(c1));
        [Some(q / c2), Some(c0 / q), None]
    } else {
        [Some(-c0 / c1), None, None]
    };
    raw.map(|t| t.filter(|t| t.is_finite()).map(polished))
}

/// Real roots of `t³ + a t² + b t + c`: by the trigonometric formula if there are three, by
/// Cardano's if there is one.
fn depressed(c: f64, b: f64, a: f64) -> [Option<f64>; 3] {
    let shift = a / 3.0;
    let p = b - a * shift;
    let q = 2.0 * shift * shift * shift - b * shift + c;
    let discriminant = q * q / 4.0 + p * p * p / 27.0;
    if discriminant > 0.0 {
        let root = discriminant.sqrt();
        // The larger summand first: the other follows from their product, −p/3, without
        // cancellation.
        let u = libm::cbrt(-0.5 * q - root.copysign(q));
        let v = if u == 0.0 { 0.0 } else { -p / (3.0 * u) };
        return [Some(u + v - shift), None, None];
    }
    let radius = (-p / 3.0).max(0.0).sqrt();
    let cosine = if radius > 0.0 {
        (-0.5 * q / (radius * radius * radius)).clamp(-1.0, 1.0)
    } else {
        0.0
    };
    let third = libm::acos(cosine) / 3.0;
    [0.0, 1.0, 2.0].map(|k| {
        let angle = third - k * std::f64::consts::TAU / 3.0;
        Some(2.0 * radius * libm::cos(angle) - shift)
    })
}
