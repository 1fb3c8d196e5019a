//! The course of a petiole's axis between the blade and its foot.
//!
//! The axis is followed from the base backwards in a frame that it carries along. Per unit of
//! length the frame turns by three rates: towards the abaxial side, towards the right, and about
//! the axis. Each rate is a sum of what the plan asks for.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use crate::document::Declared;
use crate::numeric::smooth_step;
use crate::random::{Use, uniform};

/// Pieces that the axis is followed in.
const STEPS: usize = 240;
/// Arm of the blade's weight about the base, over the leaf's length: its centre of mass.
const ARM: f64 = 0.5;
/// Greatest curvature, over the curvature of the tube's own cross-section: above 1 the inner side
/// of a bend folds.
const TIGHTEST: f64 = 0.5;
/// Amplitude of the wave by which a petiole strays, over that of its even bend.
const WAVE: f64 = 1.5;

/// How the axis of a petiole runs, beside its even bend. Angles are radians.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Course {
    /// Angle by which the blade's weight has bent it towards the abaxial side at its foot; the bend
    /// grows towards the foot.
    #[key("sag_deg", degrees(-170.0..=170.0))]
    pub sag: f64,
    /// Angle by which it bends towards the abaxial side just before the blade; with an opposite sag
    /// it is an S.
    ///
    /// Radians.
    #[key("neck_deg", degrees(-110.0..=110.0))]
    pub neck: f64,
    /// Share of its length in which it does so.
    #[key("neck_length", 0.02..=1.0)]
    pub neck_length: f64,
    /// Angle by which it has bent to the right at its foot, adaxial side up, blade ahead.
    ///
    /// Radians.
    #[key("sway_deg", degrees(-170.0..=170.0))]
    pub sway: f64,
    /// Angle by which it is twisted between blade and foot; bends turn with it.
    #[key("twist_deg", degrees(-170.0..=170.0))]
    pub twist: f64,
    /// Standard deviation, from leaf to leaf, of sag, sway, twist and of a wave in both bends.
    ///
    /// Radians.
    #[key("stray_deg", degrees(0.0..=55.0))]
    pub stray: f64,
}

impl Course {
    /// A course without any bend.
    pub const STRAIGHT: Self = Self {
        sag: 0.0,
        neck: 0.0,
        neck_length: 0.25,
        sway: 0.0,
        twist: 0.0,
        stray: 0.0,
    };
}

/// The axis of one petiole as a chain of places, in the frame of the base.
pub(super) struct Axis {
    piece: f64,
    /// Place, and the directions across the petiole, along it towards the blade, and to its adaxial
    /// side.
    stations: Vec<(DVec3, DMat3)>,
}

/// What a course is followed for.
pub(super) struct Petiole {
    /// Length of the petiole, mm.
    pub(super) length: f64,
    /// Greatest radius, mm.
    pub(super) radius: f64,
    /// Length of the leaf, mm.
    pub(super) leaf: f64,
    /// Even bend towards the abaxial side, and what wilting adds to the sag.
    pub(super) curl: f64,
    pub(super) wilted: f64,
    /// Frame at the base: columns as in [`Axis`].
    pub(super) start: DMat3,
    pub(super) seed: u64,
}

impl Axis {
    /// The axis of a petiole with this course.
    pub(super) fn new(course: &Course, petiole: &Petiole) -> Self {
        let length = petiole.length;
        let piece = length / STEPS as f64;
        let chance = |number: u64| {
            // Uniform with a standard deviation of 1.
            let u = uniform(petiole.seed, Use::Petiole, number);
            course.stray * 3.0_f64.sqrt() * (2.0 * u - 1.0)
        };
        let [down, aside, about] = [0, 1, 2].map(chance);
        let waves = [3, 4].map(|number| WAVE * chance(number));
        let phase = TAU * uniform(petiole.seed, Use::Petiole, 5);
        let arm = ARM * petiole.leaf;
        let whole = length * (arm + 0.5 * length);
        let sag = course.sag + petiole.wilted + down;
        let neck = (course.neck_length * length).max(piece);
        let rates = |back: f64| {
            let wave = libm::sin(TAU * back / length + phase);
            let bent = petiole.curl / length
                + sag * (arm + back) / whole
                + course.neck * hump(back / neck) / neck
                + waves[0] * wave / length;
            let aside = (course.sway + aside + waves[1] * wave) / length;
            (bent, aside, (course.twist + about) / length)
        };
        let most = TIGHTEST / petiole.radius;
        let mut stations = vec![(DVec3::ZERO, petiole.start)];
        let (mut at, mut frame) = stations[0];
        for step in 0..STEPS {
            let (bent, aside, about) = rates(piece * (step as f64 + 0.5));
            let tight = (bent.hypot(aside) / most).max(1.0);
            // Going backwards along −y: towards the abaxial side is about +x, to the right about
            // +z.
            let turn = DVec3::new(bent / tight, -about, aside / tight) * piece;
            let half = frame * rotation(0.5 * turn);
            let angle = 0.5 * turn.x.hypot(turn.z);
            let chord = if angle < 1e-9 {
                1.0
            } else {
                libm::sin(angle) / angle
            };
            at -= half.y_axis * (piece * chord);
            frame *= rotation(turn);
            stations.push((at, frame));
        }
        Self { piece, stations }
    }

