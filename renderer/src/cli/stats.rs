//! Times, memory and speed, for people and for scripts.

use std::path::Path;

use serde_json::Value;

use crate::checkpoint::PROGRAM;
use crate::cli::places::write_whole;
use crate::cli::terminal::Failure;

/// Writes a JSON object atomically, with the version of the program as `program`.
pub(super) fn write(path: &Path, stats: &Value) -> Result<(), Failure> {
    let mut stats = stats.clone();
    if let Some(members) = stats.as_object_mut() {
        members.insert("program".to_owned(), PROGRAM.into());
    }
    write_whole(path, format!("{stats:#}\n"))
}
