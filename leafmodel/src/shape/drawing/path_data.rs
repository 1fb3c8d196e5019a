//! Path data of SVG as cubics: every command, lines and arcs included.

use glam::DVec2;
use svgtypes::{PathParser, PathSegment};

use crate::shape::cubic::Cubic;

/// The drawn parts of a path, each a chain of cubics; open parts are left open.
///
/// # Errors
///
/// The parser's message, if the data are malformed.
pub(super) fn parts(data: &str) -> Result<Vec<Vec<Cubic>>, String> {
    let mut pen = Pen::default();
    for segment in PathParser::from(data) {
        pen.follow(segment.map_err(|error| error.to_string())?);
    }
    pen.parts.retain(|part| !part.is_empty());
    Ok(pen.parts)
}

/// The control point that a smooth curve command mirrors.
#[derive(Clone, Copy, Default)]
enum Handle {
    #[default]
    None,
    Cubic(DVec2),
    Quadratic(DVec2),
}

#[derive(Default)]
struct Pen {
    at: DVec2,
    start: DVec2,
    handle: Handle,
    parts: Vec<Vec<Cubic>>,
    /// Whether the part was closed, so that what follows begins another.
    closed: bool,
}

impl Pen {
    fn follow(&mut self, segment: PathSegment) {
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                self.at = self.place(abs, x, y);
                self.start = self.at;
                self.begin();
            }
            PathSegment::LineTo { abs, x, y } => self.line(self.place(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                let x = if abs { x } else { self.at.x + x };
                self.line(DVec2::new(x, self.at.y));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                let y = if abs { y } else { self.at.y + y };
                self.line(DVec2::new(self.at.x, y));
            }
            PathSegment::CurveTo {
                abs,
                x1,
                y1,
                x2,
                y2,
                x,
                y,
            } => {
                let first = self.place(abs, x1, y1);
                self.cubic(first, self.place(abs, x2, y2), self.place(abs, x, y));
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let first = match self.handle {
                    Handle::Cubic(before) => 2.0 * self.at - before,
                    Handle::None | Handle::Quadratic(_) => self.at,
                };
                self.cubic(first, self.place(abs, x2, y2), self.place(abs, x, y));
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                self.quadratic(self.place(abs, x1, y1), self.place(abs, x, y));
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                let control = match self.handle {
                    Handle::Quadratic(before) => 2.0 * self.at - before,
                    Handle::None | Handle::Cubic(_) => self.at,
                };
                self.quadratic(control, self.place(abs, x, y));
            }
            PathSegment::EllipticalArc {
                abs,
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
            } => {
                let arc = Arc {
                    radii: DVec2::new(rx.abs(), ry.abs()),
                    turn: x_axis_rotation.to_radians(),
                    large: large_arc,
                    sweep,
                };
                self.arc(&arc, self.place(abs, x, y));
            }
            PathSegment::ClosePath { .. } => {
                if self.at != self.start {
                    self.line(self.start);
                }
                self.closed = true;
                self.handle = Handle::None;
            }
        }
    }

    fn place(&self, abs: bool, x: f64, y: f64) -> DVec2 {
        let p = DVec2::new(x, y);
        if abs { p } else { self.at + p }
    }

    fn begin(&mut self) {
        self.parts.push(Vec::new());
        self.closed = false;
        self.handle = Handle::None;
    }

    fn draw(&mut self, piece: Cubic) {
        if self.closed || self.parts.is_empty() {
            self.begin();
        }
        self.at = piece.0[3];
        if let Some(part) = self.parts.last_mut() {
            part.push(piece);
        }
    }

    fn line(&mut self, to: DVec2) {
        self.draw(Cubic::line(self.at, to));
        self.handle = Handle::None;
    }

    fn cubic(&mut self, first: DVec2, second: DVec2, to: DVec2) {
        self.draw(Cubic([self.at, first, second, to]));
        self.handle = Handle::Cubic(second);
    }

    fn quadratic(&mut self, control: DVec2, to: DVec2) {
        let towards = |end: DVec2| end + (control - end) * (2.0 / 3.0);
        self.draw(Cubic([self.at, towards(self.at), towards(to), to]));
        self.handle = Handle::Quadratic(control);
    }

    fn arc(&mut self, arc: &Arc, to: DVec2) {
        let from = self.at;
        if arc.radii.min_element() == 0.0 {
            self.line(to);
        } else if from != to {
            for piece in arc.pieces(from, to) {
                self.draw(piece);
            }
            // The exact end point is kept, so that rounding leaves no gap before the next piece.
            self.at = to;
            if let Some(last) = self.parts.last_mut().and_then(|part| part.last_mut()) {
                last.0[3] = to;
            }
        }
        self.handle = Handle::None;
    }
}

/// The parameters of an elliptical arc, its ends left out.
struct Arc {
    radii: DVec2,
    /// Angle from the x-axis to the first radius, radians.
    turn: f64,
    large: bool,
    sweep: bool,
}

