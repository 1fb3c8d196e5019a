//! Files that a key names and that somebody else decodes.

use std::path::PathBuf;

use super::assets::Assets;
use super::context::{Context, QUOTED};
use super::error::DocumentError;
use super::keys::Keys;
use super::path::{Wanted, resolve};
use super::source::{Place, escaped};
use super::values::text_at;

/// Largest picture that is read, bytes.
const MOST_PICTURE_BYTES: u64 = 1 << 30;

/// The file behind a key, and who can decode it; an error is left if it is not there or nobody can.
pub fn asset(
    keys: &Keys<'_>,
    key: &'static str,
    endings: &'static [&'static str],
) -> Option<(&'static dyn Assets, PathBuf, Place)> {
    let block = keys.reader()?;
    let (written, at) = text_at(block.cx, block.node(key)?, key)?;
    let wanted = Wanted {
        endings,
        most_bytes: MOST_PICTURE_BYTES,
    };
    let file = resolve(block.cx, written, at, wanted)?;
    let assets = block.cx.assets;
    if assets.is_none() {
        let help = "read this leaf with the renderer, which decodes pictures and meshes";
        bad_file(block.cx, at, written, "cannot be decoded here", help);
    }
    Some((assets?, file, at.clone()))
}

/// Reports a file that is of no use.
pub fn bad_file(cx: &Context, at: &Place, path: &str, problem: &str, help: &str) {
    let error = DocumentError::BadFile {
        path: escaped(path, 2 * QUOTED),
        problem: escaped(problem, 8 * QUOTED),
        help: help.to_owned(),
    };
    cx.error(at, error);
}
