//! Text files that commands are given: tables, networks, drawings, measures.

use std::path::Path;

use leafmodel::document::whole_file;

use crate::cli::terminal::Failure;
use crate::measured::series;

/// The text of a file; a note says so if its encoding is a guess.
pub(super) fn text_of(path: &Path) -> Result<String, Failure> {
    let bytes = bytes_of(path, whole_file::MOST_BYTES)?;
    let decoded = series::text(&bytes).map_err(|fault| Failure::bad(fault.shown(path, "")))?;
    if let Some(guess) = decoded.guess() {
        eprintln!("note: {}: {guess}", path.display());
    }
    Ok(decoded.text.into_owned())
}

/// The bytes of a file.
pub(super) fn bytes_of(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    whole_file::read(path, most).map_err(Failure::at(path))
}
