//! The closed margin curve of a lamina.
//!
//! - **In**: a polygon in millimetres, and the two ends of the midrib.
//! - **Out**: tests of inside and outside, distance to the margin, area, perimeter.
//! - **Always true**: the polygon is counter-clockwise; no point is repeated; no edge crosses or
//!   touches another; the enclosed area is positive; both ends of the midrib lie on the blade.
//!
//! Away from the margin, queries are answered by the coarse cells of `shape::interior_grid`; near
//! it, by the horizontal slabs of `plane::slabs`. The cost depends on the few edges at the same
//! height, not on the whole margin.

use glam::DVec2;
use thiserror::Error;

use super::tips::Knob;
use crate::plane::{InteriorGrid, Slabs, bounds, first_crossing, polygon};

/// How far off the blade an end of the midrib may lie, as a share of the outline's extent: rounding
/// only.
const ON_BLADE: f64 = 1e-9;
/// Least midrib as a share of the blade's extent. Edges, grids and veins are scaled by the midrib, so
/// a blade of many times its size would take their squares.
const SHORTEST_MIDRIB: f64 = 0.01;

/// The margin of a lamina as a simple polygon, in millimetres.
///
/// Coordinates: the petiole is attached at [`Outline::base`], the midrib runs from there along +y
/// to [`Outline::apex`]. The polygon is counter-clockwise, without a repeated last point, without
/// self-crossings, and encloses a positive area.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    points: Vec<DVec2>,
    base: DVec2,
    apex: DVec2,
    slabs: Slabs,
    interior: InteriorGrid,
    knobs: Vec<Knob>,
}

/// Why a polygon is not a valid margin.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OutlineError {
    /// Fewer than three points (how many there are).
    #[error("an outline needs at least 3 different points, it has {0}")]
    TooFewPoints(usize),
    /// A coordinate is NaN or infinite (which point).
    #[error("point {0} of the outline is not finite")]
    NotFinite(usize),
    /// Two edges cross or touch.
    #[error("edges {first} and {second} of the outline cross")]
    SelfCrossing {
        /// Number of the first edge.
        first: usize,
        /// Number of the second edge.
        second: usize,
    },
    /// The polygon encloses no area.
    #[error("the outline encloses no area")]
    NoArea,
    /// An end of the midrib is not finite, or lies outside the blade.
    #[error("the {end} of the midrib, ({x}, {y}) mm, is not on the blade")]
    OffBlade {
        /// `base` or `apex`.
        end: &'static str,
        /// Its coordinate across the midrib, mm.
        x: f64,
        /// Its coordinate along the midrib, mm.
        y: f64,
    },
    /// Base and apex coincide.
    #[error("base and apex are the same point, so the midrib has no length")]
    NoMidrib,
    /// The blade is far wider than its midrib is long.
    #[error(
        "the midrib is {length:.3} mm long, which is less than a hundredth of the blade's extent of \
         {extent:.3} mm"
    )]
    ShortMidrib {
        /// From base to apex, mm.
        length: f64,
        /// Greater side of the blade's bounds, mm.
        extent: f64,
    },
}

