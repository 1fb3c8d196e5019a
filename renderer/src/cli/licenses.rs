//! `lamina licenses`: under which terms the program and what is in it may be used.

use crate::cli::terminal::say;

/// Lamina's own licences, the notices of its data, and those of the crates that it is built from:
/// written by `renderer/program/packaging/licenses`.
const LICENSES: &str = include_str!("licenses.txt");

pub(super) fn run() {
    say(LICENSES.trim_end());
}
