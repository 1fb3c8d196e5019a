//! From a scene file, or its text, to a [`Description`] or a report of everything that is wrong.

mod one_leaf;

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use leafmodel::leaf::LeafPlan;
use toml::de::DeTable;

use super::description::{Description, Leaf, Named, Solid};
use super::document::context::{Context, QUOTED};
use super::document::names::is_name;
use super::document::tree::Table;
use super::document::{overrides, read, read_leaves, write, write_leaf, write_solid};
use super::error::{LocatedError, SceneError};
use super::report::{SceneErrors, Warning};
use super::source::{Place, Sources, escaped, line_of_byte};

pub use one_leaf::{LeafFile, LeafNotChosen, load_one_leaf};

/// Largest scene file, bytes.
const MOST_BYTES: u64 = 16 << 20;

/// A scene that was accepted.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub description: Description,
    /// What is allowed and hardly meant.
    pub warnings: Vec<Warning>,
    /// The files that it names, without links and `..`; nothing should be written over them.
    pub inputs: Vec<PathBuf>,
}

/// Reads the scene file at `path`, with overrides `key=value` written as in the file.
///
/// Files that the scene names are looked for in the file's folder and checked, not read; tables
/// of spectra are read.
///
/// # Errors
///
/// [`SceneErrors`] with everything that is wrong with the scene and its overrides.
pub fn load(path: &Path, overrides: &[String]) -> Result<Loaded, SceneErrors> {
    let opened = Opened::file(path, overrides)?;
    opened.into_scene(&default_name(path))
}

/// Reads only the leaves of the file at `path`, which may be a scene or hold nothing but leaves.
///
/// # Errors
///
/// [`SceneErrors`] with everything that is wrong with the leaves and the overrides; what else the
/// file holds is not looked at.
pub fn load_leaves(path: &Path, overrides: &[String]) -> Result<Vec<Named<Leaf>>, SceneErrors> {
    let opened = Opened::file(path, overrides)?;
    let leaves = read_leaves(&opened.cx, &opened.tree);
    opened.finish(leaves).map(|(leaves, _)| leaves)
}

/// Reads only the leaves of a text; `file_name` and `folder` as for [`parse`].
///
/// # Errors
///
/// As [`load_leaves`].
pub fn parse_leaves(
    text: &str,
    file_name: &str,
    folder: &Path,
    overrides: &[String],
) -> Result<Vec<Named<Leaf>>, SceneErrors> {
    let shown = escaped(file_name, 4 * QUOTED);
    let opened = Opened::text(text, &shown, folder, overrides)?;
    let leaves = read_leaves(&opened.cx, &opened.tree);
    opened.finish(leaves).map(|(leaves, _)| leaves)
}

/// A file with the one leaf `name` that [`parse_leaves`] reads back to the same plan. Keys are left out where
/// they have their default, and always come in the same order.
///
/// A plan with numbers that no scene may have gives a file that is refused when it is read.
pub fn leaf_to_toml(name: &str, plan: &LeafPlan) -> String {
    write_leaf::to_toml(name, plan)
}

/// A block `[solids.NAME]` after `format = 1`, which reads back to the same body where the mesh and the pictures that it names
/// are. Keys are left out where they have their default, and always come in the same order.
pub fn solid_to_toml(name: &str, solid: &Solid) -> String {
    write_solid::to_toml(name, solid)
}

/// Reads a scene from its text.
///
/// `file_name` is what reports call it; paths start at `folder`.
///
/// # Errors
///
/// [`SceneErrors`] with everything that is wrong with the scene and its overrides.
pub fn parse(
    text: &str,
    file_name: &str,
    folder: &Path,
    overrides: &[String],
) -> Result<Loaded, SceneErrors> {
    let name = default_name(&folder.join(file_name));
    let shown = escaped(file_name, 4 * QUOTED);
    Opened::text(text, &shown, folder, overrides)?.into_scene(&name)
}

/// A file as a tree, with overrides put in and syntax errors noted, before its blocks are read.
struct Opened {
    cx: Context,
    tree: Table,
    syntax: Vec<LocatedError>,
    /// What is recorded as the scene's text.
    recorded: String,
}

impl Opened {
    fn file(path: &Path, overridden: &[String]) -> Result<Self, SceneErrors> {
        let shown = escaped(&path.display().to_string(), 4 * QUOTED);
        let text =
            read_text(path, &shown).map_err(|error| SceneErrors::of_a_file(&shown, error))?;
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            Some(_) | None => Path::new("."),
        };
        Self::text(&text, &shown, folder, overridden)
    }

    fn text(
        text: &str,
        shown: &str,
        folder: &Path,
        overridden: &[String],
    ) -> Result<Self, SceneErrors> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.len() as u64 > MOST_BYTES {
            let error = too_large(shown, text.len() as u64);
            return Err(SceneErrors::of_a_file(shown, error));
        }
        let mut sources = Sources::default();
        let source = sources.add(shown, text);
        let cx = Context::new(sources, folder.to_owned());
        let (parsed, syntax) = DeTable::parse_recoverable(text);
        let syntax = syntax
            .iter()
            .map(|error| syntax_error(text, source, error.message(), error.span()))
            .collect();
        let mut tree = Table::from_toml(source, parsed.into_inner());
        for text in overridden {
            overrides::apply(&cx, &mut tree, "-D", text);
        }
        let recorded = if overridden.is_empty() {
            text.to_owned()
        } else {
            write::to_toml(&tree)
        };
        Ok(Self {
            cx,
            tree,
            syntax,
            recorded,
        })
    }

    fn into_scene(mut self, default_name: &str) -> Result<Loaded, SceneErrors> {
        let recorded = std::mem::take(&mut self.recorded);
        let description = read(&self.cx, &self.tree, default_name, recorded);
        let inputs = self.cx.inputs.take();
        let (description, warnings) = self.finish(description)?;
        Ok(Loaded {
            description,
            warnings,
            inputs,
        })
    }

    /// What was read, unless there is any error.
    fn finish<T>(self, read: Option<T>) -> Result<(T, Vec<Warning>), SceneErrors> {
        let (sources, errors, remarks) = self.cx.into_parts();
        let sources = Arc::new(sources);
        match read {
            Some(read) if self.syntax.is_empty() && errors.is_empty() => {
                let warnings = remarks.into_iter();
                let warnings = warnings.map(|remark| Warning::new(remark, &sources));
                Ok((read, warnings.collect()))
            }
            Some(_) | None => {
                let errors = with_syntax(&sources, self.syntax, errors);
                Err(SceneErrors::new(sources, errors))
            }
        }
    }
}

