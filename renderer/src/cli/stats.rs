//! Times, memory and speed, for people and for scripts.

use std::path::Path;

use serde_json::Value;

use crate::checkpoint::PROGRAM;
use crate::cli::Failure;
use crate::cli::places::write_whole;

/// Greatest resident memory of this process so far, MiB; `None` where the system does not report
/// it.
pub(super) fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

/// Writes a JSON object atomically, with the version of the program as `program`.
pub(super) fn write(path: &Path, stats: &Value) -> Result<(), Failure> {
    let mut stats = stats.clone();
    if let Some(members) = stats.as_object_mut() {
        members.insert("program".to_owned(), PROGRAM.into());
    }
    write_whole(path, format!("{stats:#}\n"))
}
