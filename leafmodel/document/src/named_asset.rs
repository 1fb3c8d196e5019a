//! Files that a key names and that somebody else decodes.

use std::path::Path;

use super::assets::Assets;
use super::context::{Context, QUOTED};
use super::error::DocumentError;
use super::keys::Keys;
use super::path::{Wanted, resolve};
use super::source::{Place, escaped};
use super::values::text_at;

/// Largest picture that is read, bytes.
const MOST_PICTURE_BYTES: u64 = 1 << 30;

/// What is decoded of the file behind a key, by whoever can: `decode` gives it, or what is wrong with
/// the file and what to do about it. Errors are left; nothing is decoded where there are some.
pub fn decoded<T>(
    keys: &Keys<'_>,
    key: &'static str,
    endings: &'static [&'static str],
    decode: impl FnOnce(&dyn Assets, &Path) -> Result<T, (String, &'static str)>,
) -> Option<T> {
    let block = keys.reader().filter(|_| keys.is_sound())?;
    let (written, at) = text_at(block.cx, block.node(key)?, key)?;
    let wanted = Wanted {
        endings,
        most_bytes: MOST_PICTURE_BYTES,
    };
    let file = resolve(block.cx, written, at, wanted)?;
    let read = match block.cx.assets {
        Some(assets) => decode(assets, &file),
        None => Err((
            "cannot be decoded here".to_owned(),
            "read this leaf with the renderer, which decodes pictures and meshes",
        )),
    };
    read.map_err(|(problem, help)| bad_file(block.cx, at, written, &problem, help))
        .ok()
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
