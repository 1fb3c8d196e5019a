//! Outlines drawn by hand: a smooth closed curve through control points, any of which may be a
//! corner.
//!
//! - **In**: control points in shares of the midrib's length, the base at (0, 0), the apex at (0,
//!   1), for the right side alone or for the whole margin.
//! - **Out**: an [`Outline`] that passes through every control point.
//! - **Always true**: a contour given for one side is exactly mirror symmetric.
//!
//! Between points the curve is a Catmull–Rom cubic with chord-length knots, as for stretched veins.
//! At a corner the curve has no common tangent: each piece is computed as if the curve ended there.

use glam::DVec2;
use thiserror::Error;

use super::cubic::{Cubic, FLATNESS};
use super::outline::{Outline, OutlineError};
use crate::document::context::{Context, QUOTED};
use crate::document::nearest::nearest;
use crate::document::schema::Type;
use crate::document::source::escaped;
use crate::document::values::{list, number, number_at, text_at, wrong_length, wrong_type};
use crate::document::{Declared, DocumentError, Kind, Limits, ListOf, Node, RangeError, Value};

/// A point that the contour passes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Across the midrib (to the right) and along it from the base, in shares of its length, −10 to
    /// 10.
    pub place: [f64; 2],
    /// Whether the contour has a corner here instead of a tangent.
    pub corner: bool,
}

/// The points of a contour.
const POINTS: ListOf<Point> = ListOf {
    of: Point,
    least: 3,
    most: 1000,
    wanted: "a list of 3 to 1000 points, [x, y] or [x, y, \"corner\"]",
};

/// `[x, y]` or `[x, y, "corner"]`.
#[derive(Clone, Copy, Debug)]
struct Point;

impl Point {
    const LIMITS: Limits = Limits::closed(-10.0, 10.0);
    const ONE: &str = "a point, [x, y] or [x, y, \"corner\"]";
}

impl Kind for Point {
    type Of = ControlPoint;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<ControlPoint> {
        let Value::List(parts) = &node.value else {
            wrong_type(cx, node, key, Self::ONE);
            return None;
        };
        let (x, y, corner) = match parts.as_slice() {
            [x, y] => (x, y, Some(false)),
            [x, y, word] => (x, y, read_corner(cx, word, key)),
            _ => {
                wrong_length(cx, &node.at, key, "a list", parts.len(), Self::ONE);
                return None;
            }
        };
        let [x, y] = [x, y].map(|node| number_at(cx, node, key, Self::LIMITS));
        Some(ControlPoint {
            place: [x?, y?],
            corner: corner?,
        })
    }

    fn write(&self, point: &ControlPoint) -> Value {
        let corner = point.corner.then(|| Value::Text("corner".to_owned()));
        list(point.place.map(number).into_iter().chain(corner))
    }

    fn describe(&self) -> Type {
        let place = || vec![Type::Number(Self::LIMITS); 2];
        let mut corner = place();
        corner.push(Type::Word(vec!["corner".to_owned()]));
        Type::AnyOf(vec![Type::Tuple(place()), Type::Tuple(corner)], Self::ONE)
    }
}

/// The word `"corner"`.
fn read_corner(cx: &Context, node: &Node, key: &str) -> Option<bool> {
    let (word, at) = text_at(cx, node, key)?;
    if word == "corner" {
        return Some(true);
    }
    let error = DocumentError::UnknownWord {
        key: key.to_owned(),
        word: escaped(word, QUOTED),
        nearest: nearest(word, ["corner"]).map(str::to_owned),
        known: "`corner`".to_owned(),
    };
    cx.error(at, error);
    None
}

/// A contour through control points.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct ContourCurve {
    /// The points are the right side, from the base `[0, 0]` to the apex `[0, 1]`, and the left
    /// side
    /// is its mirror image. If false, they go all round.
    #[key("mirrored")]
    pub mirrored: bool,
    /// `[[x, y], [x, y, "corner"], …]`: in order; the word makes a corner where else the curve is
    /// smooth.
    #[key("points", required, POINTS)]
    pub points: Vec<ControlPoint>,
}

