//! The images that controls wrap around their axis: pictures, or patterns made by rule.

use std::f64::consts::TAU;

use super::{ControlError, check};
use crate::random::{Use, uniform};

/// A grey image on a cylinder, values 0 to 1, whose left and right edges are joined.
#[derive(Clone, Debug, PartialEq)]
pub enum ControlImage {
    /// One value everywhere, 0 to 1.
    Constant(f64),
    /// Pixels; values are interpolated between their centres.
    Picture {
        /// Name of its file in the scene; empty if there is none.
        file: String,
        /// Pixels round the axis.
        width: usize,
        /// Pixels along the axis.
        height: usize,
        /// Values, 0 to 1, in rows from left (angle 0) to right; the first row lies at the end of
        /// the axis, the last at its start.
        values: Vec<f64>,
    },
    /// White stripes along the axis on black.
    Stripes {
        /// Number of stripes around the axis, 1 to 10000.
        count: u32,
        /// Width of a stripe over the distance between stripes, 0 to 1.
        share: f64,
        /// Greatest deviation of a stripe to either side, over the distance between stripes, 0 to
        /// (1 − share)/2.
        waviness: f64,
        /// Number of bends from end to end, 0 to 1000.
        bends: f64,
        /// Seed of the bends.
        seed: u64,
    },
    /// White rings around the axis on black.
    Rings {
        /// Number of rings along the axis, 1 to 10000.
        count: u32,
        /// Width of a ring over the distance between rings, 0 to 1.
        share: f64,
    },
    /// Smooth noise.
    Noise {
        /// Number of features around the axis, 1 to 10000. Features are as high as wide if the
        /// cylinder is as high as its girth.
        around: u32,
        /// Layers of noise, each twice as fine and half as strong as the one before, 1 to 10.
        octaves: u32,
        /// Threshold: values above are white, those below black; `None` leaves them grey.
        threshold: Option<f64>,
        /// Seed of the noise.
        seed: u64,
    },
}

impl ControlImage {
    pub(super) fn validate(&self) -> Result<(), ControlError> {
        let unit = |field, value: f64| check(field, value, (0.0..=1.0).contains(&value), "0 to 1");
        let count = |field, value: u32, most: u32, range| {
            check(field, f64::from(value), (1..=most).contains(&value), range)
        };
        match self {
            Self::Constant(value) => unit("value", *value),
            Self::Picture {
                width,
                height,
                values,
                ..
            } => {
                if width * height != values.len() || values.is_empty() {
                    return Err(ControlError::PictureSize {
                        width: *width,
                        height: *height,
                        values: values.len(),
                    });
                }
                values
                    .iter()
                    .try_for_each(|&value| unit("picture's value", value))
            }
            Self::Stripes {
                count: stripes,
                share,
                waviness,
                bends,
                ..
            } => {
                count("number of stripes", *stripes, 10_000, "1 to 10000")?;
                unit("share", *share)?;
                // With a little tolerance for rounding.
                let room = (1.0 - share) / 2.0 + 1e-12;
                check(
                    "waviness",
                    *waviness,
                    (0.0..=room).contains(waviness),
                    "0 to (1 − share)/2",
                )?;
                check(
                    "number of bends",
                    *bends,
                    (0.0..=1000.0).contains(bends),
                    "0 to 1000",
                )
            }
            Self::Rings {
                count: rings,
                share,
            } => {
                count("number of rings", *rings, 10_000, "1 to 10000")?;
                unit("share", *share)
            }
            Self::Noise {
                around,
                octaves,
                threshold,
                ..
            } => {
                count("number of features", *around, 10_000, "1 to 10000")?;
                count("number of octaves", *octaves, 10, "1 to 10")?;
                threshold.map_or(Ok(()), |threshold| unit("threshold", threshold))
            }
        }
    }

    /// The value at an angle (over `2π`, 0 to 1) and a height (0 to 1).
    pub fn value(&self, turn: f64, height: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Picture {
                width,
                height: rows,
                values,
                ..
            } => picture(*width, *rows, values, turn, height),
            Self::Stripes {
                count,
                share,
                waviness,
                bends,
                seed,
            } => {
                let place = turn * f64::from(*count);
                let stripe = place.floor().min(f64::from(*count) - 1.0);
                // Each stripe has its own random numbers.
                let wander = 2.0 * smooth(*seed, stripe as u64, bends * height) - 1.0;
                white((place - stripe - 0.5 - waviness * wander).abs() < share / 2.0)
            }
            Self::Rings { count, share } => {
                let place = height * f64::from(*count);
                white((place - place.floor() - 0.5).abs() < share / 2.0)
            }
            Self::Noise {
                around,
                octaves,
                threshold,
                seed,
            } => {
                let (mut sum, mut most, mut strength) = (0.0, 0.0, 1.0);
                for octave in 0..*octaves {
                    let cells = f64::from(*around) * f64::from(1_u32 << octave);
                    sum += strength * lattice(seed ^ u64::from(octave), cells, turn, height);
                    most += strength;
                    strength /= 2.0;
                }
                let value = sum / most;
                threshold.map_or(value, |threshold| white(value > threshold))
            }
        }
    }
}

fn white(is_white: bool) -> f64 {
    f64::from(u8::from(is_white))
}

fn picture(width: usize, rows: usize, values: &[f64], turn: f64, height: f64) -> f64 {
    let x = turn * width as f64 - 0.5;
    let y = ((1.0 - height) * rows as f64 - 0.5).clamp(0.0, (rows - 1) as f64);
    let (left, top) = (x.floor(), y.floor());
    let (s, t) = (x - left, y - top);
    let column = |offset: i64| (left as i64 + offset).rem_euclid(width as i64) as usize;
    let row = |offset: usize| (top as usize + offset).min(rows - 1);
    let at = |i: i64, j: usize| values[row(j) * width + column(i)];
    let above = at(0, 0) * (1.0 - s) + at(1, 0) * s;
    let below = at(0, 1) * (1.0 - s) + at(1, 1) * s;
    above * (1.0 - t) + below * t
}

/// A smooth curve through random numbers at the integers, 0 to 1.
fn smooth(seed: u64, line: u64, at: f64) -> f64 {
    let whole = at.floor();
    let number = |k: f64| uniform(seed, Use::MosaicImage, (line << 32) | (k as u64));
    let share = eased(at - whole);
    number(whole) * (1.0 - share) + number(whole + 1.0) * share
}

/// Value noise: random numbers at the corners of a grid, smoothly interpolated; `cells` squares
/// around the axis.
fn lattice(seed: u64, cells: f64, turn: f64, height: f64) -> f64 {
    // The cylinder is taken to be as high as its girth, so that both directions have the same unit.
    let (x, y) = (turn * cells, height * cells);
    let (left, bottom) = (x.floor(), y.floor());
    let (s, t) = (eased(x - left), eased(y - bottom));
    let number = |i: f64, j: f64| {
        let column = (left + i).rem_euclid(cells) as u64;
        uniform(seed, Use::MosaicImage, ((bottom + j) as u64) << 32 | column)
    };
    let below = number(0.0, 0.0) * (1.0 - s) + number(1.0, 0.0) * s;
    let above = number(0.0, 1.0) * (1.0 - s) + number(1.0, 1.0) * s;
    below * (1.0 - t) + above * t
}

/// Half a cosine wave from 0 to 1 over [0, 1].
fn eased(share: f64) -> f64 {
    0.5 - 0.5 * libm::cos(TAU / 2.0 * share)
}
