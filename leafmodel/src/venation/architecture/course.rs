//! The course of one vein: where its sources appear, one after another.

use glam::DVec2;

use super::Lots;
use crate::plane::polyline;
use crate::plane::segment::meeting;
use crate::shape::cubic::catmull_rom;

/// Places by which a course is told.
const PLACES: u32 = 48;

/// How far a fully irregular course wanders from its curve, over its length.
const WANDER: f64 = 0.02;

/// A vein to be laid out.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    /// From its start on another vein to its end.
    pub(crate) points: Vec<DVec2>,
    /// Whether it is to join the vein that its end lies on.
    pub(crate) joins: bool,
    /// Whether it starts among others, beside which it runs for a while without joining them.
    pub(crate) is_crowded: bool,
}

impl Course {
    /// A smooth curve from `start` through `bends`; chance lets it wander `wander` as far as it
    /// can.
    pub(crate) fn curve(
        start: DVec2,
        bends: &[DVec2],
        lots: Lots,
        order: u8,
        vein: u64,
        wander: f64,
    ) -> Self {
        let knots: Vec<DVec2> = std::iter::once(start)
            .chain(bends.iter().copied())
            .collect();
        let last = knots.len() - 1;
        let at = |i: isize| {
            let i = i.clamp(0, last as isize) as usize;
            knots[i]
        };
        let ends = |i: isize| {
            if i < 0 {
                2.0 * at(0) - at(1)
            } else if i > last as isize {
                2.0 * at(last as isize) - at(last as isize - 1)
            } else {
                at(i)
            }
        };
        let chord = polyline::length(&knots);
        let phases = [0, 1].map(|what| lots.share(order, vein, 100 + what));
        let strength = wander * WANDER * chord * lots.jitter(order, vein, 102).abs().sqrt();
        let points: Vec<DVec2> = (0..=PLACES)
            .map(|k| {
                let t = f64::from(k) / f64::from(PLACES);
                let place = t * last as f64;
                let i = (place.floor() as isize).min(last as isize - 1);
                let u = place - i as f64;
                let on = |u: f64| catmull_rom([ends(i - 1), ends(i), ends(i + 1), ends(i + 2)], u);
                let aside = (on((u + 0.01).min(1.0)) - on((u - 0.01).max(0.0)))
                    .normalize_or_zero()
                    .perp();
                let wave =
                    |times: f64, phase: f64| libm::sin(std::f64::consts::TAU * (times * t + phase));
                let envelope = 4.0 * t * (1.0 - t);
                let away = wave(1.1, phases[0]) + 0.5 * wave(2.7, phases[1]);
                on(u) + aside * (strength * envelope * away)
            })
            .collect();
        Self {
            points,
            joins: false,
            is_crowded: false,
        }
    }

    /// A course through these points, two or more.
    pub(crate) fn through(points: Vec<DVec2>) -> Self {
        Self {
            points,
            joins: false,
            is_crowded: false,
        }
    }

    /// The same, joined to what its end lies on.
    pub(crate) fn joined(self) -> Self {
        Self {
            joins: true,
            ..self
        }
    }

    /// The same, started among others.
    pub(crate) fn crowded(self) -> Self {
        Self {
            is_crowded: true,
            ..self
        }
    }

    /// Where it starts.
    pub(crate) fn start(&self) -> DVec2 {
        self.points[0]
    }

    /// Its length.
    pub(crate) fn length(&self) -> f64 {
        polyline::length(&self.points)
    }

    /// The place at a share of its points, and its direction there.
    pub(crate) fn at(&self, share: f64) -> (DVec2, DVec2) {
        let last = self.points.len() - 1;
        let place = share.clamp(0.0, 1.0) * last as f64;
        let i = (place.floor() as usize).min(last - 1);
        let (a, b) = (self.points[i], self.points[i + 1]);
        (a.lerp(b, place - i as f64), (b - a).normalize_or_zero())
    }

    /// Whether a straight way crosses it.
    pub(crate) fn is_crossed_by(&self, a: DVec2, b: DVec2) -> bool {
        self.points
            .windows(2)
            .any(|pair| cross(a, b, pair[0], pair[1]).is_some())
    }
}

/// Where on the way from `a` to `b` it meets the piece from `c` to `d`, as a share.
pub(crate) fn cross(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> Option<f64> {
    let (way, piece) = (b - a, d - c);
    let (on_way, on_piece) = meeting(a, way, c, d);
    // Pieces of one straight vein lie in line, up to rounding: they do not cross.
    let is_inner = |share: f64| (0.0..=1.0).contains(&share);
    let crosses = is_inner(on_way)
        && is_inner(on_piece)
        && way.perp_dot(piece).abs() > 1e-6 * way.length() * piece.length();
    crosses.then_some(on_way)
}

/// A vein that secondaries leave: the midrib or a lateral primary.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// Its course.
    pub(crate) course: Course,
    /// On which side of the midrib it lies: 1 the right, −1 the left, 0 the midrib.
    pub(crate) side: f64,
    /// 0 the midrib, then one more than the primary that it leaves.
    pub(crate) generation: u32,
}

impl Axis {
    pub(crate) fn new(course: Course, side: f64, generation: u32) -> Self {
        Self {
            course,
            side,
            generation,
        }
    }

    /// Where it is at a share of its length, and its direction over a tenth of it.
    pub(crate) fn at(&self, share: f64) -> (DVec2, DVec2) {
        let (place, _) = self.course.at(share);
        let (before, _) = self.course.at(share - 0.05);
        let (after, _) = self.course.at(share + 0.05);
        (place, (after - before).normalize_or_zero())
    }
}
