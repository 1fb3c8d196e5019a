//! A model that a scene names: its file, and those that it names itself.

use std::fs;
use std::path::{Path, PathBuf};

use leafmodel::document::context::QUOTED;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::path::{Wanted, resolve};
use leafmodel::document::source::escaped;
use leafmodel::document::value_kind::{FilePath, NamedFile};

use super::container::{Container, FileKind};

/// Largest file of a model that is read, bytes.
const MOST_BYTES: u64 = 4 << 30;

/// A glTF 2.0 file, inside the scene's folder.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct ModelFile {
    /// The file.
    #[key(
        "path",
        required,
        FilePath::of("the path of a glTF file", &["glb", "gltf"], MOST_BYTES)
    )]
    pub path: NamedFile,
    /// The files that it names, as written there and resolved.
    #[key(with = Self::find_beside)]
    pub beside: Vec<(String, PathBuf)>,
    /// Metres per unit of the file; glTF is in metres.
    #[key("scale", above(0.0, 1e6), default = 1.0)]
    pub scale: f64,
}

impl ModelFile {
    /// Looks up the files that it names, which are beside it and must be there; all of them lie in the
    /// scene's folder.
    fn find_beside(&mut self, keys: &mut Keys<'_>) {
        let NamedFile { written, file } = &self.path;
        let Some(block) = keys.reader().filter(|_| !file.as_os_str().is_empty()) else {
            return;
        };
        let at = block.node("path").map_or(&block.at, |node| &node.at);
        let names = match names(file) {
            Ok(names) => names,
            Err(problem) => {
                let error = DocumentError::BadFile {
                    path: escaped(written, 2 * QUOTED),
                    problem,
                    help: "save the model anew as glTF 2.0".to_owned(),
                };
                block.cx.error(at, error);
                return;
            }
        };
        let folder = Path::new(written).parent().unwrap_or(Path::new(""));
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
                self.beside.push((name, file));
            }
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
