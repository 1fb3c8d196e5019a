//! From a scene file, or its text, to a [`Description`] or a report of all errors.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::fs;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use leafmodel::document::context::QUOTED;
use leafmodel::document::names::{LONGEST_FILE, is_title, may_be_in_a_title};
use leafmodel::document::opened::Opened;
use leafmodel::document::report::{DocumentErrors, Warning};
use leafmodel::document::schema::BlockSchema;
use leafmodel::document::schema::json::{self, Alone};
use leafmodel::document::source::escaped;
use leafmodel::plan_file;

use super::assets::{self, AssetError, DECODER};
use super::blocks::{self, Purpose};
use super::description::{Description, Leaf, Named, Picture, Solid};
use super::expand::{Fault, expand};
use super::fingerprint::{fingerprint, fnv1a, hexadecimal, identity};

/// A scene that was accepted.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub description: Description,
    /// Warnings about input that is allowed but probably not intended.
    pub warnings: Vec<Warning>,
    /// Resolved paths of the files that it names, which no output may overwrite.
    pub inputs: Vec<PathBuf>,
    /// What tells the scene from others, but for the bytes of its files.
    identity: String,
}

impl Loaded {
    /// A 64-bit hash of everything that samples depend on, left out what is compared by itself (number
    /// of samples, seed, target noise) and the development of the picture.
    ///
    /// # Errors
    ///
    /// [`AssetError`] if a file of the scene cannot be read.
    pub fn fingerprint(&self) -> Result<u64, AssetError> {
        fingerprint(&self.identity, &self.inputs)
    }

    /// The hashes of the files that it names, by their places in the folder of the scene or, outside
    /// of it, by their names.
    ///
    /// # Errors
    ///
    /// [`AssetError`] if a file of the scene cannot be read.
    pub fn files(&self, folder: &Path) -> Result<BTreeMap<String, String>, AssetError> {
        let whole = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        let hashed = |file: &PathBuf| {
            let place = [folder, &whole].map(|folder| file.strip_prefix(folder).ok());
            let place = place.into_iter().flatten().next();
            let name = place.or(file.file_name().map(Path::new)).unwrap_or(file);
            let hash = fnv1a(&assets::read(file)?);
            // The same on every system.
            let name = name.to_string_lossy().replace(MAIN_SEPARATOR, "/");
            Ok((name, hexadecimal(hash)))
        };
        self.inputs.iter().map(hashed).collect()
    }
}

/// Reads the scene file at `path`, with overrides `key=value` written as in the file.
///
/// Files that the scene names are searched in the file's folder and checked for existence; only
/// tables of spectra are read.
///
/// # Errors
///
/// [`DocumentErrors`] with all errors of the scene and its overrides.
pub fn load(path: &Path, overrides: &[String]) -> Result<Loaded, DocumentErrors> {
    let opened = Opened::file(path, overrides, schema)?;
    into_scene(opened, &default_name(path), Purpose::Picture)
}

/// As [`load`], for the instruments of the scene: spectra of surfaces must cover the wavelengths of
/// the instruments, those of lights need not cover anything, and there need be no light.
///
/// # Errors
///
/// [`DocumentErrors`] with all errors of the scene and its overrides.
pub fn load_for_instruments(path: &Path, overrides: &[String]) -> Result<Loaded, DocumentErrors> {
    let opened = Opened::file(path, overrides, schema)?;
    into_scene(opened, &default_name(path), Purpose::Instruments)
}

/// The kind of the film of the scene file at `path`, if it can be read so far.
pub fn film_kind(path: &Path, overrides: &[String]) -> Option<String> {
    let opened = Opened::file(path, overrides, schema).ok()?;
    let film = opened.tree.get("film")?.node.table()?;
    Some(film.0.first()?.key.clone())
}

/// Reads a scene from its text.
///
/// `file_name` is its name in reports; paths are relative to `folder`.
///
/// # Errors
///
/// [`DocumentErrors`] with all errors of the scene and its overrides.
pub fn parse(
    text: &str,
    file_name: &str,
    folder: &Path,
    overrides: &[String],
) -> Result<Loaded, DocumentErrors> {
    parse_for(Purpose::Picture, text, (file_name, folder), overrides)
}

/// As [`load_for_instruments`] of a scene's text; `file_name` and `folder` as for [`parse`].
///
/// # Errors
///
/// [`DocumentErrors`] with all errors of the scene and its overrides.
pub fn parse_for_instruments(
    text: &str,
    file_name: &str,
    folder: &Path,
    overrides: &[String],
) -> Result<Loaded, DocumentErrors> {
    parse_for(Purpose::Instruments, text, (file_name, folder), overrides)
}

fn parse_for(
    purpose: Purpose,
    text: &str,
    (file_name, folder): (&str, &Path),
    overrides: &[String],
) -> Result<Loaded, DocumentErrors> {
    let name = default_name(&folder.join(file_name));
    let shown = escaped(file_name, 4 * QUOTED);
    let opened = Opened::text(text, &shown, folder, overrides, schema)?;
    into_scene(opened, &name, purpose)
}

