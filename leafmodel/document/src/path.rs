//! Paths of a scene file: inside its folder or those that the user allows, regular files only, of
//! bearable size.

use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::sync::{PoisonError, RwLock};

use super::context::{Context, QUOTED};
use super::error::DocumentError;
use super::nearest::nearest;
use super::source::{Place, escaped};

/// Folders whose files every document may name, besides those of its own folder.
static ALLOWED: RwLock<Vec<PathBuf>> = RwLock::new(Vec::new());

/// Lets the documents of this process name files in these folders too, links followed. Nothing but
/// the person who runs the program may decide that.
pub fn allow(folders: Vec<PathBuf>) {
    *ALLOWED.write().unwrap_or_else(PoisonError::into_inner) = folders;
}

/// The folders that are allowed besides.
pub fn allowed() -> Vec<PathBuf> {
    ALLOWED
        .read()
        .unwrap_or_else(PoisonError::into_inner)
        .clone()
}

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
    match confined(&cx.folder, &allowed(), written).and_then(|file| check(file, written, wanted)) {
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

/// Follows a path and makes sure that it ends inside the folder or one of those that are allowed.
fn confined(folder: &Path, allowed: &[PathBuf], written: &str) -> Result<PathBuf, DocumentError> {
    let path = escaped(written, 2 * QUOTED);
    let relative = Path::new(written);
    let folder = fs::canonicalize(folder).map_err(|error| DocumentError::BadFile {
        path: path.clone(),
        problem: format!("cannot be looked up: {error}"),
        help: "make the scene's folder readable".to_owned(),
    })?;
    let is_inside = |file: &Path| {
        let mut folders = allowed.iter();
        file.starts_with(&folder) || folders.any(|allowed| file.starts_with(allowed))
    };
    // Before anything is looked up, so that nothing can be learnt about files outside.
    match leads(relative) {
        Leads::Nowhere => return Err(DocumentError::NotARegularFile { path }),
        Leads::Outside => {
            let plain = without_steps_back(&folder.join(relative));
            if !allowed.iter().any(|allowed| plain.starts_with(allowed)) {
                return Err(DocumentError::PathOutside { path });
            }
        }
        Leads::Inside => {}
    }
    let file = match fs::canonicalize(folder.join(relative)) {
        Ok(file) => file,
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
            let nearest = neighbour(&folder, relative, is_inside);
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
    if is_inside(&file) {
        Ok(file)
    } else {
        Err(DocumentError::PathOutside { path })
    }
}

/// Where a path leads by its words alone.
enum Leads {
    Inside,
    /// To the folder itself.
    Nowhere,
    Outside,
}

fn leads(path: &Path) -> Leads {
    let mut depth = 0_i32;
    for component in path.components() {
        match component {
            Component::Normal(_) => depth += 1,
            Component::ParentDir => depth -= 1,
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => return Leads::Outside,
        }
        if depth < 0 {
            return Leads::Outside;
        }
    }
    if depth == 0 {
        Leads::Nowhere
    } else {
        Leads::Inside
    }
}

/// A whole path without `..`, by its words alone.
fn without_steps_back(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir => {}
            Component::Normal(_) | Component::RootDir | Component::Prefix(_) => {
                plain.push(component);
            }
        }
    }
    plain
}

/// A file in the same folder with nearly the same name, as a path like the one written.
fn neighbour(folder: &Path, relative: &Path, is_inside: impl Fn(&Path) -> bool) -> Option<String> {
    const LOOKED_AT: usize = 1000;
    let name = relative.file_name()?.to_str()?;
    let parent = relative.parent()?;
    let inside = fs::canonicalize(folder.join(parent)).ok()?;
    if !is_inside(&inside) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_names_files_in_its_folder_and_in_those_that_the_user_allows() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = fs::canonicalize(folder.path()).expect("it is there");
        for name in [
            "scene/own.exr",
            "skies/deep/sky.exr",
            "skies2/sky.exr",
            "other.exr",
        ] {
            let file = root.join(name);
            fs::create_dir_all(file.parent().expect("a folder")).expect("it can be made");
            fs::write(file, b"").expect("it can be written");
        }
        let scene = root.join("scene");
        let allowed = [root.join("skies")];
        let shut: &[PathBuf] = &[];
        let absolute = root.join("skies/deep/sky.exr").display().to_string();
        let outside = |folders: &[PathBuf], written: &str| {
            let error = confined(&scene, folders, written).expect_err(written);
            assert!(
                matches!(error, DocumentError::PathOutside { .. }),
                "{error}"
            );
            let help = error.help().expect("there is one");
            assert!(help.contains("--allow DIR"), "{help}");
        };
        for written in ["../skies/deep/sky.exr", absolute.as_str()] {
            outside(shut, written);
            assert!(confined(&scene, &allowed, written).is_ok(), "{written}");
        }
        assert!(confined(&scene, shut, "own.exr").is_ok());
        for written in [
            "../skies2/sky.exr",
            "../other.exr",
            "../skies/../other.exr",
            "../skies/deep/../../other.exr",
        ] {
            outside(&allowed, written);
        }
        let missing = confined(&scene, &allowed, "../skies/deep/sky.exrr");
        let nearest = Some("../skies/deep/sky.exr".to_owned());
        let path = "../skies/deep/sky.exrr".to_owned();
        assert_eq!(missing, Err(DocumentError::FileMissing { path, nearest }));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_counts_as_the_file_that_it_leads_to() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = fs::canonicalize(folder.path()).expect("it is there");
        for name in ["scene", "skies"] {
            fs::create_dir(root.join(name)).expect("it can be made");
        }
        fs::write(root.join("skies/sky.exr"), b"").expect("it can be written");
        fs::write(root.join("other.exr"), b"").expect("it can be written");
        let link = |to: &str, at: &str| {
            std::os::unix::fs::symlink(root.join(to), root.join(at)).expect("it can be made");
        };
        link("skies/sky.exr", "scene/in.exr");
        link("other.exr", "skies/out.exr");
        let scene = root.join("scene");
        let allowed = [root.join("skies")];
        assert!(confined(&scene, &[], "in.exr").is_err());
        assert!(confined(&scene, &allowed, "in.exr").is_ok());
        assert!(confined(&scene, &allowed, "../skies/out.exr").is_err());
    }
}
