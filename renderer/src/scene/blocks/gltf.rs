//! The files of a glTF model: the one that a scene names, and those that it names itself.

use std::fs;
use std::path::{Path, PathBuf};

use leafmodel::document::context::QUOTED;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::path::{Wanted, resolve};
use leafmodel::document::source::escaped;
use leafmodel::document::value_kind::{FilePath, NamedFile};

use crate::scene::model::{Container, FileKind};

/// Largest file of a model that is read, bytes.
const MOST_BYTES: u64 = 4 << 30;

/// The key `path`. Files that the glTF file names are looked up beside it and must be there; all of
/// them lie in the scene's folder.
pub(super) fn gltf(file: &mut PathBuf, beside: &mut Vec<(String, PathBuf)>, keys: &mut Keys<'_>) {
    const PATH: FilePath = FilePath::of("the path of a glTF file", &["glb", "gltf"], MOST_BYTES);
    let mut named = NamedFile::default();
    keys.required("path", &mut named, PATH, "The file.");
    *file = named.file;
    let Some(block) = keys.reader().filter(|_| !file.as_os_str().is_empty()) else {
        return;
    };
    let at = block.node("path").map_or(&block.at, |node| &node.at);
    let names = match names(file) {
        Ok(names) => names,
        Err(problem) => {
            let error = DocumentError::BadFile {
                path: escaped(&named.written, 2 * QUOTED),
                problem,
                help: "save the model anew as glTF 2.0".to_owned(),
            };
            block.cx.error(at, error);
            return;
        }
    };
    let folder = Path::new(&named.written).parent().unwrap_or(Path::new(""));
    for (name, kind) in names {
        let wanted = Wanted {
            endings: match kind {
                FileKind::Buffer => &["bin"],
                FileKind::Picture => &["png", "jpg", "jpeg"],
            },
            most_bytes: MOST_BYTES,
        };
        let written = folder.join(&name);
        if let Some(file) = resolve(block.cx, &written.to_string_lossy(), at, wanted) {
            beside.push((name, file));
        }
    }
}

/// The names of the files that a glTF file names, or what is wrong with it.
fn names(file: &Path) -> Result<Vec<(String, FileKind)>, String> {
    let bytes = fs::read(file).map_err(|error| format!("cannot be read: {error}"))?;
    let container = Container::open(&bytes);
    let container = container.map_err(|error| format!("cannot be used: {error}"))?;
    Ok(container.files())
}
