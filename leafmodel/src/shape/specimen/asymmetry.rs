//! How the left side of a leaf differs from the right by chance.
//!
//! Each leaf has fields of low frequency of its own; see `docs/src/theory/growth-shape.md` for what
//! is known of real leaves.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use crate::document::Declared;
use crate::numeric::smooth_step;
use crate::random::{Use, bell, uniform};

/// Random differences between the sides, all of mean 0 over the leaves of a plant.
#[derive(Clone, Copy, Debug, Declared, Default, PartialEq)]
pub struct Asymmetry {
    /// Standard deviation of (right − left) / (right + left) of the widths beside the midrib.
    #[key("width", 0.0..=0.2)]
    pub width: f64,
    /// Standard deviation of how far the middle of the blade lies beside the line from base to
    /// apex, over that line's length.
    #[key("bow", 0.0..=0.1)]
    pub bow: f64,
    /// How far places of the margin wander, as a share of the length.
    #[key("wander", 0.0..=0.02)]
    pub wander: f64,
}

/// Weights of the waves of the widths' difference along the midrib: none, half a wave, one.
const MODES: [f64; 3] = [0.5, 0.3, 0.2];

/// Waves by which places wander, and the longest of them in lengths of the midrib.
const WAVES: u64 = 4;
const LONGEST_WAVE: f64 = 1.0;

/// Distance from base and apex over which wandering fades.
const FADE: f64 = 0.25;

impl Asymmetry {
    /// Whether both sides are alike.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Places in lengths of the midrib, from (0, 0) to (0, 1).
    pub(super) fn shape(&self, points: &mut [DVec2], seed: u64) {
        if self.is_none() {
            return;
        }
        let coefficients: [f64; 3] =
            std::array::from_fn(|k| MODES[k].sqrt() * bell(seed, Use::Width, k as u64));
        // The mean of the sum's square along the midrib; half that of a wave is lost.
        let scale = self.width / (MODES[0] + 0.5 * (MODES[1] + MODES[2])).sqrt();
        let bow = self.bow * bell(seed, Use::Bow, 0);
        let waves: Vec<Wave> = (0..WAVES).map(|i| Wave::new(seed, i)).collect();
        // Each component of the sum has a mean square of `WAVES / 4`.
        let far = self.wander / (WAVES as f64 / 4.0).sqrt();
        for p in points {
            let near = p.length().min(p.distance(DVec2::Y));
            if near == 0.0 {
                continue;
            }
            let y = p.y.clamp(0.0, 1.0);
            let sum: f64 = (0_u8..)
                .zip(coefficients)
                .map(|(k, c)| c * libm::cos(f64::from(k) * PI * y))
                .sum();
            // Beyond this a side would vanish.
            let wider = (scale * sum).clamp(-0.6, 0.6);
            let mut place = *p;
            place.x *= 1.0 + wider * p.x.signum();
            place.x += bow * libm::sin(PI * y);
            let wandered: DVec2 = waves.iter().map(|wave| wave.at(*p)).sum();
            *p = place + wandered * (far * smooth_step(near / FADE));
        }
    }
}

/// A plane wave of displacement.
struct Wave {
    /// Phase per place.
    ahead: DVec2,
    phase: f64,
    /// Unit direction of the displacement.
    way: DVec2,
}

impl Wave {
    fn new(seed: u64, i: u64) -> Self {
        let number = |k: u64| uniform(seed, Use::Wander, 4 * i + k);
        let direction = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            DVec2::new(cos, sin)
        };
        let length = LONGEST_WAVE * (0.5 + 0.5 * number(0));
        Self {
            ahead: direction(TAU * number(1)) * (TAU / length),
            phase: TAU * number(2),
            way: direction(TAU * number(3)),
        }
    }

    fn at(&self, p: DVec2) -> DVec2 {
        self.way * libm::sin(self.ahead.dot(p) + self.phase)
    }
}
