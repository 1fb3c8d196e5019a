//! A range of samples as written: `A..B`.

use std::fmt;

use crate::film::MOST_SAMPLES;

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