impl Arc {
    /// The arc as cubics over at most an eighth of a turn each, which are within 5·10⁻⁶ radii of
    /// it.
    ///
    /// # Source
    ///
    /// \[svg2\], appendix B.2.4 (from end points to centre) and B.2.5 (radii that are too small).
    fn pieces(&self, from: DVec2, to: DVec2) -> Vec<Cubic> {
        let axis = DVec2::new(libm::cos(self.turn), libm::sin(self.turn));
        let into = |p: DVec2| DVec2::new(p.dot(axis), axis.perp_dot(p));
        // In the frame of the ellipse scaled to the unit circle.
        let half = into((from - to) / 2.0) / self.radii;
        let (radii, half) = match half.length() {
            stretch if stretch > 1.0 => (self.radii * stretch, half / stretch),
            _ => (self.radii, half),
        };
        let squared = half.length_squared();
        let reach = ((1.0 - squared).max(0.0) / squared).sqrt();
        let side = if self.large == self.sweep {
            -reach
        } else {
            reach
        };
        let centre = DVec2::new(half.y, -half.x) * side;
        let (first, last) = (half - centre, -half - centre);
        let start = libm::atan2(first.y, first.x);
        let mut angle = libm::atan2(first.perp_dot(last), first.dot(last));
        if self.sweep && angle < 0.0 {
            angle += std::f64::consts::TAU;
        } else if !self.sweep && angle > 0.0 {
            angle -= std::f64::consts::TAU;
        }
        let pieces = (angle.abs() / std::f64::consts::FRAC_PI_4).ceil().max(1.0) as u32;
        let step = angle / f64::from(pieces);
        let handle = 4.0 / 3.0 * libm::tan(step / 4.0);
        let middle = (from + to) / 2.0;
        let place = |p: DVec2| {
            let scaled = (p + centre) * radii;
            middle + axis * scaled.x + axis.perp() * scaled.y
        };
        (0..pieces)
            .map(|i| {
                let at = |k: u32| {
                    let angle = start + step * f64::from(k);
                    DVec2::new(libm::cos(angle), libm::sin(angle))
                };
                let (a, b) = (at(i), at(i + 1));
                let controls = [a, a + a.perp() * handle, b - b.perp() * handle, b];
                Cubic(controls.map(place))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(data: &str) -> Vec<Cubic> {
        let mut parts = parts(data).expect("good path data");
        assert_eq!(parts.len(), 1, "{data}");
        parts.remove(0)
    }

    fn near(p: DVec2, q: (f64, f64)) -> bool {
        (p - DVec2::from(q)).length() < 1e-12
    }

    #[test]
    fn relative_and_absolute_commands_draw_the_same() {
        for (absolute, relative) in [
            ("M1 2 L3 4 H5 V6 Z", "m1 2 l2 2 h2 v2 z"),
            ("M1 2 C2 3 4 5 6 7 S8 9 10 10", "m1 2 c1 1 3 3 5 5 s2 2 4 3"),
            ("M1 2 Q2 3 4 5 T6 7", "m1 2 q1 1 3 3 t2 2"),
            ("M1 2 A3 4 10 0 1 5 6", "m1 2 a3 4 10 0 1 4 4"),
        ] {
            let pairs = one(absolute).into_iter().zip(one(relative));
            for (one, other) in pairs {
                for (p, q) in one.0.into_iter().zip(other.0) {
                    assert!(near(p, q.into()), "{absolute}: {p} is not {q}");
                }
            }
            assert_eq!(one(absolute).len(), one(relative).len());
        }
    }

    #[test]
    fn smooth_commands_mirror_the_handle_before() {
        let smooth = one("M0 0 C0 1 2 1 2 0 S4 -1 4 0");
        assert!(near(smooth[1].0[1], (2.0, -1.0)));
        let quadratic = one("M0 0 Q1 2 2 0 T4 0");
        // The mirrored control point is (3, -2), two thirds of the way from each end.
        assert!(near(quadratic[1].0[1], (2.0 + 2.0 / 3.0, -4.0 / 3.0)));
        // After another kind of command there is nothing to mirror.
        assert!(near(one("M0 0 Q1 2 2 0 S4 -1 4 0")[1].0[1], (2.0, 0.0)));
    }

    #[test]
    fn arcs_lie_on_their_ellipse_and_turn_the_way_their_flags_say() {
        // From (2, 0) to (0, 1): a quarter or three quarters of either ellipse with radii 2 and 1
        // through both.
        for (large, sweep, centre, turns) in [
            (0, 0, (2.0, 1.0), -0.25),
            (0, 1, (0.0, 0.0), 0.25),
            (1, 0, (0.0, 0.0), -0.75),
            (1, 1, (2.0, 1.0), 0.75),
        ] {
            let pieces = one(&format!("M2 0 A2 1 0 {large} {sweep} 0 1"));
            let into = |p: DVec2| (p - DVec2::from(centre)) / DVec2::new(2.0, 1.0);
            let mut turned = 0.0;
            for piece in &pieces {
                for i in 0..=20 {
                    let p = into(piece.at(f64::from(i) / 20.0));
                    assert!((p.length() - 1.0).abs() < 5e-6, "{large}{sweep}: {p}");
                }
                let ends = [piece.0[0], piece.0[3]].map(into);
                turned += libm::atan2(ends[0].perp_dot(ends[1]), ends[0].dot(ends[1]));
            }
            let expected = turns * std::f64::consts::TAU;
            assert!((turned - expected).abs() < 1e-9, "{large}{sweep}: {turned}");
        }
        // Radii that do not reach are enlarged: half a circle of radius 1.
        let half = one("M0 0 A0.1 0.1 0 0 1 2 0");
        assert!(
            half.iter()
                .all(|piece| ((piece.at(0.5) - DVec2::X).length() - 1.0).abs() < 5e-6)
        );
        // Without a radius it is a line.
        assert_eq!(one("M0 0 A0 1 0 0 1 2 0").len(), 1);
    }

    #[test]
    fn parts_without_anything_drawn_do_not_count() {
        assert_eq!(one("M5 5 M0 0 L1 0 L1 1 Z M9 9").len(), 3);
        assert_eq!(
            parts("M0 0 L1 0 Z L0 1 Z").expect("good path data").len(),
            2
        );
        assert!(parts("M0 0 L1").is_err());
        assert!(parts("L1 1").is_err());
    }
}
