//! The images that controls wrap around their axis: pictures, or patterns made by rule.

use std::f64::consts::TAU;

use crate::document::named_asset::decoded;
use crate::document::{Declared, Keys, Kinds, Limits, Number, RangeError, Text};
use crate::not_grown::{NotGrown, not_grown};
use crate::random::{Use, uniform};

/// A grey image on a cylinder, values 0 to 1, whose left and right edges are joined.
#[derive(Clone, Debug, Declared, PartialEq)]
pub enum ControlImage {
    /// The same value everywhere.
    #[key(skip)]
    Constant(f64),
    /// The grey of a PNG.
    ///
    /// Values are interpolated between the centres of pixels.
    Picture(Pixels),
    /// `count`, `share` (0.5), `waviness` (0), `bends` (4), `seed` (0): along the axis.
    ///
    /// They are white on black.
    Stripes {
        /// Stripes around.
        #[key("count", required, 1..=10_000, default = 1)]
        count: u32,
        /// Share of the width that is white.
        #[key("share", 0.0..=1.0, default = 0.5)]
        share: f64,
        /// How far they wander, in distances of stripes.
        #[key("waviness", within(Limits::closed(0.0, (1.0 - *share) / 2.0)))]
        waviness: f64,
        /// Bends from end to end.
        #[key("bends", 0.0..=1000.0, default = 4.0)]
        bends: f64,
        /// Seed of the bends.
        #[key("seed")]
        seed: u64,
    },
    /// `count`, `share` (0.5): about it.
    ///
    /// They are white on black.
    Rings {
        /// Rings from end to end.
        #[key("count", required, 1..=10_000, default = 1)]
        count: u32,
        /// Share of the height that is white.
        #[key("share", 0.0..=1.0, default = 0.5)]
        share: f64,
    },
    /// Noise.
    ///
    /// It is smooth.
    Noise {
        /// Patches around.
        ///
        /// They are as high as wide if the cylinder is as high as its girth.
        #[key("around", required, 1..=10_000, default = 1)]
        around: u32,
        /// Octaves of ever finer patches.
        ///
        /// Each is twice as fine and half as strong as the one before.
        #[key("octaves", 1..=10, default = 1)]
        octaves: u32,
        /// Noise above it is white, below black; left out, grey.
        #[key("threshold", 0.0..=1.0)]
        threshold: Option<f64>,
        /// Seed of the noise.
        #[key("seed")]
        seed: u64,
    },
}

/// The picture of a file.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct Pixels {
    /// The picture.
    ///
    /// Its name in the scene; empty if there is no file.
    #[key(with = picture_file)]
    pub file: String,
    /// Pixels round the axis.
    pub width: usize,
    /// Values, 0 to 1, in rows from left (angle 0) to right; the first row lies at the end of
    /// the axis, the last at its start.
    pub values: Vec<f64>,
}

impl Default for Pixels {
    fn default() -> Self {
        Self {
            file: String::new(),
            width: 1,
            values: Vec::new(),
        }
    }
}

fn picture_file(pixels: &mut Pixels, keys: &mut Keys<'_>) {
    let before = pixels.file.clone();
    let path = Text("the path of a PNG file");
    keys.required("path", &mut pixels.file, path, "The picture.");
    if pixels.file == before {
        return;
    }
    let read = decoded(keys, "path", &["png"], |assets, file| {
        assets.weights(file).map_err(|error| {
            let problem = format!("cannot be read: {error}");
            (problem, "save it anew as a PNG")
        })
    });
    if let Some(raster) = read {
        pixels.width = raster.width;
        pixels.values = raster.values.into_iter().map(f64::from).collect();
    }
}

/// The keys of an image, one of which is there.
pub(super) fn image(image: &mut ControlImage, keys: &mut Keys<'_>) {
    const IMAGES: [&str; 5] = ["picture", "stripes", "rings", "noise", "constant"];
    let current = ControlImage::KINDS.iter().find(|kind| (kind.is)(image));
    let current = current.map_or("constant", |kind| kind.name);
    let has_base = keys.base().is_some();
    for name in keys.one_of(&IMAGES, Some(current)) {
        let is_new =
            name != current || (keys.reader().is_some() && !has_base) || keys.is_description();
        if let Some(kind) = ControlImage::KINDS.iter().find(|kind| kind.name == name) {
            if is_new {
                *image = (kind.new)();
            }
            keys.required_block(name, kind.about, &[], |keys| (kind.declare)(image, keys));
        } else {
            let mut value = 0.0;
            if let ControlImage::Constant(current) = image
                && !is_new
            {
                value = *current;
            }
            let limits = Number(Limits::closed(0.0, 1.0));
            keys.required("constant", &mut value, limits, "The same value everywhere.");
            *image = ControlImage::Constant(value);
        }
    }
}

impl ControlImage {
    pub(super) fn validate(&self) -> Result<(), NotGrown> {
        let Self::Picture(Pixels { width, values, .. }) = self else {
            return Ok(());
        };
        if values.is_empty() || !values.len().is_multiple_of(*width) {
            return Err(not_grown!(
                "its picture of {width} pixels across has {} values",
                values.len()
            ));
        }
        let dark = values.iter().find(|value| !(0.0..=1.0).contains(*value));
        dark.map_or(Ok(()), |&value| {
            Ok(RangeError::unless(
                false,
                "picture's value",
                value,
                "0 to 1",
            )?)
        })
    }

    /// The value at an angle (over `2π`, 0 to 1) and a height (0 to 1).
    pub fn value(&self, turn: f64, height: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Picture(pixels) => pixels.value(turn, height),
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

impl Pixels {
    fn value(&self, turn: f64, height: f64) -> f64 {
        let Self { width, values, .. } = self;
        let rows = values.len() / width;
        let x = turn * *width as f64 - 0.5;
        let y = ((1.0 - height) * rows as f64 - 0.5).clamp(0.0, (rows - 1) as f64);
        let (left, top) = (x.floor(), y.floor());
        let (s, t) = (x - left, y - top);
        let column = |offset: i64| (left as i64 + offset).rem_euclid(*width as i64) as usize;
        let row = |offset: usize| (top as usize + offset).min(rows - 1);
        let at = |i: i64, j: usize| values[row(j) * width + column(i)];
        let above = at(0, 0) * (1.0 - s) + at(1, 0) * s;
        let below = at(0, 1) * (1.0 - s) + at(1, 1) * s;
        above * (1.0 - t) + below * t
    }
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