impl Outline {
    /// Builds a margin from its corners in order, mm. Coinciding neighbours become one; the order
    /// is made counter-clockwise.
    ///
    /// # Errors
    ///
    /// [`OutlineError`], whose edge and point numbers count the corners as given (edge `i` starts
    /// at corner `i`, with coinciding neighbours left out).
    pub fn new(points: Vec<DVec2>, base: DVec2, apex: DVec2) -> Result<Self, OutlineError> {
        if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            return Err(OutlineError::NotFinite(index));
        }
        let mut points = points;
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() < 3 {
            return Err(OutlineError::TooFewPoints(points.len()));
        }
        let slabs = Slabs::new(&points);
        let (area, perimeter) = (polygon::signed_area(&points), polygon::perimeter(&points));
        // Below this share, the area of the polygon is rounding noise of its coordinates.
        if area.abs() <= 1e-12 * perimeter * perimeter {
            return Err(OutlineError::NoArea);
        }
        if let Some((first, second)) = first_crossing(&points, &slabs) {
            return Err(OutlineError::SelfCrossing { first, second });
        }
        let slabs = if area < 0.0 {
            points.reverse();
            Slabs::new(&points)
        } else {
            slabs
        };
        let outline = Self {
            interior: InteriorGrid::new(&points, &slabs),
            points,
            base,
            apex,
            slabs,
            knobs: Vec::new(),
        };
        for (end, p) in [("base", base), ("apex", apex)] {
            if !(p.is_finite() && outline.covers(p)) {
                return Err(OutlineError::OffBlade {
                    end,
                    x: p.x,
                    y: p.y,
                });
            }
        }
        if outline.length() <= ON_BLADE * perimeter {
            return Err(OutlineError::NoMidrib);
        }
        let (low, high) = outline.bounds();
        let (length, extent) = (outline.length(), (high - low).max_element());
        if length < SHORTEST_MIDRIB * extent {
            return Err(OutlineError::ShortMidrib { length, extent });
        }
        Ok(outline)
    }

    /// The corners of the margin, counter-clockwise, mm.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// The glands on its teeth and lobes.
    pub(crate) fn knobs(&self) -> &[Knob] {
        &self.knobs
    }

    /// The same margin, of which these are glands.
    pub(crate) fn with_knobs(self, knobs: Vec<Knob>) -> Self {
        Self { knobs, ..self }
    }

    /// Where the petiole is attached, mm.
    pub fn base(&self) -> DVec2 {
        self.base
    }

    /// Where the midrib ends at the margin, mm.
    pub fn apex(&self) -> DVec2 {
        self.apex
    }

    /// Length of the midrib, from base to apex, mm, > 0.
    pub fn length(&self) -> f64 {
        (self.apex - self.base).length()
    }

    /// Whether `p` lies inside the margin. For points on the margin the answer may be either, but
    /// is always the same for the same point.
    pub fn contains(&self, p: DVec2) -> bool {
        self.interior
            .contains(p)
            .unwrap_or_else(|| self.slabs.contains(&self.points, p))
    }

    /// Whether `p` is inside or, up to rounding, on the margin.
    pub fn covers(&self, p: DVec2) -> bool {
        let (low, high) = self.bounds();
        let slack = ON_BLADE * (high - low).max_element();
        self.contains(p) || self.distance_to_margin(p) <= slack
    }

    /// Whether the segment from `a` to `b` crosses the margin; touching it from one side is no
    /// crossing.
    pub fn is_crossed_by(&self, a: DVec2, b: DVec2) -> bool {
        !self.interior.is_clear(a, b) && self.slabs.is_crossed_by(&self.points, a, b)
    }

    /// Distance from `p`, inside or outside, to the nearest point of the margin, mm, ≥ 0.
    pub(crate) fn distance_to_margin(&self, p: DVec2) -> f64 {
        self.slabs.distance_squared(&self.points, p).sqrt()
    }

    /// Area inside the margin, mm², > 0.
    pub fn area(&self) -> f64 {
        polygon::signed_area(&self.points)
    }

    /// Length of the margin, mm, > 0.
    pub fn perimeter(&self) -> f64 {
        polygon::perimeter(&self.points)
    }

    /// Lower left and upper right corner of the smallest upright rectangle around the blade, mm.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        bounds(self.points.iter().copied())
    }

    /// The margin with `centre` moved to the origin, then enlarged by `factor` > 0. Nothing is
    /// checked again, since a similarity keeps every invariant.
    pub(crate) fn moved_and_scaled(&self, centre: DVec2, factor: f64) -> Self {
        let image = |p: DVec2| (p - centre) * factor;
        let points: Vec<DVec2> = self.points.iter().map(|&p| image(p)).collect();
        let slabs = Slabs::new(&points);
        Self {
            interior: InteriorGrid::new(&points, &slabs),
            slabs,
            points,
            base: image(self.base),
            apex: image(self.apex),
            knobs: self
                .knobs
                .iter()
                .map(|knob| knob.moved(image, factor))
                .collect(),
        }
    }
}

