//! Sums of a render as a file, from which it goes on after an interruption, or which is merged with
//! other parts of the same picture.
//!
//! - **In**: a [`Begun`] render and its [`Heading`]; or a file.
//! - **Out**: a file; or the render, which goes on with the same bits; or the sum of several.
//! - **Always true**: a file is written whole or not at all ([`crate::image::atomic`]). A file of
//!   another format or a damaged one is an error, which no content can turn into a panic.
//! - **Left out**: when to write one, which the command line decides.
//!
//! A file is a magic line and sections (`codec`). First comes the heading,
//! then a section for each row of blocks ([`packed_row`](crate::film::Film::packed_row)), then counts of rejected samples,
//! clamped values and cut paths, then what is known of the noise.

mod heading;
mod merge;
mod opened;
#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use rayon::prelude::*;

pub use heading::{Heading, PROGRAM};
pub use merge::{MergeError, merge};
pub use opened::CheckpointError;

use self::heading::Progress;
use self::opened::{MAGIC, Opened};
use crate::codec::{self, write_section};
use crate::image::{ImageError, atomic};
use crate::integrator::noise::NoiseWatch;
use crate::integrator::render::Begun;

/// Writes the state of a render; an old file is replaced when the new one is whole.
///
/// # Errors
///
/// [`ImageError::File`] if it cannot be written; an old one is untouched.
pub fn write(path: &Path, heading: &Heading, begun: &Begun) -> Result<(), ImageError> {
    atomic::replace(path, |file| write_sections(file, heading, begun))
}

fn write_sections(
    file: &mut BufWriter<&mut File>,
    heading: &Heading,
    begun: &Begun,
) -> io::Result<()> {
    let film = &begun.film;
    file.write_all(&MAGIC)?;
    write_section(file, &heading.to_bytes(&Progress::of(begun)))?;
    // Rows are packed on all threads, some at a time, so that few are in memory.
    let batch = 4 * rayon::current_num_threads();
    for first in (0..film.rows()).step_by(batch) {
        let rows = first..(first + batch).min(film.rows());
        let packed: Vec<_> = rows
            .into_par_iter()
            .map(|row| film.packed_row(row))
            .collect();
        for row in packed {
            write_section(file, &row)?;
        }
    }
    write_section(file, &codec::to_bytes(&film.fault_counts()))?;
    let noise = begun.watch.as_ref().map(NoiseWatch::words);
    write_section(file, &codec::to_bytes(&noise))
}

/// Reads the state of a render; sums are added up on the current thread pool.
///
/// # Errors
///
/// [`CheckpointError`].
pub fn read(path: &Path) -> Result<(Heading, Begun), CheckpointError> {
    let opened = Opened::new(path)?;
    let begun = opened.begun(std::slice::from_ref(&opened))?;
    if begun.film.drawn_range() != opened.progress.drawn {
        return Err(opened.damaged("the heading and the sums differ in samples"));
    }
    Ok((opened.heading, begun))
}
