//! A margin of two cubic splines, given by two angles and two lengths.
//!
//! - **In**: a [`CubicMargin`].
//! - **Out**: an [`Outline`], base at the origin, midrib along +y, mirror symmetric.
//!
//! # Source
//!
//! \[oslveins\], `Angle1`, `L1`, `Angle2`, `L2`.

use glam::DVec2;

use super::cubic::{Cubic, FLATNESS};
use super::outline::Outline;
use crate::document::{Declared, RangeError};
use crate::not_grown::{NotGrown, not_grown};

/// One side as a cubic Bézier spline from base to tip; the other is its mirror image. Lengths are
/// in units of the leaf's length; the letters are the article's.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct CubicMargin {
    /// Angle at the base between midrib and margin.
    ///
    /// `Angle1`: direction of the handle at the base from the midrib, both excluded.
    #[key("angle1_deg", open(0.0, 180.0))]
    pub angle1_deg: f64,
    /// Length of the handle at the base, in midribs.
    #[key("length1", 0.01..=10.0)]
    pub length1: f64,
    /// Angle at the apex.
    ///
    /// `Angle2`: direction of the handle at the tip from the midrib, both excluded.
    #[key("angle2_deg", open(0.0, 180.0))]
    pub angle2_deg: f64,
    /// Length of the handle at the apex, in midribs.
    #[key("length2", 0.01..=10.0)]
    pub length2: f64,
}

impl Default for CubicMargin {
    /// The article's defaults.
    fn default() -> Self {
        Self {
            angle1_deg: 70.0,
            length1: 1.0,
            angle2_deg: 70.0,
            length2: 1.0,
        }
    }
}

impl CubicMargin {
    /// The margin of a leaf whose midrib goes from the origin to (0, `length_mm`), 0.001 to 100
    /// 000.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming the number that is out of range, or why the splines are not a
    /// valid margin.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, NotGrown> {
        self.in_range()?;
        let limits = "0.001 to 100000";
        RangeError::unless(
            (1e-3..=1e5).contains(&length_mm),
            "length_mm",
            length_mm,
            limits,
        )?;
        let left = self.flat();
        // From (x along, y across to the left) to (right, up).
        let place = |p: DVec2, side: f64| DVec2::new(-p.y * side, p.x) * length_mm;
        let right = left.iter().map(|&p| place(p, -1.0));
        let back = left[1..left.len() - 1].iter().rev().map(|&p| place(p, 1.0));
        let points = right.chain(back).collect();
        let outline = Outline::new(points, DVec2::ZERO, DVec2::new(0.0, length_mm));
        outline.map_err(|error| {
            not_grown!("the splines of these angles and lengths are no margin: {error}")
        })
    }

    /// The left side in leaf units: x along the midrib from 0 to 1, y away from it.
    pub(crate) fn spline(&self) -> Cubic {
        let handle = |degrees: f64| {
            let angle = degrees.to_radians();
            DVec2::new(libm::cos(angle), libm::sin(angle))
        };
        let (first, second) = (handle(self.angle1_deg), handle(self.angle2_deg));
        Cubic([
            DVec2::ZERO,
            first * self.length1,
            DVec2::new(1.0 - second.x * self.length2, second.y * self.length2),
            DVec2::X,
        ])
    }

    /// That side as a polyline, at even steps of the spline's parameter.
    pub(crate) fn flat(&self) -> Vec<DVec2> {
        let mut points = vec![DVec2::ZERO];
        self.spline().flatten(FLATNESS, &mut points);
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_place_is_that_of_the_bezier_polynomial() {
        // Both handles alike: greatest y at t = ½, where it is ¾ of the handles' height.
        let margin = CubicMargin {
            angle1_deg: 60.0,
            length1: 0.4,
            angle2_deg: 60.0,
            length2: 0.4,
        };
        let outline = margin.grow(100.0).expect("a good margin");
        let (low, high) = outline.bounds();
        let expected = 2.0 * 0.75 * 0.4 * libm::sin(60.0_f64.to_radians()) * 100.0;
        assert!((high.x - low.x - expected).abs() < 0.03, "{}", high.x);
        assert_eq!((low.x, low.y, high.y), (-high.x, 0.0, 100.0));
    }

    #[test]
    fn what_is_out_of_range_or_no_margin_is_refused() {
        let refusal = |margin: CubicMargin| margin.grow(50.0).expect_err("refused").to_string();
        let flat = CubicMargin {
            angle1_deg: 0.0,
            ..CubicMargin::default()
        };
        let expected = "angle1_deg is 0, outside the values between 0 and 180";
        assert_eq!(refusal(flat), expected);
        let long = CubicMargin {
            length2: f64::NAN,
            ..CubicMargin::default()
        };
        assert_eq!(refusal(long), "length2 is NaN, outside 0.01 to 10");
        let crossed = CubicMargin {
            angle1_deg: 5.0,
            length1: 3.0,
            angle2_deg: 5.0,
            length2: 3.0,
        };
        let message = refusal(crossed);
        assert!(message.starts_with("the splines of these"), "{message}");
    }
}