impl Outline {
    /// The same margin at another time, with corners and apex moved by growth, and without its
    /// glands. The caller guarantees that the growth keeps every invariant.
    pub(crate) fn with_points(&self, points: Vec<DVec2>, apex: DVec2) -> Self {
        let slabs = Slabs::new(&points);
        Self {
            interior: InteriorGrid::new(&points, &slabs),
            slabs,
            points,
            base: self.base,
            apex,
            knobs: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    fn square() -> Vec<DVec2> {
        [(-1.0, 0.0), (1.0, 0.0), (1.0, 2.0), (-1.0, 2.0)]
            .map(DVec2::from)
            .to_vec()
    }

    fn outline(points: Vec<DVec2>) -> Result<Outline, OutlineError> {
        Outline::new(points, DVec2::ZERO, DVec2::new(0.0, 2.0))
    }

    /// A star-shaped margin with `n` corners whose distances from the centre are hashed from
    /// `seed`.
    fn star(n: usize, seed: u64) -> Vec<DVec2> {
        (0..n)
            .map(|i| {
                let mixed = (seed + 1).wrapping_mul(i as u64 * 2 + 0x9e37_79b9_7f4a_7c15);
                let radius = 1.0 + 4.0 * ((mixed >> 40) as f64 / (1u64 << 24) as f64);
                let angle = std::f64::consts::TAU * i as f64 / n as f64;
                radius * DVec2::new(libm::cos(angle), libm::sin(angle))
            })
            .collect()
    }

    #[test]
    fn a_square_has_its_area_perimeter_and_bounds() {
        let outline = outline(square()).expect("a square is simple");
        assert_eq!(outline.area(), 4.0);
        assert_eq!(outline.perimeter(), 8.0);
        assert_eq!(outline.length(), 2.0);
        assert_eq!(
            outline.bounds(),
            (DVec2::new(-1.0, 0.0), DVec2::new(1.0, 2.0))
        );
        let larger = outline.moved_and_scaled(DVec2::ZERO, 3.0);
        assert_eq!(larger.area(), 36.0);
    }

    #[test]
    fn a_clockwise_polygon_is_turned_around() {
        let mut points = square();
        points.reverse();
        let outline = outline(points).expect("a square is simple");
        assert_eq!(outline.area(), 4.0);
        assert!(outline.contains(DVec2::new(0.0, 1.0)));
    }

    #[test]
    fn a_repeated_point_is_left_out() {
        let mut points = square();
        points.insert(2, points[1]);
        points.push(points[0]);
        assert_eq!(outline(points).expect("simple").points().len(), 4);
    }

    #[test]
    fn each_broken_polygon_is_refused_by_its_own_error() {
        let swap = |a: usize, b: usize| {
            let mut points = square();
            points.swap(a, b);
            points
        };
        assert_eq!(
            outline(swap(0, 1)),
            // The bow tie's two halves cancel, which is found before the crossing.
            Err(OutlineError::NoArea)
        );
        let mut bow = square();
        bow.insert(1, DVec2::new(0.3, 2.5));
        assert!(matches!(
            outline(bow),
            Err(OutlineError::SelfCrossing { .. })
        ));
        let mut spike = square();
        spike.splice(1..1, [DVec2::new(3.0, 0.0)]);
        assert!(matches!(
            outline(spike),
            Err(OutlineError::SelfCrossing { .. })
        ));
        let mut nan = square();
        nan[2].y = f64::NAN;
        assert_eq!(outline(nan), Err(OutlineError::NotFinite(2)));
        assert_eq!(
            outline(square()[..2].to_vec()),
            Err(OutlineError::TooFewPoints(2))
        );
        assert!(matches!(
            Outline::new(square(), DVec2::new(0.0, -1.0), DVec2::new(0.0, 2.0)),
            Err(OutlineError::OffBlade { end: "base", .. })
        ));
        assert!(matches!(
            Outline::new(square(), DVec2::ZERO, DVec2::new(0.0, f64::NAN)),
            Err(OutlineError::OffBlade { end: "apex", .. })
        ));
        assert_eq!(
            Outline::new(square(), DVec2::ZERO, DVec2::ZERO),
            Err(OutlineError::NoMidrib)
        );
        let wide = square().into_iter().map(|p| p * DVec2::new(100.1, 1.0));
        assert!(matches!(
            Outline::new(wide.collect(), DVec2::ZERO, DVec2::new(0.0, 2.0)),
            Err(OutlineError::ShortMidrib { .. })
        ));
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn slabs_answer_as_all_edges_do(
            n in 3_usize..200, seed in 0_u64..1000, x in -6.0..6.0, y in -6.0..6.0,
        ) {
            let points = star(n, seed);
            let ends = (points[0] * 0.5, points[0] * 0.25);
            let outline = Outline::new(points.clone(), ends.0, ends.1);
            // Very uneven stars of few corners may miss their centre; they are no margins.
            prop_assume!(outline.is_ok());
            let outline = outline.expect("just assumed");
            let p = DVec2::new(x, y);
            let edges = || (0..n).map(|i| (points[i], points[(i + 1) % n]));
            let inside = edges()
                .filter(|(a, b)| (a.y > y) != (b.y > y) && a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) > x)
                .count() % 2 == 1;
            prop_assert_eq!(outline.contains(p), inside);
            let nearest = edges()
                .map(|(a, b)| {
                    let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                    (a + (b - a) * along - p).length()
                })
                .fold(f64::INFINITY, f64::min);
            prop_assert!((outline.distance_to_margin(p) - nearest).abs() <= 1e-12);
            let crossed = edges().any(|(a, b)| proper(p, ends.0, a, b));
            prop_assert_eq!(outline.is_crossed_by(p, ends.0), crossed);
        }

        #[test]
        fn a_crossing_is_found_wherever_it_is(
            n in 8_usize..300, seed in 0_u64..1000, at in 0.0..1.0_f64,
        ) {
            let mut points = star(n, seed);
            let i = (at * n as f64) as usize % n;
            // Exchanging corners two apart makes edges between them cross.
            points.swap(i, (i + 2) % n);
            let brute = (0..n).any(|a| (a + 2..n).any(|b| {
                !(a == 0 && b == n - 1)
                    && proper(points[a], points[a + 1], points[b], points[(b + 1) % n])
            }));
            let found = matches!(
                Outline::new(points, DVec2::ZERO, DVec2::ZERO),
                Err(OutlineError::SelfCrossing { .. })
            );
            prop_assert!(found || !brute);
        }
    }

    /// Whether two segments cross in their interiors.
    fn proper(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
        let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
        side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
    }
}