    /// Place and frame at the distance `back` from the base.
    pub(super) fn at(&self, back: f64) -> (DVec3, DMat3) {
        let place = (back / self.piece).clamp(0.0, STEPS as f64);
        let before = (place as usize).min(STEPS - 1);
        let share = place - before as f64;
        let [(a, from), (b, to)] = [self.stations[before], self.stations[before + 1]];
        let along = from.y_axis.lerp(to.y_axis, share).normalize();
        let across = from.x_axis.lerp(to.x_axis, share);
        let across = (across - along * along.dot(across)).normalize();
        let frame = DMat3::from_cols(across, along, across.cross(along));
        // A cubic through both places with their directions.
        let (u, v) = (-from.y_axis * self.piece, -to.y_axis * self.piece);
        let cubic = (3.0 * (b - a) - 2.0 * u - v) + share * (2.0 * (a - b) + u + v);
        (a + share * (u + share * cubic), frame)
    }
}

/// A smooth hump on [0, 1] whose integral is 1.
fn hump(x: f64) -> f64 {
    2.0 * smooth_step(2.0 * x) * smooth_step(2.0 - 2.0 * x)
}

/// The rotation by the length of a vector about it.
fn rotation(turn: DVec3) -> DMat3 {
    let angle = turn.length();
    if angle == 0.0 {
        return DMat3::IDENTITY;
    }
    let axis = turn / angle;
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let turned = |v: DVec3| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
    DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn petiole() -> Petiole {
        Petiole {
            length: 30.0,
            radius: 0.5,
            leaf: 60.0,
            curl: 0.0,
            wilted: 0.0,
            start: DMat3::IDENTITY,
            seed: 1,
        }
    }

    /// The direction in which an axis leaves its foot, away from the blade.
    fn foot(course: &Course, petiole: &Petiole) -> DVec3 {
        -Axis::new(course, petiole).at(petiole.length).1.y_axis
    }

    fn course(change: impl FnOnce(&mut Course)) -> Course {
        let mut course = Course::STRAIGHT;
        change(&mut course);
        course
    }

    #[test]
    fn an_even_bend_is_an_arc() {
        let bent = Petiole {
            curl: 1.2,
            ..petiole()
        };
        let axis = Axis::new(&Course::STRAIGHT, &bent);
        let radius = 30.0 / 1.2;
        for back in [0.0_f64, 3.3, 17.01, 30.0] {
            let angle = back / radius;
            let arc = radius * DVec3::new(0.0, -angle.sin(), angle.cos() - 1.0);
            assert!(axis.at(back).0.distance(arc) < 1e-6, "{back}");
        }
    }

    #[test]
    fn each_bend_turns_the_foot_by_its_angle_and_to_its_side() {
        let foot = |change: fn(&mut Course)| foot(&course(change), &petiole());
        let angle = |direction: DVec3| direction.dot(-DVec3::Y).acos();
        let sag = foot(|course| course.sag = 0.6);
        assert!((angle(sag) - 0.6).abs() < 1e-6 && sag.z < -0.5, "{sag}");
        let neck = foot(|course| course.neck = -0.4);
        assert!((angle(neck) - 0.4).abs() < 1e-3 && neck.z > 0.3, "{neck}");
        let sway = foot(|course| course.sway = 0.5);
        assert!((angle(sway) - 0.5).abs() < 1e-6 && sway.x > 0.4, "{sway}");
    }

    #[test]
    fn weight_bends_most_at_the_foot_and_a_neck_next_to_the_blade() {
        let half = |change: fn(&mut Course)| {
            let axis = Axis::new(&course(change), &petiole());
            let turned = |back: f64| axis.at(back).1.y_axis.dot(DVec3::Y).acos();
            turned(15.0) / turned(30.0)
        };
        // The moment at x of a load at the distance a beyond the base is F (a + x).
        let weight = half(|course| course.sag = 0.6);
        let moment = (30.0 * 15.0 + 112.5) / (30.0 * 30.0 + 450.0);
        assert!((weight - moment).abs() < 1e-3, "{weight} is not {moment}");
        assert!(half(|course| course.neck = 0.6) > 0.999);
    }

    #[test]
    fn a_twist_turns_the_section_and_a_bend_goes_with_it() {
        let twisted = course(|course| course.twist = 1.0);
        let axis = Axis::new(&twisted, &petiole());
        let across = axis.at(30.0).1.x_axis;
        assert!((across.dot(DVec3::X) - 1.0_f64.cos()).abs() < 1e-6);
        let both = course(|course| (course.twist, course.sag) = (1.5, 0.8));
        assert!(foot(&both, &petiole()).x.abs() > 0.2, "it leaves its plane");
    }

    #[test]
    fn leaves_differ_by_their_seeds_as_much_as_they_may_stray() {
        let strays = course(|course| course.stray = 0.2);
        let foot = |seed: u64| foot(&strays, &Petiole { seed, ..petiole() });
        assert_eq!(foot(3), foot(3));
        let sways: Vec<f64> = (0..400).map(|seed| foot(seed).x).collect();
        let mean = sways.iter().sum::<f64>() / 400.0;
        let variance = sways.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 400.0;
        // A wave of one period does not turn the foot. 400 values: 5 % at one sigma.
        assert!((variance.sqrt() - 0.19).abs() < 0.03, "{}", variance.sqrt());
    }

    #[test]
    fn no_bend_is_tighter_than_the_tube_allows() {
        let sharp = course(|course| (course.neck, course.neck_length) = (2.0, 0.02));
        let thick = Petiole {
            radius: 2.0,
            ..petiole()
        };
        let axis = Axis::new(&sharp, &thick);
        for i in 0..30 {
            let [a, b] = [f64::from(i), f64::from(i) + 1.0].map(|back| axis.at(back).1.y_axis);
            let curvature = a.dot(b).clamp(-1.0, 1.0).acos();
            assert!(curvature <= 0.26, "{curvature} at {i}");
        }
    }
}
