//! Paths of a scene file: inside its folder, regular files only, of bearable size.

use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

use super::context::{Context, QUOTED};
use super::error::DocumentError;
use super::nearest::nearest;
use super::source::{Place, escaped};

/// What a path may lead to.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// Endings of the file's name, lower case, without the dot.
    pub endings: &'static [&'static str],
    /// Most bytes that are read.
    pub most_bytes: u64,
}

/// The file behind a path of the scene, with links followed; checked, not opened.
pub fn resolve(cx: &Context, written: &str, at: &Place, wanted: Wanted) -> Option<PathBuf> {
    match confined(&cx.folder, written).and_then(|file| check(file, written, wanted)) {
        Ok(file) => {
            cx.inputs.borrow_mut().push(file.clone());
            Some(file)
        }
        Err(error) => {
            cx.error(at, error);
            None
        }
    }
}

/// Follows a path and makes sure that it ends inside the folder.
fn confined(folder: &Path, written: &str) -> Result<PathBuf, DocumentError> {
    let path = escaped(written, 2 * QUOTED);
    let relative = Path::new(written);
    // Before anything is looked up, so that nothing can be learnt about files outside.
    let mut depth = 0_i32;
    for component in relative.components() {
        match component {
            Component::Normal(_) => depth += 1,
            Component::ParentDir => depth -= 1,
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => depth = i32::MIN / 2,
        }
        if depth < 0 {
            return Err(DocumentError::PathOutside { path });
        }
    }
    if depth == 0 {
        return Err(DocumentError::NotARegularFile { path });
    }
    let folder = fs::canonicalize(folder).map_err(|error| DocumentError::BadFile {
        path: path.clone(),
        problem: format!("cannot be looked up: {error}"),
        help: "make the scene's folder readable".to_owned(),
    })?;
    let file = match fs::canonicalize(folder.join(relative)) {
        Ok(file) => file,
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
            let nearest = neighbour(&folder, relative);
            return Err(DocumentError::FileMissing { path, nearest });
        }
        Err(error) => {
            return Err(DocumentError::BadFile {
                path,
                problem: format!("cannot be looked up: {error}"),
                help: "use another file name, or make the file readable".to_owned(),
            });
        }
    };
    if file.starts_with(&folder) {
        Ok(file)
    } else {
        Err(DocumentError::PathOutside { path })
    }
}

/// A file in the same folder with nearly the same name, as a path like the one written.
fn neighbour(folder: &Path, relative: &Path) -> Option<String> {
    const LOOKED_AT: usize = 1000;
    let name = relative.file_name()?.to_str()?;
    let parent = relative.parent()?;
    let inside = fs::canonicalize(folder.join(parent)).ok()?;
    if !inside.starts_with(folder) {
        return None;
    }
    let mut names: Vec<String> = fs::read_dir(inside)
        .ok()?
        .take(LOOKED_AT)
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    // Folders are listed in no particular order.
    names.sort();
    let found = nearest(name, names.iter().map(String::as_str))?;
    Some(escaped(parent.join(found).to_str()?, 2 * QUOTED))
}

fn check(file: PathBuf, written: &str, wanted: Wanted) -> Result<PathBuf, DocumentError> {
    let path = escaped(written, 2 * QUOTED);
    let bad = |problem: String, help: &str| DocumentError::BadFile {
        path: path.clone(),
        problem,
        help: help.to_owned(),
    };
    let metadata = fs::metadata(&file)
        .map_err(|error| bad(format!("cannot be read: {error}"), "make the file readable"))?;
    if !metadata.is_file() {
        return Err(DocumentError::NotARegularFile { path });
    }
    let ending = Path::new(written)
        .extension()
        .and_then(|ending| ending.to_str())
        .unwrap_or("")
        .to_lowercase();
    if !wanted.endings.contains(&ending.as_str()) {
        let endings: Vec<String> = wanted
            .endings
            .iter()
            .map(|ending| format!(".{ending}"))
            .collect();
        let endings = endings.join(" or ");
        return Err(bad(
            format!("is not a {endings} file"),
            "convert it, and let its name end in its format",
        ));
    }
    if metadata.len() > wanted.most_bytes {
        let problem = format!(
            "has {} MiB, more than the {} MiB that are read",
            metadata.len() >> 20,
            wanted.most_bytes >> 20
        );
        return Err(bad(problem, "make it smaller"));
    }
    Ok(file)
}
