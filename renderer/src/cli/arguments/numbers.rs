//! Numbers of the command line, and ranges of them.

use std::fmt;

use crate::film::MOST_SAMPLES;

/// Longest time that a render may be given: a year.
pub(super) const MOST_SECONDS: u32 = 366 * 24 * 3600;

/// Most memory that a render may be given, GiB.
pub(super) const MOST_GIB: u32 = 1 << 20;

/// A number from `LOW` to `HIGH`.
pub(super) fn between<const LOW: u32, const HIGH: u32>(text: &str) -> Result<f64, String> {
    let allowed = f64::from(LOW)..=f64::from(HIGH);
    let none = format!("not a number; write one from {LOW} to {HIGH}");
    let refused = format!("must be from {LOW} to {HIGH}");
    number(text, |number| allowed.contains(&number), [none, refused])
}

/// A number that is allowed; else one of the messages: that the text is none, or that it must be
/// another.
pub(super) fn number(
    text: &str,
    is_allowed: impl FnOnce(f64) -> bool,
    [none, refused]: [impl Into<String>; 2],
) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| none.into())?;
    is_allowed(number)
        .then_some(number)
        .ok_or_else(|| refused.into())
}

/// A width and a height, such as `640x480`.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let number = |text: &str| text.trim().parse().ok();
    let pair = text.split_once(['x', '×', ',']);
    let pair = pair.and_then(|(width, height)| Some([number(width)?, number(height)?]));
    pair.ok_or_else(|| "write a width and a height: 640x480".to_owned())
}

/// Two finite numbers with a comma between them; `wanted` tells what is to be written.
pub(super) fn two_numbers(text: &str, wanted: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    let pair = text
        .split_once(',')
        .and_then(|(x, y)| Some([number(x)?, number(y)?]));
    pair.ok_or_else(|| wanted.to_owned())
}

/// A side of a texture.
pub(super) fn power_of_two(text: &str) -> Result<u32, String> {
    let side = text.parse().ok();
    let side = side.filter(|side: &u32| side.is_power_of_two() && (16..=8192).contains(side));
    side.ok_or_else(|| "write a power of two from 16 to 8192: 1024".to_owned())
}

/// Numbers of samples of a pixel.
pub(super) fn samples() -> clap::builder::RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(MOST_SAMPLES))
}

/// Numbers of the samples of a part of a picture: from `first` to `end − 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleRange {
    /// The first one.
    pub first: u32,
    /// The number behind the last one, greater than `first`.
    pub end: u32,
}

impl SampleRange {
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..");
        let ends = ends.and_then(|(first, end)| first.parse().ok().zip(end.parse().ok()));
        match ends {
            Some((first, end)) if first < end && end <= MOST_SAMPLES => Ok(Self { first, end }),
            Some(_) | None => Err(format!(
                "write A..B, as in 0..64 for the first 64 samples, with A < B up to {MOST_SAMPLES}"
            )),
        }
    }
}

impl fmt::Display for SampleRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.first, self.end)
    }
}

/// A number above 0 and up to `HIGH`.
pub(super) fn above_0<const HIGH: u32>(text: &str) -> Result<f64, String> {
    let number = between::<0, HIGH>(text)?;
    let allowed = format!("it must be above 0 and at most {HIGH}");
    (number > 0.0).then_some(number).ok_or(allowed)
}