/// Reads only the leaves of the file at `path`, which may be a scene or hold nothing but leaves.
///
/// # Errors
///
/// [`DocumentErrors`] with all errors of the leaves and the overrides; the rest of the file is
/// ignored.
pub fn load_leaves(path: &Path, overrides: &[String]) -> Result<Vec<Named<Leaf>>, DocumentErrors> {
    into_leaves(Opened::file(path, overrides, schema)?)
}

/// A file of leaves only, of which margin and veins may be all.
const LEAVES_ALONE: Alone = Alone {
    section: "leaves",
    without: &["film", "camera", "lights", "objects"],
    optional: "contents",
};

/// The JSON Schema of scenes and of files of leaves only.
pub fn json_schema() -> serde_json::Value {
    json::json_schema(&schema(), LEAVES_ALONE, "A scene of Lamina, format 1")
}

/// Leaves with warnings, or all errors.
pub type LeavesRead = Result<(Vec<Named<Leaf>>, Vec<Warning>), DocumentErrors>;

/// Reads the leaves of the file at `path` if it is a file of leaves only: it has leaves, and none
/// of the sections that only a picture needs.
pub fn load_if_only_leaves(path: &Path, overrides: &[String]) -> Option<LeavesRead> {
    let mut opened = Opened::file(path, overrides, schema).ok()?;
    let has = |section: &&str| opened.tree.get(section).is_some();
    if !has(&LEAVES_ALONE.section) || LEAVES_ALONE.without.iter().any(has) {
        return None;
    }
    opened.cx.assets = Some(&DECODER);
    let leaves = blocks::read_only_leaves(&opened.cx, &opened.tree);
    Some(opened.finish(leaves))
}

/// The number of leaves of the file at `path` if margin and veins of each can be grown, whether or
/// not contents are said.
pub fn count_veins(path: &Path, overrides: &[String]) -> Option<usize> {
    let leaves = plan_file::load_veins(path, Some(&DECODER), overrides);
    leaves.ok().map(|leaves| leaves.len())
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
) -> Result<Vec<Named<Leaf>>, DocumentErrors> {
    let shown = escaped(file_name, 4 * QUOTED);
    into_leaves(Opened::text(text, &shown, folder, overrides, schema)?)
}

/// Reads only `[picture]` of a scene's text; `shown` is the text's name in reports.
///
/// # Errors
///
/// [`DocumentErrors`] with all errors of that block and of the overrides; the rest of the text is
/// ignored.
pub fn parse_picture(
    text: &str,
    shown: &str,
    overrides: &[String],
) -> Result<Picture, DocumentErrors> {
    let shown = escaped(shown, 4 * QUOTED);
    let opened = Opened::text(text, &shown, Path::new("."), overrides, schema)?;
    let picture = blocks::read_only_picture(&opened.cx, &opened.tree);
    opened.finish(picture).map(|(picture, _)| picture)
}

/// A block `[solids.NAME]` after `format = 1`, which reads back as the same body in a folder with
/// the mesh and the pictures that it names. Keys with default values are left out; the order of
/// keys is fixed.
pub fn solid_to_toml(name: &str, solid: &Solid) -> String {
    solid.to_toml(name)
}

/// The schema of a scene file.
pub fn schema() -> BlockSchema {
    blocks::schema()
}

fn into_scene(
    mut opened: Opened,
    default_name: &str,
    purpose: Purpose,
) -> Result<Loaded, DocumentErrors> {
    opened.cx.assets = Some(&DECODER);
    let recorded = std::mem::take(&mut opened.recorded);
    let authored = blocks::read(&opened.cx, &opened.tree, default_name, recorded, purpose);
    let mut said = String::new();
    let description = authored.and_then(|authored| {
        said = identity(&opened.tree, &authored);
        let expanded = expand(authored);
        let refuse = |Fault {
                          path,
                          problem,
                          help,
                      }| {
            blocks::refuse(&opened.cx, &opened.tree, &path, problem, help);
        };
        expanded.map_err(refuse).ok()
    });
    let inputs = opened.cx.inputs.take();
    let (description, warnings) = opened.finish(description)?;
    Ok(Loaded {
        description,
        warnings,
        inputs,
        identity: said,
    })
}

fn into_leaves(mut opened: Opened) -> Result<Vec<Named<Leaf>>, DocumentErrors> {
    opened.cx.assets = Some(&DECODER);
    let leaves = blocks::read_only_leaves(&opened.cx, &opened.tree);
    opened.finish(leaves).map(|(leaves, _)| leaves)
}

/// The folder's name for `scene.toml`, else the file's without its ending; characters that a
/// scene's name cannot have become `-`.
fn default_name(path: &Path) -> String {
    let is_scene = path.file_name().is_some_and(|name| name == "scene.toml");
    let folder = is_scene.then(|| {
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()
    });
    let folder = folder.flatten();
    let of_folder = folder.as_deref().and_then(Path::file_name);
    let name = of_folder.or(path.file_stem());
    let mut name: String = name
        .map(|name| name.to_string_lossy().into_owned())
        .unwrap_or_default()
        .chars()
        .take(100)
        .map(|character| {
            if may_be_in_a_title(character) {
                character
            } else {
                '-'
            }
        })
        .collect();
    while name.len() > LONGEST_FILE {
        name.pop();
    }
    if is_title(&name) {
        name
    } else {
        "scene".to_owned()
    }
}