/// Why control points give no outline.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ContourCurveError {
    /// Too few points or too many, or one that lies far outside the leaf.
    #[error("control points: {0}")]
    Range(#[from] RangeError),
    /// A point coincides with the point before it. The point before the first is the last (which
    /// point, from 0).
    #[error("control point {0} lies where the one before it does")]
    Coincident(usize),
    /// A mirrored contour does not go from base to apex.
    #[error("the {order} control point of a mirrored contour is ({x}, {y}), it must be the {end}")]
    BadEnd {
        /// `first` or `last`.
        order: &'static str,
        /// What must be there.
        end: &'static str,
        /// Across the midrib.
        x: f64,
        /// Along the midrib.
        y: f64,
    },
    /// The curve is not a valid margin.
    #[error("the curve through the control points is no margin: {0}")]
    NoMargin(#[from] OutlineError),
}

impl ContourCurve {
    /// The outline of a leaf whose midrib measures `length_mm`; the base is at the origin, the apex
    /// at (0, `length_mm`). Straight edges stay within 10⁻⁴ of the length of the curve.
    ///
    /// # Errors
    ///
    /// [`ContourCurveError`], naming the point. `length_mm` must be finite and above 0.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, ContourCurveError> {
        self.validate()?;
        let places: Vec<DVec2> = self.points.iter().map(|p| DVec2::from(p.place)).collect();
        let mut margin = vec![places[0]];
        if self.mirrored {
            let last = places.len() - 1;
            for i in 0..last {
                // Beyond base and apex a mirrored curve continues as its own mirror image.
                let reflected = |i: usize| DVec2::new(-places[i].x, places[i].y);
                let before = if i == 0 { reflected(1) } else { places[i - 1] };
                let after = if i + 1 == last {
                    reflected(last - 1)
                } else {
                    places[i + 2]
                };
                self.piece([before, places[i], places[i + 1], after], i, i + 1)
                    .flatten(FLATNESS, &mut margin);
            }
            let right = margin.len() - 1;
            for i in (1..right).rev() {
                margin.push(DVec2::new(-margin[i].x, margin[i].y));
            }
        } else {
            let n = places.len();
            for i in 0..n {
                let [before, to, after] = [i + n - 1, i + 1, i + 2].map(|k| k % n);
                let around = [before, i, to, after].map(|k| places[k]);
                self.piece(around, i, to).flatten(FLATNESS, &mut margin);
            }
        }
        let margin = margin.into_iter().map(|p| p * length_mm).collect();
        Ok(Outline::new(
            margin,
            DVec2::ZERO,
            DVec2::new(0.0, length_mm),
        )?)
    }

    /// The curve between the points number `from` and `to`. `around` holds their places, between
    /// those of the points before and after them.
    fn piece(&self, around: [DVec2; 4], from: usize, to: usize) -> Cubic {
        let [mut before, start, end, mut after] = around;
        // At a corner the curve is continued straight, as at an end.
        if self.points[from].corner {
            before = 2.0 * start - end;
        }
        if self.points[to].corner {
            after = 2.0 * end - start;
        }
        Cubic::catmull_rom([before, start, end, after])
    }

    fn validate(&self) -> Result<(), ContourCurveError> {
        self.in_range()?;
        let points = self.points.len();
        for (index, point) in self.points.iter().enumerate() {
            let before = self.points[(index + points - 1) % points].place;
            if point.place == before {
                return Err(ContourCurveError::Coincident(index));
            }
        }
        if self.mirrored {
            let ends = [
                (0, "first", "base, (0, 0)", [0.0, 0.0]),
                (points - 1, "last", "apex, (0, 1)", [0.0, 1.0]),
            ];
            for (index, order, end, place) in ends {
                let [x, y] = self.points[index].place;
                if [x, y] != place {
                    return Err(ContourCurveError::BadEnd { order, end, x, y });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(places: &[(f64, f64, bool)]) -> Vec<ControlPoint> {
        places
            .iter()
            .map(|&(x, y, corner)| ControlPoint {
                place: [x, y],
                corner,
            })
            .collect()
    }

    fn lanceolate() -> ContourCurve {
        let list = [
            (0.0, 0.0, false),
            (0.2, 0.3, false),
            (0.1, 0.8, false),
            (0.0, 1.0, true),
        ];
        ContourCurve {
            points: points(&list),
            mirrored: true,
        }
    }

    #[test]
    fn a_mirrored_contour_is_exactly_symmetric_and_passes_through_its_points() {
        let outline = lanceolate().grow(50.0).expect("a good contour");
        let margin = outline.points();
        for p in margin {
            assert!(
                margin.contains(&DVec2::new(-p.x, p.y)),
                "{p} has no mirror image"
            );
        }
        for point in lanceolate().points {
            assert!(margin.contains(&(DVec2::from(point.place) * 50.0)));
        }
        assert_eq!(
            (outline.base(), outline.apex()),
            (DVec2::ZERO, DVec2::new(0.0, 50.0))
        );
    }

    #[test]
    fn corners_all_round_give_a_polygon() {
        let list = [
            (-0.3, -0.2, true),
            (0.3, 0.0, true),
            (0.25, 1.1, true),
            (-0.3, 1.2, true),
        ];
        let curve = ContourCurve {
            points: points(&list),
            mirrored: false,
        };
        let outline = curve.grow(10.0).expect("a square of sorts");
        // Pieces between corners are straight, so no point but the corners is needed.
        assert_eq!(outline.points().len(), 4);
        let shoelace: f64 = (0..4)
            .map(|i| {
                let (a, b) = (list[i], list[(i + 1) % 4]);
                50.0 * (a.0 * b.1 - b.0 * a.1)
            })
            .sum();
        assert!((outline.area() - shoelace).abs() < 1e-12);
    }

    #[test]
    fn points_on_a_circle_give_nearly_a_circle() {
        // Radius 1/2 about the middle of the midrib.
        let n = 24;
        let place = |i: i32| {
            let angle =
                std::f64::consts::TAU * f64::from(i) / f64::from(n) - std::f64::consts::FRAC_PI_2;
            (0.5 * libm::cos(angle), 0.5 + 0.5 * libm::sin(angle), false)
        };
        let list: Vec<_> = (0..n).map(place).collect();
        let curve = ContourCurve {
            points: points(&list),
            mirrored: false,
        };
        let outline = curve.grow(1.0).expect("a circle");
        // Between two points an angle θ apart the cubic lies inside the circle. It lies deepest
        // midway, where its radius is r (cos(θ/2) + sin θ sin(θ/2) / 4).
        let angle = std::f64::consts::TAU / f64::from(n);
        let least =
            0.5 * (libm::cos(angle / 2.0) + libm::sin(angle) * libm::sin(angle / 2.0) / 4.0);
        for p in outline.points() {
            let radius = (*p - DVec2::new(0.0, 0.5)).length();
            assert!((least - 1e-12..=0.5 + 1e-12).contains(&radius), "{radius}");
        }
        let area = std::f64::consts::PI / 4.0;
        assert!((outline.area() / area - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_smooth_base_is_level_and_a_corner_is_not() {
        // Steepness of the first edge.
        let slope = |corner| {
            let mut curve = lanceolate();
            curve.points[0].corner = corner;
            let p = curve.grow(1.0).expect("a good contour").points()[1];
            p.y / p.x
        };
        assert!(slope(false) < 0.1, "{}", slope(false));
        assert!(slope(true) > 1.0, "{}", slope(true));
    }

    #[test]
    fn each_bad_contour_is_refused_by_its_own_error() {
        let spoiled = |spoil: fn(&mut ContourCurve)| {
            let mut curve = lanceolate();
            spoil(&mut curve);
            curve.grow(50.0).expect_err("a bad contour")
        };
        assert!(matches!(
            spoiled(|c| c.points.truncate(2)),
            ContourCurveError::Range(error) if error.value == "a list of 2"
        ));
        assert!(matches!(
            spoiled(|c| c.points[1].place[0] = f64::NAN),
            ContourCurveError::Range(error) if error.path == "points[1]"
        ));
        assert_eq!(
            spoiled(|c| c.points[2] = c.points[1]),
            ContourCurveError::Coincident(2)
        );
        assert!(matches!(
            spoiled(|c| c.points[0].place[1] = 0.1),
            ContourCurveError::BadEnd { order: "first", .. }
        ));
        assert!(matches!(
            spoiled(|c| c.points.swap(1, 2)),
            ContourCurveError::NoMargin(OutlineError::SelfCrossing { .. })
        ));
    }
}