/// All errors in the order of the text. Beside syntax errors only those are kept that are about a
/// value of its own: the rest may be nothing but consequences.
fn with_syntax(
    sources: &Sources,
    mut syntax: Vec<LocatedError>,
    errors: Vec<LocatedError>,
) -> Vec<LocatedError> {
    if syntax.is_empty() {
        let mut errors = errors;
        errors.sort_by_key(order);
        return errors;
    }
    let text = sources.get(0).map_or("", |source| source.text.as_str());
    let ends: Vec<usize> = text.match_indices('\n').map(|(end, _)| end).collect();
    let line_of = |located: &LocatedError| {
        let start = located.at.as_ref().map_or(0, |at| at.span.start);
        ends.partition_point(|end| *end < start)
    };
    let broken: BTreeSet<usize> = syntax.iter().map(line_of).collect();
    let kept = errors.into_iter().filter(|located| {
        let elsewhere = located.at.as_ref().is_some_and(|at| at.source != 0);
        // What the parser puts in place of a broken value has no extent.
        let written = located.at.as_ref().is_some_and(|at| !at.span.is_empty());
        elsewhere
            || (written && located.error.is_about_a_value() && !broken.contains(&line_of(located)))
    });
    // One slip often gives several errors in its line: the first says enough.
    syntax.sort_by_key(order);
    syntax.dedup_by_key(|located| line_of(located));
    syntax.extend(kept);
    syntax.sort_by_key(order);
    syntax
}

/// By place; errors of the file as a whole come last.
fn order(located: &LocatedError) -> (usize, usize) {
    located
        .at
        .as_ref()
        .map_or((usize::MAX, 0), |at| (at.source, at.span.start))
}

fn syntax_error(
    text: &str,
    source: usize,
    message: &str,
    span: Option<std::ops::Range<usize>>,
) -> LocatedError {
    let span = span.unwrap_or(text.len()..text.len());
    let error = if message == "duplicate key" {
        let key = text.get(span.clone()).unwrap_or("");
        SceneError::Duplicate {
            key: escaped(key, QUOTED),
        }
    } else {
        SceneError::Syntax {
            message: escaped(message, 4 * QUOTED),
        }
    };
    let at = Some(Place { source, span });
    LocatedError { error, at }
}

fn read_text(path: &Path, shown: &str) -> Result<String, SceneError> {
    let shown = shown.to_owned();
    let unreadable = |error: std::io::Error| {
        if error.kind() == std::io::ErrorKind::NotFound {
            SceneError::FileMissing {
                path: shown.clone(),
                nearest: None,
            }
        } else {
            SceneError::BadFile {
                path: shown.clone(),
                problem: format!("cannot be read: {error}"),
                help: "name a scene file that is readable".to_owned(),
            }
        }
    };
    // Before it is opened: opening a pipe would wait for its other end.
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(SceneError::NotARegularFile { path: shown });
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MOST_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(too_large(&shown, metadata.len()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let line = line_of_byte(error.as_bytes(), byte);
        SceneError::NotUtf8 {
            path: shown.clone(),
            byte,
            line,
        }
    })
}

fn too_large(shown: &str, bytes: u64) -> SceneError {
    SceneError::BadFile {
        path: shown.to_owned(),
        problem: format!("has {bytes} bytes, more than the {MOST_BYTES} that are read"),
        help: "put tables and meshes into files of their own".to_owned(),
    }
}

/// The folder's name for `scene.toml`, else the file's without its ending; characters that a
/// scene's name cannot have become `-`.
fn default_name(path: &Path) -> String {
    let of_file = path.file_stem();
    let name = if path.file_name().is_some_and(|name| name == "scene.toml") {
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        let folder = fs::canonicalize(folder.unwrap_or(Path::new("."))).ok();
        folder
            .as_deref()
            .and_then(Path::file_name)
            .or(of_file)
            .map(std::ffi::OsStr::to_os_string)
    } else {
        of_file.map(std::ffi::OsStr::to_os_string)
    };
    let name: String = name
        .map(|name| name.to_string_lossy().into_owned())
        .unwrap_or_default()
        .chars()
        .take(100)
        .map(|character| {
            let allowed = character.is_ascii_alphanumeric() || matches!(character, '_' | '-');
            if allowed { character } else { '-' }
        })
        .collect();
    if is_name(&name) {
        name
    } else {
        "scene".to_owned()
    }
}
