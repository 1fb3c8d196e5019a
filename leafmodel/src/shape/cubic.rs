//! Smooth curves: Bézier cubics, Catmull–Rom curves, and polylines within a tolerance of either.

use glam::DVec2;

/// How far a polyline may lie from the curve it approximates, as a share of the outline's extent.
pub(crate) const FLATNESS: f64 = 1e-4;

/// A cubic Bézier curve by its control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cubic(pub(crate) [DVec2; 4]);

impl Cubic {
    /// The straight line from `a` to `b`.
    pub(crate) fn line(a: DVec2, b: DVec2) -> Self {
        Self([a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b])
    }

    /// The piece of the Catmull–Rom curve from `p[1]` to `p[2]`.
    pub(crate) fn catmull_rom(p: [DVec2; 4]) -> Self {
        let [leaving, arriving] = slopes(p);
        Self([p[1], p[1] + leaving / 3.0, p[2] - arriving / 3.0, p[2]])
    }

    /// The point at `u` in [0, 1].
    pub(crate) fn at(&self, u: f64) -> DVec2 {
        let [a, b, c, d] = self.0;
        let v = 1.0 - u;
        a * (v * v * v) + b * (3.0 * v * v * u) + c * (3.0 * v * u * u) + d * (u * u * u)
    }

    /// Appends points of the curve, its start left out and its end included, so that straight lines
    /// between them stay within `tolerance` > 0 of the curve.
    ///
    /// The chord over a parameter step `h` is at most `h² max|B''| / 8` from the curve, and `|B''|`
    /// is greatest at an end.
    pub(crate) fn flatten(&self, tolerance: f64, points: &mut Vec<DVec2>) {
        let [a, b, c, d] = self.0;
        let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
        // Rounding leaves a little bend in a line. NaN and infinity give one piece here and are
        // refused later.
        let pieces = (0.75 * bend / tolerance).sqrt().ceil().clamp(1.0, 1e4) as u32;
        let inner = (1..pieces).map(|i| self.at(f64::from(i) / f64::from(pieces)));
        points.extend(inner.chain([d]));
    }
}

/// The Catmull–Rom curve from `p[1]` to `p[2]` at `u` in [0, 1], with chord-length knots. Old edges
/// are much longer than freshly subdivided ones beside them, and evenly spaced knots would bend the
/// curve there.
pub(crate) fn catmull_rom(p: [DVec2; 4], u: f64) -> DVec2 {
    let chord = p[2] - p[1];
    let [leaving, arriving] = slopes(p);
    // Cubic Hermite polynomial through both ends with these slopes.
    let c = 3.0 * chord - 2.0 * leaving - arriving;
    let d = leaving + arriving - 2.0 * chord;
    p[1] + (leaving + (c + d * u) * u) * u
}

/// Slopes of the Catmull–Rom curve at `p[1]` and `p[2]`, per piece.
fn slopes(p: [DVec2; 4]) -> [DVec2; 2] {
    let chords = [p[1] - p[0], p[2] - p[1], p[3] - p[2]];
    let [before, span, after] = chords.map(DVec2::length);
    // Slope, at a knot, of the parabola through the knot and its two neighbours.
    let slope = |first: DVec2, d0: f64, second: DVec2, d1: f64| {
        (first * (d1 / d0) + second * (d0 / d1)) / (d0 + d1)
    };
    [
        slope(chords[0], before, chords[1], span) * span,
        slope(chords[1], span, chords[2], after) * span,
    ]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    /// Distance from `p` to the polyline.
    fn distance(p: DVec2, line: &[DVec2]) -> f64 {
        line.windows(2)
            .map(|edge| {
                let along = edge[1] - edge[0];
                let length = along.length_squared();
                let u = if length > 0.0 {
                    ((p - edge[0]).dot(along) / length).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                (edge[0] + along * u - p).length()
            })
            .fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn a_flattened_curve_stays_within_the_tolerance(
            p in prop::array::uniform8(-1.0..1.0_f64), tolerance in 1e-4..0.1_f64,
        ) {
            let cubic = Cubic([0, 2, 4, 6].map(|i| DVec2::new(p[i], p[i + 1])));
            let mut line = vec![cubic.0[0]];
            cubic.flatten(tolerance, &mut line);
            for i in 0..=1000 {
                let away = distance(cubic.at(f64::from(i) / 1000.0), &line);
                prop_assert!(away <= tolerance + 1e-12, "{away}");
            }
        }

        #[test]
        fn both_forms_of_catmull_rom_are_one_curve(p in prop::array::uniform8(-1.0..1.0_f64), u in 0.0..1.0_f64) {
            let points = [0, 2, 4, 6].map(|i| DVec2::new(p[i], p[i + 1]));
            prop_assume!(points.windows(2).all(|pair| pair[0].distance(pair[1]) > 0.05));
            let away = catmull_rom(points, u) - Cubic::catmull_rom(points).at(u);
            // Slopes are at most some 40 times the extent under the assumption above.
            prop_assert!(away.length() <= 1e-12, "{away}");
        }
    }

    #[test]
    fn a_line_is_one_piece() {
        let mut points = Vec::new();
        Cubic::line(DVec2::ZERO, DVec2::new(3.0, 1.0)).flatten(1e-9, &mut points);
        assert_eq!(points, [DVec2::new(3.0, 1.0)]);
    }
}
