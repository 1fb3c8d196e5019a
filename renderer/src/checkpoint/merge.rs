//! Parts of a picture, each with a range of the samples of every pixel, added up to the whole.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::heading::Heading;
use super::opened::{CheckpointError, Opened};
use crate::integrator::render::Begun;

/// Why parts do not add up to a picture.
#[derive(Debug, Error)]
pub enum MergeError {
    /// A part cannot be read.
    #[error(transparent)]
    Unreadable(#[from] CheckpointError),
    /// Two parts are not of the same picture.
    #[error("{} is {what} as {}", .path.display(), .first.display())]
    Differs {
        /// The part.
        path: PathBuf,
        /// The first part.
        first: PathBuf,
        /// How they differ.
        what: String,
    },
    /// A part has not all of its samples.
    #[error(
        "{} was interrupted at {done} of its samples {start}..{end}: go on with it by --resume, then merge", .path.display()
    )]
    Unfinished {
        /// The part.
        path: PathBuf,
        /// Samples that every pixel has.
        done: u32,
        /// Number of its first sample.
        start: u32,
        /// Number behind its last one.
        end: u32,
    },
    /// A part aims at a noise, which is judged on the whole picture.
    #[error(
        "{} aims at a noise, which can only be judged on a whole picture: render parts with --noise 0", .path.display()
    )]
    Adaptive {
        /// The part.
        path: PathBuf,
    },
    /// Two parts have samples in common.
    #[error(
        "{} and {} both hold the samples {start}..{end}: leave one out", .one.display(), .other.display()
    )]
    Overlap {
        /// A part.
        one: PathBuf,
        /// Another.
        other: PathBuf,
        /// Number of the first common sample.
        start: u32,
        /// Number behind the last common one.
        end: u32,
    },
    /// No part has these samples.
    #[error("the samples {start}..{end} are missing: render them with --samples {start}..{end}")]
    Missing {
        /// Number of the first missing sample.
        start: u32,
        /// Number behind the last missing one.
        end: u32,
    },
}

/// Adds up parts, given in any order, to the picture that a render in one go has.
///
/// # Errors
///
/// [`MergeError`] unless all are finished parts of one picture and hold each of its samples once.
///
/// # Panics
///
/// If no part is given.
pub fn merge(paths: &[PathBuf]) -> Result<(Heading, Begun), MergeError> {
    let opened: Result<Vec<_>, _> = paths.iter().map(|path| Opened::new(path)).collect();
    let mut parts = opened?;
    parts.sort_by_key(|part| (part.progress.first, part.heading.job.spp));
    let first = &parts[0];
    let mut next: (u32, Option<&Path>) = (0, None);
    for part in &parts {
        check(part, first)?;
        let (start, end) = (part.progress.first, part.heading.job.spp);
        if start > next.0 {
            return Err(MergeError::Missing {
                start: next.0,
                end: start,
            });
        }
        if let (true, Some(other)) = (start < next.0, next.1) {
            return Err(MergeError::Overlap {
                one: other.to_owned(),
                other: part.path.clone(),
                start,
                end: next.0.min(end),
            });
        }
        next = (end, Some(&part.path));
    }
    let whole = parts.iter().filter_map(|part| part.heading.whole).max();
    if let Some(end) = whole.filter(|&end| end > next.0) {
        return Err(MergeError::Missing { start: next.0, end });
    }
    let begun = first.begun(&parts)?;
    if begun.film.drawn_range() != [next.0; 2] {
        return Err(first
            .damaged("the headings and the sums differ in samples")
            .into());
    }
    let mut heading = first.heading.clone();
    heading.job.spp = next.0;
    Ok((heading, begun))
}

/// Whether a part is finished, and of the same picture as the first one.
fn check(part: &Opened, first: &Opened) -> Result<(), MergeError> {
    let path = part.path.clone();
    if part.heading.aim.is_some() {
        return Err(MergeError::Adaptive { path });
    }
    let same_effort = part.progress.effort == first.progress.effort;
    let other_effort = (!same_effort).then(|| "not traced with the same effort".to_owned());
    if let Some(what) = part.heading.difference(&first.heading).or(other_effort) {
        return Err(MergeError::Differs {
            path,
            first: first.path.clone(),
            what,
        });
    }
    let (start, end) = (part.progress.first, part.heading.job.spp);
    if part.progress.drawn != [end - start; 2] {
        return Err(MergeError::Unfinished {
            path,
            done: part.progress.drawn[0],
            start,
            end,
        });
    }
    Ok(())
}
