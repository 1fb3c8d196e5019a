//! Elliptic Fourier descriptors: a margin as a sum of ellipses, independent of size, place,
//! direction and starting point.
//!
//! # Source
//!
//! \[kuhl1982\]: coefficients of a polygon, and their normalisation by the first ellipse.

use std::f64::consts::{PI, TAU};

use glam::{DMat2, DVec2};

use crate::plane::polygon;
use crate::shape::outline::Outline;

/// Number of ellipses in the sum.
pub(super) const HARMONICS: usize = 20;

/// A first ellipse whose squared axes differ by less than this share is a circle, which has no
/// direction of its own.
const ROUND: f64 = 1e-9;

/// `a, b, c, d` of each harmonic in turn, 80 numbers: the margin is
/// `x = Σ a cos nt + b sin nt`, `y = Σ c cos nt + d sin nt` about its mean.
///
/// The unit is the first ellipse's larger half axis, which lies along x, so that the first harmonic
/// is `1, 0, 0, d`. Of the two ends of that axis, the one nearer to the apex is at +x; if the axis
/// lies rather across the midrib, the right one is. If the first ellipse is a circle, +x is the
/// direction of the midrib.
pub(super) fn descriptors(outline: &Outline) -> Vec<f64> {
    let ellipses = coefficients(outline.points());
    let midrib = (outline.apex() - outline.base()) / outline.length();
    // Columns: the coefficients of cos and sin of the first harmonic.
    let (cosine, sine) = (ellipses[0].x_axis, ellipses[0].y_axis);
    let (mixed, apart) = (
        2.0 * cosine.dot(sine),
        cosine.length_squared() - sine.length_squared(),
    );
    let size = cosine.length_squared() + sine.length_squared();
    let mut phase = if libm::hypot(mixed, apart) <= ROUND * size {
        libm::atan2(sine.dot(midrib), cosine.dot(midrib))
    } else {
        0.5 * libm::atan2(mixed, apart)
    };
    let end = |phase: f64| cosine * libm::cos(phase) + sine * libm::sin(phase);
    let (forward, leftward) = (midrib.dot(end(phase)), midrib.perp_dot(end(phase)));
    let wrong_end = if forward.abs() >= leftward.abs() {
        forward < 0.0
    } else {
        leftward > 0.0
    };
    if wrong_end {
        phase += PI;
    }
    let axis = end(phase);
    let length = axis.length();
    // Turns the axis to +x.
    let turn = DMat2::from_cols(DVec2::new(axis.x, -axis.y), DVec2::new(axis.y, axis.x)) / length;
    let normal = |(n, ellipse): (usize, &DMat2)| {
        let angle = (n + 1) as f64 * phase;
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        let start = DMat2::from_cols(DVec2::new(c, s), DVec2::new(-s, c));
        let [a, c, b, d] = (turn * *ellipse * start / length).to_cols_array();
        [a, b, c, d]
    };
    ellipses.iter().enumerate().flat_map(normal).collect()
}

/// The ellipses of a closed polygon walked at constant speed: columns for cosine and sine.
fn coefficients(points: &[DVec2]) -> Vec<DMat2> {
    let steps: Vec<DVec2> = polygon::sides(points).map(|(a, b)| b - a).collect();
    let perimeter: f64 = steps.iter().map(|step| step.length()).sum();
    let ellipse = |n: usize| {
        let n = n as f64;
        let (mut cosine, mut sine) = (DVec2::ZERO, DVec2::ZERO);
        let (mut walked, mut before) = (0.0, (1.0, 0.0));
        for step in &steps {
            let length = step.length();
            walked += length;
            let angle = n * TAU * (walked / perimeter);
            let here = (libm::cos(angle), libm::sin(angle));
            let direction = *step / length;
            cosine += direction * (here.0 - before.0);
            sine += direction * (here.1 - before.1);
            before = here;
        }
        DMat2::from_cols(cosine, sine) * (perimeter / (2.0 * n * n * PI * PI))
    };
    (1..=HARMONICS).map(ellipse).collect()
}
